"""Meshes and scenes are kept once, for everybody, and drawn as what they were."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable
from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from eth_abi.abi import decode
from numpy.typing import NDArray
from tools.ledger import World, call_data

from pictures import frames_of
from shackled import Background, Camera, ChainError, Light, Material, Mesh, Object, RenderError, Scene, Texture, render
from shackled.artifacts import artifact
from shackled.datasets import teapot
from shackled.ethereum._encoding import word
from shackled.image import decode_bmp
from shackled.scene._arithmetic import from_euler
from shackled.scene._fields import Shading
from stored_scenes import CHANGES, SCENE_STRUCT, changes, kept, stored, struct_of, turned

POT = Mesh(np.round(np.asarray(teapot(3).positions) * 100), teapot(3).faces)
TENT = Mesh([[-90, 0, 0], [90, 0, 0], [0, 150, 0]], [[0, 1, 2]], [[255, 0, 0], [0, 255, 0], [0, 0, 255]])
SCENE = Scene(
    [
        Object(POT, (0, -100, 0), material=Material("smooth", 0.25, 0.75, 0.5, 16)),
        Object(TENT, (50, 20, 200), from_euler((0, 30, 0)), 0.5, cull=False),
    ],
    Camera((200, 250, 900), (0, 40, 0)),
    [Light("directional", (-1, 2, 3))],
    Background("#102040", "#a0b0c0"),
    width=48,
    height=40,
)
NOBODY = "0x" + 20 * "77"


def changed(world: World, pointer: str, **change: object) -> NDArray[np.uint8]:
    """The picture with changes: fields, turn, color, background, invert, canvas."""
    bmp = world.call("Studio", f"render(address,{CHANGES})", pointer, changes(**change))
    width, height = (int.from_bytes(bmp[at : at + 4], "little") for at in (18, 22))
    return decode_bmp(bmp, width, height)


def test_a_scene_is_drawn_as_it_was(world: World) -> None:
    pointer = stored(world, SCENE)
    picture = render(SCENE)
    assert (picture.covered_pixels or 0) > 200
    assert world.call("Studio", "render(address)", pointer) == picture.bmp
    png = world.call("Studio", "renderPNG(address,uint256)", pointer, 3)
    assert np.array_equal(frames_of(png)[0], picture.pixels.repeat(3, 0).repeat(3, 1))
    uri = world.call("Studio", "renderDataURI(address,uint256)", pointer, 1)
    assert uri.startswith("data:image/png;base64,iVBORw0KGgo")
    assert f'href="{uri}"' in world.call("Studio", "renderSVG(address,uint256)", pointer, 1)


def test_a_data_uri_of_whole_words(world: World) -> None:
    """The PNG file ends where a word ends, and what is behind it in memory is free."""
    pointer = stored(world, SCENE)

    def made(kind: str, width: int) -> Any:
        narrow = changes(fields=16, canvas=(width, 8))
        return world.call("Studio", f"render{kind}(address,uint256,{CHANGES})", pointer, 2, narrow)

    width, png = next((width, png) for width in range(8, 200) if len(png := made("PNG", width)) % 32 == 0)
    uri = "data:image/png;base64," + base64.b64encode(png).decode()
    assert made("DataURI", width) == uri
    assert f'href="{uri}"' in made("SVG", width)


def test_what_is_kept_is_the_scene(world: World) -> None:
    pointer = stored(world, SCENE)
    struct = struct_of(world, pointer)
    assert struct[0] == (48, 40)
    sizes = [5 + 13 * len(POT.positions) + 6 * len(POT.faces), 5 + 9 * 3 + 6]
    assert [len(o[0]) for o in struct[6]] == sizes
    # a scene that is not kept is drawn in the same way, its meshes wherever they are
    data = call_data(f"drawPNG({SCENE_STRUCT},uint256)", struct, 1)
    drawn = decode(["bytes"], world.run(world.address("Studio"), data))[0]
    assert drawn == world.call("Studio", "renderPNG(address,uint256)", pointer, 1)


def test_extensions_are_kept_with_the_scene(world: World) -> None:
    glass = [evolve(o, opacity=opacity) for o, opacity in zip(SCENE.objects, (0.5, 1.0), strict=True)]
    cone = Light("spot", (300, 500, 900), (255, 240, 200), (-300, -500, -900), 5, 20)
    scene = evolve(SCENE, objects=glass, lights=[*SCENE.lights, cone])
    pointer = stored(world, scene)
    drawn = changed(world, pointer)
    assert (drawn == render(scene).pixels).all()
    assert (drawn != render(SCENE).pixels).any()
    struct = struct_of(world, pointer)
    assert len(struct[7]) == 45 + 9
    # what a newer contract may know is reported when it is drawn
    newer = kept(world, (*struct[:7], b"\x0e\0\0\0\1" + bytes(32)))
    with pytest.raises(RenderError, match=r"UnknownExtension\(kind=14, index=0\)"):
        world.call("Studio", "check(address)", newer)


@pytest.mark.parametrize("shading", ["flat", "smooth"])
def test_textures_and_opacities_are_kept_with_the_scene(world: World, shading: Shading) -> None:
    """Stored meshes have their vertices in another order, and what belongs to vertices with them."""
    random, count = np.random.default_rng(1), len(POT.positions)
    texture = Texture(random.integers(0, 256, (40, 30, 3), dtype=np.uint8))
    for mesh, material in (
        (evolve(POT, uvs=random.uniform(0, 1, (count, 2))), Material(shading, texture=texture)),
        (evolve(POT, opacities=random.uniform(0, 1, count)), Material(shading)),
    ):
        scene = evolve(SCENE, objects=[Object(mesh, (0, -100, 0), material=material)])
        assert changed(world, stored(world, scene)).tolist() == render(scene).pixels.tolist()


def test_antialiased(world: World) -> None:
    glass = evolve(SCENE, objects=[evolve(o, opacity=0.5) for o in SCENE.objects])
    for scene in (SCENE, glass, evolve(glass, antialias=True)):
        picture = changed(world, stored(world, scene), fields=32)
        assert (picture == render(evolve(scene, antialias=True)).pixels).all()


@pytest.mark.parametrize("records", [b"\1\0\0\0\x28" + bytes(35), b"\0\0", b"\2\0\0\0\4"])
def test_records_that_are_cut_off(world: World, records: bytes) -> None:
    """Another record does not complete them."""
    struct = struct_of(world, stored(world, SCENE))
    pointer = kept(world, (*struct[:7], records))
    for fields in (0, 32):
        with pytest.raises(RenderError, match=r"ExtensionCutOff\(position=0\)"):
            changed(world, pointer, fields=fields)


def test_the_same_has_the_same_pointer_and_is_kept_once(world: World) -> None:
    mesh = b"\0" + (7).to_bytes(2, "big") + b"\0\0" + bytes(range(63))
    first = world.store("storeMesh(bytes)", mesh)
    dear = world.gas
    assert world.store("storeMesh(bytes)", mesh) == first
    assert world.gas < dear / 4
    assert world.store("storeMesh(bytes)", mesh[:-1] + b"\1") != first
    assert world.call("Studio", "mesh(address)", "0x" + first.hex()) == mesh
    assert world.codes[first] == b"\0" + mesh


def test_turned(world: World) -> None:
    quaternion = from_euler((10, 70, -20))
    turn = tuple(round(part * 2**32) for part in quaternion.tolist())
    expected = render(turned(SCENE, quaternion))
    assert (expected.covered_pixels or 0) > 200
    found = changed(world, stored(world, SCENE), fields=1, turn=turn)
    # the last bits of the numbers differ
    assert (np.abs(found.astype(int) - expected.pixels).max(axis=2) > 3).mean() < 0.02
    assert (np.abs(render(SCENE).pixels.astype(int) - expected.pixels).max(axis=2) > 3).mean() > 0.1


def test_painted_on_another_background_inverted_and_larger(world: World) -> None:
    pointer = stored(world, SCENE)
    painted = [
        evolve(o, mesh=evolve(o.mesh, colors=np.tile((1, 2, 250), (len(o.mesh.positions), 1)))) for o in SCENE.objects
    ]
    expected = render(
        evolve(SCENE, objects=painted, background=Background("#010203", "#fefdfc"), invert=True, width=64, height=30)
    )
    picture = changed(
        world, pointer, fields=30, color=0x0102FA, background=(0x010203, 0xFEFDFC), invert=1, canvas=(64, 30)
    )
    assert np.array_equal(picture, expected.pixels)
    # fields that are not named do not count
    picture = changed(world, pointer, turn=(0, 0, 0, 0), color=2**30, background=(1, 2), invert=7, canvas=(0, 0))
    assert np.array_equal(picture, render(SCENE).pixels)


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"fields": 64}, "UnknownChanges.*64"),
        ({"fields": 1, "turn": (0, 0, 0, 0)}, "TurnOutOfRange"),
        ({"fields": 1, "turn": (2**255 - 1, 0, 0, 0)}, "TurnOutOfRange"),
        ({"fields": 2, "color": 1 << 24}, "ColorOutOfRange"),
        ({"fields": 16, "canvas": (0, 4)}, "CanvasSize"),
        ({"fields": 8, "invert": 2}, "NotAFlag"),
    ],
)
def test_changes_out_of_range(world: World, change: dict[str, object], error: str) -> None:
    pointer = stored(world, SCENE)
    with pytest.raises(RenderError, match=error):
        changed(world, pointer, **change)


def test_large_meshes_are_kept_in_parts(world: World) -> None:
    random = np.random.default_rng(1)
    mesh = b"\0" + (6000).to_bytes(2, "big") + b"\0\0" + random.bytes(54000)
    at_once = world.store("storeMesh(bytes)", mesh)
    assert len(world.codes[at_once]) == 1 + 1 + 3 * 20
    assert world.call("Studio", "mesh(address)", "0x" + at_once.hex()) == mesh
    parts = ["0x" + world.store("storePart(bytes)", mesh[k : k + 24575]).hex() for k in range(0, len(mesh), 24575)]
    assert world.store("join(address[])", parts) == at_once
    with pytest.raises(RenderError, match="NotToBeKept"):
        world.store("storePart(bytes)", bytes(24576))
    with pytest.raises(RenderError, match=f"NothingKept.*{NOBODY}"):
        world.store("join(address[])", [parts[0], NOBODY])


@pytest.mark.parametrize("function", ["mesh", "scene", "render"])
def test_where_nothing_is_kept(world: World, function: str) -> None:
    with pytest.raises(RenderError, match=f"NothingKept.*{NOBODY}"):
        world.call("Studio", f"{function}(address)", NOBODY)


def test_only_what_the_studio_keeps_counts(world: World) -> None:
    """Code elsewhere may change: an account that delegates (EIP-7702) has 0xef0100 and an address as its code."""
    account, other = bytes(19) + b"\x71", bytes(19) + b"\x72"
    world.codes[account] = bytes.fromhex("ef0100") + bytes(20)
    # a mesh whose last bytes are those of the account's code; the rest is kept
    head = world.store("storePart(bytes)", b"\0\0\2\0\0" + bytes(3))
    joined = world.store("join(address[])", ["0x" + head.hex(), "0x" + account.hex()])
    with pytest.raises(RenderError, match=f"NothingKept.*{account.hex()}"):
        world.call("Studio", "mesh(address)", "0x" + joined.hex())
    # the very code of what is kept, and a list of parts, at another place
    mesh = world.store("storeMesh(bytes)", bytes(5))
    for code in (world.codes[mesh], b"\0\x13" + mesh):
        world.codes[other] = code
        with pytest.raises(RenderError, match=f"NothingKept.*{other.hex()}"):
            world.call("Studio", "mesh(address)", "0x" + other.hex())


def test_what_is_neither(world: World) -> None:
    mesh = "0x" + world.store("storeMesh(bytes)", bytes(5)).hex()
    with pytest.raises(RenderError, match="NotAScene"):
        world.call("Studio", "render(address)", mesh)
    with pytest.raises(RenderError, match=r"UnknownMesh.*32"):
        world.call("Studio", "mesh(address)", stored(world, SCENE))
    for data, kind in ((b"", 256), (b"\4", 4), (b"\x12" + bytes(20), 0x12), (b"\x13" + bytes(20), 0x13), (b"\x20", 32)):
        with pytest.raises(RenderError, match=f"NotAMesh.*{kind}"):
            world.store("storeMesh(bytes)", data)


def test_a_scene_with_a_broken_mesh_spoils_only_itself(world: World) -> None:
    good = stored(world, SCENE)
    broken = "0x" + world.store("storeMesh(bytes)", b"\0\0\3\0\1").hex()
    struct = struct_of(world, good)
    for o in range(2):
        objects = list(struct[6])
        objects[o] = (b"\x12" + bytes.fromhex(broken[2:]), *objects[o][1:])
        pointer = kept(world, (*struct[:6], objects, struct[7]))
        with pytest.raises(RenderError, match="MeshLength"):
            world.call("Studio", "render(address)", pointer)
    assert world.call("Studio", "render(address)", good) == render(SCENE).bmp


@pytest.mark.parametrize("kind", [0x11, 0x14, 0xFF])
def test_kinds_of_meshes_that_there_are_not(world: World, kind: int) -> None:
    """They cost little, stored or not, however few bytes they have."""
    data = bytes([kind]) + b"\xff\xff\xff\xff"
    with pytest.raises(RenderError, match=f"NotAMesh.*{kind}"):
        world.store("storeMesh(bytes)", data)
    stored = world.store("storePart(bytes)", data)
    with pytest.raises(RenderError, match=f"UnknownMesh.*{kind}"):
        world.call("Studio", "mesh(address)", "0x" + stored.hex(), gas=100_000)
    struct = (*draw_nothing(), [(data, (0,) * 3, (0, 0, 0, 1), 1, (0, 0, 0, 0, 1), 0)], b"")
    with pytest.raises(RenderError, match=f"UnknownMesh.*{kind}"):
        world.call("Studio", f"drawPNG({SCENE_STRUCT},uint256)", struct, 1, gas=100_000)


def draw_nothing() -> tuple[object, ...]:
    """All of a scene but its objects."""
    one = 1 << 32
    camera = ((0, 0, 0), (0, 0, -one), (0, one, 0), 0, one, one)
    return ((4, 4), camera, (0, 0), 0, 0, [])


@pytest.mark.parametrize("count", [43, 100, 1000])
def test_a_list_that_names_one_part_many_times(world: World, count: int) -> None:
    """It is refused for little gas, when it is stored as a list and when it is read."""
    part = world.store("storePart(bytes)", b"\0\xff\xff\xff\xff" + bytes(24570))
    size = count * 24575
    with pytest.raises(RenderError, match=rf"PartsTooLarge\(size={size}, largest={1 << 20}\)"):
        world.run(world.address("Studio"), call_data("join(address[])", ["0x" + part.hex()] * count), 1_500_000)
    listed = "0x" + world.store("storePart(bytes)", b"\x13" + part * count).hex()
    for function in ("mesh", "scene", "render"):
        with pytest.raises(RenderError, match=rf"PartsTooLarge\(size={size}, largest={1 << 20}\)"):
            world.call("Studio", f"{function}(address)", listed, gas=1_500_000)


def test_the_largest_list_can_be_read(world: World) -> None:
    """It costs less than a picture."""
    part = world.store("storePart(bytes)", b"\0\xff\xff\xff\xff" + bytes(24570))
    joined = world.store("join(address[])", ["0x" + part.hex()] * 42)
    mesh = world.call("Studio", "mesh(address)", "0x" + joined.hex(), gas=20_000_000)
    assert len(mesh) == 42 * 24575


FAR = 1 << 58


@pytest.mark.parametrize(
    ("function", "fields", "turn"),
    [
        ("render(address)", 0, None),
        (f"render(address,{CHANGES})", 1, (0, 0, 0, 1 << 32)),
        (f"render(address,{CHANGES})", 1, (0, 1 << 32, 0, 1 << 32)),
        (f"render(address,{CHANGES})", 31, (1, 0, 0, 0)),
    ],
)
@pytest.mark.parametrize(
    ("field", "value", "error"),
    [
        (1, (1 << 255) - (1 << 256), "PositionOutOfRange(object=1, x={}, y=0, z=0)"),
        (1, FAR + 1, "PositionOutOfRange(object=1, x={}, y=0, z=0)"),
        (1, -FAR - 1, "PositionOutOfRange(object=1, x={}, y=0, z=0)"),
        (2, 1 << 128, "RotationOutOfRange(object=1, x={}, y=0, z=0, w=4294967296)"),
        (2, -FAR - 1, "RotationOutOfRange(object=1, x={}, y=0, z=0, w=4294967296)"),
        (2, None, "RotationIsZero(object=1)"),
        (3, (1 << 255) - 1, "ScaleOutOfRange(object=1, scale={})"),
        (3, (1 << 44) + 1, "ScaleOutOfRange(object=1, scale={})"),
        (3, -1, "ScaleOutOfRange(object=1, scale={})"),
    ],
)
def test_what_is_refused_plain_is_refused_turned(
    world: World,
    field: int,
    value: int | None,
    error: str,
    function: str,
    fields: int,
    turn: tuple[int, ...] | None,
) -> None:
    """Position, rotation or scale of an object beyond their bounds, with the error that says so."""
    pointer = stored(world, SCENE)
    struct = struct_of(world, pointer)
    second = list(struct[6][1])
    second[field] = {1: (value, 0, 0), 2: (0, 0, 0, 0) if value is None else (value, 0, 0, 1 << 32), 3: value}[field]
    broken = kept(world, (*struct[:6], [struct[6][0], tuple(second)], struct[7]))
    change = [] if turn is None else [changes(fields=fields, turn=turn, canvas=(8, 8))]
    with pytest.raises(RenderError, match=re.escape(error.format(value))):
        world.call("Studio", function, broken, *change)


@pytest.mark.parametrize("length", [1, 1 << 10, 1 << 32, 1 << 50])
def test_turned_however_long_the_rotations_are(world: World, length: int) -> None:
    """Only the direction of a rotation counts, that of the object and that of the turn."""
    tent = evolve(SCENE, objects=[SCENE.objects[1]])
    struct = struct_of(world, stored(world, tent))
    pictures = []
    for own, turn in ((1 << 32, 1 << 32), (length, 1 << 32), (1 << 32, min(length, 1 << 48)), (length, 1)):
        o = list(struct[6][0])
        o[2] = (0, -own, 0, own)
        pointer = kept(world, (*struct[:6], [tuple(o)], struct[7]))
        pictures.append(changed(world, pointer, fields=1, turn=(turn, 0, 0, -turn)))
    assert len(np.unique(pictures[0].reshape(-1, 3), axis=0)) > 20
    for picture in pictures[1:]:
        assert np.abs(picture.astype(int) - pictures[0]).max() <= 2


@pytest.mark.parametrize(
    ("change", "error"),
    [
        (lambda s, o: (s, [o[0], (o[1][0], (FAR + 1, 0, 0), *o[1][2:])]), "PositionOutOfRange(object=1"),
        (
            lambda s, o: (s, [o[0], (o[1][0][:-1] + b"\3", *o[1][1:])]),
            "IndexOutOfRange(object=1, face=0, vertexCount=3)",
        ),
        (lambda s, o: (s, [(o[0][0][:-1], *o[0][1:]), o[1]]), "MeshLength(object=0"),
        (lambda s, o: (((0, 4), *s[1:]), o), "CanvasSize(width=0, height=4)"),
        (lambda s, o: ((s[0], (s[1][0], s[1][0], *s[1][2:]), *s[2:]), o), "NoViewDirection()"),
        (lambda s, o: (s, [o[0], (b"\x12" + 20 * b"\x77", *o[1][1:])]), f"NothingKept(pointer={NOBODY}"),
    ],
)
def test_what_cannot_be_drawn_does_not_pass_the_check(
    world: World, change: Callable[[Any, Any], tuple[Any, Any]], error: str
) -> None:
    pointer = stored(world, SCENE)
    world.run(world.address("Studio"), call_data("check(address)", pointer))
    struct = struct_of(world, pointer)
    others, objects = change(struct[:6], list(struct[6]))
    broken = kept(world, (*others, objects, struct[7]))
    for function in ("check", "render"):
        with pytest.raises(RenderError, match=re.escape(error)):
            world.run(world.address("Studio"), call_data(f"{function}(address)", broken))


@pytest.mark.parametrize("contract", ["Studio", "Turntable"])
def test_an_address_without_code_is_no_part(world: World, contract: str) -> None:
    parts = [world.address(name) for name in artifact(contract).parts]
    for given in (parts, *([*parts[:place], b"\x77" * 20, *parts[place + 1 :]] for place in range(len(parts)))):
        with pytest.raises(ChainError, match="could not be deployed") if given is not parts else nullcontext():
            world.deploy(artifact(contract).creation, b"".join(map(word, given)))
