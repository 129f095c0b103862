import numpy as np
import pytest

from pictures import projected
from shackled import load
from shackled.datasets.common import shapes
from shackled.errors import InputError
from shackled.scene import stage
from shackled.scene._light import Light
from shackled.scene._mesh import Mesh
from shackled.scene._object import Material
from shackled.scene._scene import Scene
from shackled.scene._staging import is_closed, painted, signed_volume

CORNERS = np.sign(shapes.cube().positions)
FACES = shapes.cube().faces.tolist()
BOX = Mesh(CORNERS * (1, 2, 3) * 100 + (1000, -50, 7), FACES)


def test_the_mesh_comes_into_the_unit_sphere() -> None:
    scene = stage(BOX)
    assert scene.objects[0].mesh is BOX
    assert np.linalg.norm(scene.world_positions(), axis=1).max() == pytest.approx(1)
    np.testing.assert_allclose(scene.world_positions().min(axis=0), -scene.world_positions().max(axis=0), atol=1e-12)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("size", [(128, 128), (300, 100), (50, 200)])
@pytest.mark.parametrize("turn", [(0, 0, 0), (30, 100, -70)])
@pytest.mark.parametrize("view", [(30, 20), (200, -60), (0, 90), (10, -90)])
def test_the_mesh_fills_the_picture(
    projection: str, size: tuple[int, int], turn: tuple[int, ...], view: tuple[int, int]
) -> None:
    azimuth, elevation = view
    level = projection == "orthographic"
    scene = stage(BOX, size, rotate=turn, azimuth=azimuth, elevation=elevation, orthographic=level, margin=0.1)
    places = projected(scene)
    assert np.abs(places).max() == pytest.approx(0.9)
    # the side that decides is filled on both ends
    axis = np.abs(places).max(axis=0).argmax()
    assert (places[:, axis].min(), places[:, axis].max()) == pytest.approx((-0.9, 0.9))
    assert (scene.width, scene.height) == size


def test_the_viewer_stands_before_it_above_and_to_the_right() -> None:
    x, y, z = stage(BOX).camera.eye
    assert 0 < y < x < z
    assert stage(BOX).camera.half_height == pytest.approx(1 / 2.145)


def test_the_key_light_comes_from_the_upper_left_of_the_viewer() -> None:
    for azimuth in (0, 90, 200):
        scene = stage(BOX, azimuth=azimuth, elevation=10)
        back = scene.camera.eye - scene.camera.target
        right = np.cross(scene.camera.up, back)
        (key,) = scene.lights
        assert key.vector @ right < 0 < key.vector @ np.cross(back, right)
        assert key.vector @ back > 0


def test_a_mesh_is_photographed() -> None:
    scene = load(BOX)
    assert (scene.width, scene.height, scene.antialias, scene.objects[0].cull) == (256, 256, True, True)
    back = scene.camera.eye - scene.camera.target
    right = np.cross(scene.camera.up, back)
    (key,) = scene.lights
    assert key.vector @ right < 0 < key.vector @ back
    # warm
    assert key.color[0] > key.color[2]
    assert np.abs(projected(scene)).max() == pytest.approx(0.85)
    assert load(BOX, lights=Light("directional", (0, 0, 1))).lights == (Light("directional", (0, 0, 1)),)


def test_the_flatter_a_mesh_the_higher_the_viewer() -> None:
    def elevation(mesh: Mesh, **look: float) -> float:
        camera = load(mesh, **look).camera  # type: ignore[arg-type]
        x, y, z = camera.eye - camera.target
        return float(np.degrees(np.arctan2(y, np.hypot(x, z))))

    heights = (0.0, 0.5, 1.0, 3.0)
    found = [elevation(Mesh(CORNERS * (1, height, 1), FACES)) for height in heights]
    assert found == pytest.approx([40, 20, 20, 20])
    assert elevation(Mesh(CORNERS * (1, 0.25, 1), FACES)) == pytest.approx(30)
    assert elevation(Mesh(CORNERS * (1, 0.25, 1), FACES), elevation=-5) == pytest.approx(-5)


def test_only_closed_meshes_are_culled() -> None:
    assert stage(BOX).objects[0].cull
    assert not stage(Mesh(BOX.positions, FACES[1:])).objects[0].cull
    assert stage(Mesh(BOX.positions, FACES[1:]), cull=True).objects[0].cull


def test_a_look_changes_the_material_that_is_given() -> None:
    assert stage(BOX, material=Material("smooth", 0.1), diffuse=0.2).objects[0].material.diffuse == 0.2


def test_closed_whatever_the_colors() -> None:
    split = Mesh(CORNERS[np.array(FACES)].reshape(-1, 3), np.arange(36).reshape(-1, 3))
    assert is_closed(split)
    assert not is_closed(Mesh(CORNERS, [face[::-1] for face in FACES]))
    assert not is_closed(Mesh(CORNERS, [FACES[0][::-1], *FACES[1:]]))

    assert signed_volume(BOX) == pytest.approx(2 * 4 * 6 * 1e6)
    assert signed_volume(Mesh(CORNERS, [face[::-1] for face in FACES])) == pytest.approx(-8)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_flat_thin_and_pointlike_meshes(projection: str) -> None:
    for points in ([[0, 0, 0]] * 3, [[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 0, 0], [0, 0, 1], [1, 0, 0]]):
        scene = stage(Mesh(points, [[0, 1, 2]]), orthographic=projection == "orthographic")
        assert np.abs(projected(scene)).max() <= 0.92 + 1e-9


def test_what_cannot_be() -> None:
    with pytest.raises(InputError, match=r"^the coordinates of the mesh are too large or too small to be scaled$"):
        stage(Mesh(np.array([[0, 0, 0], [1e308, 0, 0], [-1e308, 1e308, 0]]), [[0, 1, 2]]))
    with pytest.raises(InputError, match=r"^`margin` must be a finite number from 0 to 0\.9, not 1$"):
        stage(BOX, margin=1)
    with pytest.raises(InputError, match=r"^the height of a picture must be from 1 to 2048 pixels, not 0$"):
        stage(BOX, (8, 0))


def test_the_background_is_light_unless_most_of_the_surface_is() -> None:
    def top(own: str, **look: object) -> int:
        return load(painted(BOX, own), **look).background.top[0]  # type: ignore[arg-type]

    light, dark = top("#202020"), top("white")
    assert light > 100 > 50 > dark
    assert [top(color) for color in ("black", "#888", "tomato", "#c8c8c8")] == [light] * 4
    assert top("black", color="white") == dark
    assert top("white", color="black") == light
    # without light, colours stay as they are
    assert (top("#c8c8c8", unlit=True), top("#303030", unlit=True)) == (dark, light)
    assert load(painted(BOX, "white"), background="red").background.top == (255, 0, 0)
    # most of the surface: of the box, two sides are larger than the four others
    flat = Mesh(CORNERS * (1, 0.1, 1), FACES, [(255, 255, 255) if y > 0 else (100, 100, 100) for _, y, _ in CORNERS])
    assert load(flat).background.top[0] == light
    assert load(painted(flat, "white")).background.top[0] == dark


def test_the_shadow_on_a_ground_is_in_the_picture() -> None:
    light = Light("directional", (-3, 1, 0))
    alone = load(BOX, lights=light, ground="grey", azimuth=0)
    scene = load(BOX, lights=light, ground="grey", shadow=True, azimuth=0)
    assert np.abs(projected(alone)).max() == pytest.approx(0.85)
    # the shadow falls to the right
    assert projected(scene)[:, 0].max() < projected(alone)[:, 0].max() - 0.1
    assert load(BOX, lights=light, shadow=True, azimuth=0).camera == load(BOX, lights=light, azimuth=0).camera
    # the part of it that is on what is left of the ground, however low the light is, also from a lamp
    for lamp in (Light("directional", (-1, 1e-9, 0)), Light("point", (-3, 0, 0))):
        far = load(BOX, lights=lamp, ground="grey", shadow=True, azimuth=0).camera
        assert np.linalg.norm(far.eye) < 3 * np.linalg.norm(alone.camera.eye)
    # and of a scene whose camera is placed anew
    placed, bare = (
        load(Scene(scene.objects, lights=each, ground="grey"), margin=0.1).camera for each in (scene.lights, light)
    )
    assert placed != bare
