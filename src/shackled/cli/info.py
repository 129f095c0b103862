"""shackled info"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from contextlib import ExitStack, nullcontext
from dataclasses import asdict, fields
from typing import Any

from attrs import evolve

from .._load import is_model, load, locate
from .._render import render
from ..errors import ChainError, InputWarning, ShackledError
from ..gas import headline
from ..scene import Scene, as_shown
from ..values import listed, plural
from .facts import Facts, facts_of
from .option import option, with_options
from .output import print_json, print_line
from .picture import Source, fits_of_made
from .progress import LateBar
from .several import INPUTS, inputs_of
from .streams import STREAM, as_stdin

#: The sides of the pictures whose gas is told, in pixels.
SIDES = (128, 256, 512)


def info(
    inputs: tuple[str, ...] = INPUTS,
    gas: bool = option("--gas/--no-gas", "Draw it, to count the gas of pictures and where they fit.", default=True),
    as_json: bool = option("--json", "Print a JSON object instead of text, for each input."),
) -> None:
    """Show what a file contains, what is left out, and what its pictures cost."""
    failed: list[Exception] = []
    is_first = True
    with ExitStack() as stack:
        sources = inputs_of(inputs, stack)
        for source in sources:
            try:
                told = _told(source, gas)
            except (ShackledError, InputWarning) as error:
                if len(sources) == 1:
                    raise
                failed.append(error)
                if as_json:
                    print_json({"input": source.name, "error": with_options(str(error))})
                continue
            if as_json:
                print_json(told)
            else:
                print("\n" * (not is_first), end="")
                for line in _lines(told):
                    print_line(line)
                is_first = False
    if failed:
        raise ExceptionGroup(f"{len(sources) - len(failed)} read, {len(failed)} failed", failed)


def _told(source: Source, gas: bool) -> dict[str, Any]:
    """Return the object of --json. gas: whether there are pictures, with the size, gas and limits of each."""
    named = as_stdin(source.place) if source.name == STREAM else nullcontext()
    with warnings.catch_warnings(record=True) as caught, LateBar("reading"), named:
        place = locate(source.place)
        scene, facts = load(place), facts_of(place)
    notes = [with_options(str(each.message)) for each in caught if issubclass(each.category, InputWarning)]
    drawn = {"pictures": [_picture(scene, side, is_model(place)) for side in SIDES]} if gas else {}
    return {"input": source.name, **asdict(facts), "notes": list(dict.fromkeys(notes)), **drawn}


def _lines(told: dict[str, Any]) -> list[str]:
    """Return the lines of text."""
    facts = Facts(**{each.name: told[each.name] for each in fields(Facts)})
    rows = [("input", told["input"]), *_words(facts).items(), *(("note", note) for note in told["notes"])]
    for each in told.get("pictures", ()):
        cost = each["fits"] if each["gas"] is None else f"{each['gas']:,} gas, {each['fits']}"
        if each["triangles"] < facts.triangles:
            cost = f"simplified to {plural(each['triangles'], 'triangle')}, {cost}"
        rows.append((f"{each['size']} px", cost))
    return [f"{name:9} {text}" for name, text in rows]


def _picture(scene: Scene, side: int, is_simplified: bool) -> dict[str, Any]:
    scene = evolve(scene, width=side, height=side)
    if is_simplified:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", InputWarning)
            scene = as_shown(scene, "")
    facts = {"size": side, "triangles": scene.triangles}
    try:
        with LateBar(f"drawing {side} x {side} pixels"):
            made = render(scene)
            fits = fits_of_made(made, scene)
    except ChainError as error:
        return {**facts, "gas": None, "fits": with_options(str(error))}
    return {**facts, "gas": made.gas, "fits": None if fits is None else headline(fits)}


def _words(facts: Facts) -> dict[str, str]:
    """Return facts as text, by the names of the lines."""
    vertices, parts = plural(facts.vertices, "vertex", "vertices"), plural(facts.parts, "part")
    sizes = [high - low for low, high in zip(facts.low, facts.high, strict=True)]
    textures = [f"{width} x {height}" for width, height in facts.textures]
    materials = [
        plural(facts.materials, "material"),
        f"textures of {listed(textures)} texels" if textures else "no textures",
        plural(facts.colors, "colour"),
        "opaque" if facts.opaque else "not opaque",
    ]
    rows = {
        "mesh": f"{vertices}, {plural(facts.triangles, 'triangle')}, {parts}",
        "bounds": f"{_numbers(facts.low)} to {_numbers(facts.high)}, size {_numbers(sizes)}",
        "up": _up(facts),
        "surface": _surface(facts),
        "material": ", ".join(materials),
        "normals": f"of {facts.normals} of {parts}" if facts.normals else "none, they are computed",
    }
    if facts.animations:
        named = [(f"{number} {name}".strip(), length) for number, (name, length) in enumerate(facts.animations)]
        rows["animated"] = ", ".join(f"{name} ({length:.6g} s)" for name, length in named)
    return rows


def _up(facts: Facts) -> str:
    if facts.base is None:
        return f"{facts.up} is taken; no flat base tells it"
    if facts.base == facts.up:
        return f"{facts.up}: it stands on a flat base"
    return f"{facts.up} is taken, but it stands on a flat base along {facts.base}: --up-axis {facts.base} turns it"


def _surface(facts: Facts) -> str:
    wrong = [
        f"{plural(count, 'edge')} {words}"
        for count, words in (
            (facts.open_edges, "of one face"),
            (facts.crowded_edges, "of three faces or more"),
            (facts.disagreeing_edges, "between faces that are wound differently"),
        )
        if count
    ]
    if wrong:
        return f"not closed: {listed(wrong)}" if facts.open_edges or facts.crowded_edges else listed(wrong)
    return f"closed{', but its faces are seen from inside' if facts.inside_out else ''}"


def _numbers(values: Sequence[float]) -> str:
    return ", ".join(f"{value:.6g}" for value in values)
