"""A picture as code that reproduces it: a program in Python, and a command for cast, the tool of Foundry."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..artifacts import artifact
from ..chain import CallResult, EmbeddedChain
from ..errors import InputError
from ..gas import floor_gas, needed_for, render_call
from ..image import Image
from ..scene import Fog, Hemisphere, Light, Rim, Scene, Tone, look_at
from ._link import LOCAL, is_local
from ._scene import EFFECTS, FLAGS, MATERIAL, Facts
from ._state import State
from ._store import Stored

#: Longest argument of a program on Linux.
MAX_ARGUMENT = 128 * 1024 - 1


@dataclass(frozen=True, eq=False)
class Subject:
    """A picture with everything that it is made of.

    facts, source: of the state's source. scene: that is rendered. stored: the upload, if the source is one. link:
    address of the picture, for comments.
    """

    state: State
    facts: Facts
    source: Scene
    scene: Scene
    stored: Stored | None = None
    link: str = ""

    @property
    def stem(self) -> str:
        """Name for files, such as "genesis-12"; of an upload, that of its file."""
        source = self.state.source
        name = self.facts.title.rpartition(".")[0] if source.kind == "upload" else source.name
        stem = re.sub(r"[^0-9A-Za-z]+", "-", name).strip("-")
        return stem[:24].strip("-") or "picture"

    @property
    def comments(self) -> list[str]:
        """Lines for the head of a program: the link, and the attribution."""
        local = LOCAL if is_local(self.link) else ""
        return [" ".join(text.split()) for text in (self.link, local, self.facts.notice) if text.strip()]


def python_program(subject: Subject, image: Image) -> str:
    """Return a program that renders the picture from its source, saves it, and fails if it is not this image."""
    loaded, source = _loaded(subject), subject.source
    if subject.state.surface.shading == "smooth" and not _is_packed(subject):
        source = look_at(source, {"shading": "smooth"})
        if source != subject.source:
            loaded.append('scene = shackled.load(scene, shading="smooth")')
    with_size = subject.stored is not None  # its canvas may have been reduced
    changes = [] if _is_packed(subject) else _changes(source, subject.scene, with_size)
    if changes:
        loaded.append(f"scene = shackled.replace(\n    scene,\n{''.join(changes)})")
    sha256 = hashlib.sha256(image.pixels.tobytes()).hexdigest()
    return "\n".join(
        [
            *(f"# {comment}" for comment in subject.comments),
            "import hashlib",
            "",
            "import shackled",
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
    state, stored = subject.state, subject.stored
    if _is_packed(subject):
        return [f'scene = shackled.load("{subject.stem}.json")  # download the scene file as well']
    if stored is None:
        source = subject.source
        plain = f"size=({source.width}, {source.height}), antialias={source.antialias}"
        lines = [f"scene = shackled.load({json.dumps(state.source.name)}, {plain})"]
        bounds = [state.max_triangles]
    else:
        lines = [f"scene = shackled.load({json.dumps(stored.name)})  # SHA-256 {state.source.name}"]
        bounds = [stored.simplified_to, state.max_triangles]
    return lines + [f"scene = shackled.load(scene, max_triangles={most})" for most in bounds if most is not None]


def _is_packed(subject: Subject) -> bool:
    """Return whether the source is an archive, which only the Creator can open."""
    return subject.stored is not None and subject.stored.name.lower().endswith(".zip")


def _effect(value: Hemisphere | Rim | Fog | Tone | None) -> str:
    """Return an effect as an expression; a hemisphere as its two colours."""
    if value is None:
        return "None"
    if isinstance(value, Hemisphere):
        return f"({_numbers(value.sky)}, {_numbers(value.ground)})"
    return f"shackled.{value!r}"


def _changes(source: Scene, scene: Scene, with_size: bool) -> list[str]:
    """Return the fields that differ between two scenes, as lines of a call of `replace`."""
    lines = [
        f"    {name}={getattr(scene, name)!r},\n"
        for name in ("width", "height", *FLAGS)
        if getattr(source, name) != getattr(scene, name) or (with_size and name not in FLAGS)
    ]
    if source.ambient_light != scene.ambient_light:
        lines.append(f"    ambient_light={_numbers(scene.ambient_light)},\n")
    lines += [
        f"    {name}={_effect(value)},\n"
        for name in EFFECTS
        if (value := getattr(scene, name)) != getattr(source, name)
    ]
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
        lights = "".join(f"        {_light(light)},\n" for light in scene.lights)
        lines.append(f"    lights=[\n{lights}    ],\n" if lights else "    lights=[],\n")
    objects = [_object_changes(before, after) for before, after in zip(source.objects, scene.objects, strict=True)]
    if any(objects):
        lines.append(_objects(objects))
    return lines


def _light(light: Light) -> str:
    arguments = [_numbers(light.vector), _numbers(light.color)]
    if light.direction is not None:
        arguments.insert(1, _numbers(light.direction))
        arguments += [f"{light.inner_angle!r}", f"{light.outer_angle!r}"]
    return f"shackled.Light.{light.kind}({', '.join(arguments)})"


def _object_changes(before: Any, after: Any) -> dict[str, str]:
    changes = {}
    if not np.array_equal(before.mesh.colors, after.mesh.colors):
        changes["mesh"] = (
            f"shackled.replace({{o}}.mesh, colors=[{_numbers(after.mesh.colors[0])}] * len({{o}}.mesh.positions))"
        )
    for name in ("position", "rotation"):
        if not np.array_equal(getattr(before, name), getattr(after, name)):
            changes[name] = _numbers(getattr(after, name))
    if before.material != after.material:
        fields = {name: json.dumps(getattr(after.material, name)) for name in MATERIAL if name != "emission"}
        if any(after.material.emission):
            fields["emission"] = _numbers(after.material.emission)
        material = ", ".join(f"{name}={value}" for name, value in fields.items())
        changes["material"] = f"shackled.Material({material})"
    for name in ("scale", "cull", "wireframe", "opacity"):
        if getattr(before, name) != getattr(after, name):
            changes[name] = repr(getattr(after, name))
    return changes


def _objects(objects: Sequence[dict[str, str]]) -> str:
    if all(each == objects[0] for each in objects):
        inside = "".join(f"            {name}={value},\n" for name, value in _named(objects[0], "o"))
        one = f"        shackled.replace(\n            o,\n{inside}        )\n"
        return f"    objects=[\n{one}        for o in scene.objects\n    ],\n"
    parts = []
    for number, changes in enumerate(objects):
        one = f"scene.objects[{number}]"
        inside = "".join(f"            {name}={value},\n" for name, value in _named(changes, one))
        parts.append(
            f"        shackled.replace(\n            {one},\n{inside}        ),\n" if inside else f"        {one},\n"
        )
    return f"    objects=[\n{''.join(parts)}    ],\n"


def _named(changes: dict[str, str], one: str) -> Iterable[tuple[str, str]]:
    return ((name, value.replace("{o}", one)) for name, value in changes.items())


def _numbers(values: Any) -> str:
    """Return numbers as Python writes them, without loss: (0, 1.5, -2)."""
    plain = np.asarray(values).tolist()
    return f"({', '.join(str(int(v)) if float(v).is_integer() and abs(v) < 1e15 else repr(v) for v in plain)})"


def cast_command(subject: Subject, chain: EmbeddedChain, everything: bool) -> str:
    """Return a shell command that renders the picture on a node and saves it as a BMP file.

    everything: send the code of the contracts along, as a state override, so that nothing need be deployed. InputError
    if the call is too long for a command line.
    """
    scene = subject.scene
    address = "0x" + chain.address("Renderer").hex()
    call = render_call(scene)
    data = "0x" + call.hex()
    if len(data) > MAX_ARGUMENT:
        raise InputError(
            f"the call has {len(data) // 2 - 1:,} bytes, too many for a command line, which takes"
            f" {MAX_ARGUMENT // 2 - 1:,}: download the calldata, or choose fewer triangles"
        )
    gas = _gas_limit(chain.call("Renderer", call), call)
    size = 54 + (3 * scene.width + 3) // 4 * 4 * scene.height
    overrides = ""
    if everything:
        needed = [chain.address(name) for name in ("Renderer", *artifact("Renderer").parts)]
        codes = (f"0x{place.hex()}:0x{chain.codes()[place].hex()}" for place in needed)
        overrides = "".join(f" --override-code {code}" for code in codes)
    # the output is two words, offset and length of the bytes, and then the bytes
    keep = f"cut -c131- | xxd -r -p | head -c {size} > {subject.stem}.bmp"
    node = '--rpc-url "${ETH_RPC_URL:-http://127.0.0.1:8545}"'
    return f"cast call {address} {data}{overrides} --gas-limit {gas} {node} | {keep}\n"


def _gas_limit(result: CallResult, data: bytes) -> int:
    """Return the gas limit of the call, which may be above the default limit of a node.

    A quarter is added for nodes that count by the rules of another fork.
    """
    needed = max(result.intrinsic_gas + needed_for(result.gas), floor_gas(data))
    return needed + needed // 4
