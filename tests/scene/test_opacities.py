"""Opacities of vertices: what a mesh takes, what keeps them, and the calls that hold them."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from attrs import evolve
from numpy.typing import NDArray
from PIL import Image

from pictures import draw
from shackled import Camera, InputError, Light, Material, Mesh, Object, Scene, Texture, load
from shackled.datasets.common import shapes
from shackled.scene import decode
from shackled.scene._codec import extensions, render_call
from shackled.scene._crease import creased
from shackled.scene._files.model import MeshPart
from shackled.scene._from_trimesh import objects_of, part_of
from shackled.scene._in_range import in_range
from shackled.scene._mesh import weld
from shackled.scene._simplify import simplify

CORNERS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
FACES = [[0, 1, 2], [0, 2, 3]]
SQUARE = Mesh(CORNERS, FACES, opacities=[0, 0.2, 1, 0.4])
BALL = shapes.icosphere(2)
HEIGHTS = (BALL.positions[:, 1] - BALL.positions[:, 1].min()) / np.ptp(BALL.positions[:, 1])


def glass(**changes: Any) -> Object:
    """A ball that is opaque at its top, and not seen at its bottom."""
    return evolve(Object(evolve(BALL, opacities=HEIGHTS), material=Material("smooth")), **changes)


def scene_of(*objects: Object, **changes: Any) -> Scene:
    scene = Scene(list(objects), Camera((0, 0, 3), (0, 0, 0)), Light("directional", (1, 2, 3)), "white")
    return evolve(scene, width=40, height=40, **changes)


def pixels(scene: Scene) -> NDArray[np.int64]:
    return draw(in_range(scene)).astype(int)


def test_they_are_multiples_of_a_255th() -> None:
    assert SQUARE.opacities is not None
    assert np.rint(255 * SQUARE.opacities).tolist() == [0, 51, 255, 102]
    assert Mesh(CORNERS, FACES, opacities=np.array([0, 0.2001, 0.999, 0.4])) == SQUARE
    assert pickle.loads(pickle.dumps(SQUARE)) == SQUARE
    assert evolve(SQUARE, opacities=None) != SQUARE
    assert Mesh(CORNERS, FACES, opacities=[1, 1, 0.9999, 1]).opacities is None
    assert not SQUARE.opacities.flags.writeable


@pytest.mark.parametrize("kind", [list, np.array, lambda rows: np.array(rows, np.uint8)])
def test_the_alpha_of_colours(kind: Any) -> None:
    rows = [(1, 2, 3, 0), (4, 5, 6, 51), (7, 8, 9, 255), (10, 11, 12, 102)]
    mesh = Mesh(CORNERS, FACES, kind(rows))
    assert mesh.colors.tolist() == [list(row[:3]) for row in rows]
    assert mesh.rgba.tolist() == [list(row) for row in rows]
    assert mesh == Mesh(CORNERS, FACES, [row[:3] for row in rows], opacities=SQUARE.opacities)
    assert evolve(mesh, colors="red").opacities is not None


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"opacities": [0.5] * 3}, "a mesh of 4 vertices needs as many opacities, not 3"),
        ({"opacities": [0.5, 1.5, 1, 1]}, "the opacity of vertex 1 must be from 0 to 1, not 1.5"),
        ({"opacities": [0.5, 1, 1, np.nan]}, "the opacity of vertex 3 must be from 0 to 1, not nan"),
        ({"opacities": "glass"}, "the opacities of a mesh must be numbers, one for each vertex"),
        ({"opacities": [[0.5]] * 4}, r"the opacities of a mesh must be numbers, .* not of shape \(4, 1\)"),
        ({"opacities": [0.5] * 4, "colors": [(1, 2, 3, 4)] * 4}, "a mesh has opacities, or colours with .* not both"),
    ],
)
def test_opacities_that_are_none(values: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=f"^{message}"):
        Mesh(CORNERS, FACES, **values)


def test_corners_of_other_opacities_are_other_vertices() -> None:
    colors = np.full((2, 3, 4), 255)
    colors[1, :, 3] = [9, 255, 0]
    mesh = weld(CORNERS, FACES, colors)
    assert len(mesh.positions) == 5
    assert mesh.rgba[mesh.faces].tolist() == colors.tolist()


def test_creases_and_simplification_keep_them() -> None:
    ball = evolve(BALL, opacities=HEIGHTS, normals=None)
    sharp = creased(ball, 0.0)
    assert (sharp.rgba[sharp.faces] == ball.rgba[ball.faces]).all()
    fewer = simplify(ball, 100)
    assert fewer.opacities is not None
    heights = (fewer.positions[:, 1] - BALL.positions[:, 1].min()) / np.ptp(BALL.positions[:, 1])
    assert np.abs(fewer.opacities - heights).max() < 0.2
    textured = simplify(evolve(ball, uvs=BALL.positions[:, :2]), 100)
    assert textured.opacities is not None
    assert np.abs(textured.opacities - textured.positions[:, 1] / np.ptp(BALL.positions[:, 1]) - 0.5).max() < 0.2


def test_one_colour_for_all_keeps_them() -> None:
    (o,) = load([glass()], color="tomato").objects
    expected = [(255, 99, 71, alpha) for alpha in glass().mesh.rgba[:, 3]]
    assert (o.mesh.rgba == expected).all()


def test_records() -> None:
    plain = Object(Mesh(CORNERS, FACES))
    wood = Texture(np.zeros((1, 1, 3)))
    both = Object(evolve(SQUARE, uvs=np.zeros((4, 2))), material=Material(texture=wood), opacity=0.5)
    many = Object(Mesh(np.zeros((33, 3)), [[0, 1, 32]], opacities=[0.2, *np.ones(31), 0]))
    scene = scene_of(plain, both, many)
    records = extensions(scene)
    levels = [b"\0\x33\xff\x66" + bytes(28), b"\x33" + b"\xff" * 31 + bytes(32)]
    assert records[:9] == b"\2\0\1\0\4\0\x80\0\0"
    assert records[9:14] == b"\10\0\1\0\2"
    assert records[14 + 64 :] == b"\t\0\1\0\1" + levels[0] + b"\t\0\2\0\2" + levels[1]


def test_a_scene_file(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"

    def read(keys: str) -> Mesh:
        path.write_text(f"[[objects]]\nmesh = {{ positions = {CORNERS}, faces = {FACES}, {keys} }}\n")
        return load(path).objects[0].mesh

    assert read("opacities = [0, 0.2, 1, 0.4]") == SQUARE
    rows = [[200, 200, 200, level] for level in (0, 51, 255, 102)]
    assert read(f"colors = {rows}") == SQUARE
    for keys, message in (
        ("opacities = [0, 1, 1, true]", "objects[0].mesh.opacities[3] must be a number, not True"),
        ("opacities = [0, 1, 1]", "objects[0].mesh: a mesh of 4 vertices needs as many opacities, not 3"),
        (f"colors = {[*rows[:3], [1, 2, 3]]}", "colors[3] must be four whole numbers, not [1, 2, 3]"),
    ):
        with pytest.raises(InputError) as caught:
            read(keys)
        assert message in str(caught.value)


def test_records_that_are_wrong() -> None:
    scene = scene_of(Object(SQUARE))
    call = render_call(scene)
    begin = call.index(b"\t\0\0\0\1") + 5
    opaque = call[:begin] + b"\xff" * 4 + call[begin + 4 :]
    for wrong in (*(call[: begin + at] + b"\1" + call[begin + at + 1 :] for at in (4, 31, -4)), opaque):
        with pytest.raises(InputError, match="the call is not the one that Shackled makes of its scene"):
            decode(wrong)


def test_trimesh() -> None:
    levels = np.arange(16, dtype=np.uint8).reshape(4, 4)
    colored = trimesh.Trimesh(CORNERS, FACES, vertex_colors=levels, process=False)
    assert Mesh.from_trimesh(colored).rgba.tolist() == levels.tolist()
    (o,) = objects_of(trimesh.Scene([colored]))
    assert o.mesh.rgba.tolist() == levels.tolist()


IMAGE = Image.new("RGBA", (2, 2), (1, 2, 3, 4))


def part_with(**material: Any) -> MeshPart:
    """The square with a material of trimesh."""
    visuals: Any = trimesh.visual
    visual = visuals.TextureVisuals(uv=np.zeros((4, 2)), material=visuals.material.PBRMaterial(**material))
    return part_of(trimesh.Trimesh(CORNERS, FACES, visual=visual, process=False))


@pytest.mark.parametrize("mode", [None, "OPAQUE", "BLEND"])
@pytest.mark.parametrize("image", [None, IMAGE])
def test_materials_of_trimesh(mode: str | None, image: Image.Image | None) -> None:
    part = part_with(baseColorFactor=[255, 0, 0, 51], alphaMode=mode, baseColorTexture=image)
    if image is not None:
        alpha = part.material["texture"].alpha
        assert (None if alpha is None else alpha.tolist()) == ([[4, 4]] * 2 if mode == "BLEND" else None)
    assert part.opacity == (0.2 if mode == "BLEND" else 1)
    assert part.mesh.opacities is None
    assert part.mesh.colors.tolist() == [[255, 0, 0]] * 4


@pytest.mark.parametrize(("given", "expected"), [(None, 128), (0.25, 64), (1.0, 255), (0.0, None)])
def test_masks_of_trimesh(given: float | None, expected: int | None) -> None:
    """Without a cutoff it is a half, as in glTF; one of 0 hides nothing."""
    image = IMAGE.copy()
    image.putpixel((0, 1), (1, 2, 3, 255))
    texture = part_with(alphaMode="MASK", alphaCutoff=given, baseColorTexture=image).material["texture"]
    assert (None if texture.alpha is None else texture.cutoff) == expected


def test_what_is_not_opaque_shows_what_is_behind() -> None:
    behind = Object(shapes.cube(), (0, 0, -3), scale=5)
    seen, clear, both = pixels(scene_of(glass())), pixels(scene_of(behind)), pixels(scene_of(glass(), behind))
    # the top is opaque, the bottom is not there, whatever the order
    column = np.flatnonzero(np.abs(both[:, 20] - clear[:, 20]).max(axis=1) > 2)
    assert np.abs(both[column[1], 20] - seen[column[1], 20]).max() < 30
    assert np.abs(both[column[-1], 20] - clear[column[-1], 20]).max() < 30
    assert column[-1] - column[0] > 25
    assert (pixels(scene_of(behind, glass())) == both).all()
