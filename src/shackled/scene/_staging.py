"""Cameras, lights and backgrounds for meshes that have none: all of a mesh in the picture, seen from a little above."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import ArrayLike, NDArray

from ..base import checks
from ..base.checks import Color, Floats, number
from ..base.values import checked, with_names
from ..errors import InputError
from ._arithmetic import cosine, dot, length, sine
from ._camera import DEFAULT_HALF_HEIGHT, Camera, half_height_of
from ._constants import LARGEST
from ._effects import Background
from ._fields import FIELDS, Projection
from ._light import WHITE, Light
from ._mesh import Mesh, face_normals, faces_of_all
from ._object import Material, Object

BACKGROUND = Background((46, 54, 72), (136, 146, 162))

#: The most pixels along a side of a picture, and how many it has where none are given.
MAX_SIDE: int = FIELDS["Scene"]["width"].limits[1]
DEFAULT_SIDE: int = FIELDS["Scene"]["width"].default

#: Toward the light, in the directions right, up and toward the viewer. Contracts are fastest with one white light.
KEY_LIGHT = (-0.4, 0.7, 0.8)

_AZIMUTH, _ELEVATION, _MARGIN = (FIELDS["Camera"][name] for name in ("azimuth", "elevation", "margin"))

#: Behind mesh files: light, or dark where most of the surface is light, so that no outline is lost.
LIGHT_BACKGROUND = Background((120, 130, 148), (196, 202, 212))
DARK_BACKGROUND = Background((16, 19, 25), (58, 64, 75))
#: The brightness, 0..255, from which a colour is light: in the light of a mesh file, and unlit.
_LIGHT, _LIGHT_UNLIT = 215.0, 115.0
#: Shares of red, green and blue in brightness.
_LUMA = np.array([0.2126, 0.7152, 0.0722])


@frozen(field_transformer=with_names)
class Viewpoint:
    """The side from which a camera sees all objects, and how it projects.

    azimuth, elevation: where the viewer stands, in degrees: to the right of the front (+z), and above the horizon.
    margin: the part of the picture's half width and half height that stays free around the objects, 0..0.9.
    half_height: of a perspective camera, as in `Camera`; an orthographic one takes what the objects need.
    aspect: width of the picture / its height.
    """

    azimuth: float = field(default=_AZIMUTH.default, converter=number, metadata=checked("the azimuth in degrees"))
    elevation: float = field(
        default=_ELEVATION.default, converter=number, metadata=checked("the elevation in degrees", *_ELEVATION.limits)
    )
    margin: float = field(default=_MARGIN.default, converter=number, metadata=checked("the margin", *_MARGIN.limits))
    projection: Projection = "perspective"
    half_height: float = DEFAULT_HALF_HEIGHT
    aspect: float = 1.0


@frozen
class Staging:
    """How a mesh without a scene is shown. side: of the picture in pixels. fields: of the Scene, by their names.

    view: of meshes at least half as high as wide; the flatter a mesh, the higher the viewer, up to `flat_elevation`.
    light: as `toward_viewer` has it.
    material: of the mesh. Its shading is replaced if `by_normals`: by that of the mesh's normals, or of computed ones.
    """

    side: int
    view: Viewpoint
    flat_elevation: float
    light: tuple[tuple[float, float, float], Color]
    material: Material
    by_normals: bool
    fields: Mapping[str, Any]

    def view_of(self, points: Floats) -> Viewpoint:
        """Return the view of points, (n, 3)."""
        with np.errstate(over="ignore"):
            x, y, z = np.ptp(points, axis=0).tolist()
        width = max(x, z)
        flatness = 1 - 2 * y / width if 2 * y < width < np.inf else 0.0
        lowest = self.view.elevation
        return evolve(self.view, elevation=lowest + flatness * (self.flat_elevation - lowest))


#: Of the pieces of datasets: cheap to draw.
PLAIN = Staging(
    side=DEFAULT_SIDE,
    view=Viewpoint(),
    flat_elevation=_ELEVATION.default,
    light=(KEY_LIGHT, WHITE),
    material=Material(),
    by_normals=False,
    fields={"background": BACKGROUND},
)
#: Of mesh files: as a product is photographed, with a warm key light from the upper left, through a lens of a narrow
#: angle.
MESH_STAGING = Staging(
    side=256,
    view=Viewpoint(azimuth=35.0, elevation=20.0, margin=0.15, half_height=half_height_of(30.0)),
    flat_elevation=40.0,
    # one: smooth surfaces in the light of several take three times the gas
    light=((-0.6, 0.7, 0.9), (255, 243, 226)),
    material=Material("smooth", ambient=0.32, diffuse=0.8, specular=0.4, shininess=28),
    by_normals=True,
    fields={"antialias": True, "ambient_light": (232, 240, 255)},
)


def staged(points: Floats, width: int, height: int) -> tuple[Camera, tuple[Light], Background]:
    """Return the camera, light and background with which points of the world, (n, 3), fill a picture. InputError
    where a float does not hold them, or the camera.
    """
    view = Viewpoint(aspect=width / height)
    # of any size: squares of its lengths stay within floats
    largest = float(np.abs(points).max()) or 1.0
    if not largest < LARGEST:
        raise InputError("the coordinates of the objects are too large for a camera to be placed")
    camera = frame(points / largest, view)
    camera = evolve(camera, eye=largest * camera.eye, target=largest * camera.target)
    return camera, (toward_viewer(view),), BACKGROUND


def painted(mesh: Mesh, color: ArrayLike | str) -> Mesh:
    return evolve(mesh, colors=checks.color(color, "the colour of a mesh"))


def painted_object(o: Object, color: ArrayLike | str) -> Object:
    """Return the object in one colour, without a texture."""
    return evolve(o, mesh=painted(o.mesh, color), material=evolve(o.material, texture=None))


def frame(points: Floats, view: Viewpoint) -> Camera:
    """Return the camera of a view, as near as all points, (n, 3), fit the picture."""
    right, up, back = view_axes(view.azimuth, view.elevation)
    x, y, z = dot(points, right), dot(points, up), dot(points, back)
    free = 1 - view.margin
    if view.projection == "orthographic":
        middle = np.array([each.max() + each.min() for each in (x, y, z)]) / 2
        half_height = float(max((x.max() - x.min()) / 2 / view.aspect, (y.max() - y.min()) / 2) / free) or 1.0
        distance = float(z.max() - middle[2]) + half_height
    else:
        # a point is in the picture if |x - x0| <= slope * (z0 - z): both sides are tight for the nearest z0, and
        # likewise for y
        half_height = view.half_height
        slopes = number(half_height, "half_height", 2**-10, 2**10) * free * np.array([view.aspect, 1])
        sides = [((a / slope + z).max(), (z - a / slope).max(), slope) for a, slope in ((x, slopes[0]), (y, slopes[1]))]
        z0 = max((high + low) / 2 for high, low, _ in sides)
        x0, y0 = (slope * (high - low) / 2 for high, low, slope in sides)
        # a mesh that is only a line toward the eye fits at any distance
        z0 = max(z0, float(z.max()) + 1e-3 * float(np.ptp(points, axis=0).max() or 1))
        middle = np.array([x0, y0, (z.max() + z.min()) / 2])
        distance = z0 - middle[2]
    target = middle[0] * right + middle[1] * up + middle[2] * back
    return Camera(
        target + distance * back, target, (0, 1, 0) if abs(back[1]) < 0.999 else up, view.projection, half_height
    )


def contrasting(objects: Sequence[Object]) -> Background:
    """Return the background before which no outline of the objects is lost: that which suits most of their surface."""
    light = total = 0.0
    for each in objects:
        colors = each.mesh.colors[each.mesh.faces].mean(axis=1)
        if each.material.texture is not None:
            colors = colors * each.material.texture.pixels.mean(axis=(0, 1)) / 255
        areas = length(face_normals((each.scale * each.mesh.positions)[each.mesh.faces]))
        limit = _LIGHT_UNLIT if each.material.shading == "unlit" else _LIGHT
        light += float(areas[dot(colors, _LUMA) >= limit].sum())
        total += float(areas.sum())
    return DARK_BACKGROUND if 2 * light > total else LIGHT_BACKGROUND


def toward_viewer(view: Viewpoint, direction: tuple[float, float, float] = KEY_LIGHT, color: Color = WHITE) -> Light:
    """Return a light at infinity that stays where it is for the viewer. direction: to it, right, up and toward them."""
    axes = np.stack(view_axes(view.azimuth, view.elevation), axis=1)
    return Light("directional", dot(np.array(direction), axes), color)


def view_axes(azimuth: float, elevation: float) -> tuple[Floats, Floats, Floats]:
    """Return unit vectors to the right, upward, and toward a viewer, of angles in degrees."""
    right = np.array([cosine(azimuth), 0, -sine(azimuth)])
    level = cosine(elevation)
    back = np.array([sine(azimuth) * level, sine(elevation), cosine(azimuth) * level])
    return right, np.cross(back, right), back


def is_closed(mesh: Mesh) -> bool:
    """Return whether each edge has a face on either side, wound alike, and the mesh bounds a volume from outside."""
    return _is_closed(mesh.positions, mesh.faces) and signed_volume(mesh) > 0


def are_closed(objects: Sequence[Object]) -> bool:
    """Return whether the faces of all objects together are closed; places within 2^-16 of their size are one."""
    if not objects:
        return True
    positions = np.concatenate([o.world_positions() for o in objects])
    low, high = positions.min(axis=0), positions.max(axis=0)
    step = math.ldexp(1.0, math.frexp(float((high - low).max()))[1] - 16)
    places = np.rint((positions - low) / step)
    faces = faces_of_all(o.mesh for o in objects)
    a, b, c = (places[faces[:, corner]] for corner in range(3))
    return _is_closed(places, faces) and float(dot(a, np.cross(b, c)).sum()) > 0


def _is_closed(positions: Floats, faces: NDArray[np.integer[Any]]) -> bool:
    number = np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)
    edges = number[faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    keys = np.sort(edges[:, 0] * len(positions) + edges[:, 1])
    twins = np.sort(edges[:, 1] * len(positions) + edges[:, 0])
    return bool(np.array_equal(keys, twins))


def signed_volume(mesh: Mesh) -> float:
    """Return the volume that a closed mesh bounds, negative if its faces are seen from inside."""
    positions = mesh.positions
    corners = (positions - positions.mean(axis=0))[mesh.faces]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)
