"""Meshes as they are kept: nothing is lost, and the contract gives back what Python does."""

from __future__ import annotations

import re

import numpy as np
import pytest
from eth_abi.abi import decode
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tools.ledger import call_data

from pictures import chain
from shackled import ChainError, InputError, Mesh, RenderError, load
from shackled.chain._embedded import EmbeddedChain
from shackled.datasets import teapot
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.studio._compact_mesh import COMPACT, compact, split_mesh
from shackled.studio._storage import storage_address


def opened(stored: bytes, gas: int | None = None) -> bytes:
    """What the Studio makes of it, had it been kept, with so much gas."""
    place = chain()
    assert isinstance(place, EmbeddedChain)
    pointer = storage_address(stored, place.address("Studio"))
    place._codes[pointer] = b"\0" + stored
    try:
        output = place.call("Studio", call_data("mesh(address)", "0x" + pointer.hex()), gas).output
    finally:
        del place._codes[pointer]
    return bytes(decode(["bytes"], output)[0])


def content(packed: bytes) -> tuple[list[str], list[str]]:
    """The vertices, and the faces by what their vertices are: in no order, from no particular corner."""
    parts = split_mesh(packed)
    vertices = [f"{parts.positions[k]} {parts.colors[k]} {parts.normals[k]}" for k in range(len(parts.positions))]
    faces = [tuple(vertices[corner] for corner in face) for face in parts.faces]
    turned = [str(min(face[k:] + face[:k] for k in range(3))) for face in faces]
    return sorted(vertices), sorted(turned)


@st.composite
def meshes(draw: st.DrawFn) -> bytes:
    """Any faces over any vertices: far from what surfaces look like."""
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    n, m = draw(st.integers(1, 400)), draw(st.integers(1, 120))
    reach = draw(st.sampled_from([0, 5, 300, 2**15 - 1, 2**15, 2**23 - 1]))
    positions = random.integers(-reach, reach + 1, (n, 3))
    near = draw(st.sampled_from([2, 20, 400]))
    faces = (np.arange(m)[:, None] + random.integers(0, near, (m, 3))) % n
    colors = random.integers(0, 256, (draw(st.sampled_from([1, 2, 5, 400])), 3))
    mesh = Mesh(positions, faces, colors[random.integers(0, len(colors), n)], random.normal(size=(n, 3)))
    return pack(mesh, smooth=draw(st.booleans()))


@settings(max_examples=60)
@given(packed=meshes())
def test_nothing_is_lost(packed: bytes) -> None:
    assert content(opened(compact(packed))) == content(packed)


@pytest.mark.parametrize("normal_bits", range(4, 11))
def test_normals_of_fewer_bits(normal_bits: int) -> None:
    packed = pack(Mesh(np.round(np.asarray(teapot(3).positions) * 1000), teapot(3).faces), smooth=True)
    stored = compact(packed, normal_bits)
    exact, near = split_mesh(opened(compact(packed))), split_mesh(opened(stored))
    assert exact.positions == near.positions
    assert exact.faces == near.faces
    for a, b in zip(exact.normals, near.normals, strict=True):
        for shift in (22, 12, 2):
            difference = abs(((a >> shift & 1023) ^ 512) - ((b >> shift & 1023) ^ 512))
            assert difference <= 1 << (9 - normal_bits) if normal_bits < 10 else difference == 0


@pytest.mark.parametrize("name", ["icons/crown", "teapot", "torus-knot"])
def test_surfaces_become_small(name: str) -> None:
    for o in in_range(load(name)).objects:
        packed = pack(o.mesh, o.material.shading == "smooth")
        stored = compact(packed)
        assert content(opened(stored)) == content(packed)
        assert len(stored) < 0.6 * len(packed)


def test_meshes_that_are_kept_as_they_are_or_lack_faces() -> None:
    packed = pack(Mesh([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [[0, 1, 2]]))
    assert opened(packed) == packed
    lonely = pack(Mesh([[0, 0, 0], [9, 0, 0], [5, 5, 5], [0, 9, 0]], [[0, 1, 3]]))
    for packed in (lonely, b"\0\0\0\0\0", b"\0\0\1\0\0" + bytes(9)):
        assert content(opened(compact(packed))) == content(packed)


CUBE = compact(pack(Mesh(np.array(np.meshgrid([0, 9], [0, 9], [0, 9])).reshape(3, 8).T, [[0, 1, 3], [0, 3, 2]])))


@pytest.mark.parametrize(
    ("broken", "error"),
    [
        (CUBE[:-1], "CompactMeshLength"),
        (CUBE + b"\0", "CompactMeshLength"),
        (CUBE[:20], "CompactMeshLength"),
        (CUBE[:1] + b"\4" + CUBE[2:], "CompactMeshHeader"),
        (CUBE[:8] + b"\x11" + CUBE[9:], "CompactMeshHeader"),
        (CUBE[:22] + b"\x19" + CUBE[23:], "CompactMeshHeader"),
        (CUBE[:23] + b"\1" + CUBE[24:], "CompactMeshHeader"),
        (CUBE[:27] + b"\xff\xff" + CUBE[29:], "CompactMeshFaces"),
        (b"\x21" + CUBE[1:], "UnknownMesh"),
        # a face of three new vertices, where there are none
        (bytes([COMPACT]) + bytes(4) + b"\1" + bytes(18) + b"\xf0", "CompactMeshFaces"),
    ],
)
def test_what_is_broken_is_refused(broken: bytes, error: str) -> None:
    with pytest.raises(RenderError, match=error):
        opened(broken)


def head(kind: int = 0, x: int = 0, y: int = 0, z: int = 0, colors: int = 0, color: int = 0, normal: int = 0) -> bytes:
    """A compact mesh of nothing: how many bits its numbers have, if there were any."""
    sizes = bytes([COMPACT, kind]) + bytes(6) + bytes([x, y, z]) + bytes(9)
    return sizes + colors.to_bytes(2, "big") + bytes([color, normal]) + bytes(3 * colors)


@pytest.mark.parametrize("known", [{"x": 16, "y": 16, "z": 16}, {"kind": 2, "z": 24}])
@pytest.mark.parametrize("more", [{"color": 24}, {"colors": 1}, {"colors": 3, "color": 2}, {"kind": 3, "normal": 10}])
def test_heads_that_the_format_knows(known: dict[str, int], more: dict[str, int]) -> None:
    assert opened(head(**known | more))[1:] == bytes(4)


@pytest.mark.parametrize(
    "beyond",
    [
        *({"kind": 4}, {"x": 17}, {"y": 17}, {"z": 17}, {"kind": 2, "x": 25}, {"kind": 2, "z": 25}, {"color": 25}),
        *({"colors": 1, "color": 1}, {"colors": 3, "color": 3}, {"kind": 1, "normal": 11}, {"kind": 1}, {"normal": 5}),
    ],
)
def test_heads_beyond_what_the_format_knows(beyond: dict[str, int]) -> None:
    with pytest.raises(RenderError, match="CompactMeshHeader"):
        opened(head(**beyond))


@settings(max_examples=40)
@given(data=st.data())
def test_no_bytes_break_the_decoder(data: st.DataObject) -> None:
    """Whatever it is given it ends, in little gas, with a mesh of the size that it tells or an error of its own."""
    broken = bytearray(CUBE)
    for _ in range(data.draw(st.integers(1, 6))):
        broken[data.draw(st.integers(1, len(broken) - 1))] = data.draw(st.integers(0, 255))
    try:
        mesh = opened(bytes(broken))
    except ChainError as error:
        assert "CompactMesh" in str(error)  # noqa: PT017
    else:
        size = 5 + int.from_bytes(mesh[1:3], "big") * (9, 13, 12, 16)[mesh[0]] + 6 * int.from_bytes(mesh[3:5], "big")
        assert len(mesh) == size


@settings(max_examples=150)
@given(
    kind=st.sampled_from([0, 1, 2, 3, 4, COMPACT, 0x11, 0x12, 0x13, 0x20, 0xFF]),
    rest=st.one_of(st.binary(max_size=70), st.binary(min_size=15, max_size=15).map(bytes(8).__add__)),
)
@example(kind=0x11, rest=b"\xff\xff\xff\xff")
@example(kind=0x11, rest=b"\xe0\xff\xff")
@example(kind=COMPACT, rest=b"\3\xff\xff" + bytes(19) + b"\0\4" + bytes(32767))
def test_no_bytes_of_any_kind_burn_all_gas(kind: int, rest: bytes) -> None:
    """A few bytes that anyone can store are a mesh or an error with a name, and leave gas to whoever reads them."""
    stored = bytes([kind]) + rest
    try:
        mesh = opened(stored, 40_000_000)
    except ChainError as error:
        assert re.search("UnknownMesh|CompactMesh|NothingKept", str(error))  # noqa: PT017
        assert kind > 3
    else:
        assert kind == COMPACT or (kind <= 3 and mesh == stored)


NO_MESHES = (b"", b"\4\0\0\0\0", b"\0\0\1\0\0", b"\0\0\0\0\1" + bytes(6))


@pytest.mark.parametrize(("data", "normal_bits"), [*((data, 10) for data in NO_MESHES), (bytes(5), 3), (bytes(5), 11)])
def test_what_cannot_be_compressed(data: bytes, normal_bits: int) -> None:
    with pytest.raises(InputError, match=r"packed mesh|numbered 0 to|4 to 10 bits"):
        compact(data, normal_bits)
