"""shackled info: what a mesh or scene file holds, in its own coordinates"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

from .._load import is_model, load, locate
from .._render import render
from ..base.checks import Floats, Ints
from ..base.values import listed, plural
from ..datasets._pieces import Piece
from ..errors import ChainError, InputError, InputWarning, ShackledError
from ..gas._limits import headline
from ..scene._canvas import as_shown
from ..scene._fields import Axis
from ..scene._files.content import format_of
from ..scene._files.gltf.animation import animations_of
from ..scene._files.link import Link
from ..scene._files.mesh_file import GLTF, READERS, read_model
from ..scene._mesh import Mesh, faces_of_all
from ..scene._object import Material, Object
from ..scene._scene import Scene
from ..scene._staging import is_closed
from ..scene._upright import axis_of_format, base_axis
from .option import option, with_options
from .output import print_json, print_line
from .picture import Source, fits_of_made
from .progress import LateBar
from .several import INPUTS, inputs_of

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
                facts, notes, pictures = _told(source, gas)
            except (ShackledError, InputWarning) as error:
                if len(sources) == 1:
                    raise
                failed.append(error)
                if as_json:
                    print_json({"input": source.name, "error": with_options(str(error))})
                continue
            if as_json:
                drawn = {"pictures": pictures} if gas else {}
                print_json({"input": source.name, **asdict(facts), "notes": notes, **drawn})
            else:
                print("\n" * (not is_first), end="")
                for name, text in _rows(source.name, facts, notes, pictures):
                    print_line(f"{name:9} {text}")
                is_first = False
    if failed:
        raise ExceptionGroup(f"{len(sources) - len(failed)} read, {len(failed)} failed", failed)


def _told(source: Source, gas: bool) -> tuple[Facts, list[str], list[dict[str, Any]]]:
    """Return facts, notes, and for `gas` the pictures, with the size, gas and limits of each."""
    with warnings.catch_warnings(record=True) as caught, LateBar("reading"), source.named():
        place = locate(source.place)
        scene, facts = load(place), facts_of(place)
    notes = [with_options(str(each.message)) for each in caught if issubclass(each.category, InputWarning)]
    return facts, [*dict.fromkeys(notes)], [_picture(scene, side, is_model(place)) for side in SIDES if gas]


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


def _rows(name: str, facts: Facts, notes: list[str], pictures: list[dict[str, Any]]) -> Iterator[tuple[str, str]]:
    """Yield the names of the lines, and their text."""
    vertices, parts = plural(facts.vertices, "vertex", "vertices"), plural(facts.parts, "part")
    sizes = [high - low for low, high in zip(facts.low, facts.high, strict=True)]
    textures = [f"{width} x {height}" for width, height in facts.textures]
    materials = [
        plural(facts.materials, "material"),
        f"textures of {listed(textures)} texels" if textures else "no textures",
        plural(facts.colors, "colour"),
        "opaque" if facts.opaque else "not opaque",
    ]
    yield "input", name
    yield "mesh", f"{vertices}, {plural(facts.triangles, 'triangle')}, {parts}"
    yield "bounds", f"{_numbers(facts.low)} to {_numbers(facts.high)}, size {_numbers(sizes)}"
    yield "up", _up(facts)
    yield "surface", _surface(facts)
    yield "material", ", ".join(materials)
    yield "normals", f"of {facts.normals} of {parts}" if facts.normals else "none, they are computed"
    if facts.animations:
        named = [(f"{number} {name}".strip(), length) for number, (name, length) in enumerate(facts.animations)]
        yield "animated", ", ".join(f"{name} ({length:.6g} s)" for name, length in named)
    yield from (("note", note) for note in notes)
    for each in pictures:
        cost = each["fits"] if each["gas"] is None else f"{each['gas']:,} gas, {each['fits']}"
        if each["triangles"] < facts.triangles:
            cost = f"simplified to {plural(each['triangles'], 'triangle')}, {cost}"
        yield f"{each['size']} px", cost


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


# ---- facts ----


@dataclass(frozen=True)
class Facts:
    """Figures of all objects, taken together.

    low, high: the bounds. parts: how many objects. open_edges: edges of one face; crowded_edges: of three or more;
    disagreeing_edges: of two faces that are wound differently. closed: as `is_closed`, from outside. inside_out:
    whether faces of a closed surface are seen from inside. up: the axis that is taken as up. base: "y" or "z", along
    which the model stands on a flat base; None if it does so along none, or both. textures: width and height of each.
    colors: different ones of vertices. opaque: whether nothing is transparent. normals: how many parts have them.
    animations: the name and the length in seconds of each.
    """

    low: list[float]
    high: list[float]
    vertices: int
    triangles: int
    parts: int
    closed: bool
    inside_out: bool
    open_edges: int
    crowded_edges: int
    disagreeing_edges: int
    up: Axis
    base: Axis | None
    materials: int
    textures: list[list[int]]
    colors: int
    opaque: bool
    normals: int
    animations: list[tuple[str, float]]


def facts_of(place: Path | Piece | Link) -> Facts:
    """Return the facts of a file or a piece."""
    kind = format_of(place) if isinstance(place, Path) else ""
    if kind in READERS and isinstance(place, Path):
        parts = read_model(place)
        objects = [
            Object(each.mesh, material=evolve(Material(), **each.material), opacity=each.opacity) for each in parts
        ]
    else:
        objects = [*load(place).objects]
    if not objects:
        raise InputError(f"{place} has no objects")
    positions = np.concatenate([each.world_positions() for each in objects])
    faces = faces_of_all(each.mesh for each in objects)
    single, crowded, disagreeing = _edges(positions, faces)
    is_tight = not (single or crowded or disagreeing)
    textures = [each.material.texture for each in objects if each.material.texture is not None]
    return Facts(
        low=positions.min(axis=0).tolist(),
        high=positions.max(axis=0).tolist(),
        vertices=len(positions),
        triangles=len(faces),
        parts=len(objects),
        closed=is_tight,
        inside_out=is_tight and not is_closed(Mesh(positions, faces)),
        open_edges=single,
        crowded_edges=crowded,
        disagreeing_edges=disagreeing,
        up=axis_of_format(place) if isinstance(place, Path) else "y",
        base=base_axis(positions, faces),
        materials=len({(each.material, each.opacity) for each in objects}),
        textures=[[*each.pixels.shape[1::-1]] for each in textures],
        colors=len(np.unique(np.concatenate([each.mesh.rgba[:, :3] for each in objects]), axis=0)),
        opaque=all(each.is_opaque for each in objects),
        normals=sum(each.mesh.normals is not None for each in objects),
        animations=animations_of(place) if kind in GLTF and isinstance(place, Path) else [],
    )


def _edges(positions: Floats, faces: Ints) -> tuple[int, int, int]:
    """Return the numbers of edges of one face, of three or more, and of two that are wound differently.

    Corners at one place are one; edges without length are none.
    """
    places = np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)
    edges = places[faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    forward = edges[:, 0] < edges[:, 1]
    _, number = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    number = number.reshape(-1)
    count = np.bincount(number)
    ahead = np.bincount(number, forward, len(count))
    return int((count == 1).sum()), int((count > 2).sum()), int(((count == 2) & (ahead != 1)).sum())
