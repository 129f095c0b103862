"""What the page is made of: HTML as text, for all that stays as it is; elements of NiceGUI, for what is filled in."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape
from nicegui import ui
from nicegui.element import Element
from nicegui.elements.mixins.text_element import TextElement

from . import keys
from .icons import icon

ASSETS = Path(__file__).parent / "assets"

#: Elements that have no end.
_VOID = ("img", "input")


def mark(name: str, /, *inside: str, **attributes: Any) -> Markup:
    """An HTML element as text. What stands inside is escaped, but for what `mark` has made.

    attributes: a final underscore is dropped, others are hyphens; True stands for an attribute without a value, None
    and False for none, and tables become JSON.
    """
    listed = Markup("").join(_attribute(key, value) for key, value in attributes.items())
    start = Markup("<{}{}>").format(name, listed)
    return start if name in _VOID else start + Markup("").join(inside) + Markup("</{}>").format(name)


def drawing(name: str) -> Markup:
    """The drawing of that name."""
    return Markup(icon(name))


def push(label: str, does: dict[str, Any], /, *before: str, classes: str = "button small", **attributes: Any) -> Markup:
    """A button that sends a message."""
    return mark("button", *before, label, type="button", class_=classes, data_do=does, **attributes)


def push_icon(name: str, label: str, /, title: str = "", **attributes: Any) -> Markup:
    """A button with a drawing."""
    return mark(
        "button", drawing(name), type="button", class_="icon", aria_label=label, title=title or label, **attributes
    )


def tag(name: str, /, classes: str = "", **attributes: str) -> Element:
    """An element; use it with `with` to put others into it. Attributes as in `mark`."""
    return _dress(ui.element(name), classes, attributes)


def words(name: str, text: str, /, classes: str = "", **attributes: str) -> Element:
    """An element with text in it, which is shown as it is."""
    return _dress(TextElement(tag=name, text=text), classes, attributes)


class Html(Element, component=ASSETS / "markup.js"):
    """HTML that stays as it is."""

    def __init__(self, *content: Markup) -> None:
        """`content`: as `mark` makes it."""
        super().__init__()
        self._props["markup"] = str(Markup("").join(content))


class Terminal(Element, component=ASSETS / "creator.js"):
    """What happens in the browser; it shows nothing of its own."""

    def __init__(self, visitor: str) -> None:
        """`visitor`: the name of the wire."""
        super().__init__()
        self._props["visitor"] = visitor
        self._props["keys"] = keys.table()


def _dress(element: Element, classes: str, attributes: dict[str, str]) -> Element:
    if classes:
        element.classes(classes)
    element._props.update({_name(key): value for key, value in attributes.items()})
    return element


def _attribute(key: str, value: Any) -> Markup:
    if value is None or value is False:
        return Markup("")
    if value is True:
        return Markup(" {}").format(_name(key))
    if isinstance(value, dict):
        value = json.dumps(value)
    return Markup(' {}="{}"').format(_name(key), escape(value))


def _name(key: str) -> str:
    return key.rstrip("_").replace("_", "-")
