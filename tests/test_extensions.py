"""Spot lights and opacity, and the records of a scene that hold them and anti-aliasing."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

import judge
from pictures import chain, counts, draw, dynamic
from shackled import Background, Camera, InputError, Light, Material, Mesh, Object, RenderError, Scene
from shackled.artifacts import artifact
from shackled.chain._node import engines
from shackled.image import decode_bmp
from shackled.scene import Rectangle, encode, encode_scene, fit, render_call
from shackled.scene._codec import ONE, extensions

CORNERS = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
BOX = Mesh(
    100 * np.array(CORNERS),
    [(a, b, c) for a, b, c, _ in QUADS] + [(a, c, d) for a, _, c, d in QUADS],
    [[250, 120, 40], [40, 200, 90], [60, 80, 240], [230, 230, 60]] * 2,
)
WALL = Mesh(
    [[x, y, 0] for x in range(-300, 301, 100) for y in range(-300, 301, 100)],
    [
        face
        for x in range(6)
        for y in range(6)
        for face in ((7 * x + y, 7 * x + y + 7, 7 * x + y + 1), (7 * x + y + 1, 7 * x + y + 7, 7 * x + y + 8))
    ],
    [[200, 220, 240]] * 49,
    [[0, 0, 1]] * 49,
)
MATTE = Material("flat", 0.1, 0.9, 0.0, 1)
GLOSSY = Material("smooth", 0.1, 0.7, 0.6, 30)
CAMERA = Camera((0, 0, 700), (0, 0, 0), near=1)


def wall(material: Material = GLOSSY, **changes: Any) -> Scene:
    return evolve(Scene([Object(WALL, material=material)], CAMERA, width=64, height=64), **changes)


def spot(inner: float = 10, outer: float = 25, **changes: Any) -> Light:
    light = Light("spot", (150, 100, 400), (255, 240, 200), (-150, -100, -400), inner, outer)
    return evolve(light, **changes)


def box(opacity: float, z: float = 0, **changes: Any) -> Object:
    turned = Object(BOX, (0, 0, z), (0.3, 0.4, 0.1, 1), material=Material("unlit"), opacity=opacity)
    return evolve(turned, **changes)


def pixels(scene: Scene) -> NDArray[np.int64]:
    return np.asarray(draw(scene)).astype(int)


# ---- spot lights ----


@pytest.mark.parametrize("shading", ["flat", "smooth"])
@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
@pytest.mark.parametrize("angles", [(0, 45), (10, 25), (20, 20), (60, 120)])
def test_a_cone_is_that_of_gltf(shading: Any, projection: Any, angles: tuple[float, float]) -> None:
    camera = evolve(CAMERA, projection=projection, half_height=0.5 if projection == "perspective" else 330.0)
    lights = [spot(*angles), Light("directional", (-1, 1, 3), (30, 60, 90))]
    verdict = judge.judge("cone", wall(evolve(GLOSSY, shading=shading), camera=camera, lights=lights))
    assert verdict.interior > 300
    assert verdict.is_near


def test_a_cone_of_all_directions_is_a_point_light() -> None:
    plain = Light("point", (150, 100, 400), (255, 240, 200))
    for material in (MATTE, GLOSSY):
        whole = wall(material, lights=[spot(179, 180)])
        difference = np.abs(pixels(whole) - pixels(wall(material, lights=[plain])))
        # the point light may be interpolated over blocks and triangles
        assert difference.max() <= 4


def test_outside_of_the_cone_is_ambient_light_only() -> None:
    away = spot(direction=(0, 0, 1))
    for material in (MATTE, GLOSSY):
        dark = pixels(wall(material, lights=[]))
        assert np.abs(pixels(wall(material, lights=[away])) - dark).max() <= 1
        lit = pixels(wall(material, lights=[spot(0, 10)]))
        # in the middle of the cone it is bright, in the corners dark
        assert (lit[30:34, 30:34] > dark[30:34, 30:34] + 40).all()
        assert np.abs(lit[:8, :8] - dark[:8, :8]).max() <= 1


def test_what_a_spot_light_needs() -> None:
    with pytest.raises(InputError, match="a spot light needs a direction"):
        Light("spot", (0, 0, 0))
    with pytest.raises(InputError, match="the direction of a spot light must not be zero"):
        Light("spot", (0, 0, 0), direction=(0, 0, 0))
    with pytest.raises(InputError, match="the inner_angle of a spot light, 50, must not be above its outer_angle, 45"):
        Light("spot", (0, 0, 0), direction=(0, 0, 1), inner_angle=50)
    with pytest.raises(InputError, match="outer_angle of a spot light must be a finite number from 0 to 180"):
        Light("spot", (0, 0, 0), direction=(0, 0, 1), outer_angle=181)
    with pytest.raises(InputError, match="only a spot light has direction, inner_angle and outer_angle, not a point"):
        Light("point", (0, 0, 0), direction=(0, 0, 1))


# ---- opacity ----


def scene_of(*objects: Object, **changes: Any) -> Scene:
    backdrop = Background((200, 210, 220), (40, 30, 20))
    return evolve(Scene(list(objects), CAMERA, background=backdrop, width=48, height=48), **changes)


def test_opaque_is_as_without() -> None:
    assert extensions(scene_of(box(1.0))) == b""
    assert encode(b"....", scene_of(box(1.0))) == encode(b"....", scene_of(evolve(box(0.5), opacity=1)))


def test_an_opacity_of_0_is_not_there() -> None:
    behind = box(1.0, -300)
    scene = scene_of(box(0.0), behind)
    assert (pixels(scene) == pixels(scene_of(behind))).all()
    assert counts(scene)[1] == counts(scene_of(behind))[1]


@pytest.mark.parametrize("wireframe", [False, True])
@pytest.mark.parametrize("cull", [False, True])
def test_the_nearest_surface_is_seen_once(cull: bool, wireframe: bool) -> None:
    plain = scene_of(box(1.0, cull=cull, wireframe=wireframe))
    half = scene_of(box(0.5, cull=cull, wireframe=wireframe))
    nothing, opaque, mixed = pixels(scene_of()), pixels(plain), pixels(half)
    assert (opaque != nothing).any()
    assert np.abs(mixed - (nothing + opaque) / 2).max() <= 2


def test_the_order_of_faces_makes_no_difference() -> None:
    expected = pixels(scene_of(box(0.4, cull=False)))
    for seed in range(5):
        faces = np.random.default_rng(seed).permutation(BOX.faces)
        assert (pixels(scene_of(box(0.4, cull=False, mesh=evolve(BOX, faces=faces)))) == expected).all()


def test_what_is_not_opaque_comes_last() -> None:
    far = box(1.0, -300, mesh=evolve(BOX, colors=[[255, 0, 0]] * 8))
    for objects in ((box(0.5), far), (far, box(0.5))):
        verdict = judge.judge("opacity", scene_of(*objects))
        assert verdict.faults == []
        assert verdict.worst <= 2
    assert (pixels(scene_of(box(0.5), far)) == pixels(scene_of(far, box(0.5)))).all()
    # of two that are not opaque the farther should come first: behind the nearer it is not drawn
    near = box(0.5, mesh=evolve(BOX, colors=[[0, 0, 255]] * 8))
    through = evolve(far, opacity=0.5)
    assert pixels(scene_of(through, near))[24, 24, 0] > pixels(scene_of(near, through))[24, 24, 0] + 20
    for objects in ((through, near), (near, through)):
        assert judge.judge("opacities", scene_of(*objects)).worst <= 2


def test_bright_colours_are_mixed_as_they_are_seen() -> None:
    bright = wall(evolve(GLOSSY, ambient=4.0), lights=[spot()])
    mixed = evolve(bright, objects=[evolve(bright.objects[0], opacity=0.25)], background=Background((0, 0, 0)))
    assert np.abs(pixels(mixed) - np.minimum(pixels(bright), 255) / 4).max() <= 1


# ---- records ----


def record(kind: int, index: int, content: bytes) -> bytes:
    return bytes([kind]) + index.to_bytes(2, "big") + len(content).to_bytes(2, "big") + content


def cone(*numbers: int) -> bytes:
    return b"".join(number.to_bytes(8, "big", signed=True) for number in numbers)


def with_records(scene: Scene, data: bytes) -> bytes:
    """The call that has the scene rendered with these extensions."""
    plain = evolve(
        scene,
        lights=[Light("point", w.vector, w.color) if w.kind == "spot" else w for w in scene.lights],
        objects=[evolve(o, opacity=1.0) for o in scene.objects],
        antialias=False,
    )
    assert extensions(plain) == b""
    struct = encode_scene(fit(plain))[:-32] + len(data).to_bytes(32, "big") + data + bytes(-len(data) % 32)
    return artifact("Renderer").selectors["render"] + (32).to_bytes(32, "big") + struct


def fog(near: int, far: int) -> bytes:
    """The content of a record of white fog."""
    return b"\xff" * 3 + b"".join(distance.to_bytes(8, "big", signed=True) for distance in (near, far))


def tone(exposure: int, flags: int) -> bytes:
    """The content of a record of a tone."""
    return exposure.to_bytes(4, "big") + bytes([flags])


DOWN = cone(0, -ONE, 0, ONE, 0)
HALF = (1 << 23).to_bytes(4, "big")
FAR = 1 << 58


def mixed() -> Scene:
    """Two lights, the second of them a point light; three objects."""
    lights = [Light("directional", (1, 1, 1)), spot()]
    return fit(scene_of(box(1.0), box(0.5, 100), box(0.25, 200), lights=lights))


def test_records_are_what_the_file_says() -> None:
    scene = evolve(mixed(), antialias=True)
    axis = [round(part * ONE) for part in np.asarray(scene.lights[1].direction).tolist()]
    cosines = [round(math.cos(math.radians(angle)) * ONE) for angle in (10, 25)]
    expected = record(1, 1, cone(*axis, *cosines)) + record(2, 1, HALF) + record(2, 2, (1 << 22).to_bytes(4, "big"))
    expected += record(3, 0, b"")
    assert extensions(scene) == expected
    drawn = chain().call("Renderer", with_records(scene, expected)).output
    assert drawn == chain().call("Renderer", encode(artifact("Renderer").selectors["render"], scene)).output


def texture(index: int, flags: int, width: int, height: int, bits: int, words: int = 0) -> bytes:
    """The record of a texture of the object, whose mesh is a box. words: more than it should have."""
    begin = bytes([flags, width - 1, height - 1, bits])
    size = 4 + (3 << bits if bits <= 8 else 0) + (width * height * bits + 7) // 8 + 6 * len(BOX.positions)
    content = begin + np.random.default_rng(bits).bytes(size + -size % 32 + 32 * words - 4)
    return bytes([8, 0, index]) + (len(content) // 32).to_bytes(2, "big") + content


def levels(index: int, words: int) -> bytes:
    """The record of opacities of the vertices of an object."""
    return b"\t" + index.to_bytes(2, "big") + words.to_bytes(2, "big") + np.random.default_rng(words).bytes(32 * words)


@pytest.mark.parametrize(
    ("data", "error"),
    [
        (b"\1", "ExtensionCutOff(position=0)"),
        (record(1, 1, DOWN)[:-1], "ExtensionCutOff(position=0)"),
        (record(1, 1, DOWN) + b"\2\0\1\0", "ExtensionCutOff(position=45)"),
        (record(2, 1, HALF) + bytes([2, 0, 2, 255, 255]), "ExtensionCutOff(position=9)"),
        (record(0, 0, b""), "UnknownExtension(kind=0, index=0)"),
        # sizes of kinds from 8 on are told in words
        (b"\xc8\0\7\0\1" + bytes(32), "UnknownExtension(kind=200, index=7)"),
        (b"\xc8\0\7\0\1" + bytes(31), "ExtensionCutOff(position=0)"),
        (record(255, 65535, b""), "UnknownExtension(kind=255, index=65535)"),
        (record(2, 1, HALF) + record(1, 1, DOWN), "ExtensionOrder(kind=1, index=1)"),
        (record(2, 1, HALF) + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
        (record(2, 2, HALF) + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
        (record(3, 0, b"") + record(2, 1, HALF), "ExtensionOrder(kind=2, index=1)"),
        (record(3, 0, b"") + record(3, 0, b""), "ExtensionOrder(kind=3, index=0)"),
        (record(1, 1, DOWN + b"\0"), "ExtensionSize(kind=1, index=1, expected=40, actual=41)"),
        (record(2, 1, HALF[:3]), "ExtensionSize(kind=2, index=1, expected=4, actual=3)"),
        (record(2, 1, b""), "ExtensionSize(kind=2, index=1, expected=4, actual=0)"),
        (record(3, 0, b"\1"), "ExtensionSize(kind=3, index=0, expected=0, actual=1)"),
        (record(1, 2, DOWN), "ExtensionIndex(kind=1, index=2, count=2)"),
        (record(2, 3, HALF), "ExtensionIndex(kind=2, index=3, count=3)"),
        (record(2, 65535, HALF), "ExtensionIndex(kind=2, index=65535, count=3)"),
        (record(3, 1, b""), "ExtensionIndex(kind=3, index=1, count=1)"),
        (record(1, 0, DOWN), "SpotIsNoPoint(light=0)"),
        (record(1, 1, cone(FAR + 1, 2, -3, ONE, 0)), f"SpotOutOfRange(light=1, x={FAR + 1}, y=2, z=-3)"),
        (record(1, 1, cone(0, 0, -FAR - 1, ONE, 0)), f"SpotOutOfRange(light=1, x=0, y=0, z={-FAR - 1})"),
        (record(1, 1, cone(0, 0, 0, ONE, 0)), "SpotWithoutDirection(light=1)"),
        (record(1, 1, cone(1, 0, 0, ONE + 1, 0)), f"SpotAngles(light=1, cosInner={ONE + 1}, cosOuter=0)"),
        (record(1, 1, cone(1, 0, 0, 0, -ONE - 1)), f"SpotAngles(light=1, cosInner=0, cosOuter={-ONE - 1})"),
        (record(1, 1, cone(1, 0, 0, 5, 6)), "SpotAngles(light=1, cosInner=5, cosOuter=6)"),
        (record(2, 0, (1 << 24).to_bytes(4, "big")), f"OpacityOutOfRange(object=0, opacity={1 << 24})"),
        (record(2, 0, b"\xff" * 4), f"OpacityOutOfRange(object=0, opacity={2**32 - 1})"),
        (record(4, 0, bytes(5)), "ExtensionSize(kind=4, index=0, expected=6, actual=5)"),
        (record(5, 0, bytes(5)), "ExtensionSize(kind=5, index=0, expected=4, actual=5)"),
        (record(6, 0, b""), "ExtensionSize(kind=6, index=0, expected=19, actual=0)"),
        (record(7, 0, bytes(4)), "ExtensionSize(kind=7, index=0, expected=5, actual=4)"),
        (record(4, 1, bytes(6)), "ExtensionIndex(kind=4, index=1, count=1)"),
        (record(7, 65535, bytes(5)), "ExtensionIndex(kind=7, index=65535, count=1)"),
        (record(5, 0, bytes(4)) + record(4, 0, bytes(6)), "ExtensionOrder(kind=4, index=0)"),
        (record(5, 0, bytes(4)), "RimPowerOutOfRange(power=0)"),
        (record(5, 0, b"\0\0\0\x11"), "RimPowerOutOfRange(power=17)"),
        (record(6, 0, fog(0, 0)), "FogOutOfRange(near=0, far=0)"),
        (record(6, 0, fog(2, 1)), "FogOutOfRange(near=2, far=1)"),
        (record(6, 0, fog(-1, 1)), "FogOutOfRange(near=-1, far=1)"),
        (record(6, 0, fog(0, FAR + 1)), f"FogOutOfRange(near=0, far={FAR + 1})"),
        (record(7, 0, bytes(5)), "ExposureOutOfRange(exposure=0)"),
        (record(7, 0, tone((64 << 16) + 1, 0)), f"ExposureOutOfRange(exposure={(64 << 16) + 1})"),
        (record(7, 0, tone(1, 4)), "UnknownToneFlags(flags=4)"),
        (record(7, 0, tone(1, 255)), "UnknownToneFlags(flags=255)"),
        (texture(3, 0, 1, 1, 1), "ExtensionIndex(kind=8, index=3, count=3)"),
        (b"\10\0\1\0\0", "ExtensionSize(kind=8, index=1, expected=32, actual=0)"),
        (texture(1, 4, 1, 1, 1), "TextureFormat(object=1, flags=4, bits=1)"),
        (texture(1, 255, 1, 1, 24), "TextureFormat(object=1, flags=255, bits=24)"),
        (texture(1, 0, 1, 1, 0), "TextureFormat(object=1, flags=0, bits=0)"),
        (texture(1, 0, 1, 1, 3), "TextureFormat(object=1, flags=0, bits=3)"),
        (texture(1, 0, 1, 1, 32), "TextureFormat(object=1, flags=0, bits=32)"),
        (texture(1, 0, 9, 9, 4, -1), "ExtensionSize(kind=8, index=1, expected=160, actual=128)"),
        (texture(1, 0, 9, 9, 4, 1), "ExtensionSize(kind=8, index=1, expected=160, actual=192)"),
        (texture(0, 0, 1, 1, 1) + texture(0, 0, 1, 1, 1), "ExtensionOrder(kind=8, index=0)"),
        (levels(3, 1), "ExtensionIndex(kind=9, index=3, count=3)"),
        (levels(65535, 0), "ExtensionIndex(kind=9, index=65535, count=3)"),
        (levels(0, 0), "ExtensionSize(kind=9, index=0, expected=32, actual=0)"),
        (levels(2, 2), "ExtensionSize(kind=9, index=2, expected=32, actual=64)"),
        (levels(1, 1) + levels(1, 1), "ExtensionOrder(kind=9, index=1)"),
        (levels(1, 1) + texture(1, 0, 1, 1, 1), "ExtensionOrder(kind=8, index=1)"),
        (b"\x0c\0\3\0\1" + bytes(32), "ExtensionIndex(kind=12, index=3, count=3)"),
        (b"\x0c\0\1\0\2" + bytes(64), "ExtensionSize(kind=12, index=1, expected=32, actual=64)"),
        (b"\x0c\0\2\0\1" + (1 << 24).to_bytes(32, "big"), "EmissionNotAColor(object=2, value=16777216)"),
        (b"\x0d\0\1\0\1" + bytes(32), "AlphaWithoutTexture(object=1)"),
        (texture(0, 0, 1, 1, 1) + b"\x0d\0\1\0\1" + bytes(32), "AlphaWithoutTexture(object=1)"),
        (texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\4\0\0\1" + bytes(27), "TextureFormat(object=1, flags=4, bits=1)"),
        (texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\0\0\0\3" + bytes(27), "TextureFormat(object=1, flags=0, bits=3)"),
        (
            texture(1, 0, 1, 1, 1) + b"\x0d\0\1\0\1\0\0\x0f\x0f\1" + bytes(27),
            "ExtensionSize(kind=13, index=1, expected=64, actual=32)",
        ),
        (b"\x0d\0\1\0\0", "ExtensionSize(kind=13, index=1, expected=32, actual=0)"),
        (b"\x0e\0\1\0\1" + bytes(32), "UnknownExtension(kind=14, index=1)"),
    ],
)
def test_wrong_records_are_refused(data: bytes, error: str) -> None:
    call = with_records(mixed(), data)
    with pytest.raises(RenderError) as caught:
        chain().call("Renderer", call)
    assert str(caught.value) == f"the contract refused: {error}"


@pytest.mark.parametrize(
    "data",
    [
        b"",
        record(2, 0, bytes(4)),
        record(2, 2, ((1 << 24) - 1).to_bytes(4, "big")),
        record(1, 1, cone(FAR, -FAR, FAR, ONE, -ONE)) + record(2, 0, HALF) + record(2, 1, HALF) + record(2, 2, HALF),
        record(1, 1, cone(0, 0, 1, -ONE, -ONE)),
        record(1, 1, cone(0, 0, -1, ONE, ONE)),
        record(3, 0, b""),
        record(1, 1, DOWN) + record(2, 2, HALF) + record(3, 0, b""),
        record(4, 0, bytes(6)) + record(5, 0, b"\0\0\0\1") + record(6, 0, fog(0, 1)) + record(7, 0, tone(1, 0)),
        record(2, 2, HALF) + record(4, 0, b"\xff" * 6) + record(5, 0, b"\xff\xff\xff\x10"),
        record(6, 0, fog(FAR - 1, FAR)) + record(7, 0, tone(64 << 16, 3)),
        pytest.param(texture(0, 0, 1, 1, 1) + texture(1, 1, 7, 5, 4) + texture(2, 2, 3, 256, 2), id="textures"),
        pytest.param(record(7, 0, tone(1 << 16, 2)) + texture(1, 3, 256, 256, 24), id="the largest texture"),
        pytest.param(record(2, 0, HALF) + texture(0, 0, 1, 1, 1) + levels(0, 1) + levels(2, 1), id="opacities"),
    ],
)
def test_values_at_their_bounds(data: bytes) -> None:
    call = with_records(mixed(), data)
    drawn = decode_bmp(dynamic(chain().call("Renderer", call).output), 48, 48)
    assert judge.judge_pixels("bounds", drawn, judge.render(call)).faults == []


PLAIN = ["Engine", "FragmentEngine"]
FOUR_SAMPLES = ["AntialiasedEngine", "AntialiasedFragmentEngine"]
SMOOTH = ["AntialiasedSmoothEngine"]


def test_engines_of_a_call() -> None:
    spots, opacity, antialias = record(1, 1, DOWN), record(2, 2, HALF), record(3, 0, b"")
    assert engines(with_records(mixed(), spots + opacity + antialias)) == FOUR_SAMPLES
    assert engines(with_records(mixed(), spots + antialias + record(4, 0, bytes(6)))) == ["EffectsEngine", "Effects"]
    for data in (b"", spots + opacity):
        assert engines(with_records(mixed(), data)) == PLAIN
    # other functions of the Renderer, and data that are no call at all
    tile = encode(artifact("Renderer").selectors["renderTile"], evolve(mixed(), antialias=True), Rectangle(0, 0, 8, 8))
    assert engines(tile) == FOUR_SAMPLES
    # of antialiased scenes: by light, projection, material and flags
    smooth = scene_of(box(1.0, material=Material("smooth")), lights=[Light("point", (0, 0, 9))], antialias=True)
    flat = box(1.0)
    orthographic = evolve(smooth, camera=Camera(projection="orthographic"))
    for scene, needed in (
        (smooth, SMOOTH),
        (orthographic, FOUR_SAMPLES[1:]),
        (evolve(orthographic, lights=[Light("directional", (0, 0, 9))]), SMOOTH),
        (evolve(smooth, lights=[]), FOUR_SAMPLES[:1]),
        (evolve(smooth, lights=2 * [*smooth.lights]), SMOOTH),
        (evolve(smooth, lights=3 * [*smooth.lights]), FOUR_SAMPLES[1:]),
        (evolve(orthographic, lights=[Light("directional", (0, 0, 9)), *smooth.lights]), FOUR_SAMPLES[1:]),
        (evolve(smooth, objects=[]), FOUR_SAMPLES[:1]),
        (evolve(smooth, objects=[flat]), FOUR_SAMPLES[:1]),
        (evolve(smooth, objects=[flat, *smooth.objects]), [FOUR_SAMPLES[0], *SMOOTH]),
        (evolve(smooth, objects=[evolve(flat, wireframe=True), *smooth.objects]), [FOUR_SAMPLES[1], *SMOOTH]),
        (evolve(smooth, objects=[box(1.0, material=Material("smooth", 1, 1, 1, 1))]), FOUR_SAMPLES[1:]),
        (evolve(smooth, objects=[box(1.0, material=Material("smooth", 1, 1, 0, 1))]), SMOOTH),
    ):
        assert engines(render_call(scene)) == needed
    for data in (b"", tile[:4], tile[:100], artifact("Renderer").selectors["engineCall"]):
        assert engines(data) == PLAIN


def test_objects_far_down_the_scene_cannot_have_records() -> None:
    small = Object(Mesh([[0, 0, 0]] * 3, [[0, 1, 2]], [[0, 0, 0]] * 3), opacity=0.5)
    scene = evolve(scene_of(), objects=[evolve(small, opacity=1.0)] * 65536 + [small])
    with pytest.raises(InputError, match="among the first 65,536 of a scene, not number 65,536"):
        extensions(scene)
