from __future__ import annotations

from typing import cast

import pytest

from shackled import Mesh, Scene
from shackled.chain import Connection
from shackled.errors import VerificationError
from shackled.scene import Object, fit
from shackled.studio import stored_codes
from shackled.studio._storage import SCENE, compress_zeros, encode_with_pointers, storage_address, stored_meshes


class Store:
    """A node that has what was stored, and counts how often it is asked."""

    name = "node"

    def __init__(self) -> None:
        self.codes: dict[bytes, bytes] = {}
        self.asked = 0

    def put(self, data: bytes) -> bytes:
        pointer = storage_address(data, OWNER)
        self.codes[pointer] = b"\0" + data
        return pointer

    def code(self, address: bytes) -> bytes:
        self.asked += 1
        return self.codes.get(address, b"")

    def scene(self, meshes: list[bytes]) -> bytes:
        mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        scene = fit(Scene([Object(mesh, (0, 0, -5))] * len(meshes)))
        return self.put(bytes([SCENE]) + compress_zeros((32).to_bytes(32, "big") + encode_with_pointers(scene, meshes)))

    def read(self, pointer: bytes) -> dict[bytes, bytes]:
        return stored_codes(cast(Connection, self), OWNER, pointer)


OWNER = b"\7" * 20
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
