"""A mesh without a scene, set up like a product shot: centred, seen from a little above and to the side, lit from the
front.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import ArrayLike, NDArray

from .. import checks
from ..checks import Color, Floats
from ..errors import InputError
from ._background import Background, background_of
from ._camera import DEFAULT_HALF_HEIGHT, Camera, Projection
from ._light import WHITE, Light
from ._material import Material
from ._mesh import Mesh
from ._object import Object
from ._rotation import rotate, rotation_of
from ._scene import DEFAULT_SIDE, Scene
from ._value import array_key

BACKGROUND = Background((46, 54, 72), (136, 146, 162))

#: Toward the light, in the directions right, up and toward the viewer. Contracts are fastest with one white light.
KEY_LIGHT = (-0.4, 0.7, 0.8)

#: Degrees: where the viewer stands, to the right of the front (+z) and above the horizon.
AZIMUTH, ELEVATION = 30.0, 20.0
#: The part of the picture's half width and half height that stays free around a mesh.
MARGIN = 0.08
#: Coordinates of objects at most, so that a float holds those of a camera that sees them all.
LARGEST = 1e305


def _color(value: ArrayLike | str | None) -> Color | None:
    return None if value is None else checks.color(value, "the colour of a mesh")


@frozen
class Look:
    """What may be chosen about the picture of a mesh.

    rotation: of the mesh, as that of an `Object`; for instance (-90, 0, 0) for a file with z up.
    azimuth, elevation: where the viewer stands, in degrees: to the right of the front (+z), and above the horizon.
    half_height: as in `Camera`, for the perspective camera; the orthographic one takes what the mesh needs.
    margin: the part of the picture's half width and half height that stays free around the mesh, 0..0.9.
    color: one colour for the whole mesh in place of its own.
    lights: None for a white light from the upper left.
    cull: None leaves out the faces that turn away where the mesh is closed, so that this cannot be seen.
    """

    width: int = DEFAULT_SIDE
    height: int = DEFAULT_SIDE
    rotation: Floats = field(default=(0, 0, 0, 1), converter=rotation_of, eq=array_key)
    azimuth: float = AZIMUTH
    elevation: float = ELEVATION
    projection: Projection = "perspective"
    half_height: float = DEFAULT_HALF_HEIGHT
    margin: float = MARGIN
    color: Color | None = field(default=None, converter=_color)
    material: Material = field(factory=lambda: Material("flat", 0.3, 0.75, 0.3, 24))
    lights: Sequence[Light] | None = None
    background: Background = field(default=BACKGROUND, converter=background_of)
    ambient_light: Color = field(default=WHITE, converter=checks.color)
    cull: bool | None = None
    wireframe: bool = False
    invert: bool = False


def stage(mesh: Mesh, look: Look | None = None) -> Scene:
    """Return a scene of one mesh: scaled to a bounding sphere of radius 1 about the origin, and filling the picture.

    The mesh keeps its coordinates; position and scale of the object do the rest.
    """
    look = look or Look()
    Scene([], width=look.width, height=look.height)  # a wrong size is told before anything is divided by it
    positions = mesh.positions
    with np.errstate(over="ignore"):
        center = (positions.min(axis=0) + positions.max(axis=0)) / 2
        radius = float(np.linalg.norm(positions - center, axis=1).max())
    scale = 1 / radius if radius > 0 else 1.0
    if not np.isfinite(center).all() or not np.isfinite(radius) or not np.isfinite(scale):
        raise InputError("the coordinates of the mesh are too large or too small to be scaled")
    turned = rotate(look.rotation, (positions - center) * scale)
    return Scene(
        objects=[
            Object(
                mesh if look.color is None else painted(mesh, look.color),
                position=-rotate(look.rotation, center * scale),
                rotation=look.rotation,
                scale=scale,
                material=look.material,
                cull=is_closed(mesh) if look.cull is None else look.cull,
                wireframe=look.wireframe,
            )
        ],
        camera=frame(turned, look),
        lights=[key_light(look)] if look.lights is None else look.lights,
        background=look.background,
        ambient_light=look.ambient_light,
        invert=look.invert,
        width=look.width,
        height=look.height,
    )


def staged(points: NDArray[np.float64], width: int, height: int) -> tuple[Camera, tuple[Light], Background]:
    """Return the camera, the light and the background with which points of the world, (n, 3), fill a picture.

    InputError where a float does not hold their coordinates, or those of the camera.
    """
    look = Look(width=width, height=height)
    # of any size: squares of its lengths stay within floats
    largest = float(np.abs(points).max()) or 1.0
    if not largest < LARGEST:
        raise InputError("the coordinates of the objects are too large for a camera to be placed")
    camera = frame(points / largest, look)
    camera = evolve(camera, eye=largest * camera.eye, target=largest * camera.target)
    return camera, (key_light(look),), BACKGROUND


def painted(mesh: Mesh, color: ArrayLike | str) -> Mesh:
    """Return the mesh in one colour."""
    return evolve(mesh, colors=checks.color(color, "the colour of a mesh"))


def frame(points: NDArray[np.float64], look: Look) -> Camera:
    """Return the camera that looks from `azimuth` and `elevation`, as near as all points, (n, 3), fit the picture."""
    right, up, back = view_axes(look)
    x, y, z = points @ right, points @ up, points @ back
    free = 1 - checks.number(look.margin, "the margin around the mesh", 0, 0.9)
    aspect = look.width / look.height
    if look.projection == "orthographic":
        middle = np.array([x.max() + x.min(), y.max() + y.min(), z.max() + z.min()]) / 2
        half_height = float(max((x.max() - x.min()) / 2 / aspect, (y.max() - y.min()) / 2) / free) or 1.0
        distance = float(z.max() - middle[2]) + half_height
    else:
        # a point is in the picture if |x - x0| <= slope * (z0 - z): both sides are tight for the nearest z0, and
        # likewise for y
        half_height = look.half_height
        slopes = checks.number(half_height, "half_height", 2**-10, 2**10) * free * np.array([aspect, 1])
        sides = [((a / slope + z).max(), (z - a / slope).max(), slope) for a, slope in ((x, slopes[0]), (y, slopes[1]))]
        z0 = max((high + low) / 2 for high, low, _ in sides)
        x0, y0 = (slope * (high - low) / 2 for high, low, slope in sides)
        # a mesh that is only a line toward the eye fits at any distance
        z0 = max(z0, float(z.max()) + 1e-3 * float(np.ptp(points, axis=0).max() or 1))
        middle = np.array([x0, y0, (z.max() + z.min()) / 2])
        distance = z0 - middle[2]
    target = middle[0] * right + middle[1] * up + middle[2] * back
    return Camera(
        target + distance * back, target, (0, 1, 0) if abs(back[1]) < 0.999 else up, look.projection, half_height
    )


def key_light(look: Look) -> Light:
    """Return a light that stays where it is for the viewer, wherever the viewer stands."""
    return Light("directional", np.asarray(KEY_LIGHT) @ np.stack(view_axes(look)))


def view_axes(look: Look) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return unit vectors to the right, upward, and toward the viewer."""
    azimuth = np.radians(checks.number(look.azimuth, "the azimuth in degrees"))
    elevation = np.radians(checks.number(look.elevation, "the elevation in degrees", -90, 90))
    right = np.array([np.cos(azimuth), 0, -np.sin(azimuth)])
    back = np.array([np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)])
    return right, np.cross(back, right), back


def is_closed(mesh: Mesh) -> bool:
    """Return whether each edge has a face on either side, wound alike, and the mesh bounds a volume from outside."""
    positions = mesh.positions
    number = np.unique(positions, axis=0, return_inverse=True)[1].reshape(-1)
    faces = number[mesh.faces]
    edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    keys = np.sort(edges[:, 0] * len(positions) + edges[:, 1])
    twins = np.sort(edges[:, 1] * len(positions) + edges[:, 0])
    return bool(np.array_equal(keys, twins)) and signed_volume(mesh) > 0


def signed_volume(mesh: Mesh) -> float:
    """Return the volume that a closed mesh bounds, negative if its faces are seen from inside."""
    positions = mesh.positions
    corners = (positions - positions.mean(axis=0))[mesh.faces]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)
