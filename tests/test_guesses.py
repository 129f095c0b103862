"""What people write who know other libraries, not the documentation: it works, or an error says what does."""

from __future__ import annotations

import io
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image as PillowImage

import shackled
from shackled.errors import NodeUnreachableError
from shackled.scene._staging import painted

# guesses are no calls that a checker of types would let pass
s: Any = shackled
BOX, BALL = trimesh.creation.box(), trimesh.creation.icosphere(subdivisions=1)
MESH = shackled.Mesh(BOX.vertices, BOX.faces)
RED = painted(MESH, "red")
SIDE = 16
THING = shackled.Object(MESH)
CAMERA = shackled.Camera.perspective((3, 3, 3), (0, 0, 0), fov=45)
NOWHERE = "http://127.0.0.1:1"
MATRIX = np.diag([2.0, 2.0, 2.0, 1.0])


def cube(**look: Any) -> Any:
    return s.render("cube", size=look.pop("size", SIDE), **look)


def turns(count: int = 2) -> list[Any]:
    return [cube(azimuth=360 * turn / count) for turn in range(count)]


def point(position: Any = (1, 2, 3), **fields: Any) -> Any:
    return s.Light.point(position, **fields)


def sun(toward: Any) -> Any:
    return s.Light.directional(toward=toward)


#: Guesses, and the documented way, which gives the same.
SAME: list[tuple[Callable[[], Any], Callable[[], Any]]] = [
    # what is rendered
    (lambda: s.render(trimesh.Scene([BOX]), size=SIDE), lambda: s.render(shackled.Object(MESH), size=SIDE)),
    (lambda: s.render((np.array(BOX.vertices), np.array(BOX.faces)), SIDE), lambda: s.render(MESH, SIDE)),
    (lambda: s.render(vertices=BOX.vertices, faces=BOX.faces), lambda: s.render(MESH)),
    (lambda: s.render(BOX.vertices, BOX.faces), lambda: s.render(MESH)),
    (lambda: s.load([BOX, BALL], SIDE).triangles, lambda: len(BOX.faces) + len(BALL.faces)),
    (lambda: s.load(["cube", "teapot"]).triangles, lambda: sum(s.load(each).triangles for each in ("cube", "teapot"))),
    (
        lambda: len(s.load([s.load("cube").objects[0], s.replace(THING, position=(3, 0, 0))]).objects),
        lambda: 2,
    ),
    (lambda: next(s.datasets.pieces()).make().triangles > 0, lambda: True),
    # meshes and objects
    (lambda: s.Mesh(vertices=BOX.vertices, faces=BOX.faces), lambda: MESH),
    (lambda: s.Mesh(vertices=BOX.vertices, faces=BOX.faces).vertices.tolist(), lambda: MESH.positions.tolist()),
    (lambda: s.Mesh(positions=BOX.vertices, faces=BOX.faces, colors="red"), lambda: RED),
    (lambda: s.Mesh(BOX.vertices, BOX.faces, color="red"), lambda: RED),
    (lambda: s.Mesh.from_trimesh(BOX).faces.tolist(), lambda: MESH.faces.tolist()),
    (
        lambda: s.Mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]).faces.tolist(),
        lambda: [[0, 1, 2], [0, 2, 3]],
    ),
    (lambda: s.Scene([BOX]).objects[0].mesh.triangles, lambda: 12),
    (lambda: s.Object(BOX, position=(1, 0, 0)), lambda: s.Object(s.Mesh.from_trimesh(BOX), (1, 0, 0))),
    (lambda: s.Object(MESH, translation=(1, 0, 0)), lambda: s.Object(MESH, (1, 0, 0))),
    (lambda: s.Object(MESH, color="red"), lambda: s.Object(RED)),
    (lambda: s.Object(MESH, transform=MATRIX), lambda: s.Object(MESH, scale=2)),
    (lambda: s.replace(s.load("cube"), width=64).width, lambda: 64),
    # the camera
    (lambda: s.Camera(position=(3, 3, 3), target=(0, 0, 0), fov=45), lambda: CAMERA),
    (lambda: s.Camera(eye=(3, 3, 3), target=(0, 0, 0), fov=45), lambda: CAMERA),
    (lambda: s.Camera.look_at((3, 3, 3), (0, 0, 0), fov=45), lambda: CAMERA),
    (lambda: s.load("cube", SIDE, camera=CAMERA).camera, lambda: CAMERA),
    (lambda: s.load("cube", eye=(3, 3, 3), target=(0, 0, 0), fov=45).camera, lambda: CAMERA),
    (lambda: s.load("cube", camera=CAMERA, fov=30).camera, lambda: s.replace(CAMERA, half_height=np.tan(np.pi / 12))),
    (lambda: cube(azimuth=90, elevation=20).width, lambda: SIDE),
    # size and background
    (lambda: s.render("cube", width=24, height=12), lambda: s.render("cube", (24, 12))),
    (lambda: s.render("cube", resolution=(24, 12)), lambda: s.render("cube", (24, 12))),
    (lambda: cube(bg="white"), lambda: cube(background="white")),
    (lambda: cube(background="transparent"), lambda: cube(transparent=True)),
    (lambda: cube(alpha=True), lambda: cube(transparent=True)),
    # pyvista and matplotlib
    (lambda: s.render("cube", window_size=(24, 12)), lambda: s.render("cube", (24, 12))),
    (lambda: cube(elev=20.0, azim=50), lambda: cube(elevation=20, azimuth=50)),
    (lambda: cube(smooth_shading=True), lambda: cube(shading="smooth")),
    (lambda: cube(smooth_shading=False), lambda: cube(shading="flat")),
    (lambda: cube(style="wireframe"), lambda: cube(wireframe=True)),
    (lambda: cube(style="surface"), cube),
    (lambda: cube(bg="w", color="c"), lambda: cube(background="white", color=(0, 191, 191))),
    (lambda: s.turntable("cube", n_frames=2, size=SIDE), lambda: s.turntable("cube", 2, SIDE)),
    (lambda: np.asarray(cube(transparent=True)).shape, lambda: (SIDE, SIDE, 4)),
    (lambda: cube(background=None), cube),
    (lambda: cube(background=(0.2, 0.4, 0.6)), lambda: cube(background="#336699")),
    (lambda: cube(aa=True), lambda: cube(antialias=True)),
    (lambda: cube(antialias=4), lambda: cube(antialias=True)),
    # lights
    (lambda: s.Light(type="point", position=(2, 3, 4), color="orange"), lambda: point((2, 3, 4), color="orange")),
    (lambda: s.Light(type="directional", direction=(0, -1, 0)), lambda: sun((0, 1, 0))),
    (lambda: s.Light.directional(direction=(-1, -1, -1)), lambda: sun((1, 1, 1))),
    (lambda: cube(light=point(position=(1, 2, 3))), lambda: cube(lights=[point()])),
    (lambda: cube(lights=sun((1, 1, 1))), lambda: cube(lights=[sun((1, 1, 1))])),
    # surfaces
    (lambda: s.load("cube", material=s.Material(diffuse=1)).objects[0].material, lambda: s.Material(diffuse=1)),
    (lambda: cube(colour="red"), lambda: cube(color="red")),
    (lambda: cube(color="#f00"), lambda: cube(color=(255, 0, 0))),
    (lambda: s.Texture("a.png"), lambda: s.Texture.open("a.png")),
    (lambda: s.Texture(np.full((4, 4, 3), (255, 0, 0), np.uint8)), lambda: s.Texture.open("a.png")),
    (lambda: s.load(textured()).objects[0].material.texture, lambda: s.Texture.open("a.png")),
    (lambda: cube(shadow=True), lambda: cube(shadows=True)),
    (lambda: cube(ground="white"), lambda: cube(ground=(1.0, 1.0, 1.0))),
    # animations
    (lambda: s.turntable("cube", frames=4, size=SIDE, fps=10), lambda: s.turntable("cube", 4, SIDE, duration=100)),
    (lambda: s.Animation(frames=turns(), fps=10), lambda: s.Animation(turns(), 100)),
    (lambda: len(s.Animation(turns(3))), lambda: 3),
    (lambda: list(s.Animation(turns())), turns),
    (lambda: s.Animation(turns())[1], lambda: turns()[1]),
    # pictures
    (lambda: cube().to_pil().size, lambda: (SIDE, SIDE)),
    (lambda: np.asarray(cube()).shape, lambda: (SIDE, SIDE, 3)),
    (lambda: cube().gas > 100_000, lambda: True),
    # packages
    (lambda: s.gas.measure("teapot").gas, lambda: s.render("teapot", 256).gas),
    (lambda: s.tokens.__name__, lambda: "shackled.tokens"),
]


def textured() -> Any:
    box: Any = trimesh.creation.box()
    visuals: Any = trimesh.visual.TextureVisuals
    box.visual = visuals(uv=np.linspace(0, 1, 16).reshape(8, 2), image=PillowImage.new("RGB", (4, 4), "red"))
    return box


@pytest.fixture(autouse=True)
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    PillowImage.new("RGB", (4, 4), "red").save("a.png")


@pytest.mark.parametrize("number", range(len(SAME)))
def test_a_guess_is_the_documented_way(number: int) -> None:
    guess, documented = (each() for each in SAME[number])
    assert guess == documented


@pytest.mark.parametrize("on", [NOWHERE, shackled.Nodes(NOWHERE, timeout=2)], ids=["address", "Nodes"])
def test_a_node_is_asked(on: Any) -> None:
    with pytest.raises(NodeUnreachableError, match=r"the node 127\.0\.0\.1:1 cannot be reached"):
        cube(on=on)


#: Guesses, and words of the error that name what is right.
NAMED: dict[str, tuple[Callable[[], Any], str]] = {
    "Mesh.load": (lambda: s.Mesh.load("x.obj"), "shackled.load(path) returns a scene"),
    "Scene().add": (lambda: s.Scene().add(MESH), "objects"),
    "scene.add": (lambda: s.load("cube").add(MESH), "give all objects to Scene([...])"),
    "gas()": (lambda: s.gas("cube"), "shackled.gas is a package: call one of its functions, "),
    "to_trimesh": (
        lambda: s.Mesh(BOX.vertices, BOX.faces).to_trimesh(),
        "trimesh.Trimesh(mesh.positions, mesh.faces, ",
    ),
    "Object of a name": (lambda: s.Object("cube"), "shackled.load('cube') has objects"),
    "scenes that differ": (lambda: s.render([s.load("cube"), s.load("teapot")]), "[*one.objects, *other.objects]"),
    "depth": (lambda: cube().depth, "depths are not returned"),
    "intensity": (lambda: s.Light(position=(1, 2, 3), color="white", intensity=2), "`exposure` multiplies all light"),
    "intensity of a point": (lambda: point(intensity=2), "`exposure` multiplies all light"),
    "PointLight": (lambda: s.PointLight(position=(1, 2, 3)), "shackled.Light.point"),
    "toward or direction": (lambda: s.Light.directional((0, 1, 0)), "toward=, the way from the scene to the light, or"),
    "a place of the sun": (lambda: s.Light(kind="directional", position=(0, 1, 0)), "give toward=, the way"),
    "size": (lambda: s.render("cube", "out.png"), "`save` of what is returned writes"),
    "output=": (lambda: cube(output="out.png"), "`save` of what is returned writes"),
    "background": (lambda: s.load("cube", background="transparent"), "give `transparent` for a picture without"),
    "scene.width =": (lambda: setattr(s.load("cube"), "width", 64), "shackled.replace(it, width=...)"),
    "list_models": (lambda: s.list_models(), "shackled.datasets.pieces()"),
    "no file": (lambda: s.render("nothere.obj"), "nothere.obj does not exist"),
    "rotate=45": (lambda: cube(rotate=45), "`rotate` must be x, y, z in degrees"),
    "a stream": (lambda: s.load(io.BytesIO(b"v 0 0 0")), "the data: it has no faces, only 1 vertex"),
    "scale": (lambda: s.Object(MESH, scale=(1, 2, 1)), "the scale of an object must be a number"),
    "nothing": (lambda: s.render([], size=SIDE), "vertices and faces are needed"),
    "nan": (lambda: s.render((np.full((3, 3), np.nan), [(0, 1, 2)])), "not a finite number: [nan, nan, nan]"),
    "ground=True": (lambda: cube(ground=True), "`ground` must be red, green and blue"),
    "scene.save": (lambda: s.load("teapot").save("teapot.glb"), "must end in .json; the command `shackled export`"),
    "export": (lambda: s.export("cube", "cube.glb"), "must end in .html; the command `shackled export`"),
    "shininess": (lambda: s.Material(shininess=12.5), "must be a whole number from 1 to 128, not 12.5"),
    "both words": (lambda: s.Mesh(MESH.positions, MESH.faces, colors="red", color="red"), "are the same: give one"),
    "fov and half_height": (lambda: s.Camera(fov=40, half_height=1), "exclude each other: give one of them"),
    "toward and direction": (lambda: s.Light(kind="directional", toward=(0, 1, 0), direction=(0, 1, 0)), "give one of"),
    "a light that is replaced": (
        lambda: s.replace(sun((1, 1, 1)), toward=(0, 1, 0)),
        "`toward` and `vector` of a light",
    ),
    "fps and duration": (lambda: s.Animation(turns(), 100, fps=10), "exclude each other: give one of them"),
    "faces of all sizes": (lambda: s.Mesh(BOX.vertices, [(0, 1, 2), (0, 1)]), "the faces of a mesh must be rows of 3"),
    "fps": (lambda: s.Animation(turns(), fps=0), "`fps` must be the number of frames in a second, not 0"),
    "alpha": (lambda: cube(alpha=0.5), "'alpha' is not a keyword of a look; `transparent` of render leaves out"),
    "transparent": (lambda: cube(transparent="no"), "`transparent` must be True or False, not 'no'"),
    "transparent frames": (lambda: s.turntable("cube", 2, SIDE, transparent=0.5), "must be True or False, not 0.5"),
    "sise": (lambda: s.render("cube", sise=3), "render has no keyword 'sise'; did you mean size?"),
    "frams": (lambda: s.turntable("cube", frams=3), "turntable has no keyword 'frams'; did you mean frames?"),
    "elevaton": (lambda: cube(elevaton=3), "did you mean elevation?"),
    "show_edges": (lambda: cube(show_edges=True), "`wireframe` draws edges only"),
    "style": (lambda: cube(style="points"), "`wireframe` draws edges only"),
    "two words": (lambda: cube(style="wireframe", wireframe=True), "are the same: give one"),
    "cmap": (lambda: cube(cmap="viridis"), "Mesh(positions, faces, colors=...)"),
    "dpi": (lambda: cube(dpi=100), "`size` is the side in pixels"),
    "camera_position": (lambda: cube(camera_position="xy"), "`azimuth` and `elevation` turn it"),
    "image.shape": (lambda: cube().shape, "the `pixels` of a picture have a shape"),
    "image.size": (lambda: cube().size, "`width` and `height`"),
    "mesh.bounds": (lambda: s.Mesh(BOX.vertices, BOX.faces).bounds, "mesh.positions.min(axis=0)"),
    "scene.show": (lambda: s.load("cube").show(), "shackled.render(scene).show()"),
    "tokens": (lambda: s.tokens.read_metadata, "No shackled.tokens attribute read_metadata"),
}


@pytest.mark.parametrize("name", NAMED)
def test_an_error_names_what_is_right(name: str) -> None:
    guess, words = NAMED[name]
    with pytest.raises((TypeError, AttributeError, shackled.ShackledError)) as error:
        guess()
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_the_light_of_the_sun_falls_where_it_travels() -> None:
    """Both words for the direction of a light, seen: from above, the upper half of a ball is the lighter one."""
    for light in (sun((0, 1, 0)), s.Light.directional(direction=(0, -1, 0))):
        pixels = s.render(BALL, 32, elevation=0, lights=light, ambient=0, background="black").pixels.astype(int)
        assert pixels[:16].sum() > 10 * pixels[16:].sum()


def test_an_error_is_one_line_in_a_notebook(capsys: pytest.CaptureFixture[str]) -> None:
    """And has its traceback everywhere else, as errors of other libraries have there."""
    shell = pytest.importorskip("IPython.core.interactiveshell").InteractiveShell()
    wrong = "import shackled; shackled.render('cube', %s)"
    for cell, said in (
        (wrong % "sise=3", "KeywordError: render has no keyword 'sise'; did you mean size?\n"),
        (wrong % "size=0", "InputError: "),
        (wrong % "on='http://127.0.0.1:1'", "NodeUnreachableError: "),
    ):
        shell.run_cell(cell)
        shown = capsys.readouterr().out
        assert shown.startswith(said)
        assert shown.count("\n") == 1
        with pytest.raises((TypeError, shackled.ShackledError)) as error:
            exec(cell)
        assert len(traceback.format_exception(error.value)) > 3
    shell.run_cell("1 / 0")
    assert "Traceback" in capsys.readouterr().out
