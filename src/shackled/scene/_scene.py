"""Scenes: objects, camera, lights, background and size."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from attrs import field, frozen

from ..base.checks import Color, Floats, color, flag, instance, integer
from ..base.synonyms import Hinted, with_synonyms
from ..base.values import plural
from ..base.whole_file import check_output_file, write_output
from ..errors import InputError
from ._camera import Camera
from ._effects import Background, Fog, Hemisphere, Rim, Tone, background_of, fog_of, hemisphere_of, rim_of, tone_of
from ._files.written import encode_document, fields_of
from ._ground import Ground, ground_of
from ._light import Light, lights_of, parts_of
from ._mesh import Mesh, is_trimesh
from ._object import Object
from ._staging import staged
from ._table import USUAL, from_table


def _objects(value: Object | Mesh | Iterable[Object | Mesh]) -> tuple[Object, ...]:
    given: Any = [value] if isinstance(value, Object | Mesh) or is_trimesh(value) else value
    parts: list[Any] = parts_of(given, "objects", "an Object, a Mesh")
    objects = [Object(part) if isinstance(part, Mesh) or is_trimesh(part) else part for part in parts]
    return tuple(instance(part, f"objects[{number}] of a scene", Object) for number, part in enumerate(objects))


def _camera(value: Camera | None) -> Camera:
    return value if value is None else instance(value, "the camera of a scene", Camera)  # type: ignore[return-value]


def _side(value: int, name: str = "side", low: int = 1, high: int = 1) -> int:
    side = integer(value)
    if side is None or not low <= side <= high:
        raise InputError(f"the {name} of a picture must be from {low} to {high} pixels, not {value!r:.60}")
    return side


@with_synonyms()
@frozen(field_transformer=from_table, repr=False)
class Scene(Hinted):
    """Objects, drawn in their order with one depth buffer, seen by a camera.

    objects: also a Mesh in place of an Object, or one alone.
    background: also a colour, or two, (top, bottom).
    camera, lights, background: if none of the three is given, objects are staged: the camera sees all of them from a
        little above and to the side, and a white light shines from the upper left. Otherwise None is `Camera()`, no
        light, or black.
    ambient_light: the colour of the light that comes from everywhere.
    invert: every byte v of the picture becomes 255 - v.
    width, height: of the picture in pixels, 1..2048.
    antialias: whether edges are smoothed, by four samples per pixel.
    hemisphere: light from above and below; also given as a colour, or two, (sky, ground).
    rim: light along outlines; also given as a colour, or (colour, power).
    fog: fog between two distances; also given as (colour, near, far).
    tone: how light becomes colours.
    ground: a disc under the objects, which receives shadows; also given as a colour. Scenes with a hemisphere, rim,
        fog, tone, shadow or ground are always antialiased.
    """

    objects: tuple[Object, ...] = field(converter=_objects)
    camera: Camera = field(default=None, converter=_camera)
    lights: tuple[Light, ...] = field(default=None, converter=lights_of)
    background: Background = field(default=None, converter=background_of)
    ambient_light: Color = field(default=USUAL, converter=color)
    invert: bool = field(default=USUAL, converter=flag)
    width: int = field(default=USUAL, converter=_side)
    height: int = field(default=USUAL, converter=_side)
    antialias: bool = field(default=USUAL, converter=flag)
    hemisphere: Hemisphere | None = field(default=None, converter=hemisphere_of)
    rim: Rim | None = field(default=None, converter=rim_of)
    fog: Fog | None = field(default=None, converter=fog_of)
    tone: Tone | None = field(default=None, converter=tone_of)
    ground: Ground | None = field(default=None, converter=ground_of)

    def __attrs_post_init__(self) -> None:
        """Set the default camera, lights and background; check that one light at most casts shadows."""
        camera, background = Camera(), Background()
        lights: tuple[Light, ...] = ()
        if self.objects and self.camera is None and self.lights is None and self.background is None:
            with np.errstate(over="ignore", invalid="ignore"):
                points = self.world_positions()
            camera, lights, background = staged(points, self.width, self.height)
        for name, chosen in (("camera", camera), ("lights", lights), ("background", background)):
            if getattr(self, name) is None:
                object.__setattr__(self, name, chosen)
        if sum(light.shadow for light in self.lights) > 1:
            raise InputError("one light of a scene may cast shadows, not several")

    @property
    def triangles(self) -> int:
        """The number of triangles of all objects."""
        return sum(each.mesh.triangles for each in self.objects)

    def world_positions(self) -> Floats:
        """Return the vertices of all objects in the world, (n, 3)."""
        return np.concatenate([np.zeros((0, 3)), *(each.world_positions() for each in self.objects)])

    @property
    def bounds(self) -> Floats:
        """The box around all objects in the world, (2, 3): its lowest and its highest corner; zeros without objects."""
        points = self.world_positions()
        return np.stack([points.min(axis=0), points.max(axis=0)]) if len(points) else np.zeros((2, 3))

    def encode(self) -> bytes:
        """Return the bytes of a .json scene file, with its meshes inside, such that loading it gives the same scene."""
        return encode_document(
            {
                "size": (self.width, self.height),
                **fields_of(self, "scene"),
                **({} if self.tone is None else {"tone": fields_of(self.tone, "tone")}),
                "camera": self.camera,
                "objects": self.objects,
            }
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a scene file, .json, as `encode` returns it.

        InputError where the path is wrong, OutputError where the disk is full or fails.
        """
        path = Path(path)
        if path.suffix.lower() != ".json":
            hint = "; the command `shackled export` writes models" if path.suffix.lower() == ".glb" else ""
            raise InputError(f"the scene {path} must end in .json{hint}")
        write_output(check_output_file(path, "scene"), self.encode())

    def __repr__(self) -> str:
        return (
            f"<Scene {self.width}x{self.height}, {plural(len(self.objects), 'object')}, "
            f"{plural(self.triangles, 'triangle')}, {plural(len(self.lights), 'light')}>"
        )
