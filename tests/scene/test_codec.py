"""The codec: scenes as calldata, against an outside decoder."""

from __future__ import annotations

import struct
from typing import Any

import eth_abi
import numpy as np
import pytest
from attrs import evolve
from hypothesis import example, given, settings
from hypothesis import strategies as st

from pictures import scene_types
from shackled import Background, Camera, Fog, InputError, Light, Material, Mesh, Object, Scene
from shackled.scene import encode
from shackled.scene._codec import ONE, Rectangle, extensions
from shackled.scene._constants import MAX_COORDINATE
from shackled.scene._fields import Projection
from shackled.scene._in_range import in_range
from shackled.scene._mesh import vertex_normals
from shackled.scene._packed import pack

SELECTOR = b"\x12\x34\x56\x78"
TRIANGLE = Mesh([[0, 0, 0], [1000, 0, 0], [0, 1000, 0]], [[0, 1, 2]], [[1, 2, 3], [4, 5, 6], [255, 0, 128]])


def scene_of(mesh: Mesh = TRIANGLE, **changes: Any) -> Scene:
    thing = Object(mesh, position=(0, 0, -2500), material=Material("unlit"))
    return evolve(Scene([thing], Camera()), **changes)


def decode(data: bytes, *more: str) -> tuple[Any, ...]:
    types = scene_types() + list(more)
    values = eth_abi.decode(types, data[4:])  # type: ignore[attr-defined]
    # eth-abi encodes in the one canonical way: ours must be the same bytes
    assert eth_abi.encode(types, values) == data[4:]  # type: ignore[attr-defined]
    return tuple(values)


def test_fog_of_any_distance() -> None:
    scene = Scene([Object(Mesh(np.array([[0.1, 0, 0], [1, 0, 0], [0, 1, 0.7]]), [[0, 1, 2]]))], Camera((0, 0, 5)))
    for far in (1e30, 1e300):
        distant = in_range(evolve(scene, fog=Fog("red", far / 2, far))).fog
        assert distant is not None
        assert 0 < distant.near < distant.far <= MAX_COORDINATE
    exact = scene_of(fog=Fog("red", 0.1, MAX_COORDINATE))
    assert in_range(exact).fog == exact.fog
    assert in_range(evolve(exact, fog=Fog("red", 1e-50, 1e-40))).fog == Fog("red", 1e-50, 1e-40)
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
    assert (canvas, more) == ((320, 200), b"")
    assert camera == ((0, 0, 0), (0, 0, -ONE), (0, ONE, 0), 0, round(ONE / 2.145), 2 * ONE)
    assert (background, invert, ambient) == ((0x010203, 0x040506), 1, 0x0A141E)
    assert lights == ((0, (ONE, 2 * ONE, 3 * ONE), 0x090807), (1, (-100 * ONE, ONE // 2, 7 * ONE), 0xFFFFFF))
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


def test_unused_vertices_are_dropped_in_order() -> None:
    points = [[9, 9, 9], [0, 0, 0], [8, 8, 8], [5, 0, 0], [0, 5, 0]]
    mesh = Mesh(points, [[1, 4, 3]], np.arange(20).reshape(5, 4))
    fitted = in_range(scene_of(mesh)).objects[0].mesh
    assert fitted.positions.tolist() == [[0, 0, 0], [5, 0, 0], [0, 5, 0]]
    assert fitted.faces.tolist() == [[0, 2, 1]]
    assert fitted.rgba.tolist() == mesh.rgba[[1, 3, 4]].tolist()


def placed(scene: Scene) -> np.ndarray:
    """The vertices of the first object, from the eye."""
    return np.asarray(scene.objects[0].world_positions() - scene.camera.eye)


coordinate = st.floats(-1, 1)
magnitude = st.floats(-12, 12).map(lambda e: 10.0**e)


@settings(max_examples=150)
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
    fitted = in_range(scene)
    before, after = placed(scene), placed(fitted)
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


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize(("zoom", "bound"), [(1, 0.04), (100, 0.04), (1000, 0.15)])
def test_corners_stay_in_place_however_near_one_looks(zoom: int, bound: float, projection: Projection) -> None:
    """In pixels, of those that are seen."""
    rng = np.random.default_rng(3)
    spots = np.array([0.31, 0.17, 0.05]) + rng.uniform(-1, 1, (60, 3)) * [[0.5 / zoom, 0.5 / zoom, 0.02 / zoom]]
    positions = np.vstack([rng.uniform(-1, 1, (60, 3)) * [1, 1, 0.02], spots])
    thing = Object(Mesh(positions, rng.permutation(120).reshape(-1, 3)), rotation=(0.1, 0.2, 0.3, 0.9))
    target = thing.world_positions()[60:].mean(axis=0)
    camera = Camera((*target[:2], target[2] + 1), tuple(target), projection=projection, half_height=1.0 / zoom)
    scene = Scene([thing], camera, width=256, height=256)

    def pixels(of: Scene) -> np.ndarray:
        points = placed(of)[60:]
        distance = -points[:, 2:] if projection == "perspective" else 1.0
        return np.asarray(128 * points[:, :2] / distance / of.camera.half_height)

    assert np.abs(pixels(scene) - pixels(in_range(scene))).max() <= bound


def test_a_finer_grid_is_taken_only_where_it_shows() -> None:
    mesh = Mesh([[0.1, 0.2, 0.3], [0.9, 0.2, 0.3], [0.1, 0.25, 0.3]], [[0, 1, 2]])
    for half_height, wide in ((1.0, False), (0.001, True)):
        scene = Scene([Object(mesh)], Camera(eye=(0, 0, 3), target=(0, 0, 0), half_height=half_height))
        positions = np.abs(in_range(scene).objects[0].mesh.positions)
        assert positions.max() > 32767 if wide else (positions[:, 0] == 32767).all()


def test_worlds_far_from_the_origin_keep_their_precision() -> None:
    mesh = Mesh(np.array([[0, 0, 0], [0.7, 0, 0], [0, 0.7, 0]]), [[0, 1, 2]])
    far = np.array([5e8, -3e8, 1e8])
    near, moved = (
        in_range(Scene([Object(mesh, offset)], Camera(eye=offset + np.array([0, 0, 4]), target=offset)))
        for offset in (np.zeros(3), far)
    )
    assert np.allclose(np.asarray(near.objects[0].position), np.asarray(moved.objects[0].position), atol=1e-3)
    assert near.objects[0].scale == moved.objects[0].scale
    assert near.camera.target.tolist() == moved.camera.target.tolist()


def test_a_far_light_does_not_cost_the_meshes_their_precision() -> None:
    """Scaled so that a light a million times as far fits too, little would be left of what is seen."""
    alone, near, far = (
        in_range(scene_of(TRIANGLE, lights=lights)).objects[0].scale
        for lights in ([], *([Light("point", (distance, 0, 0))] for distance in (1e9, 1e15)))
    )
    assert near == far
    assert alone <= 4096 * far


def test_directions_of_any_length_are_sent() -> None:
    scene = scene_of(lights=[Light("directional", (1e-200, 0, 0)), Light("directional", (0, -1e200, 0))])
    fitted = in_range(evolve(scene, objects=[evolve(scene.objects[0], rotation=(0, 0, 0, 1e-30))]))
    assert [light.vector.tolist() for light in fitted.lights] == [[1, 0, 0], [0, -1, 0]]
    assert fitted.objects[0].rotation.tolist() == [0, 0, 0, 1]


def test_the_near_plane_is_chosen_by_the_extent() -> None:
    def near(scene: Scene) -> float:
        fitted = in_range(scene)
        return float((fitted.camera.near or 0) / np.abs(placed(fitted)).max())

    assert in_range(scene_of()).camera.near == 1
    small = Object(Mesh([[-1, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]), position=(0, 0, -3))
    assert near(Scene([small])) == pytest.approx(2**-10, rel=0.5)
    assert near(Scene([evolve(small, scale=1e-6)])) == pytest.approx(2**-10, rel=0.5)
    assert in_range(scene_of(camera=Camera(projection="orthographic", half_height=500))).camera.near == -MAX_COORDINATE


def test_a_chosen_near_plane_is_scaled_with_the_world() -> None:
    mesh = Mesh(np.array([[0, 0, 0], [0.7, 0, 0], [0, 0.7, 0]]), [[0, 1, 2]])
    scene = Scene([Object(mesh, position=(0, 0, -4))], Camera(near=2))
    fitted = in_range(scene)
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
        in_range(scene_of(camera=camera))


def test_scenes_beyond_floats() -> None:
    with pytest.raises(InputError, match="too large"):
        in_range(scene_of(evolve(TRIANGLE, positions=1e305 * TRIANGLE.positions), camera=Camera((-1.7e308, 0, 9))))


def test_scenes_of_extreme_sizes_are_encoded() -> None:
    for size in (1e-300, 1e-30, 1e30, 1e300):
        mesh = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.5]]) * size, [[0, 1, 2]])
        for shading in ("flat", "smooth"):
            thing = Object(mesh, position=(0, 0, -3 * size), material=Material(shading))
            decode(encode(SELECTOR, Scene([thing])))
            normals = in_range(Scene([thing])).objects[0].mesh.normals
            assert (normals is None) == (shading == "flat")
            assert normals is None or np.linalg.norm(np.asarray(normals), axis=1) == pytest.approx(1)
    for flat in ([[0.5, 0.5, 0.5]] * 3, [[7, 7, 7]] * 3):
        decode(encode(SELECTOR, Scene([Object(Mesh(flat, [[0, 1, 2]]), scale=12345.678)])))
    decode(encode(SELECTOR, Scene([])))


def test_smooth_normals_are_those_of_the_unrounded_mesh() -> None:
    rng = np.random.default_rng(1)
    mesh = Mesh(rng.normal(size=(10, 3)), rng.integers(0, 10, (30, 3)))
    fitted = in_range(Scene([Object(mesh, (0, 0, -5), material=Material("smooth"))])).objects[0].mesh
    expected = vertex_normals(mesh.positions, mesh.faces)
    assert np.allclose(np.asarray(fitted.normals), expected[np.unique(mesh.faces)])


def test_scaling_the_world_by_a_power_of_two_changes_nothing() -> None:
    def scaled(k: float) -> bytes:
        mesh = Mesh(np.array([[0.1, 0, 0], [1, 0, 0.3], [0, 1, 0]]) * k, [[0, 1, 2]])
        camera = Camera(np.array([1, 2, 3]) * k, (0, 0, 0), projection="orthographic", half_height=1.7 * k, near=k)
        return encode(SELECTOR, Scene([Object(mesh)], camera, [Light("point", np.array([4, 5, 6]) * k)]))

    assert scaled(2.0**-60) == scaled(1) == scaled(2.0**60)


# ---- packed meshes, by hand ----

FACES = [[0, 1, 2]]
COLORS = [[1, 2, 3], [4, 5, 6], [7, 8, 255]]


def triangle(*numbers: float) -> Mesh:
    """One with these coordinates, the others 0."""
    positions = np.zeros(9)
    positions[: len(numbers)] = numbers
    return Mesh(positions.reshape(3, 3), FACES, COLORS)


def test_a_mesh_in_16_bits() -> None:
    vertices = [(1, -2, 3, *COLORS[0]), (-(2**15), 2**15 - 1, 0, *COLORS[1]), (256, 255, -256, *COLORS[2])]
    mesh = Mesh([vertex[:3] for vertex in vertices], [[0, 1, 2], [2, 1, 0]], COLORS)
    expected = bytes([0]) + struct.pack(">HH", 3, 2)
    expected += b"".join(struct.pack(">hhhBBB", *vertex) for vertex in vertices) + struct.pack(">6H", 0, 1, 2, 2, 1, 0)
    assert pack(mesh) == expected


@pytest.mark.parametrize("number", [2**15, -(2**15) - 1, 2**23 - 1, -(2**23)])
def test_a_mesh_in_24_bits(number: int) -> None:
    """As soon as one coordinate needs them."""
    packed = pack(triangle(0, number, -1))
    places = [b"\0" * 3 + number.to_bytes(3, "big", signed=True) + b"\xff" * 3, bytes(9), bytes(9)]
    vertices = b"".join(place + bytes(color) for place, color in zip(places, COLORS, strict=True))
    assert packed == bytes([2]) + struct.pack(">HH", 3, 1) + vertices + struct.pack(">HHH", 0, 1, 2)


@pytest.mark.parametrize("number", [2**23, -(2**23) - 1, 0.5, 2.0**60])
def test_coordinates_that_cannot_be_packed(number: float) -> None:
    with pytest.raises(InputError, match=r"^a packed mesh needs whole coordinates from -8,388,608 to 8,388,607$"):
        pack(triangle(0, 0, number))


def test_normals_are_three_numbers_of_ten_bits() -> None:
    """Of unit length times 511, rounded, however long they were; what has no length points nowhere."""
    normals = [[0.6, -0.8, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]
    packed = pack(Mesh(np.eye(3), FACES, COLORS, normals), smooth=True)
    assert packed[0] == 1
    rows = [packed[5 + 13 * vertex :][:13] for vertex in range(3)]
    assert [row[6:9] for row in rows] == [bytes(color) for color in COLORS]
    words = [int.from_bytes(row[9:], "big") for row in rows]
    assert words == [307 << 22 | (1024 - 409) << 12, 511 << 12, 0]
    assert len(packed) == 5 + 3 * 13 + 6
    turned = pack(Mesh(np.eye(3), FACES, COLORS, [[0.0, 0.6, -0.8], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]), smooth=True)
    words = [int.from_bytes(turned[5 + 13 * vertex + 9 :][:4], "big") for vertex in range(3)]
    assert words == [307 << 12 | (1024 - 409) << 2, 511 << 2, (1024 - 511) << 22]


def test_a_mesh_without_normals_is_given_them() -> None:
    flat = triangle(0, 0, 0, 9, 0, 0, 0, 9)
    assert pack(flat, smooth=True) == pack(Mesh(flat.positions, FACES, COLORS, [[0, 0, 5]] * 3), smooth=True)
    wide = triangle(0, 0, 0, 2**20, 0, 0, 0, 9)
    assert pack(wide, smooth=True)[0] == 3


def test_the_largest_meshes() -> None:
    corners = np.zeros((65535, 3))
    faces = np.tile(FACES, (65535, 1))
    assert pack(Mesh(corners, faces))[1:5] == b"\xff" * 4
    words = r"has {} vertices and {} triangles; a contract takes 65,535 and 65,535: simplify it with `max_triangles`$"
    with pytest.raises(InputError, match=words.format("65,536", "1")):
        pack(Mesh(np.zeros((65536, 3)), FACES))
    with pytest.raises(InputError, match=words.format("65,535", "65,536")):
        pack(Mesh(corners, np.tile(FACES, (65536, 1))))
