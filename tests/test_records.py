"""Each kind of record of `Scene.extensions`, alone and mixed with others, in everything that writes or reads records.

What is expected is computed here from the scenes, or is the picture of the same scene whose records are elsewhere.
"""

from __future__ import annotations

import io
import shutil
import struct
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from eth_abi.abi import encode as encode_abi
from PIL import Image as PillowImage
from PIL import ImageSequence
from tools.ledger import World, call_data

import gltf_reader
from node_scripts import answers
from pictures import chain, draw, dynamic, words
from shackled import (
    Background,
    Camera,
    Fog,
    InputError,
    Light,
    Material,
    Mesh,
    Object,
    RenderError,
    Rim,
    Scene,
    Tone,
    load,
)
from shackled.artifacts import artifact
from shackled.gas._runs import engine_calls
from shackled.image import decode_bmp
from shackled.scene import (
    Hemisphere,
    Rectangle,
    Texture,
    decode,
    encode,
    encode_scene,
    encode_scene_file,
    fit,
    render_call,
)
from shackled.scene._codec import extensions
from shackled.scene._texture import FILTERS, WRAPS
from shackled.studio import store_scene
from shackled.studio._storage import quantize

#: In the order of their numbers, from 1. From LONG on, sizes are in words.
KINDS = (
    *("spot", "opacity", "antialias", "hemisphere", "rim", "fog"),
    *("tone", "texture", "opacities", "shadow", "ground"),
)
LONG, WORD, HEADER = 8, 32, 5
ONE = 1 << 32
#: Half a side of the box around each mesh, in units.
HALF = 40
WIDTH, HEIGHT = 26, 22
#: More than a model or a picture of these scenes takes; without an end, as much is used up at once.
MODEL_GAS, PICTURE_GAS = 400_000, 60_000_000

SCRIPT, BUNDLE = Path(__file__).parent / "web" / "calls.mjs", files("shackled") / "web" / "shackled.js"

Rng = np.random.Generator


def mixed(seed: int) -> frozenset[str]:
    return frozenset(np.random.default_rng(seed).permutation(KINDS)[: 2 + seed % 6].tolist())


CASES = {kind: frozenset([kind]) for kind in KINDS} | {"all": frozenset(KINDS), "none": frozenset[str]()}
CASES |= {"-".join(sorted(each)): each for each in map(mixed, range(12))}


def bipyramid(rng: Rng, corners: int) -> Mesh:
    """A closed mesh, or one without its last face; HALF away from its middle along each axis."""
    angles = np.arange(corners) * 2 * np.pi / corners
    ring = np.rint(HALF * np.stack([np.cos(angles), 0 * angles, -np.sin(angles)], axis=1))
    around = [(k, (k + 1) % corners) for k in range(corners)]
    faces = [(a, b, corners) for a, b in around] + [(b, a, corners + 1) for a, b in around]
    positions = [*ring.tolist(), (0, HALF, 0), (0, -HALF, 0)]
    return Mesh(positions, faces[: len(faces) - (rng.random() < 0.3)], rng.integers(0, 256, (corners + 2, 3)))


def scene_of(case: str) -> Scene:
    """A scene with the records of a case, in the numbers of the contracts; its objects are apart on the canvas."""
    kinds, rng = CASES[case], np.random.default_rng(list(case.encode()))

    def some(kind: str, count: int) -> list[bool]:
        chosen = rng.random(count) < 0.5
        chosen[rng.integers(count)] = True
        return [kind in kinds and bool(each) for each in chosen]

    clear, pictures, glass, fading = (some(kind, 3) for kind in ("opacity", "texture", "opacities", "ground"))
    objects = []
    for k in range(3):
        mesh, texture = bipyramid(rng, int(rng.choice([4, 8, 36]))), None
        count = len(mesh.positions)
        if pictures[k]:
            colors = rng.integers(0, 256, (int(rng.choice([1, 3, 5, 20, 300])), 3), dtype=np.uint8)
            pixels = colors[rng.integers(0, len(colors), rng.integers(1, 20, 2))]
            texture = Texture(pixels, FILTERS[rng.integers(2)], WRAPS[rng.integers(2)])
            mesh = evolve(mesh, uvs=rng.integers(-(1 << 17), 1 << 17, (count, 2)) / 65536)
        if glass[k]:
            mesh = evolve(mesh, opacities=rng.integers(0, 255, count) / 255)
        shading = ("unlit", "flat", "smooth")[rng.integers(3)]
        thing = Object(
            mesh,
            (95 * (k - 1), 2 * int(rng.integers(-25, 26)), 2 * int(rng.integers(-10, 11))),
            np.rint(rng.normal(size=4) * ONE) / ONE,
            material=Material(shading, 0.3, 0.7, 0.25 * rng.integers(3), 9, texture),
            cull=bool(rng.random() < 0.7),
            wireframe=bool(rng.random() < 0.15),
            opacity=rng.choice([0, 0.25, 1 - 2.0**-24]) if clear[k] else rng.choice([1, 1 - 2.0**-26]),
            fade=(8.5, 31) if fading[k] else None,
        )
        objects.append(thing)
    lights = [Light("directional", (-1, 2, 3), (255, 240, 200))]
    lights += [Light("point", place, (90, 120, 255)) for place in ((-200, 300, 400), (100, 50, 300))]
    for k, is_cone in enumerate(some("spot", 2), 1):
        if is_cone:
            lights[k] = Light("spot", lights[k].vector, lights[k].color, -lights[k].vector, *((0, 60), (60, 90))[k - 1])
    shadow = int(rng.integers(3)) if "shadow" in kinds else None
    flat = rng.random() < 0.5
    projection, half_height, near = ("orthographic", 125, -1000) if flat else ("perspective", 0.2, 1)
    return Scene(
        objects,
        Camera((10, 30, 600), (0, 0, 0), (0, 1, 0), projection, half_height, near),
        [evolve(light, shadow=k == shadow) for k, light in enumerate(lights)],
        Background((20, 40, 90), (200, 160, 90)),
        (200, 210, 255),
        False,
        WIDTH,
        HEIGHT,
        "antialias" in kinds,
        Hemisphere((90, 120, 200), (50, 30, 10)) if "hemisphere" in kinds else None,
        Rim((255, 200, 100), int(rng.integers(1, 17))) if "rim" in kinds else None,
        Fog((99, 99, 120), 500, 700) if "fog" in kinds else None,
        Tone(1.25, bool(rng.random() < 0.5), bool(rng.random() < 0.5)) if "tone" in kinds else None,
    )


SCENES = {case: scene_of(case) for case in CASES}
every_case = pytest.mark.parametrize("case", CASES)
#: For what takes long.
FEW = ("opacity", "texture", "opacities", "shadow", "ground", "all", *list(CASES)[-4:])
few_cases = pytest.mark.parametrize("case", FEW)


# ---- records, from what contracts/src/scene says of them ----

Records = dict[tuple[int, int], bytes]


def records_of(scene: Scene) -> Records:
    """The contents that the records of a scene must have, by kind and index."""
    found: dict[tuple[str, int], bytes] = {}
    for k, light in enumerate(scene.lights):
        if light.direction is not None:
            cosines = {0.0: ONE, 60.0: ONE // 2, 90.0: 0}
            numbers = [*(int(x) * ONE for x in light.direction), cosines[light.inner_angle], cosines[light.outer_angle]]
            found["spot", k] = struct.pack(">5q", *numbers)
        if light.shadow:
            solid = [o for o in scene.objects if o.cull and not o.wireframe and o.mesh.opacities is None]
            casters = [o for o in solid if o.opacity > 1 - 2.0**-25 and o.fade is None]
            closed = all(o.mesh.triangles == 2 * (len(o.mesh.positions) - 2) for o in casters)
            found["shadow", k] = words(2 if closed else 1)
    for k, o in enumerate(scene.objects):
        if o.opacity <= 1 - 2.0**-24:
            found["opacity", k] = struct.pack(">I", int(o.opacity * 2**24))
        if o.material.texture is not None:
            found["texture", k] = texture_record(o)
        if o.mesh.opacities is not None:
            found["opacities", k] = padded(bytes(round(each * 255) for each in o.mesh.opacities))
        if o.fade is not None:
            found["ground", k] = padded(struct.pack(">QQ", *(int(each * ONE) for each in o.fade)))
    if scene.antialias:
        found["antialias", 0] = b""
    if scene.hemisphere is not None:
        found["hemisphere", 0] = bytes([*scene.hemisphere.sky, *scene.hemisphere.ground])
    if scene.rim is not None:
        found["rim", 0] = bytes([*scene.rim.color, scene.rim.power])
    if scene.fog is not None:
        found["fog", 0] = bytes(scene.fog.color) + struct.pack(
            ">QQ", int(scene.fog.near * ONE), int(scene.fog.far * ONE)
        )
    if scene.tone is not None:
        flags = scene.tone.filmic + 2 * scene.tone.gamma
        found["tone", 0] = struct.pack(">IB", int(scene.tone.exposure * 65536), flags)
    return {(1 + KINDS.index(kind), k): content for (kind, k), content in found.items()}


def padded(content: bytes) -> bytes:
    return content + bytes(-len(content) % WORD)


def texture_record(o: Object) -> bytes:
    texture, uvs = o.material.texture, o.mesh.uvs
    assert texture is not None
    assert uvs is not None
    texels = [tuple(each) for row in texture.pixels.tolist() for each in row]
    palette = sorted(set(texels))
    bits = next((each for each in (1, 2, 4, 8) if len(palette) <= 1 << each), 24)
    flags = (texture.filter == "bilinear") + 2 * (texture.wrap == "clamp")
    head = bytes([flags, texture.width - 1, texture.height - 1, bits])
    image = bytes(value for texel in texels for value in texel)
    if bits < 24:
        digits = "".join(f"{palette.index(texel):0{bits}b}" for texel in texels)
        digits += "0" * (-len(digits) % 8)
        image = bytes(value for color in palette for value in color).ljust(3 << bits, b"\0")
        image += bytes(int(digits[at : at + 8], 2) for at in range(0, len(digits), 8))
    corners = b"".join(struct.pack(">i", round(x * 65536))[1:] for uv in uvs.tolist() for x in uv)
    return padded(head + image + corners)


def joined(records: Records) -> bytes:
    parts = []
    for (kind, index), content in sorted(records.items()):
        size = len(content) // (WORD if kind >= LONG else 1)
        parts.append(struct.pack(">BHH", kind, index, size) + content)
    return b"".join(parts)


def split(data: bytes) -> Records:
    """The records in bytes that are right."""
    found: Records = {}
    at = 0
    while at < len(data):
        kind, index, size = struct.unpack_from(">BHH", data, at)
        end = at + HEADER + size * (WORD if kind >= LONG else 1)
        found[kind, index] = data[at + HEADER : end]
        at = end
    return found


def extensions_in(call: bytes) -> bytes:
    """The extensions in a call of `render`: the last of the 21 words of a scene tells where they are."""
    begin = HEADER - 1 + WORD
    at = begin + int.from_bytes(call[begin + 20 * WORD :][:WORD], "big")
    return call[at + WORD :][: int.from_bytes(call[at : at + WORD], "big")]


# ---- Python and TypeScript ----


@every_case
def test_python(case: str, tmp_path: Path) -> None:
    """Writes the records that are right, reads the same scene from them, and has them in each file."""
    scene = SCENES[case]
    expected = joined(records_of(scene))
    call = render_call(scene)
    assert extensions(fit(scene)) == extensions_in(call) == expected
    again = decode(call)
    assert render_call(again) == call
    for light, other in zip(again.lights, scene.lights, strict=True):
        assert (light.kind, light.shadow) == (other.kind, other.shadow)
        assert np.array_equal(light.direction, other.direction)  # type: ignore[arg-type]
        assert (light.inner_angle, light.outer_angle) == pytest.approx((other.inner_angle, other.outer_angle))
    for name in ("antialias", "hemisphere", "rim", "fog", "tone"):
        assert getattr(again, name) == getattr(scene, name)
    for found, thing in zip(again.objects, scene.objects, strict=True):
        assert found.material.texture == thing.material.texture
        assert found.fade == thing.fade
        assert np.array_equal(found.mesh.rgba, thing.mesh.rgba)
        assert thing.material.texture is None or np.array_equal(found.mesh.uvs, thing.mesh.uvs)  # type: ignore[arg-type]
        assert found.opacity == (1 if thing.opacity == 1 - 2.0**-26 else thing.opacity)
    path = tmp_path / "scene.json"
    path.write_bytes(encode_scene_file(scene))
    assert load(path) == scene


@pytest.mark.skipif(not shutil.which("node"), reason="there is no Node")
def test_typescript(tmp_path: Path) -> None:
    """Writes the same calls, and turns nothing but the spots among the records."""
    texts = [encode_scene_file(scene).decode() for scene in SCENES.values()]
    lines: list[dict[str, Any]] = [{"text": text} for text in texts]
    lines += [{"text": text, "turn": {"azimuth": 30}} for text in texts]
    calls = answers(SCRIPT, BUNDLE, lines, tmp_path)
    sine, cosine = 0.5, 0.75**0.5
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    for case, call, turned in zip(CASES, calls[: len(CASES)], calls[len(CASES) :], strict=True):
        assert call == render_call(SCENES[case]), case
        found, expected = split(extensions_in(turned)), records_of(SCENES[case])
        assert found.keys() == expected.keys(), case
        for (kind, index), content in expected.items():
            if kind != 1:
                assert found[kind, index] == content, case
                continue
            before, after = (np.array(struct.unpack(">5q", each)) / ONE for each in (content, found[kind, index]))
            assert np.allclose(after[:3], turn @ before[:3], rtol=1e-6), case
            assert np.array_equal(after[3:], before[3:]), case


# ---- contracts ----


def model(scene: Scene, gas: int = MODEL_GAS) -> bytes:
    data = encode(artifact("GlbEncoder").selectors["encode"], scene)
    return dynamic(chain().call("GlbEncoder", data, gas).output)


def alphas(glb: bytes) -> list[float]:
    """The alpha of the material of each node."""
    document, _ = gltf_reader.split(glb)
    primitives = [document["meshes"][node["mesh"]]["primitives"][0] for node in document["nodes"]]
    surfaces = [document["materials"][each["material"]] for each in primitives]
    found = [each["pbrMetallicRoughness"].get("baseColorFactor", [1, 1, 1, 1])[3] for each in surfaces]
    assert [each.get("alphaMode") for each in surfaces] == ["BLEND" if alpha < 1 else None for alpha in found]
    return found


def opacities(scene: Scene) -> list[Any]:
    return [pytest.approx(int(o.opacity * 2**24 + 0.5) / 2**24, abs=1e-9) for o in scene.objects]


def world_corners(scene: Scene) -> Any:
    """The corners of all faces that are not wires, (n, 3, 3)."""
    corners = [o.world_positions()[o.mesh.faces] for o in scene.objects if not o.wireframe]
    return np.concatenate([np.zeros((0, 3, 3)), *corners])


@every_case
def test_models(case: str) -> None:
    """Have all objects with their opacities, whatever other records there are."""
    scene = SCENES[case]
    glb = model(scene)
    assert alphas(glb) == opacities(scene)
    found = np.array([triangle[0] for triangle in gltf_reader.read(glb)]).reshape(-1, 3, 3)
    assert np.allclose(found, world_corners(scene), atol=1e-3)
    assert glb == model(without_records(scene))


def without_records(scene: Scene) -> Scene:
    """The scene with no records but the opacities of objects."""
    objects = [
        evolve(o, mesh=evolve(o.mesh, opacities=None), material=evolve(o.material, texture=None), fade=None)
        for o in scene.objects
    ]
    lights = [Light("directional", (0, 0, 1))]
    return Scene(objects, scene.camera, lights, scene.background, width=WIDTH, height=HEIGHT)


@every_case
def test_tiles(case: str) -> None:
    scene = fit(SCENES[case])
    whole = draw(scene)
    for tile in (Rectangle(0, 0, 9, HEIGHT), Rectangle(9, 0, WIDTH - 9, 10), Rectangle(9, 10, WIDTH - 9, HEIGHT - 10)):
        part = whole[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
        assert np.array_equal(draw(scene, tile), part)


@every_case
def test_records_belong_to_their_objects(case: str) -> None:
    """Objects that are apart make the same picture in any order."""
    scene = fit(SCENES[case])
    whole = draw(scene)
    assert np.array_equal(draw(evolve(scene, objects=scene.objects[::-1])), whole)
    assert len(np.unique(whole.reshape(-1, 3), axis=0)) > HEIGHT


@pytest.mark.parametrize("case", ["shadow", "ground", "all"])
def test_numbers_of_two_bytes(case: str) -> None:
    """Objects behind 257 others, which lie outside of the picture."""
    scene = fit(SCENES[case])
    wire = Object(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), (0, 9000, 0), wireframe=True)
    many = evolve(scene, objects=[*257 * [wire], *scene.objects])
    assert np.array_equal(draw(many), draw(scene))
    of_objects = [1 + KINDS.index(kind) for kind in ("opacity", "texture", "opacities", "ground")]
    records = {(kind, index + 257 * (kind in of_objects)): c for (kind, index), c in records_of(scene).items()}
    assert extensions(many) == joined(records)
    assert alphas(model(many, 100 * MODEL_GAS))[257:] == opacities(scene)


@few_cases
def test_stored_scenes(case: str, world: World) -> None:
    """The Studio draws and models what it keeps with the values of each vertex, and adds a record where it belongs."""
    scene = fit(SCENES[case])
    for storing in store_scene(scene, world.address("Studio"), chain=world.chain):
        world.run(world.address("Studio"), storing.data, created=True)
    pointer = "0x" + storing.pointer.hex()
    assert alphas(world.call("Studio", "glb(address)", pointer, gas=PICTURE_GAS)) == opacities(scene)
    output = world.run(world.address("Studio"), call_data("scene(address)", pointer))
    stored = decode(artifact("Renderer").selectors["render"] + output)
    # vertices and faces are stored in another order
    objects = []
    for o, given in zip(stored.objects, scene.objects, strict=True):
        numbers = [given.mesh.positions.tolist().index(place) for place in o.mesh.positions.tolist()]
        uvs, levels = (each if each is None else each[numbers] for each in (given.mesh.uvs, given.mesh.opacities))
        objects.append(evolve(given, mesh=evolve(o.mesh, uvs=uvs, opacities=levels)))
    expected = evolve(scene, objects=objects)
    assert extensions_in(artifact("Renderer").selectors["render"] + output) == joined(records_of(expected))
    drawn = world.call("Studio", "render(address)", pointer)
    assert np.array_equal(decode_bmp(drawn, WIDTH, HEIGHT), draw(expected))
    changes = "(uint256,(int256,int256,int256,int256),uint256,(uint256,uint256),uint256,(uint256,uint256))"
    data = call_data(f"scene(address,{changes})", pointer, (32, (0, 0, 0, ONE), 0, (0, 0), 0, (0, 0)))
    output = world.run(world.address("Studio"), data)
    records = records_of(expected) | {(3, 0): b""}
    assert extensions_in(artifact("Renderer").selectors["render"] + output) == joined(records)


@pytest.fixture(scope="module")
def world() -> World:
    return World()


@few_cases
def test_turntables(case: str) -> None:
    """The second of two frames is the scene turned by 180 degrees, with the same records."""
    scene = fit(SCENES[case])
    spin = encode_abi(["(uint256,uint256,uint256,(int256,int256,int256),bool)"], [(2, 80, 1, (0, ONE, 0), False)])
    data = artifact("Turntable").selectors["animate"] + words(8 * WORD) + spin + encode_scene(scene)
    places = np.array([o.position for o in scene.objects])
    # the boxes of all meshes are alike
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    objects = []
    for o in scene.objects:
        x, y, z, w = o.rotation
        place = 2 * middle - o.position
        objects.append(evolve(o, position=(place[0], o.position[1], place[2]), rotation=(z, w, -x, -y)))
    film = dynamic(chain().call("Turntable", data).output)
    with PillowImage.open(io.BytesIO(film)) as file:
        first, second = (np.array(frame.convert("RGB")) for frame in ImageSequence.Iterator(file))
    assert np.array_equal(first, draw(scene))
    assert np.array_equal(second, draw(evolve(scene, objects=objects)))


@few_cases
def test_the_calls_of_engines(case: str) -> None:
    """The last of them returns the picture: after two words rows from the bottom, blue first."""
    scene = fit(SCENES[case])
    output = engine_calls(scene, chain())[-1].result.output
    pixels = np.frombuffer(output, np.uint8, 3 * WIDTH * HEIGHT, 2 * WORD).reshape(HEIGHT, WIDTH, 3)
    assert np.array_equal(pixels[::-1, :, ::-1], draw(scene))


def test_a_fade_is_about_the_position_of_its_object(tmp_path: Path) -> None:
    """Also of a mesh that is beside it, whose coordinates are rounded to a grid: by the encoders, and when stored."""
    size, inner, outer = 48, 0.75, 1.5
    square = Mesh([(-1.05, 0, -1), (-1.05, 0, 5.1), (5.03, 0, 5.1), (5.03, 0, -1)], [(0, 1, 2), (0, 2, 3)], "white")
    ground = Object(square, (0.3, 0, -0.2), material=Material("unlit"), cull=False, fade=(inner, outer))
    camera = Camera((0, 9, 0), (0, 0, 0), (0, 0, -1), "orthographic", 3)
    scene = Scene([ground], camera, [], "black", width=size, height=size)
    at = (np.arange(size) + 0.5) * 6 / size - 3
    x, z = at[None, :], at[:, None]
    distance, step = np.hypot(x - 0.3, z + 0.2), 12 / size
    covered = (x > step - 0.75) & (z > step - 1.2)
    calls = [render_call(scene), render_call(evolve(scene, objects=[quantize(ground, 9)]))]
    if shutil.which("node"):
        calls += answers(SCRIPT, BUNDLE, [{"text": encode_scene_file(scene).decode()}], tmp_path)
    for call in calls:
        pixels = decode_bmp(dynamic(chain().call("Renderer", call).output), size, size)[:, :, 0]
        assert (pixels[covered & (distance < inner - step)] > 250).all()
        assert (pixels[distance > outer + step] == 0).all()
        assert np.count_nonzero(covered & (distance < inner - step)) > 20


# ---- records that are wrong ----


def wrong(data: bytes, scene: Scene) -> str | None:
    """The error of records whose order or sizes are wrong, or of the first three kinds, which each reader checks."""
    at, least = 0, 0
    sizes, counts = {1: 40, 2: 4, 3: 0}, {1: len(scene.lights), 2: len(scene.objects), 3: 1}
    while at < len(data):
        if len(data) - at < HEADER:
            return f"ExtensionCutOff(position={at})"
        kind, index, size = struct.unpack_from(">BHH", data, at)
        size *= WORD if kind >= LONG else 1
        if len(data) - at - HEADER < size:
            return f"ExtensionCutOff(position={at})"
        if kind << 16 | index < least:
            return f"ExtensionOrder(kind={kind}, index={index})"
        least = (kind << 16 | index) + 1
        if kind == 0:
            return f"UnknownExtension(kind=0, index={index})"
        if kind in sizes and size != sizes[kind]:
            return f"ExtensionSize(kind={kind}, index={index}"
        if kind in sizes and index >= counts[kind]:
            return f"ExtensionIndex(kind={kind}, index={index}"
        if kind == 1 and scene.lights[index].kind == "directional":
            return f"SpotIsNoPoint(light={index})"
        at += HEADER + size
    return None


def damaged(seed: int) -> bytes:
    """The records of the scene with all kinds, of which the end is missing, or a byte of a header is another one."""
    rng, records = np.random.default_rng(seed), records_of(SCENES["all"])
    data = joined(records)
    if seed % 4 == 0:
        return data[: rng.integers(1, len(data))]
    starts = [len(joined(dict(sorted(records.items())[:k]))) for k in range(len(records))]
    at = starts[rng.integers(len(starts))] + int(rng.integers(HEADER))
    return data[:at] + bytes([int(rng.choice([0, 1, 2, 7, 8, 12, 255, data[at] ^ 1]))]) + data[at + 1 :]


@pytest.mark.parametrize("seed", range(30))
def test_damaged_records(seed: int) -> None:
    """Each reader comes to an end, and says of what it checks where it is wrong."""
    scene, data = fit(SCENES["all"]), damaged(seed)
    struct_ = encode_scene(scene)
    right = joined(records_of(scene))
    end = len(struct_) - len(padded(right)) - WORD
    arguments = words(WORD) + struct_[:end] + words(len(data)) + padded(data)
    error = wrong(data, scene)
    for contract, function, gas in (("GlbEncoder", "encode", MODEL_GAS), ("Renderer", "render", PICTURE_GAS)):
        found = ""
        try:
            chain().call(contract, artifact(contract).selectors[function] + arguments, gas)
        except RenderError as refused:
            found = str(refused)
        if error is None:
            # the Renderer checks the records of effects, too
            assert not found or contract == "Renderer"
        else:
            assert error in found
    try:
        again = decode(artifact("Renderer").selectors["render"] + arguments)
        assert extensions(fit(again)) == data
    except InputError:
        assert data != right
