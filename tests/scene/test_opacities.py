"""Opacities of vertices: what a mesh takes, what keeps them, and the calls that hold them."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from attrs import evolve
from numpy.typing import NDArray
from PIL import Image

import shackled
from pictures import draw
from shackled import Camera, InputError, Light, Material, Mesh, Object, Scene, Texture, load
from shackled.datasets.common import shapes
from shackled.scene import decode, fit, objects_of, part_of, read_model, render_call, simplify, weld
from shackled.scene._codec import extensions
from shackled.scene._crease import creased

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
    return draw(fit(scene)).astype(int)


# ---- what a mesh takes ----


def test_they_are_multiples_of_a_255th() -> None:
    assert SQUARE.opacities is not None
    assert np.rint(255 * SQUARE.opacities).tolist() == [0, 51, 255, 102]
    assert Mesh(CORNERS, FACES, opacities=np.array([0, 0.2001, 0.999, 0.4])) == SQUARE
    assert hash(SQUARE) == hash(copy.deepcopy(SQUARE))
    assert pickle.loads(pickle.dumps(SQUARE)) == SQUARE
    assert evolve(SQUARE, opacities=None) != SQUARE
    assert Mesh(CORNERS, FACES, opacities=[1, 1, 0.9999, 1]).opacities is None
    assert repr(SQUARE) == "<Mesh 4 vertices, 2 triangles>"
    with pytest.raises(ValueError, match="read-only"):
        SQUARE.opacities[0] = 1


@pytest.mark.parametrize("kind", [list, np.array, lambda rows: np.array(rows, np.uint8)])
def test_the_alpha_of_colours(kind: Any) -> None:
    rows = [(1, 2, 3, 0), (4, 5, 6, 51), (7, 8, 9, 255), (10, 11, 12, 102)]
    mesh = Mesh(CORNERS, FACES, kind(rows))
    assert mesh.colors.tolist() == [list(row[:3]) for row in rows]
    assert mesh.rgba.tolist() == [list(row) for row in rows]
    assert mesh == Mesh(CORNERS, FACES, [row[:3] for row in rows], opacities=SQUARE.opacities)
    assert evolve(mesh, colors="red").opacities is not None


def test_the_alpha_of_one_colour_is_that_of_all() -> None:
    mesh = Mesh(CORNERS, FACES, (1.0, 0.5, 0.0, 0.2))
    assert mesh.rgba.tolist() == [[255, 128, 0, 51]] * 4
    assert Mesh(CORNERS, FACES, (1, 2, 3, 255)).opacities is None


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"opacities": [0.5] * 3}, "a mesh of 4 vertices needs as many opacities, not 3"),
        ({"opacities": [0.5, 1.5, 1, 1]}, "the opacity of vertex 1 must be from 0 to 1, not 1.5"),
        ({"opacities": [0.5, 1, -0.1, 1]}, "the opacity of vertex 2 must be from 0 to 1, not -0.1"),
        ({"opacities": [0.5, 1, 1, np.nan]}, "the opacity of vertex 3 must be from 0 to 1, not nan"),
        ({"opacities": "glass"}, "the opacities of a mesh must be numbers, one for each vertex"),
        (
            {"opacities": [[0.5]] * 4},
            r"the opacities of a mesh must be numbers, one for each vertex, not of shape \(4, 1\)",
        ),
        (
            {"opacities": [0.5] * 4, "colors": [(1, 2, 3, 4)] * 4},
            "a mesh has opacities, or colours with an alpha below 255, not both",
        ),
        ({"colors": [(1, 2, 3, 256)] * 4}, "the colour of vertex 0 must be from 0 to 255"),
    ],
)
def test_opacities_that_are_none(values: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=f"^{message}"):
        Mesh(CORNERS, FACES, **values)


# ---- what keeps them ----


def test_corners_of_other_opacities_are_other_vertices() -> None:
    colors = np.full((2, 3, 4), 255)
    colors[1, :, 3] = [255, 255, 0]
    mesh = weld(CORNERS, FACES, colors)
    assert len(mesh.positions) == 4
    colors[1, 0, 3] = 9
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


def test_joined_meshes_keep_them() -> None:
    both = shapes.joined(SQUARE, BALL)
    assert both.opacities is not None
    assert both.opacities.tolist() == [*np.asarray(SQUARE.opacities).tolist(), *np.ones(len(BALL.positions)).tolist()]


def test_vertices_that_no_face_uses_are_left_out() -> None:
    more = Mesh([[9, 9, 9], *CORNERS], np.array(FACES) + 1, opacities=[0.5, 0, 0.2, 1, 0.4])
    (o,) = fit(scene_of(Object(more))).objects
    assert o.mesh.opacities is not None
    assert o.mesh.opacities.tolist() == np.asarray(SQUARE.opacities).tolist()
    (o,) = fit(scene_of(Object(evolve(more, opacities=[0.5, 1, 1, 1, 1])))).objects
    assert o.mesh.opacities is None


def test_one_colour_for_all_keeps_them() -> None:
    (o,) = load([glass()], color="tomato").objects
    assert (o.mesh.rgba[:, :3] == (255, 99, 71)).all()
    assert (o.mesh.rgba[:, 3] == glass().mesh.rgba[:, 3]).all()


# ---- calls, and files with scenes ----


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


def test_scene_files_links_and_pictures_keep_them(tmp_path: Path) -> None:
    scene = scene_of(glass(), Object(SQUARE, opacity=0.5))
    scene.save(tmp_path / "scene.json")
    assert load(tmp_path / "scene.json") == scene
    call = render_call(scene)
    assert render_call(decode(call)) == call
    shackled.render(scene).save(tmp_path / "scene.png")
    assert render_call(load(tmp_path / "scene.png")) == call


def test_a_scene_file(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"

    def read(keys: str) -> Mesh:
        path.write_text(f"[[objects]]\nmesh = {{ positions = {CORNERS}, faces = {FACES}, {keys} }}\n")
        return load(path).objects[0].mesh

    assert read("opacities = [0, 0.2, 1, 0.4]") == SQUARE
    rows = [[200, 200, 200, level] for level in (0, 51, 255, 102)]
    assert read(f"colors = {rows}") == SQUARE
    for keys, message in (
        ("opacities = 1", "objects[0].mesh.opacities must be a list, not 1"),
        ("opacities = [0, 1, 1, true]", "objects[0].mesh.opacities[3] must be a number, not True"),
        ("opacities = [0, 1, 1]", "objects[0].mesh: a mesh of 4 vertices needs as many opacities, not 3"),
        (f"colors = {[*rows[:3], [1, 2, 3]]}", "colors[3] must be four whole numbers, not [1, 2, 3]"),
        (f"opacities = [0, 1, 1, 1], colors = {rows}", "not both"),
    ):
        with pytest.raises(InputError) as caught:
            read(keys)
        assert message in str(caught.value)


def test_records_that_are_wrong() -> None:
    scene = scene_of(Object(SQUARE))
    call = render_call(scene)
    begin = call.index(b"\t\0\0\0\1") + 5
    for place, byte, message in (
        (4, 1, r"the opacities of objects\[0\] must be 4 bytes, and zeros that fill the last word"),
        (31, 1, "zeros that fill the last word"),
        (-4, 1, "number 256 of 1"),
    ):
        wrong = bytearray(call)
        wrong[begin + place] = byte
        with pytest.raises(InputError, match=message):
            decode(bytes(wrong))
    opaque = call[:begin] + b"\xff" * 4 + call[begin + 4 :]
    with pytest.raises(InputError, match=r"one of the opacities of objects\[0\] must be below 255"):
        decode(opaque)


# ---- files ----


def test_ply(tmp_path: Path) -> None:
    def read(kind: str, rows: Any) -> Mesh:
        names = "".join(f"property {kind} {name}\n" for name in ("red", "green", "blue", "alpha"))
        text = f"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{names}"
        text += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        for point, row in zip(CORNERS, rows, strict=False):
            text += " ".join(map(str, [*point, *row])) + "\n"
        path = tmp_path / "a.ply"
        path.write_text(text + "3 0 1 2\n")
        return read_model(path)[0].mesh

    levels = [[1, 2, 3, 4], [5, 6, 7, 255], [8, 9, 10, 0]]
    assert read("uchar", levels).rgba.tolist() == levels
    assert read("float", [[0.2, 0.4, 0.6, 0.8]] * 3).rgba.tolist() == [[51, 102, 153, 204]] * 3
    assert read("uchar", [[*row[:3], 255] for row in levels]).opacities is None


def test_trimesh() -> None:
    levels = np.arange(16, dtype=np.uint8).reshape(4, 4)
    colored = trimesh.Trimesh(CORNERS, FACES, vertex_colors=levels, process=False)
    assert Mesh.from_trimesh(colored).rgba.tolist() == levels.tolist()
    (o,) = objects_of(trimesh.Scene([colored]))
    assert o.mesh.rgba.tolist() == levels.tolist()


@pytest.mark.parametrize("mode", [None, "OPAQUE", "BLEND"])
@pytest.mark.parametrize("image", [None, Image.new("RGBA", (2, 2), (1, 2, 3, 4))])
def test_materials_of_trimesh(mode: str | None, image: Image.Image | None) -> None:
    visuals: Any = trimesh.visual
    material = visuals.material.PBRMaterial(baseColorFactor=[255, 0, 0, 51], alphaMode=mode, baseColorTexture=image)
    visual = visuals.TextureVisuals(uv=np.zeros((4, 2)), material=material)
    part = part_of(trimesh.Trimesh(CORNERS, FACES, visual=visual, process=False))
    if image is not None:
        alpha = part.material["texture"].alpha
        assert (None if alpha is None else alpha.tolist()) == ([[4, 4]] * 2 if mode == "BLEND" else None)
    assert part.opacity == (0.2 if mode == "BLEND" else 1)
    assert part.mesh.opacities is None
    assert part.mesh.colors.tolist() == [[255, 0, 0]] * 4


@pytest.mark.parametrize(("given", "expected"), [(None, 128), (0.25, 64), (1.0, 255), (0.0, None)])
def test_masks_of_trimesh(given: float | None, expected: int | None) -> None:
    """Without a cutoff it is a half, as in glTF; one of 0 hides nothing."""
    image = Image.new("RGBA", (2, 2), (1, 2, 3, 4))
    visuals: Any = trimesh.visual
    material = visuals.material.PBRMaterial(alphaMode="MASK", alphaCutoff=given, baseColorTexture=image)
    visual = visuals.TextureVisuals(uv=np.zeros((4, 2)), material=material)
    texture = part_of(trimesh.Trimesh(CORNERS, FACES, visual=visual, process=False)).material["texture"]
    assert (None if texture.alpha is None else texture.cutoff) == expected


# ---- pictures ----


def test_what_is_not_opaque_shows_what_is_behind() -> None:
    behind = Object(shapes.cube(), (0, 0, -3), scale=5)
    seen, clear, both = pixels(scene_of(glass())), pixels(scene_of(behind)), pixels(scene_of(glass(), behind))
    # the top is opaque, the bottom is not there, whatever the order
    column = np.flatnonzero(np.abs(both[:, 20] - clear[:, 20]).max(axis=1) > 2)
    assert np.abs(both[column[1], 20] - seen[column[1], 20]).max() < 30
    assert np.abs(both[column[-1], 20] - clear[column[-1], 20]).max() < 30
    assert column[-1] - column[0] > 25
    assert (pixels(scene_of(behind, glass())) == both).all()


def test_equal_opacities_are_that_of_the_object() -> None:
    """Up to how colours are rounded."""
    behind = Object(shapes.cube(), (0, 0, -3), scale=5)
    level = Object(evolve(BALL, opacities=np.full(len(BALL.positions), 0.4)), material=Material("flat"), opacity=0.5)
    plain = evolve(level, mesh=evolve(BALL, opacities=None), opacity=0.2)
    tone = shackled.Tone()
    difference = pixels(scene_of(level, behind)) - pixels(scene_of(plain, behind, tone=tone))
    assert np.abs(difference).max() <= 1
    assert (
        pixels(scene_of(evolve(level, opacity=0.0), behind, tone=tone)) == pixels(scene_of(behind, tone=tone))
    ).all()


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_they_are_correct_in_perspective(projection: Any) -> None:
    """Black over white: the picture shows the opacity, of a place known from a texture."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, -8], [-1, 1, -8]])
    ramp = Mesh(corners, FACES, "black", opacities=[0, 0, 1, 1])
    camera = Camera((0, 0, 2), (0, 0, 0), projection=projection, half_height=0.6)
    scene = Scene([Object(ramp, material=Material("unlit"), cull=False)], camera, [], "white", width=60, height=60)
    found = pixels(scene)[:, 30, 0]
    y = (29.5 - np.arange(60)) / 30 * 0.6
    if projection == "perspective":
        # the ray (0, y t, 2 - t) meets the plane z = -4 (1 + y)
        y = np.divide(6 * y, 1 - 4 * y, out=np.ones(60), where=y < 0.2)
    inside = np.abs(y) < 0.9
    assert np.abs(found - 255 * (1 - (1 + y) / 2))[inside].max() <= 2


def test_clipped_faces() -> None:
    """A plate that reaches behind the camera has the opacities of one that was cut at the same place before."""
    camera = Camera((0, 0.5, 0), (0, 0.4, -1), near=0.5)

    def plate(nearest: float) -> Scene:
        corners = np.array([[-2, 0, nearest], [2, 0, nearest], [2, 0, -6], [-2, 0, -6]])
        opacities = (corners[:, 2] + 6) / 12
        mesh = Mesh(corners, FACES, "black", opacities=opacities)
        return Scene([Object(mesh, material=Material("unlit"), cull=False)], camera, [], "white", width=50, height=50)

    whole, cut = pixels(plate(6.0)), pixels(plate(-0.6))
    same = cut[:, :, 0] < 255
    assert same.sum() > 300
    assert np.abs(whole - cut)[same].max() <= 2


def test_wires_have_them_along_the_edges() -> None:
    wire = Object(evolve(SQUARE, positions=np.array(CORNERS) * 2 - (1, 1, 0), colors="black"), wireframe=True)
    found = pixels(scene_of(evolve(wire, material=Material("unlit"))))[:, :, 0]
    # the right edge: from 0.2 below to 1 above
    edge = found.min(axis=1, initial=255, where=np.arange(40) > 30)
    shown = np.flatnonzero(edge < 255)
    assert (np.diff(edge[shown[2:-2]]) >= 0).all()
    assert edge[shown[2]] < 30
    assert 190 < edge[shown[-3]] < 210


def test_they_cast_no_shadow() -> None:
    lights = [Light("directional", (0.2, 1, 0.1), shadow=True)]
    camera = Camera((0, 3, 6), (0, 0, 0))
    changes = {"lights": lights, "camera": camera, "ground": shackled.Ground("tan")}
    clear = glass(position=(0, 1, 0), mesh=evolve(BALL, opacities=np.zeros(len(HEIGHTS))))
    opaque = glass(position=(0, 1, 0), mesh=BALL)
    none, cast = pixels(scene_of(clear, **changes)), pixels(scene_of(opaque, **changes))
    assert (none != cast).any()
    unshaded = [evolve(lights[0], shadow=False)]
    assert (pixels(scene_of(clear, **{**changes, "lights": unshaded})) == none).all()
