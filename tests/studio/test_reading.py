from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shackled import Mesh, Scene
from shackled.errors import VerificationError
from shackled.scene import Object, fit
from shackled.studio import SCENE, compress_zeros, encode_with_pointers, expand_zeros, stored_meshes

runs = st.lists(st.tuples(st.sampled_from([0, 255, 1, 200]), st.integers(1, 300)), max_size=8)


@given(runs)
def test_zeros_come_back(parts: list[tuple[int, int]]) -> None:
    data = b"".join(bytes([value]) * count for value, count in parts)
    assert expand_zeros(compress_zeros(data)) == data


def test_the_meshes_of_a_scene_are_found() -> None:
    mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    scene = fit(Scene([Object(mesh, (0, 0, -5)), Object(mesh, (1, 0, -5))]))
    pointers = [bytes([number]) * 20 for number in (1, 2)]
    kept = bytes([SCENE]) + compress_zeros((32).to_bytes(32, "big") + encode_with_pointers(scene, pointers))
    assert stored_meshes(kept) == [b"\x12" + pointer for pointer in pointers]


@pytest.mark.parametrize("data", [b"", b"\x10abc", bytes([SCENE]), bytes([SCENE]) + b"\xff\x80" * 9])
def test_what_is_no_scene_is_refused(data: bytes) -> None:
    with pytest.raises(VerificationError, match=r"not a scene|not a complete scene"):
        stored_meshes(data)
