"""Compile the contracts of examples/ and render their tokens."""

from __future__ import annotations

import base64
import io
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from eth_abi.abi import decode
from numpy.typing import NDArray
from PIL import Image as PillowImage

from tools import build_contracts
from tools.build_contracts import compile_once
from tools.ledger import World, call_data

ROOT = Path(__file__).resolve().parent.parent


def compile_example(name: str) -> tuple[bytes, dict[str, bytes]]:
    """Compile a source: the creation code of its contract, and the selectors by signature.

    The examples are compiled together, once: what they import is what takes the time.
    """
    examples = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "examples").rglob("*.sol"))
    output = _compiled(tuple(examples if name in examples else [name]))[name][Path(name).stem]["evm"]
    selectors = {signature: bytes.fromhex(value) for signature, value in output["methodIdentifiers"].items()}
    return bytes.fromhex(output["bytecode"]["object"]), selectors


@cache
def _compiled(names: tuple[str, ...]) -> dict[str, Any]:
    sources = build_contracts.follow_imports(names, ROOT)
    selection = {name: {"*": ["evm.bytecode.object", "evm.methodIdentifiers"]} for name in names}
    settings = build_contracts.settings(200, True)
    # only the renderer needs the IR pipeline, which takes much longer
    settings["viaIR"] = any("/pipeline/" in name for name in sources)
    return compile_once(build_contracts.request(sources, settings, selection))


def token_uri(world: World, token: bytes, number: int, minted: int) -> str:
    """Read the token's URI after so many were minted."""
    mints = minted * [call_data("mint()")]
    return str(decode(["string"], world.run(token, call_data("tokenURI(uint256)", number), before=mints))[0])


def picture(uri: str) -> NDArray[np.uint8]:
    """Decode the picture in a token's URI."""
    json_text = base64.b64decode(uri.removeprefix("data:application/json;base64,"), validate=True)
    assert len(uri) < 100_000
    image = json.loads(json_text)["image"].removeprefix("data:image/png;base64,")
    with PillowImage.open(io.BytesIO(base64.b64decode(image, validate=True))) as opened:
        return np.asarray(opened)
