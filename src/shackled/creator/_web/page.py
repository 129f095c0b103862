"""The HTML of the page, made from templates, and the actions of its keys. The picture comes by WebSocket."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ...datasets import Piece, find, pieces
from ...scene import MAX_LIGHTS
from .._controls import CONTROLS, GROUPS, lamp_controls
from .._presets import PRESETS
from .._takeaway import SCALES, kind_of
from .._upload import ACCEPTED

ASSETS = Path(__file__).parent / "assets"

#: Number of Genesis pieces on the shelf; the others are found by number or seed.
GENESIS = 36
SHELVES = (("icons", "Icons"), ("common", "Objects"), ("genesis", "Genesis"))
#: The panels that are open at first.
OPEN = ("lights", "material")
#: Files that belong to meshes: materials, buffers, textures, besides PNG files.
COMPANIONS = (".mtl", ".bin", ".jpg", ".jpeg")
#: Sides with a button of their own.
SIDES = (64, 128, 256, 512)
#: Files of the picture besides PNG, and snippets, by kind.
PICTURES = ("bmp", "svg", "scene", "page", "file")
SNIPPETS = ("python", "solidity", "cast", "cast-anywhere", "calldata")
#: Frames and scale of turntables.
TURNTABLES = ((24, 1), (24, 2), (60, 2))
#: Part of the picture's height for one press of an arrow key.
STEP = 1 / 24


@dataclass(frozen=True)
class Key:
    """A key of the keyboard.

    names: as in KeyboardEvent.key, after "Ctrl+" and "Shift+". shown, text: for the help. does: the message it sends.
    """

    names: tuple[str, ...]
    shown: str
    text: str
    does: dict[str, Any]


def _arrows(do: str, before: str, texts: Sequence[str]) -> list[Key]:
    ways = (("Left", "←", -STEP, 0), ("Right", "→", STEP, 0), ("Up", "↑", 0, -STEP), ("Down", "↓", 0, STEP))
    return [
        Key((f"{before}Arrow{name}",), before.replace("+", " ") + arrow, text, {"do": do, "x": x, "y": y})
        for (name, arrow, x, y), text in zip(ways, texts, strict=True)
    ]


KEYS: tuple[Key, ...] = (
    *_arrows("orbit", "", ("Turn left", "Turn right", "Turn up", "Turn down")),
    *_arrows("pan", "Shift+", ("Move left", "Move right", "Move up", "Move down")),
    Key(("+", "="), "+", "Zoom in", {"do": "zoom", "notches": 1}),
    Key(("-", "_"), "-", "Zoom out", {"do": "zoom", "notches": -1}),
    Key(("f", "F"), "F", "Fit the object into the picture", {"do": "fit"}),
    Key(("0", "Home"), "0", "Reset the camera", {"do": "reset-group", "group": "camera"}),
    Key(("p", "P"), "P", "Switch projection", {"do": "cycle", "path": "camera.projection"}),
    Key(("s", "S"), "S", "Cycle shading", {"do": "cycle", "path": "surface.shading"}),
    Key(("w", "W"), "W", "Wireframe", {"do": "cycle", "path": "wireframe"}),
    Key(("c", "C"), "C", "Cull back faces", {"do": "cycle", "path": "cull"}),
    Key(("i", "I"), "I", "Invert", {"do": "cycle", "path": "invert"}),
    Key(("a", "A"), "A", "Anti-aliasing", {"do": "cycle", "path": "antialias"}),
    Key(("l", "L"), "L", "Next look", {"do": "next-look"}),
    Key(("g", "G"), "G", "Random Genesis piece", {"do": "any-genesis"}),
    Key(("Ctrl+z",), "Ctrl Z", "Undo", {"do": "undo"}),
    Key(("Ctrl+Shift+z", "Ctrl+y"), "Ctrl Shift Z", "Redo", {"do": "redo"}),
    Key(("Enter",), "Enter", "Gas, limits and stages", {"do": "stages"}),
    Key(("d", "D"), "D", "Download and share", {"do": "takeaway"}),
    Key(("?",), "?", "Show this help", {"open": "keys"}),
)

#: What the pointer does, and how.
POINTER = (
    ("Turn the object", "drag"),
    ("Move it", "right drag, two fingers"),
    ("Zoom", "wheel, pinch"),
    ("Move a light", "drag on its sphere"),
)

_TEMPLATES = Environment(
    loader=FileSystemLoader(Path(__file__).parent / "templates"),
    autoescape=True,
    trim_blocks=True,
    lstrip_blocks=True,
    undefined=StrictUndefined,
)


def page(has_node: bool) -> str:
    """Return the page, which is the same for all visitors. has_node: whether it can compare pictures with a node."""
    return _TEMPLATES.get_template("page.html").render(
        has_node=has_node,
        accepted=(*ACCEPTED, *COMPANIONS),
        keys=KEYS,
        key_table={name: key.does for key in KEYS for name in key.names},
        pointer=POINTER,
        shelves=[(name, title, on_shelf(name)) for name, title in SHELVES],
        looks=PRESETS,
        groups=[(name, title, [each for each in CONTROLS if each.group == name]) for name, title in GROUPS],
        open_groups=OPEN,
        lamps=[lamp_controls(number) for number in range(MAX_LIGHTS)],
        sides=SIDES,
        scales=SCALES,
        png=kind_of("png"),
        pictures=[kind_of(name) for name in PICTURES],
        turntables=TURNTABLES,
        snippets=[kind_of(name) for name in SNIPPETS],
    )


def fragment(name: str, **values: Any) -> str:
    """Return a part of the page that is filled in later. name: of a macro in fragments.html."""
    macro: Any = getattr(_TEMPLATES.get_template("fragments.html").module, name)
    return str(macro(**values))


def on_shelf(name: str) -> list[Piece]:
    """Return the pieces on a shelf, without those that must be downloaded first."""
    return [piece for piece in islice(pieces(name), GENESIS if name == "genesis" else None) if piece.ready()]


def has_thumbnail(name: str) -> bool:
    """Return whether there is a piece of this name that needs no download."""
    piece = find(name) if len(name) <= 40 else None
    return piece is not None and piece.ready()
