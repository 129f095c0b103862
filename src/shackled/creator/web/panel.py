"""The controls, as HTML made of their data. Values come over the wire when the page is there."""

from __future__ import annotations

from markupsafe import Markup

from ..controls import CONTROLS, MAX_LAMPS, Control, lamp_controls
from .elements import drawing, mark, push

#: What the sliders reach; the fields beside them take all that the state takes.
_REACH = {
    "pose.position": (-2.0, 2.0),
    "pose.scale": (0.1, 10.0),
    "camera.target": (-2.0, 2.0),
    "camera.distance": (0.5, 20.0),
    "camera.fov": (5.0, 120.0),
    "lights.0.distance": (0.2, 20.0),
    "surface.ambient": (0.0, 2.0),
    "surface.diffuse": (0.0, 2.0),
    "surface.specular": (0.0, 2.0),
    "size.width": (16.0, 512.0),
    "size.height": (16.0, 512.0),
}
#: Units as there is room for them.
_SHORT = {"pixels": "px", "triangles": "tri."}
#: Sides at one click.
_SIZES = (64, 128, 256, 512)


def group_body(group: str) -> Markup:
    """All that is in the panel of a group."""
    rows = [row(each) for each in CONTROLS if each.group == group]
    tools = []
    if group == "lights":
        rows += [_lamp(number) for number in range(MAX_LAMPS)]
        tools.append(push("Add a light", {"do": "add-lamp"}, drawing("plus"), data_name="add-lamp"))
    if group == "background":
        tools.append(push("One colour", {"do": "one-color"}))
    if group == "size":
        rows.append(mark("div", *map(_size, _SIZES), class_="tools", role="group", aria_label="Usual sizes"))
    tools.append(push("Reset", {"do": "reset-group", "group": group}, drawing("reset")))
    return mark("div", *rows, mark("div", *tools, class_="tools"), class_="body")


def row(of: Control, prefix: str = "") -> Markup:
    """One control: its name, how it is changed, and its reset. prefix: of its name where that is spoken."""
    spoken = f"{prefix}{of.label}"
    reset = mark(
        "button",
        drawing("reset"),
        type="button",
        class_="reset",
        data_do={"do": "reset", "path": of.path},
        aria_label=f"Reset {spoken}",
        title="Reset",
    )
    label = mark("label", of.label, for_=of.path)
    if of.kind == "switch":
        box = mark("input", type="checkbox", role="switch", class_="toggle", id=of.path, data_path=of.path)
        inside = [label, box]
    elif of.kind == "choice":
        inside = [mark("span", of.label, class_="name", aria_hidden="true"), _choice(of, spoken)]
    elif of.kind == "color":
        box = mark("input", type="color", id=of.path, data_path=of.path, aria_label=spoken, data_none=of.none or None)
        own = [mark("span", of.none, class_="own", aria_hidden="true")] if of.optional else []
        inside = [label, mark("div", box, *own, class_="wide")]
    else:
        inside = [label, *_number(of, spoken)]
    return mark("div", *inside, reset, class_=f"row {of.kind}-row", data_row=of.path, title=of.help or None)


def _choice(of: Control, spoken: str) -> Markup:
    options = [
        mark(
            "label",
            mark("input", type="radio", name=of.path, value=value, data_path=of.path),
            mark("span", label),
        )
        for value, label in of.choices
    ]
    return mark("div", *options, class_="choices wide", role="radiogroup", aria_label=spoken)


def _number(of: Control, spoken: str) -> tuple[Markup, Markup]:
    low, high = _reach(of)
    scale = {"min": f"{low:g}", "max": f"{high:g}", "step": f"{of.step:g}"}
    if of.logarithmic:
        scale = {"min": "0", "max": "1000", "step": "1", "data_log": "1"}
        scale |= {"data_low": f"{low:g}", "data_high": f"{high:g}"} | ({"data_whole": "1"} if of.whole else {})
    # the field has all that the slider has, and its keys; one of the two is enough for keyboard and screen reader
    slider = mark("input", type="range", tabindex="-1", aria_hidden="true", data_path=of.path, **scale)
    field = mark(
        "input",
        type="number",
        id=of.path,
        data_path=of.path,
        min=f"{of.low:g}",
        max=f"{of.high:g}",
        step=f"{of.step:g}",
        placeholder=of.none or None,
        aria_label=f"{spoken}, {of.unit}" if of.unit else spoken,
    )
    unit = mark("span", _SHORT.get(of.unit, of.unit), class_="unit", aria_hidden="true")
    return slider, mark("span", field, unit, class_="number")


def _reach(of: Control) -> tuple[float, float]:
    path = of.path
    for number in range(1, MAX_LAMPS):
        path = path.replace(f"lights.{number}.", "lights.0.")
    return next((reach for start, reach in _REACH.items() if path.startswith(start)), (of.low, of.high))


def _lamp(number: int) -> Markup:
    title = f"Light {number + 1}"
    # the fields below do the same for those who do not point
    sphere = mark(
        "div",
        mark("div", class_="dot"),
        class_="sphere",
        data_number=number,
        aria_hidden="true",
        title="Drag the light; beyond the rim it goes behind",
    )
    remove = push("Remove", {"do": "remove-lamp", "number": number}, aria_label=f"Remove light {number + 1}")
    return mark(
        "fieldset",
        mark("legend", title, class_="unseen"),
        mark("div", sphere, mark("b", title, aria_hidden="true"), remove, class_="head"),
        *(row(each, f"{title}: ") for each in lamp_controls(number)),
        class_="lamp",
        data_lamp=number,
        hidden=True,
    )


def _size(side: int) -> Markup:
    return push(f"{side}", {"do": "size", "side": side}, aria_label=f"{side} by {side} pixels")
