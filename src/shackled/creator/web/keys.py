"""What the keys do: the same messages that buttons and pointers send."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Key:
    """names: as the browser says them, "Ctrl+" and "Shift+" before. shown: for people. does: the message."""

    names: tuple[str, ...]
    shown: str
    text: str
    does: dict[str, Any]


#: The part of the picture's height that one press moves.
STEP = 1 / 24


def _moves(do: str, before: str, words: tuple[str, str, str, str]) -> list[Key]:
    ways = {"ArrowLeft": (-STEP, 0), "ArrowRight": (STEP, 0), "ArrowUp": (0, -STEP), "ArrowDown": (0, STEP)}
    arrows = {"ArrowLeft": "←", "ArrowRight": "→", "ArrowUp": "↑", "ArrowDown": "↓"}
    return [
        Key((before + name,), before.replace("+", " ") + arrows[name], word, {"do": do, "x": x, "y": y})
        for (name, (x, y)), word in zip(ways.items(), words, strict=True)
    ]


KEYS: tuple[Key, ...] = (
    *_moves("orbit", "", ("Turn to the left", "Turn to the right", "Turn upward", "Turn downward")),
    *_moves("pan", "Shift+", ("Shift to the left", "Shift to the right", "Shift up", "Shift down")),
    Key(("+", "="), "+", "Nearer", {"do": "zoom", "notches": 1}),
    Key(("-", "_"), "-", "Farther", {"do": "zoom", "notches": -1}),
    Key(("f", "F"), "F", "Fit the object into the picture", {"do": "fit"}),
    Key(("0", "Home"), "0", "The view it came with", {"do": "reset-group", "group": "camera"}),
    Key(("p", "P"), "P", "Perspective or orthographic", {"do": "cycle", "path": "camera.projection"}),
    Key(("s", "S"), "S", "Unlit, flat or smooth", {"do": "cycle", "path": "surface.shading"}),
    Key(("w", "W"), "W", "Wireframe", {"do": "cycle", "path": "wireframe"}),
    Key(("c", "C"), "C", "Leave out back faces", {"do": "cycle", "path": "cull"}),
    Key(("i", "I"), "I", "Invert", {"do": "cycle", "path": "invert"}),
    Key(("l", "L"), "L", "The next look", {"do": "next-look"}),
    Key(("g", "G"), "G", "Any piece of Genesis", {"do": "any-genesis"}),
    Key(("Ctrl+z",), "Ctrl Z", "Undo", {"do": "undo"}),
    Key(("Ctrl+Shift+z", "Ctrl+y"), "Ctrl Shift Z", "Redo", {"do": "redo"}),
    Key(("Enter",), "Enter", "Gas by stage, and the pictures of the stages", {"do": "stages"}),
    Key(("d", "D"), "D", "Download and share", {"do": "takeaway"}),
    Key(("?",), "?", "These keys", {"open": "keys"}),
)

#: What a pointer does: for people, and how.
POINTER: tuple[tuple[str, str], ...] = (
    ("Turn the object", "drag"),
    ("Shift it", "right drag, two fingers"),
    ("Nearer, farther", "wheel, pinch"),
    ("Move a light", "drag on its sphere"),
)


def table() -> dict[str, dict[str, Any]]:
    """The message of each key, by its name."""
    return {name: key.does for key in KEYS for name in key.names}
