"""What is on the page. What it shows of a visitor's picture comes over the wire, see `live`."""

from __future__ import annotations

from functools import cache

from markupsafe import Markup
from nicegui import ui

from ..controls import GROUPS
from ..presets import PRESETS, Preset
from .dialogs import Dialogs
from .elements import Html, Terminal, drawing, mark, push, push_icon, tag, words
from .icons import LOGO
from .panel import group_body
from .shelf import shelf
from .visitor import Visitor

#: The panels that are open at first.
_OPEN = ("lights", "material")

#: The theme that was chosen, before anything is painted.
_HEAD = (
    '<link rel="stylesheet" href="/assets/creator.css">'
    '<meta name="description" content="Pictures of 3D scenes, every pixel computed by a smart contract">'
    "<script>try { document.documentElement.style.colorScheme = localStorage.getItem('theme') || '' } catch {}</script>"
)
#: A picture of one pixel, which is clear.
_NOTHING = "data:image/gif;base64,R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7"
_HELP = (
    "The picture. Arrow keys turn the object, plus and minus zoom, shift and arrow keys shift it,"
    " question mark shows all keys."
)


def prepare() -> None:
    """Makes what is the same for all visitors."""
    for part in (_top, _panel, shelf):
        part()


def build(visitor: Visitor) -> None:
    """The page of a visitor; in the context of NiceGUI's page."""
    ui.add_head_html(_HEAD)
    with tag("div", "creator"):
        with tag("header", "top"):
            Html(*_top())
        # NiceGUI puts all of it into its own main element
        with tag("section", "shelf", aria_label="Objects"):
            Html(shelf())
        with tag("section", "stage", id="stage", aria_label="The picture and its gas"):
            Html(*_stage(visitor.pool.has_node))
        with tag("section", "panel", aria_label="Controls"):
            Html(*_panel())
    visitor.screen = Dialogs(visitor)
    words("div", "", "unseen", id="spoken", role="status", aria_live="polite")
    Terminal(visitor.name)


@cache
def _top() -> tuple[Markup, ...]:
    name = mark("h1", mark("span", "Shackled ", class_="first"), "Creator")
    brand = mark("div", name, mark("p", "Every pixel computed by a smart contract"))
    return (
        mark("a", "Skip to the picture", href="#view", class_="button main skip"),
        mark("div", Markup(LOGO), brand, class_="brand"),
        push_icon("undo", "Undo", "Undo (Ctrl Z)", data_name="undo", data_do={"do": "undo"}),
        push_icon("redo", "Redo", "Redo (Ctrl Shift Z)", data_name="redo", data_do={"do": "redo"}),
        push_icon("fit", "Fit", "Fit the object into the picture (F)", data_do={"do": "fit"}),
        push_icon("theme", "Light or dark", data_theme_toggle=""),
        push_icon("help", "Keys", "Keys (?)", data_open="keys"),
        push(
            "",
            {"do": "takeaway"},
            drawing("take"),
            mark("span", "Download", class_="word"),
            classes="button main",
            aria_haspopup="dialog",
            aria_label="Download and share",
        ),
    )


@cache
def _stage(has_node: bool) -> tuple[Markup, ...]:
    canvas = mark(
        "canvas", id="picture", data_name="picture", role="img", aria_label="The picture", width=128, height=128
    )
    hint = mark("div", "drag to turn · wheel to zoom · right drag to shift", class_="hint", aria_hidden="true")
    view = mark("div", canvas, hint, id="view", tabindex="0", role="application", aria_label=_HELP)
    caption = mark(
        "div",
        mark("h2", data_text="title"),
        mark("p", data_text="size"),
        mark("p", data_text="notice"),
        class_="caption",
    )
    more = mark("span", "details", class_="more")
    figures = push(
        "",
        {"do": "stages"},
        mark("span", mark("small", "Gas", data_text="gas-label"), " ", mark("b", "…", data_text="gas")),
        mark(
            "span", mark("small", "Triangles", data_text="triangles-label"), " ", mark("b", "…", data_text="triangles")
        ),
        mark("span", mark("small", "Bytes sent"), " ", mark("b", "…", data_text="bytes")),
        mark("span", mark("small", "Where it fits · ", more), " ", mark("b", "…", data_text="fits"), class_="fits"),
        classes="figures",
        data_name="figures",
        aria_haspopup="dialog",
        title="Gas by stage, and the pictures of the stages",
    )
    node = mark("span", "Render on the node", data_text="node")
    compare = [push("", {"do": "node"}, drawing("node"), node, data_name="node")] if has_node else []
    # the same once more, small, for screens on which the figures go out of sight
    strip = mark(
        "div",
        mark("i"),
        mark("span", data_text="gas"),
        " gas · ",
        mark("span", data_text="triangles"),
        " triangles · ",
        mark("span", data_text="bytes"),
        " bytes",
        mark("div", data_text="fits"),
        class_="strip",
        data_name="strip",
        aria_hidden="true",
    )
    return (mark("div", view, strip, class_="well"), mark("div", caption, figures, *compare, class_="below"))


@cache
def _panel() -> tuple[Markup, ...]:
    looks = [_look(look) for look in PRESETS]
    everything = push("Reset everything", {"do": "reset-all"}, drawing("reset"))
    return (
        mark(
            "section",
            mark("h2", "Looks", id="looks"),
            mark("div", *looks, class_="chips"),
            class_="looks",
            aria_labelledby="looks",
        ),
        *(
            mark("details", mark("summary", title), group_body(name), class_="group", open=name in _OPEN)
            for name, title in GROUPS
        ),
        mark("div", everything, class_="looks"),
    )


def _look(look: Preset) -> Markup:
    # the picture, of the visitor's object in that look, comes over the wire
    picture = mark("img", src=_NOTHING, alt="", width=56, height=56, data_name=f"look-picture-{look.name}")
    return mark(
        "button",
        picture,
        mark("span", look.title),
        type="button",
        class_="look",
        title=look.help,
        aria_pressed="false",
        data_name=f"look-{look.name}",
        data_do={"do": "look", "name": look.name},
    )
