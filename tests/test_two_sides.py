"""Objects with two sides: what is seen from behind looks as if it were the front."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from pictures import draw
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.scene import Hemisphere, Texture, fit, look_at, vertex_normals
from shackled.scene._look import MOST_TWO_SIDED

LOOKS: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, Any]]] = {
    # fields of the material, of the object, of the scene
    "flat": ({"shading": "flat"}, {}, {}),
    "flat, antialiased": ({"shading": "flat"}, {}, {"antialias": True}),
    "smooth": ({"shading": "smooth"}, {}, {}),
    "smooth, antialiased": ({"shading": "smooth"}, {}, {"antialias": True}),
    "smooth, broad": ({"shading": "smooth", "shininess": 1}, {}, {"antialias": True}),
    "glass": ({"shading": "smooth"}, {"opacity": 0.5}, {}),
    "glass, antialiased": ({"shading": "flat"}, {"opacity": 0.5}, {"antialias": True}),
    "effects": ({"shading": "smooth"}, {}, {"hemisphere": Hemisphere("white", "red")}),
    "effects, flat": ({"shading": "flat"}, {}, {"hemisphere": Hemisphere("white", "red")}),
}
LIGHTS = [Light.directional(toward=(0.3, 0.5, 1)), Light.point((1, 1, 2), color="orange")]


def sheet(sides: int = 5) -> Mesh:
    """A wavy sheet in many colours, whose front is that of +z."""
    rng = np.random.default_rng(4)
    x, y = np.meshgrid(np.linspace(-1, 1, sides), np.linspace(-1, 1, sides))
    points = np.stack([x, y, 0.3 * np.sin(3 * x) * np.cos(2 * y)], axis=2).reshape(-1, 3)
    corner = np.arange(sides * sides).reshape(sides, sides)[:-1, :-1].reshape(-1, 1)
    faces = np.concatenate([corner + np.array(each) for each in ((0, 1, sides + 1), (0, sides + 1, sides))])
    texture = np.clip((points[:, :2] + 1) / 2, 0, 1)
    mesh = Mesh(points, faces, rng.integers(60, 255, (len(points), 3)), uvs=texture)
    return evolve(mesh, normals=vertex_normals(points, faces))


def turned(mesh: Mesh) -> Mesh:
    """The mesh with its front on the other side."""
    assert mesh.normals is not None
    return evolve(mesh, faces=mesh.faces[:, [0, 2, 1]], normals=-mesh.normals)


def picture(
    mesh: Mesh, look: str, two_sided: bool, eye: tuple[float, float, float] = (0.4, 0.3, 3), **more: Any
) -> NDArray[Any]:
    material, fields, scene = LOOKS[look]
    thing = Object(mesh, material=Material(**{**material, **more}), cull=False, two_sided=two_sided, **fields)
    camera = Camera.perspective(eye, (0, 0, 0), fov=50)
    return np.asarray(draw(fit(Scene([thing], camera, LIGHTS, width=48, height=48, **scene))))


def test_large_meshes_have_two_sides_only_if_their_file_says_so() -> None:
    """By default; each vertex would have a second record in memory."""
    small, large = sheet(128), sheet(129)
    assert len(small.positions) == MOST_TWO_SIDED < len(large.positions)
    for mesh, stated, expected in ((small, False, True), (large, False, False), (large, True, True)):
        (thing,) = look_at([Object(mesh, two_sided=stated)], {}).objects
        assert (thing.cull, thing.two_sided) == (False, expected)
    (thing,) = look_at([Object(large, two_sided=True)], {"two_sided": False}).objects
    assert not thing.two_sided


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("near", [False, True])
def test_the_back_looks_like_a_front(look: str, near: bool) -> None:
    """From behind, as a sheet whose front is there, also where faces are clipped. From the front, as before."""
    eye = (0.1, -0.2, 0.45) if near else (0.4, 0.3, 3)
    mesh = sheet()
    right = picture(mesh, look, False, eye)
    assert (picture(mesh, look, True, eye) == right).all()
    behind = picture(turned(mesh), look, True, eye)
    # the depths of faces that are turned away, by which colours are divided, are a little less
    assert np.abs(behind.astype(int) - right).max() <= 1
    assert (picture(turned(mesh), look, False, eye) != right).any()


def test_neighbours_that_disagree() -> None:
    """A sheet some of whose faces are turned looks like one whose faces agree."""
    mesh = evolve(sheet(), normals=None)
    faces = mesh.faces.copy()
    faces[::3] = faces[::3][:, [0, 2, 1]]
    mixed = evolve(mesh, faces=faces)
    for look in ("flat", "flat, antialiased", "effects, flat"):
        right, got = (picture(each, look, True).astype(int) for each in (mesh, mixed))
        # faces that are turned away are moved back a little, which decides at the edges between both kinds
        assert (np.abs(right - got).max(axis=2) > 2).mean() < 0.02


def test_textures_of_backs() -> None:
    """Smooth vertices have second records behind, which have the same texture coordinates."""
    pixels = np.random.default_rng(1).integers(0, 256, (4, 4, 3))
    for near in (False, True):
        eye = (0.1, -0.2, 0.45) if near else (0.4, 0.3, 3)
        right, got = (
            picture(mesh, "smooth", True, eye, texture=Texture(pixels, "nearest"))
            for mesh in (sheet(), turned(sheet()))
        )
        assert (right == got).all()


def test_what_is_culled_has_one_side() -> None:
    mesh, pictures = sheet(), []
    for two_sided in (False, True):
        thing = Object(mesh, material=Material("smooth"), cull=True, two_sided=two_sided)
        scene = Scene([thing], Camera.perspective((0.4, 0.3, 3), (0, 0, 0), fov=50), LIGHTS, width=48, height=48)
        pictures.append(draw(fit(scene)))
    assert (pictures[0] == pictures[1]).all()
