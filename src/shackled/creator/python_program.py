"""A picture as a program in Python, which says what is different from its source."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ..image import Image
from ..scene import Scene
from .scene import MATERIAL
from .subject import Subject


def python_program(subject: Subject, image: Image) -> str:
    """A program that makes the picture from its source, saves it, and stops if it is not this image."""
    loaded, imports = _loaded(subject), []
    with_size = subject.stored is not None  # it may have been brought down
    changes = [] if _is_packed(subject) else _changes(subject.source, subject.scene, with_size)
    if changes:
        imports.append("from shackled import replace")
        loaded.append(f"scene = replace(\n    scene,\n{''.join(changes)})")
    ours = [line for line in imports if "shackled" in line]
    sha256 = hashlib.sha256(image.pixels.tobytes()).hexdigest()
    return "\n".join(
        [
            *(f"# {comment}" for comment in subject.comments),
            "import hashlib",
            *(line for line in imports if line not in ours),
            "",
            "import shackled",
            *ours,
            "",
            *loaded,
            "",
            "image = shackled.render(scene)",
            f'image.save("{subject.stem}.png")',
            "print(image.gas)",
            f'assert hashlib.sha256(image.pixels.tobytes()).hexdigest() == "{sha256}"',
            "",
        ]
    )


def _loaded(subject: Subject) -> list[str]:
    """The lines that load the source."""
    state, stored = subject.state, subject.stored
    if _is_packed(subject):
        return [f'scene = shackled.load("{subject.stem}.json")  # the scene file, to be had beside this program']
    if stored is None:
        lines, bounds = [f"scene = shackled.load({json.dumps(state.source.name)})"], [state.max_triangles]
    else:
        lines = [f"scene = shackled.load({json.dumps(stored.name)})  # SHA-256 {state.source.name}"]
        bounds = [stored.simplified_to, state.max_triangles]
    return lines + [f"scene = shackled.load(scene, max_triangles={most})" for most in bounds if most is not None]


def _is_packed(subject: Subject) -> bool:
    """Whether the source is an archive, which only the Creator opens."""
    return subject.stored is not None and subject.stored.name.lower().endswith(".zip")


def _changes(source: Scene, scene: Scene, with_size: bool) -> list[str]:
    """The fields that differ between two scenes, as lines of a call of `replace`; the size in any case, if wanted."""
    lines = [
        f"    {name}={getattr(scene, name)!r},\n"
        for name in ("width", "height", "invert")
        if getattr(source, name) != getattr(scene, name) or (with_size and name != "invert")
    ]
    if source.ambient_light != scene.ambient_light:
        lines.append(f"    ambient_light={_numbers(scene.ambient_light)},\n")
    if source.background != scene.background:
        top, bottom = _numbers(scene.background.top), _numbers(scene.background.bottom)
        lines.append(f"    background=shackled.Background({top}, {bottom}),\n")
    if source.camera != scene.camera:
        camera = scene.camera
        near = "" if camera.near is None else f"        near={camera.near!r},\n"
        lines.append(
            "    camera=shackled.Camera(\n"
            f"        eye={_numbers(camera.eye)},\n"
            f"        target={_numbers(camera.target)},\n"
            f"        up={_numbers(camera.up)},\n"
            f'        projection="{camera.projection}",\n'
            f"        half_height={camera.half_height!r},\n"
            f"{near}    ),\n"
        )
    if source.lights != scene.lights:
        lights = "".join(
            f'        shackled.Light("{light.kind}", {_numbers(light.vector)}, {_numbers(light.color)}),\n'
            for light in scene.lights
        )
        lines.append(f"    lights=[\n{lights}    ],\n" if lights else "    lights=[],\n")
    objects = [_object_changes(before, after) for before, after in zip(source.objects, scene.objects, strict=True)]
    if any(objects):
        lines.append(_objects(objects))
    return lines


def _object_changes(before: Any, after: Any) -> dict[str, str]:
    changes = {}
    if not np.array_equal(before.mesh.colors, after.mesh.colors):
        changes["mesh"] = f"replace({{o}}.mesh, colors=[{_numbers(after.mesh.colors[0])}] * len({{o}}.mesh.positions))"
    for name in ("position", "rotation"):
        if not np.array_equal(getattr(before, name), getattr(after, name)):
            changes[name] = _numbers(getattr(after, name))
    if before.material != after.material:
        material = ", ".join(f"{name}={json.dumps(getattr(after.material, name))}" for name in MATERIAL)
        changes["material"] = f"shackled.Material({material})"
    for name in ("scale", "cull", "wireframe"):
        if getattr(before, name) != getattr(after, name):
            changes[name] = repr(getattr(after, name))
    return changes


def _objects(objects: Sequence[dict[str, str]]) -> str:
    if all(each == objects[0] for each in objects):
        inside = "".join(f"            {name}={value},\n" for name, value in _named(objects[0], "o"))
        one = f"        replace(\n            o,\n{inside}        )\n"
        return f"    objects=[\n{one}        for o in scene.objects\n    ],\n"
    parts = []
    for number, changes in enumerate(objects):
        one = f"scene.objects[{number}]"
        inside = "".join(f"            {name}={value},\n" for name, value in _named(changes, one))
        parts.append(f"        replace(\n            {one},\n{inside}        ),\n" if inside else f"        {one},\n")
    return f"    objects=[\n{''.join(parts)}    ],\n"


def _named(changes: dict[str, str], one: str) -> Iterable[tuple[str, str]]:
    return ((name, value.replace("{o}", one)) for name, value in changes.items())


def _numbers(values: Any) -> str:
    """Exact, as Python writes them: (0, 1.5, -2)."""
    plain = np.asarray(values).tolist()
    return f"({', '.join(str(int(v)) if float(v).is_integer() and abs(v) < 1e15 else repr(v) for v in plain)})"
