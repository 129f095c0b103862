"""The figures under the picture, in words."""

from __future__ import annotations

from typing import Any

from ..fits import headline
from ..picture import Frame
from ..scene import Facts

#: What is said where nothing of the object is left.
_NONE = "nothing of the object is in sight"
_LOST = f" · {_NONE}: F fits it"


def figures(frame: Frame, facts: Facts, draft: bool) -> dict[str, Any]:
    """The message that shows the figures of a picture. draft: while it moves, which is smaller than what is wanted."""
    gas = "not counted" if frame.gas is None else f"{frame.gas:,}"
    size = f"{frame.width} x {frame.height}"
    texts = {"gas": gas, "gas-label": f"Gas, at {size}" if draft else "Gas"}
    if draft:
        return {"texts": texts}
    fits = headline(frame.fits) if frame.fits else "no gas is counted here"
    texts |= {
        "triangles": "" if frame.triangles is None else f"{frame.triangles:,}",
        "triangles-label": f"Triangles drawn, of {facts.triangles:,}",
        "bytes": f"{frame.calldata_bytes:,}",
        "fits": fits[0].upper() + fits[1:],
        "size": f"{size} pixels · {frame.seconds * 1000:.0f} ms in the EVM{'' if frame.triangles != 0 else _LOST}",
    }
    drawn = "" if frame.triangles is None else f"{frame.triangles:,} triangles, " if frame.triangles else f"{_NONE}, "
    return {
        "texts": texts,
        "attributes": {
            **{name: {"data-place": place(frame)} for name in ("figures", "strip")},
            "picture": {"aria-label": f"{facts.title}, {size} pixels, drawn by the contract"},
        },
        "say": f"{facts.title}: {gas} gas, {drawn}{fits}",
    }


def place(frame: Frame) -> str:
    """The most demanding place where the picture fits: "transaction", "call" or "none"."""
    kinds = {fit.kind for fit in frame.fits if fit.fits}
    transactions = [fit for fit in frame.fits if fit.kind == "transaction"]
    if transactions and all(fit.fits for fit in transactions):
        return "transaction"
    return "call" if "call" in kinds else "none"
