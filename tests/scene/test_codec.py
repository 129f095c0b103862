"""The codec: scenes as calldata, against an outside decoder."""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

import eth_abi
import numpy as np
import pytest
from attrs import evolve
from hypothesis import example, given, settings
from hypothesis import strategies as st

from shackled import Background, Camera, Fog, InputError, Light, Material, Mesh, Object, Scene
from shackled.scene import Projection, Rectangle, encode, fit, pack, rotate, vertex_normals
from shackled.scene._codec import ONE, extensions
from shackled.scene._fit import EXACT_SIZES, MAX_COORDINATE

SELECTOR = b"\x12\x34\x56\x78"
TRIANGLE = Mesh([[0, 0, 0], [1000, 0, 0], [0, 1000, 0]], [[0, 1, 2]], [[1, 2, 3], [4, 5, 6], [255, 0, 128]])


def scene_of(mesh: Mesh = TRIANGLE, **changes: Any) -> Scene:
    thing = Object(mesh, position=(0, 0, -2500), material=Material("unlit"))
    return evolve(Scene([thing], Camera()), **changes)


def scene_types() -> list[str]:
    """The ABI types of renderTile(Scene, Rectangle), from the compiled contract."""
    abi = json.loads(files("shackled.artifacts").joinpath("Renderer.json").read_text("utf-8"))["abi"]
    function = next(entry for entry in abi if entry.get("name") == "render")
    return [type_of(parameter) for parameter in function["inputs"]]


def type_of(parameter: dict[str, Any]) -> str:
    if not parameter["type"].startswith("tuple"):
        return str(parameter["type"])
    return f"({','.join(map(type_of, parameter['components']))}){parameter['type'].removeprefix('tuple')}"


def decode(data: bytes, *more: str) -> tuple[Any, ...]:
    types = scene_types() + list(more)
    values = eth_abi.decode(types, data[4:])  # type: ignore[attr-defined]
    # eth-abi encodes in the one canonical way: ours must be the same bytes
    assert eth_abi.encode(types, values) == data[4:]  # type: ignore[attr-defined]
    return tuple(values)


@pytest.mark.parametrize("size", [1e-9, 1, 1e12])
def test_fog_is_scaled_with_the_scene(size: float) -> None:
    mesh = Mesh(size * np.array([[0.1, 0, 0], [1, 0, 0], [0, 1, 0.7]]), [[0, 1, 2]])
    scene = Scene([Object(mesh)], Camera((0, 0, 5 * size), near=size), fog=Fog("red", 2 * size, 5.5 * size))
    fitted = fit(scene)
    assert fitted.fog is not None
    assert fitted.camera.near is not None
    assert fitted.fog == Fog("red", 2 * fitted.camera.near, 5.5 * fitted.camera.near)
    for far in (1e30, 1e300):
        distant = fit(evolve(scene, fog=Fog("red", far / 2, far))).fog
        assert distant is not None
        assert 0 < distant.near < distant.far <= MAX_COORDINATE
    exact = scene_of(fog=Fog("red", 0.1, MAX_COORDINATE))
    assert fit(exact).fog == exact.fog
    assert fit(evolve(exact, fog=Fog("red", 1e-50, 1e-40))).fog == Fog("red", 1e-50, 1e-40)
    assert extensions(evolve(exact, fog=Fog((1, 2, 3), 1e-50, 1e-40))) == b"\6\0\0\0\x13\1\2\3" + bytes(15) + b"\1"


def test_a_whole_numbered_scene_passes_exactly() -> None:
    scene = scene_of(
        camera=Camera(near=2),
        lights=[Light("directional", (1, 2, 3), (9, 8, 7)), Light("point", (-100, 0.5, 7))],
        background=Background((1, 2, 3), (4, 5, 6)),
        ambient_light=(10, 20, 30),
        invert=True,
        width=320,
        height=200,
    )
    ((canvas, camera, background, invert, ambient, lights, objects, more),) = decode(encode(SELECTOR, scene))
    assert canvas == (320, 200)
    assert more == b""
    assert camera == ((0, 0, 0), (0, 0, -ONE), (0, ONE, 0), 0, round(ONE / 2.145), 2 * ONE)
    assert (background, invert, ambient) == ((0x010203, 0x040506), 1, 0x0A141E)
    assert lights == (
        (0, (ONE, 2 * ONE, 3 * ONE), 0x090807),
        (1, (-100 * ONE, ONE // 2, 7 * ONE), 0xFFFFFF),
    )
    ((mesh, position, rotation, scale, material, flags),) = objects
    assert mesh == bytes([0, 0, 3, 0, 1]) + bytes.fromhex(
        "0000 0000 0000 010203   03e8 0000 0000 040506   0000 03e8 0000 ff0080   0000 0001 0002"
    )
    assert (position, rotation, scale) == ((0, 0, -2500 * ONE), (0, 0, 0, ONE), ONE)
    assert material == (0, round(0.3 * ONE), round(0.75 * ONE), round(0.3 * ONE), 24)
    assert flags == 1


def test_two_objects_and_a_tile() -> None:
    thing = scene_of().objects[0]
    scene = scene_of(objects=[thing, evolve(thing, cull=False, wireframe=True, position=(1, 2, -3000))])
    data = encode(SELECTOR, scene, Rectangle(5, 6, 7, 8))
    values, rectangle = decode(data, "(uint256,uint256,uint256,uint256)")
    assert rectangle == (5, 6, 7, 8)
    assert [o[-1] for o in values[-2]] == [1, 2]
    assert values[-2][1][1] == (ONE, 2 * ONE, -3000 * ONE)


@pytest.mark.parametrize("tile", [(-1, 0, 5, 5), (0, 0, 0, 5), (124, 0, 5, 5), (0, 127, 1, 2), (0, 0, 129, 1)])
def test_a_tile_outside_the_canvas(tile: tuple[int, int, int, int]) -> None:
    with pytest.raises(InputError, match="does not lie on the canvas of 128 x 128 pixels"):
        encode(SELECTOR, scene_of(), Rectangle(*tile))


def test_normals_take_ten_bits_each() -> None:
    packed = pack(evolve(TRIANGLE, normals=[[0, 0, 5], [-1, 0, 0], [0, 0, 0]]), smooth=True)
    assert packed[0] == 1
    words = [int.from_bytes(packed[5 + 13 * i + 9 : 5 + 13 * i + 13], "big") for i in range(3)]
    assert words == [511 << 2, (-511 & 1023) << 22, 0]
    computed = pack(TRIANGLE, smooth=True)
    assert computed[14:18] == (511 << 2).to_bytes(4, "big")
    assert len(pack(TRIANGLE)) == len(computed) - 3 * 4


def test_large_whole_coordinates_take_24_bits() -> None:
    corners = np.array([[0, 0, -40000], [70000, 0, 0], [0, -8388608, 8388607]])
    mesh = Mesh(corners, TRIANGLE.faces, TRIANGLE.colors)
    packed = pack(mesh)
    assert packed[:5] == bytes([2, 0, 3, 0, 1])
    rows = [packed[5 + 12 * i : 17 + 12 * i] for i in range(3)]
    numbers = [[int.from_bytes(row[k : k + 3], "big", signed=True) for k in (0, 3, 6)] for row in rows]
    assert numbers == mesh.positions.tolist()


def test_whole_coordinates_are_needed_to_pack() -> None:
    with pytest.raises(InputError, match="whole coordinates"):
        pack(Mesh(np.array([[0, 0, 0.5], [1, 0, 0], [0, 1, 0]]), [[0, 1, 2]]))


def test_unused_vertices_are_dropped_in_order() -> None:
    mesh = Mesh([[9, 9, 9], [0, 0, 0], [8, 8, 8], [5, 0, 0], [0, 5, 0]], [[1, 4, 3]], np.arange(15).reshape(5, 3))
    fitted = fit(scene_of(mesh)).objects[0].mesh
    assert fitted.positions.tolist() == [[0, 0, 0], [5, 0, 0], [0, 5, 0]]
    assert fitted.faces.tolist() == [[0, 2, 1]]
    assert fitted.colors.tolist() == [[3, 4, 5], [9, 10, 11], [12, 13, 14]]


def test_the_largest_mesh_is_taken() -> None:
    mesh = Mesh(np.arange(3 * 65535).reshape(-1, 3) % 1000, np.arange(3 * 65535).reshape(-1, 3) % 65535)
    assert len(pack(mesh)) == 5 + 65535 * 15


def placed(o: Object, camera: Camera, scene: Scene) -> np.ndarray:
    """The vertices in units that do not depend on how the world was moved: as the camera sees them."""
    eye = camera.eye
    points = o.position + rotate(o.rotation, o.scale * o.mesh.positions) - eye
    return np.asarray(points)


coordinate = st.floats(-1, 1)
magnitude = st.floats(-12, 12).map(lambda e: 10.0**e)


@settings(max_examples=150, deadline=None)
@given(
    st.lists(st.tuples(coordinate, coordinate, coordinate), min_size=3, max_size=8),
    magnitude,
    magnitude,
    st.tuples(coordinate, coordinate, coordinate),
    st.tuples(coordinate, coordinate, coordinate, coordinate).filter(lambda q: max(map(abs, q)) > 1e-3),
)
# a mesh without any extent, and a light that is farther than it
@example([(0.0, 0.0, 1.0)] * 3, 1.0, 10000.0, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0))
def test_fitting_keeps_what_the_camera_sees(
    points: list[tuple[float, float, float]],
    size: float,
    scale: float,
    position: tuple[float, float, float],
    rotation: tuple[float, float, float, float],
) -> None:
    mesh = Mesh(np.array(points) * size, [[0, 1, 2]] + [[0, i, i - 1] for i in range(2, len(points))])
    world = size * scale
    thing = Object(mesh, np.array(position) * world, rotation, scale)
    eye = np.array([0.3, 0.2, 3]) * world
    light = Light("point", np.array([1, 2, 3]) * world)
    scene = Scene([thing], Camera(eye=eye, target=(0, 0, 0)), [light])
    fitted = fit(scene)
    before, after = placed(thing, scene.camera, scene), placed(fitted.objects[0], fitted.camera, fitted)
    used = np.unique(mesh.faces)
    lengths = [np.abs(np.asarray(s.lights[0].vector) - s.camera.eye).max() for s in (fitted, scene)]
    factor = lengths[0] / lengths[1]
    radius = np.abs(mesh.positions).max() * scale
    # half a step of the grid along each axis, turned
    assert np.abs(before[used] * factor - after).max() <= (radius / 32767 + 1e-9 * world) * factor
    assert np.log2(factor) == pytest.approx(round(np.log2(factor)), abs=1e-6)
    for vector in (fitted.camera.eye, fitted.camera.target, fitted.objects[0].position, fitted.lights[0].vector):
        assert np.abs(np.asarray(vector)).max() <= MAX_COORDINATE
    towards = fitted.camera.target - fitted.camera.eye
    assert np.allclose(towards / np.linalg.norm(towards), -eye / np.linalg.norm(eye), atol=1e-9)
    assert fitted.camera.near is not None
    assert fitted.camera.near > 0
    decode(encode(SELECTOR, scene))


def test_a_float_mesh_uses_the_whole_grid() -> None:
    mesh = Mesh([[0.1, 0.2, 0.3], [0.9, 0.2, 0.3], [0.1, 0.25, 0.3]], [[0, 1, 2]])
    positions = np.asarray(fit(scene_of(mesh)).objects[0].mesh.positions)
    assert positions[:, 0].tolist() == [-32767, 32767, -32767]
    assert np.abs(positions).max() == 32767


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize(("zoom", "bound"), [(1, 0.04), (100, 0.04), (1000, 0.15)])
def test_corners_stay_in_place_however_near_one_looks(zoom: int, bound: float, projection: Projection) -> None:
    """In pixels, of those that are seen."""
    rng = np.random.default_rng(3)
    spots = np.array([0.31, 0.17, 0.05]) + rng.uniform(-1, 1, (60, 3)) * [[0.5 / zoom, 0.5 / zoom, 0.02 / zoom]]
    positions = np.vstack([rng.uniform(-1, 1, (60, 3)) * [1, 1, 0.02], spots])
    thing = Object(Mesh(positions, rng.permutation(120).reshape(-1, 3)), rotation=(0.1, 0.2, 0.3, 0.9))
    target = placed(thing, Camera(eye=(0, 0, 0)), scene_of())[60:].mean(axis=0)
    camera = Camera((*target[:2], target[2] + 1), tuple(target), projection=projection, half_height=1.0 / zoom)
    scene = Scene([thing], camera, width=256, height=256)

    def pixels(of: Scene) -> np.ndarray:
        points = placed(of.objects[0], of.camera, of)[60:]
        distance = -points[:, 2:] if projection == "perspective" else 1.0
        return np.asarray(128 * points[:, :2] / distance / of.camera.half_height)

    assert np.abs(pixels(scene) - pixels(fit(scene))).max() <= bound


def test_a_finer_grid_is_taken_only_where_it_shows() -> None:
    mesh = Mesh([[0.1, 0.2, 0.3], [0.9, 0.2, 0.3], [0.1, 0.25, 0.3]], [[0, 1, 2]])
    for half_height, wide in ((1.0, False), (0.001, True)):
        scene = Scene([Object(mesh)], Camera(eye=(0, 0, 3), target=(0, 0, 0), half_height=half_height))
        assert (np.abs(fit(scene).objects[0].mesh.positions).max() > 32767) == wide


def test_worlds_far_from_the_origin_keep_their_precision() -> None:
    mesh = Mesh(np.array([[0, 0, 0], [0.7, 0, 0], [0, 0.7, 0]]), [[0, 1, 2]])
    far = np.array([5e8, -3e8, 1e8])
    near, moved = (
        fit(Scene([Object(mesh, offset)], Camera(eye=offset + np.array([0, 0, 4]), target=offset)))
        for offset in (np.zeros(3), far)
    )
    assert np.allclose(np.asarray(near.objects[0].position), np.asarray(moved.objects[0].position), atol=1e-3)
    assert near.objects[0].scale == moved.objects[0].scale
    assert near.camera.target.tolist() == moved.camera.target.tolist()


def test_a_light_infinitely_far_away_keeps_its_direction() -> None:
    scene = scene_of(TRIANGLE, lights=[Light("point", (1e30, 2e30, -1e30))])
    light = np.asarray(fit(scene).lights[0].vector)
    assert np.abs(light).max() <= MAX_COORDINATE
    assert np.allclose(light / np.linalg.norm(light), np.array([1, 2, -1]) / 6**0.5)


def test_a_far_light_does_not_cost_the_meshes_their_precision() -> None:
    """Scaled so that a light a million times as far fits too, little would be left of what is seen."""
    alone, near, far = (
        fit(scene_of(TRIANGLE, lights=lights)).objects[0].scale
        for lights in ([], *([Light("point", (distance, 0, 0))] for distance in (1e9, 1e15)))
    )
    print(alone, near, far)
    assert near == far
    assert alone <= 4096 * far


def test_directions_of_any_length_are_sent() -> None:
    scene = scene_of(lights=[Light("directional", (1e-200, 0, 0)), Light("directional", (0, -1e200, 0))])
    fitted = fit(evolve(scene, objects=[evolve(scene.objects[0], rotation=(0, 0, 0, 1e-30))]))
    assert np.asarray(fitted.lights[0].vector).tolist() == [1, 0, 0]
    assert np.asarray(fitted.lights[1].vector).tolist() == [0, -1, 0]
    assert np.asarray(fitted.objects[0].rotation).tolist() == [0, 0, 0, 1]


def test_the_near_plane_is_chosen_by_the_extent() -> None:
    def near(scene: Scene) -> float:
        fitted = fit(scene)
        farthest = np.abs(placed(fitted.objects[0], fitted.camera, fitted)).max()
        return float(fitted.camera.near / farthest)

    assert fit(scene_of()).camera.near == 1
    small = Object(Mesh([[-1, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), position=(0, 0, -3))
    assert near(Scene([small])) == pytest.approx(2**-10, rel=0.5)
    assert near(Scene([evolve(small, scale=1e-6)])) == pytest.approx(2**-10, rel=0.5)
    assert fit(scene_of(camera=Camera(projection="orthographic", half_height=500))).camera.near == -MAX_COORDINATE


def test_a_chosen_near_plane_is_scaled_with_the_world() -> None:
    mesh = Mesh(np.array([[0, 0, 0], [0.7, 0, 0], [0, 0.7, 0]]), [[0, 1, 2]])
    scene = Scene([Object(mesh, position=(0, 0, -4))], Camera(near=2))
    fitted = fit(scene)
    assert fitted.camera.near == pytest.approx(-np.asarray(fitted.objects[0].position)[2] / 2)


@pytest.mark.parametrize(
    ("camera", "message"),
    [
        (Camera(eye=(1, 2, 3), target=(1, 2, 3)), r"eye and target are the same point, \(1, 2, 3\)"),
        (Camera(up=(0, 0, 0)), "up must not be"),
        (Camera(eye=(0, 5, 0), target=(0, 0, 0)), r"looks along its up direction, \(0, 1, 0\)"),
        (Camera(projection="orthographic", half_height=1e-9), "half_height 1e-09 is too small"),
    ],
)
def test_cameras_that_see_nothing(camera: Camera, message: str) -> None:
    with pytest.raises(InputError, match=message):
        fit(scene_of(camera=camera))


def test_scenes_beyond_floats() -> None:
    mesh = Mesh([[1e308, 0, 0], [-1e308, 0, 0], [0, 1e308, 0]], [[0, 1, 2]])
    with pytest.raises(InputError, match="too large"):
        fit(Scene([Object(mesh, scale=1e10)]))


def test_scenes_of_extreme_sizes_are_encoded() -> None:
    for size in (1e-300, 1e-30, 1e30, 1e300):
        mesh = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.5]]) * size, [[0, 1, 2]])
        for shading in ("flat", "smooth"):
            thing = Object(mesh, position=(0, 0, -3 * size), material=Material(shading))
            decode(encode(SELECTOR, Scene([thing])))
            normals = fit(Scene([thing])).objects[0].mesh.normals
            assert (normals is None) == (shading == "flat")
            assert normals is None or np.linalg.norm(np.asarray(normals), axis=1) == pytest.approx(1)
    for flat in ([[0.5, 0.5, 0.5]] * 3, [[7, 7, 7]] * 3):
        decode(encode(SELECTOR, Scene([Object(Mesh(flat, [[0, 1, 2]]), scale=12345.678)])))
    decode(encode(SELECTOR, Scene([])))
    assert EXACT_SIZES[0] < EXACT_SIZES[1]


def test_smooth_normals_are_those_of_the_unrounded_mesh() -> None:
    rng = np.random.default_rng(1)
    mesh = Mesh(rng.normal(size=(10, 3)), rng.integers(0, 10, (30, 3)))
    fitted = fit(Scene([Object(mesh, (0, 0, -5), material=Material("smooth"))])).objects[0].mesh
    expected = vertex_normals(mesh.positions, mesh.faces)
    assert np.allclose(np.asarray(fitted.normals), expected[np.unique(mesh.faces)])


def test_scaling_the_world_by_a_power_of_two_changes_nothing() -> None:
    def scaled(k: float) -> bytes:
        mesh = Mesh(np.array([[0.1, 0, 0], [1, 0, 0.3], [0, 1, 0]]) * k, [[0, 1, 2]])
        camera = Camera(np.array([1, 2, 3]) * k, (0, 0, 0), projection="orthographic", half_height=1.7 * k, near=k)
        return encode(SELECTOR, Scene([Object(mesh)], camera, [Light("point", np.array([4, 5, 6]) * k)]))

    assert scaled(2.0**-60) == scaled(1) == scaled(2.0**60)
