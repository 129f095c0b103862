"""What opens over the page: what can be taken away, gas and stages, the keys."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from functools import cache

from markupsafe import Markup
from nicegui.element import Element

from ...errors import ShackledError
from ..link import LOCAL
from ..picture import StagePicture
from ..pool import film_pixels
from ..scene import filled
from ..state import Size
from ..takeaway import MAX_PNG, SCALES, Kind, kind_of
from . import keys
from .elements import Html, drawing, mark, push, push_icon, tag, words
from .mint import offer_of
from .visitor import Message, Visitor

#: Files of the picture, each with a button of its own, by their kind; PNG has one for each scale.
PICTURES = ("bmp", "svg", "scene", "file")
#: Pictures and scale of a turntable.
TURNTABLES = ((24, 1), (24, 2), (60, 2))
#: What is shown as text to copy, by its kind.
SNIPPETS = ("python", "solidity", "cast", "cast-anywhere", "calldata")
#: Characters of a snippet that are shown; what is copied is whole.
SHOWN = 1500
_LOCAL = f"{LOCAL} For others, hand on the scene file or the program in Python."
_UPLOAD = "The file that you opened is kept in the memory of this server only; without it, the link says so."


class Dialogs:
    """The dialogs of one page."""

    def __init__(self, visitor: Visitor) -> None:
        """In the context of NiceGUI's page. What they show is filled in when they are opened."""
        take = f"/take/{visitor.name}"
        with _dialog("takeaway", "Download and share"), tag("div", "box", tabindex="0"):
            Html(*_files(take))
            self._mint = tag("section")
            Html(*(_snippet(take, kind_of(name)) for name in SNIPPETS))
        with _dialog("stages", "Gas, limits and stages", wide=True), tag("div", "box", tabindex="0"):
            self._fits = tag("section")
            self._pictures = tag("section")
            self._gas = tag("section")
        with _dialog("keys", "Keys and pointer"):
            Html(_keys())

    async def takeaway(self, visitor: Visitor) -> None:
        """Opens what can be taken away, with the snippets of the picture as it is."""
        is_upload = visitor.state.source.kind == "upload"
        notes = [_LOCAL] if visitor.is_local else []
        notes += [_UPLOAD] if is_upload else []
        texts, attributes = _turntables(visitor)
        await visitor.tell(
            {
                "open": "takeaway",
                "texts": {"link-note": " ".join(notes)} | texts,
                "attributes": {"take-file": {"hidden": None if is_upload else ""}} | _scales(visitor) | attributes,
            }
        )
        for kind in SNIPPETS:
            try:
                text = (await visitor.pool.take(visitor.name, visitor.state, kind)).data.decode()
            except ShackledError as error:
                text = str(error)
            if len(text) > SHOWN:
                text = f"{text[:SHOWN]}…\n\n{len(text):,} characters; Copy and Save take them all"
            await visitor.tell({"texts": {f"snippet-{kind}": text}})

    def wallets(self, visitor: Visitor) -> None:
        """What may be minted, by which wallets."""
        offer = offer_of(visitor.state.source)
        self._mint.clear()
        if offer is None:
            return
        with self._mint:
            words("h3", "Mint")
            words("p", offer.words, "quiet")
            if not visitor.wallets:
                words("p", "There is no wallet in this browser.", "quiet")
            buttons = [
                push(
                    f"Mint with {name}",
                    {"do": "mint", "wallet": number},
                    classes="button",
                    data_name="mint-start",
                    disabled=visitor.is_at("mint"),
                )
                for number, name in enumerate(visitor.wallets)
            ]
            status = mark("p", visitor.minting, data_text="mint-words", class_="quiet", role="status")
            Html(mark("div", *buttons, class_="scales"), status)

    async def stages(self, visitor: Visitor) -> None:
        """Opens gas by stage, the six stage pictures, and where the picture fits."""
        self._show_fits(visitor)
        for section, title in ((self._pictures, "The pipeline"), (self._gas, "Gas by stage")):
            section.clear()
            with section:
                words("h3", title)
                words("p", "Being computed …", "quiet", **({"data_text": "traced"} if section is self._gas else {}))
        await visitor.tell({"open": "stages"})
        state = visitor.state
        self._show_stages(await visitor.pool.stages(visitor.name, state))
        try:
            self._show_gas(await visitor.pool.stage_gas(visitor.name, state, progress=visitor.progress(_traced)))
        except ShackledError as error:
            self._gas.clear()
            with self._gas:
                words("h3", "Gas by stage")
                words("p", str(error), "quiet")

    async def node(self, visitor: Visitor) -> None:
        """Has the node make the picture, and says whether it is the same."""
        await visitor.tell({"texts": {"node": "The node renders …"}, "attributes": {"node": {"disabled": ""}}})
        try:
            result = await visitor.pool.compare(visitor.name, visitor.state)
            same = "the same bytes as here" if result.same else "OTHER bytes than here"
            text = f"{result.node}: {same}, in {result.seconds:.2f} s"
            await visitor.tell({"note" if result.same else "alert": text})
        finally:
            await visitor.tell({"texts": {"node": "Render on the node"}, "attributes": {"node": {"disabled": None}}})

    def _show_fits(self, visitor: Visitor) -> None:
        frame = visitor.frame
        self._fits.clear()
        with self._fits:
            words("h3", "Where it fits")
            if frame is None or not frame.fits:
                words("p", "No gas is counted here.", "quiet")
                return
            with tag("table"):
                with tag("thead"), tag("tr"):
                    for title, classes in (
                        ("Where", ""),
                        ("Gas allowed", "number"),
                        ("Used of it", "number"),
                        ("", ""),
                    ):
                        words("th" if title else "td", title, classes, **({"scope": "col"} if title else {}))
                with tag("tbody"):
                    for fit in frame.fits:
                        with tag("tr"):
                            words("th", fit.name, scope="row", title=fit.remark)
                            words("td", f"{fit.limit:,}", "number")
                            words("td", f"{fit.share:,.0%}", "number")
                            words("td", "fits" if fit.fits else fit.reason or "too small", "yes" if fit.fits else "no")

    def _show_stages(self, pictures: Sequence[StagePicture]) -> None:
        self._pictures.clear()
        with self._pictures:
            words("h3", "The pipeline")
            with tag("div", "stages"):
                for number, stage in enumerate(pictures, 1):
                    with tag("figure"):
                        source = f"data:image/png;base64,{base64.b64encode(stage.png).decode()}"
                        tag("img", src=source, alt=stage.title)
                        with tag("figcaption"):
                            words("b", f"{number}. {stage.title}")
                            words("span", stage.detail)

    def _show_gas(self, gas: Mapping[str, int]) -> None:
        total, largest = sum(gas.values()) or 1, max(gas.values(), default=1) or 1
        self._gas.clear()
        with self._gas:
            words("h3", "Gas by stage")
            with tag("table"), tag("tbody"):
                for stage, used in gas.items():
                    with tag("tr"):
                        words("th", stage[:1].upper() + stage[1:], scope="row")
                        words("td", f"{used:,}", "number")
                        words("td", f"{used / total:.1%}", "number")
                        with tag("td", "bar"):
                            tag("span").style(f"width:{100 * used / largest:.1f}%")
                with tag("tr", "total"):
                    words("th", "All", scope="row")
                    words("td", f"{total:,}", "number")
                    words("td", "", colspan="2")


def _scales(visitor: Visitor) -> dict[str, dict[str, str | None]]:
    """How large a PNG of each scale is; those that are too large cannot be had."""
    size = filled(visitor.state, visitor.facts).size or Size()
    return {
        f"take-png-{scale}": {
            "title": f"{scale * size.width} x {scale * size.height} pixels",
            "hidden": "" if scale * max(size.width, size.height) > MAX_PNG else None,
        }
        for scale in SCALES
    }


def _turntables(visitor: Visitor) -> tuple[dict[str, str], dict[str, dict[str, str | None]]]:
    """Those that are too large cannot be had: what is said where there is none, and which are hidden."""
    size = filled(visitor.state, visitor.facts).size or Size()
    most = visitor.pool.limits.gif_pixels
    fits = {each: film_pixels(size.width * size.height, *each) <= most for each in TURNTABLES}
    note = f"The picture is too large for a GIF, which can have up to {most:,} pixels in all: choose a smaller size."
    hidden: dict[str, dict[str, str | None]] = {
        f"gif-{frames}-{scale}": {"hidden": None if fits[frames, scale] else ""} for frames, scale in TURNTABLES
    }
    return {"gif-note": "" if any(fits.values()) else note}, hidden


def _traced(done: int, total: int) -> Message:
    return {"texts": {"traced": f"Traced in the EVM, instruction by instruction: {done / max(total, 1):.0%}"}}


def _dialog(name: str, title: str, wide: bool = False) -> Element:
    dialog = tag("dialog", "wide" if wide else "", id=name, aria_labelledby=f"{name}-title")
    with dialog, tag("header"):
        Html(mark("h2", title, id=f"{name}-title"), push_icon("close", "Close", data_close=""))
    return dialog


@cache
def _keys() -> Markup:
    told = [*keys.POINTER, *((key.text, key.shown) for key in keys.KEYS)]
    listed = [mark("div", mark("span", text), mark("kbd", shown)) for text, shown in told]
    return mark("div", mark("div", *listed, class_="keys"), class_="box", tabindex="0")


def _files(take: str) -> tuple[Markup, ...]:
    png = kind_of("png")
    scales = [
        _download(f"{scale}x", f"{take}/png?scale={scale}", png, f"take-png-{scale}", f"PNG, {scale}x")
        for scale in SCALES
    ]
    others = [
        _download(kind.title, f"{take}/{kind.name}", kind, f"take-{kind.name}") for kind in map(kind_of, PICTURES)
    ]
    turntables = [
        push(
            f"GIF, {frames} pictures, {scale}x",
            {"do": "gif", "frames": frames, "scale": scale},
            classes="button",
            data_name=f"gif-start gif-{frames}-{scale}",
        )
        for frames, scale in TURNTABLES
    ]
    progress = mark("progress", data_name="gif-bar", value="0", max="24", aria_label="Pictures of the GIF")
    job = mark(
        "div",
        mark("div", mark("span", class_="quiet", data_text="gif-words"), progress),
        push("Cancel", {"do": "stop-gif"}),
        class_="job",
        data_name="gif-job",
        hidden=True,
    )
    link = mark("input", class_="field", id="link", readonly=True, aria_label="The link")
    copy_link = mark("button", drawing("link"), "Copy", type="button", class_="button", data_copy_link="")
    return (
        mark(
            "section",
            mark("h3", "The picture"),
            mark("div", mark("span", "PNG", class_="quiet"), *scales, class_="scales"),
            mark("div", *others, class_="scales"),
        ),
        mark(
            "section",
            mark("h3", "Turntable"),
            mark("div", *turntables, class_="scales"),
            mark("p", class_="quiet", data_text="gif-note"),
            job,
        ),
        mark(
            "section",
            mark("h3", "A link that restores everything"),
            mark("div", link, copy_link, class_="linkline"),
            mark("p", class_="quiet", data_text="link-note"),
        ),
    )


def _download(title: str, where: str, kind: Kind, name: str, spoken: str | None = None) -> Markup:
    return mark(
        "a",
        title,
        class_="button",
        href=where,
        download="",
        title=kind.help,
        data_name=name,
        aria_label=spoken,
        hidden=kind.name == "file",
    )


def _snippet(take: str, kind: Kind) -> Markup:
    text = mark("pre", "…", data_text=f"snippet-{kind.name}", tabindex="0", role="region", aria_label=kind.title)
    where = f"{take}/{kind.name}"
    copy = mark(
        "button", "Copy", type="button", class_="button small", data_copy=where, aria_label=f"Copy: {kind.title}"
    )
    save = mark("a", "Save", class_="button small", href=where, download="", aria_label=f"Save: {kind.title}")
    pair = mark("span", copy, " ", save, class_="pair")
    return mark(
        "section",
        mark("div", mark("h3", kind.title), mark("p", kind.help, class_="quiet"), pair, class_="snippet"),
        mark("div", text, class_="code"),
    )
