"""What Python says of storing is what happens, and what was stored is read back."""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import Any, cast

import numpy as np
import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image as PillowImage
from tools.ledger import World

from shackled import InputError, Mesh, Object, Scene, load, render
from shackled.chain import Connection
from shackled.datasets import teapot
from shackled.errors import RenderError, VerificationError
from shackled.ethereum._encoding import intrinsic_gas
from shackled.scene import stage
from shackled.scene._arithmetic import from_euler, rotate
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.studio import store_scene
from shackled.studio._compact_mesh import compact, split_mesh
from shackled.studio._storage import (
    SCENE,
    StoreTransaction,
    compress_zeros,
    encode_with_pointers,
    expand_zeros,
    quantize,
    storage_address,
    store_mesh,
    stored_codes,
    stored_meshes,
)

STUDIO = b"\x11" * 20


def vertices(parts: Any, numbers: Iterable[int]) -> list[tuple[object, ...]]:
    """Positions and colours of some vertices, in no order."""
    return sorted((*parts.positions[number], parts.colors[number]) for number in numbers)


def happens(world: World, storings: list[StoreTransaction]) -> None:
    for storing in storings:
        # as much as it uses is not enough, since a call hands on all but a 64th
        if storing.size > 2000:
            with pytest.raises(RenderError):
                world.run(world.address("Studio"), storing.data, storing.gas)
        output = world.run(world.address("Studio"), storing.data, storing.gas_limit, created=True)
        assert output[12:32] == storing.pointer
        assert len(world.codes[storing.pointer]) == storing.size + 1
        gas = world.gas + intrinsic_gas(storing.data)
        if "joined" in storing.what:
            assert gas <= storing.gas <= 1.1 * gas
        else:
            assert gas == storing.gas


def test_pointers_and_gas_of_a_scene(world: World) -> None:
    scene = load("icons/skull")
    storings = store_scene(scene, world.address("Studio"))
    assert [storing.what for storing in storings] == ["mesh 1", "mesh 2", "scene"]
    happens(world, storings)
    world.chain._codes.update(world.codes)
    small = render(scene)
    png = world.chain.ask("Studio", "renderPNG(address,uint256)", storings[-1].pointer, 1)
    with PillowImage.open(io.BytesIO(png)) as picture:
        assert np.array_equal(np.asarray(picture), small.pixels)


def test_a_mesh_that_objects_share_is_stored_once() -> None:
    mesh = Mesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]])
    scene = Scene([Object(mesh), Object(mesh, (0, 0, -20))])
    assert [storing.what for storing in store_scene(scene, STUDIO)] == ["mesh 1", "scene"]


def test_a_large_mesh(world: World) -> None:
    random = np.random.default_rng(2)
    n = 5000
    faces = random.integers(0, n, (2000, 3))
    packed = pack(Mesh(random.integers(-32768, 32768, (n, 3)), faces, random.integers(0, 256, (n, 3))))
    storings = store_mesh("mesh", compact(packed), world.address("Studio"))
    assert [s.what for s in storings] == ["mesh, part 1 of 3", "mesh, part 2 of 3", "mesh, part 3 of 3", "mesh, joined"]
    happens(world, storings)
    world.chain._codes.update(world.codes)
    stored = b"".join(world.codes[storing.pointer][1:] for storing in storings[:3])
    assert storings[-1].pointer == storage_address(stored, world.address("Studio"))
    there, whole = split_mesh(world.chain.ask("Studio", "mesh", storings[-1].pointer)), split_mesh(packed)
    assert vertices(there, range(n)) == vertices(whole, range(n))
    assert sorted(vertices(there, each) for each in there.faces) == sorted(
        vertices(whole, each) for each in whole.faces
    )


def test_a_thousand_triangles_are_stored_for_what_is_promised() -> None:
    """Without loss where faces have one shade each; where it is smooth, on a grid of 2^11, with normals of 6 bits."""
    pot = teapot(4)
    flat = store_scene(stage(pot), STUDIO)[0]
    assert len(pot.faces) == 992
    assert flat.gas < 1_100_000
    scene = load("teapot")
    assert scene.objects[0].material.shading == "smooth"
    assert store_scene(scene, STUDIO, 11, 6)[0].gas < 1_100_000


@given(st.lists(st.tuples(st.sampled_from([0, 255, 1, 7, 200]), st.integers(1, 300)), max_size=6))
def test_zeros_are_compressed_as_they_are_decompressed(runs: list[tuple[int, int]]) -> None:
    data = b"".join(bytes([value]) * times for value, times in runs)
    assert expand_zeros(compress_zeros(data)) == data


@pytest.mark.parametrize("bits", [4, 8, 16])
def test_a_grid_leaves_objects_where_they_are(bits: int) -> None:
    o = Object(teapot(2), (3, -4, 5), from_euler((20, 30, 40)), 2.5)
    gridded = quantize(o, bits)
    positions = gridded.mesh.positions
    assert (positions % 1 == 0).all()
    assert np.ptp(positions, axis=0).max() <= 2**bits - 1

    def placed(each: Object) -> NDArray[np.float64]:
        return each.position + rotate(each.rotation, each.mesh.positions * each.scale)

    step = 2.5 * np.ptp(o.mesh.positions, axis=0).max() / (2**bits - 2)
    assert np.abs(placed(gridded) - placed(o)).max() <= 0.87 * step


def test_a_grid_keeps_a_point() -> None:
    o = Object(Mesh([[1, 2, 3]] * 3, [[0, 1, 2]]))
    assert np.array_equal(quantize(o, 8).position, (1, 2, 3))


def test_bad_input() -> None:
    scene = Scene([Object(teapot(1))])
    with pytest.raises(InputError, match="20 bytes, not 3"):
        store_scene(scene, b"abc")
    with pytest.raises(InputError, match="4 to 16 bits a side, not 17"):
        store_scene(scene, STUDIO, position_bits=17)
    with pytest.raises(InputError, match="4 to 10 bits, not 2"):
        store_scene(evolve(scene), STUDIO, normal_bits=2)


class Store:
    """A node that has what was stored, and counts how often it is asked."""

    name = "node"

    def __init__(self) -> None:
        self.codes: dict[bytes, bytes] = {}
        self.asked = 0

    def put(self, data: bytes) -> bytes:
        pointer = storage_address(data, STUDIO)
        self.codes[pointer] = b"\0" + data
        return pointer

    def code(self, address: bytes) -> bytes:
        self.asked += 1
        return self.codes.get(address, b"")

    def scene(self, meshes: list[bytes]) -> bytes:
        mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        scene = in_range(Scene([Object(mesh, (0, 0, -5))] * len(meshes)))
        return self.put(bytes([SCENE]) + compress_zeros((32).to_bytes(32, "big") + encode_with_pointers(scene, meshes)))

    def read(self, pointer: bytes) -> dict[bytes, bytes]:
        return stored_codes(cast(Connection, self), STUDIO, pointer)


LIST = b"\x13"


def test_parts_are_bytes_whatever_they_begin_with() -> None:
    """As in Storage.sol: a part that begins like a list is none. Each address is read once."""
    store = Store()
    part = store.put(LIST + b"bytes of a mesh")
    other = store.put(b"more")
    mesh = store.put(LIST + part + other + part + b"an incomplete address"[:19])
    codes = store.read(store.scene([mesh, mesh]))
    assert set(codes) == set(store.codes)
    assert store.asked == len(store.codes)


def test_lists_of_lists_are_not_followed() -> None:
    """They may have more entries than anybody could read."""
    store = Store()
    level = store.put(b"leaf")
    for _ in range(2000):
        level = store.put(LIST + level * 100)
    assert len(store.read(store.scene([level]))) == 3
    assert store.asked == 3


def test_a_list_that_is_too_long_is_refused() -> None:
    store = Store()
    part = store.put(b"p" * 24_575)
    with pytest.raises(VerificationError, match="have more than 1,048,576 bytes together"):
        store.read(store.scene([store.put(LIST + part * 43)]))


@pytest.mark.parametrize("data", [b"", b"\x10abc", bytes([SCENE]), bytes([SCENE]) + b"\xff\x80" * 9])
def test_what_is_no_scene_is_refused(data: bytes) -> None:
    with pytest.raises(VerificationError, match=r"not a scene|not a complete scene"):
        stored_meshes(data)
