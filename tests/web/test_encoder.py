"""The encoder of the TypeScript package gives the bytes of Python's."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import ImageColor

import shackled
from node_scripts import bundled, calls_made, needs_node, needs_web
from original_scenes import document as original_document
from original_scenes import documents as original_documents
from pictures import chain, dynamic
from random_scenes import random_case, random_scene
from shackled import Ground, InputError, Light, Mesh, Object, Scene, load
from shackled.artifacts import artifact
from shackled.datasets import pieces
from shackled.image import decode_bmp
from shackled.scene import decode, encode
from shackled.scene._arithmetic import from_axis_angle, multiply
from shackled.scene._codec import Rectangle, render_call
from shackled.scene._files.original import original_scene
from shackled.scene._turning import turn

RANDOM = 400
DOCUMENTS = 150

pytestmark = needs_node


class Calls:
    """Scene files, and the calls that Python makes of them."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.lines: list[dict[str, Any]] = []
        self.expected: list[bytes] = []

    def add(
        self, name: str, scene: Scene, function: str = "render", tile: Rectangle | None = None, text: str = ""
    ) -> None:
        """text: the file, if it is not as `Scene.save` writes it."""
        self.names.append(name)
        text = text or scene.encode().decode()
        self.lines.append({"name": function, "text": text} | ({"tile": tile._asdict()} if tile else {}))
        self.expected.append(encode(artifact("Renderer").selectors[function], scene, tile))

    def differences(self, folder: Path) -> list[str]:
        """The names of those of which TypeScript makes other calls, with what it says."""
        calls = zip(self.names, calls_made(self.lines, folder), self.expected, strict=True)
        return [f"{name}: {difference(call, expected)}" for name, call, expected in calls if call != expected]


def difference(call: Any, expected: bytes) -> str:
    if isinstance(call, str) or len(call) != len(expected):
        return call[:200] if isinstance(call, str) else f"{len(call)}, not {len(expected)}"
    bad = [place for place in range(len(call)) if call[place] != expected[place]]
    return f"{len(bad)} bytes, from {bad[0]}"


def test_built_in_scenes(tmp_path: Path) -> None:
    calls = Calls()
    chosen = [piece for piece in pieces() if piece.ready() and piece.dataset != "genesis"]
    chosen += [piece for piece in pieces() if piece.dataset == "genesis"][::25]
    assert len(chosen) > 70
    for piece in chosen:
        calls.add(piece.name, piece.make())
    assert calls.differences(tmp_path) == []


def test_random_scenes(tmp_path: Path) -> None:
    calls = Calls()
    of_tiles, others = ("renderTile", "renderTileCounted"), ("render", "renderCounted", "renderSVG", "renderDataURI")
    for seed in range(RANDOM):
        case = random_case(seed)
        scene = case.scene if seed % 3 == 0 else changed(case.scene, np.random.default_rng([seed, 2]))
        if seed % 2:
            calls.add(f"seed {seed}", scene, others[seed // 2 % 4])
        else:
            calls.add(f"seed {seed}", scene, of_tiles[seed // 2 % 2], case.tile)
        if seed < DOCUMENTS:
            # from a PNG file: nothing rescales it, however far it reaches
            lights = [*scene.lights[:3], Light.point((1e30, 2e30, 3e30))]
            calls.add(f"decoded {seed}", decode(render_call(evolve(scene, lights=lights))))
    assert calls.differences(tmp_path) == []


@needs_web
def test_decoded_calls(tmp_path: Path) -> None:
    """Calls are decoded to scenes of which the same calls are made; others are refused."""
    calls: list[bytes] = []
    wrong: list[bytes] = []
    for seed in range(RANDOM):
        rng = np.random.default_rng([seed, 3])
        calls.append(
            render_call(random_scene("shadows", seed) if seed % 4 == 0 else changed(random_case(seed).scene, rng))
        )
        broken = bytearray(calls[-1])
        for place in rng.integers(0, len(broken), rng.integers(1, 4)):
            broken[place] = rng.integers(256)
        wrong.append(bytes(broken))
    lines = [{"call": call.hex()} for call in (*calls, *wrong)]
    found = calls_made(lines, tmp_path, bundled(tmp_path, "scene/decode", "scene/encode"))
    assert [number for number, call in enumerate(calls) if found[number] != call] == []
    refused = 0
    for call, again in zip(wrong, found[len(calls) :], strict=True):
        if isinstance(again, str) and again.startswith("InputError: "):
            refused += 1
            with pytest.raises(InputError):
                decode(call)
        else:
            assert again == call
            decode(call)
    assert refused > RANDOM / 4


def changed(scene: Scene, rng: np.random.Generator) -> Scene:
    """The scene with numbers that the contracts do not take as they are."""
    factor, camera, fog = 10.0 ** rng.uniform(-12, 12), scene.camera, scene.fog
    objects = [
        evolve(
            o,
            mesh=evolve(o.mesh, positions=o.mesh.positions * (own := rng.uniform(0.001, 3)) + rng.normal(size=3)),
            position=o.position * factor,
            scale=o.scale * factor / own,
            rotation=rng.normal(size=4) * 10.0 ** rng.uniform(-12, 12),
            opacity=rng.choice([o.opacity, rng.uniform()]),
        )
        for o in scene.objects
    ]
    return evolve(
        scene,
        fog=fog and evolve(fog, near=fog.near * factor, far=fog.far * factor),
        objects=objects,
        camera=evolve(
            camera,
            eye=camera.eye * factor,
            target=camera.target * factor,
            up=camera.up * 10.0 ** rng.uniform(-12, 12),
            near=None if rng.random() < 0.5 else abs(camera.near or 1) * factor,
            half_height=camera.half_height * (1 if camera.projection == "perspective" else factor),
        ),
        lights=[evolve(light, vector=light.vector * factor) for light in scene.lights],
    )


def test_scene_files(tmp_path: Path) -> None:
    calls = Calls()
    for seed in range(DOCUMENTS):
        document = json.loads(random_case(seed).scene.encode())
        path = tmp_path / "scene.json"
        path.write_text(json.dumps(in_other_words(document, np.random.default_rng([seed, 5]))))
        calls.add(f"document {seed}", load(path), text=path.read_text())
    assert calls.differences(tmp_path) == []


def test_staged_scenes(tmp_path: Path) -> None:
    """Scenes of meshes only, of any size."""
    rng = np.random.default_rng(6)
    lines, expected = [], []
    for _ in range(50):
        count, size = int(rng.integers(3, 9)), 10.0 ** rng.uniform(-20, 20)
        positions, faces = size * rng.normal(size=(count, 3)), rng.integers(0, count, (int(rng.integers(1, 9)), 3))
        rotation, width = rng.uniform(-180, 180, 3), int(rng.integers(1, 300))
        mesh = {"positions": positions.ravel().tolist(), "faces": faces.tolist(), "colors": "tomato"}
        lines.append({"scene": {"objects": [{"mesh": mesh, "rotation": rotation.tolist()}], "width": width}})
        scene = Scene(Object(Mesh(positions, faces, "tomato"), rotation=rotation), width=width)
        expected.append(encode(artifact("Renderer").selectors["render"], scene))
    assert calls_made(lines, tmp_path) == expected


@pytest.mark.parametrize(("azimuth", "elevation"), [(30, 0), (-140, 20), (0, -45)])
def test_turned_calls(tmp_path: Path, azimuth: float, elevation: float) -> None:
    """A viewer who goes around objects sees what one sees who turns them the other way."""
    scene = load("teapot", size=96)
    scene = evolve(scene, lights=[*scene.lights, Light.spot((2, 2, 2), (-1, -1, -1), "orange", 10, 40)])
    turned = {"azimuth": azimuth, "elevation": elevation}
    (call,) = calls_made([{"name": "render", "text": scene.encode().decode(), "turn": turned}], tmp_path)
    found = decode_bmp(dynamic(chain().call("Renderer", call).output), 96, 96)
    right = np.cross(scene.camera.target - scene.camera.eye, scene.camera.up)
    way = multiply(from_axis_angle(right, elevation), from_axis_angle((0, 1, 0), -azimuth))
    expected = shackled.render(turn(scene, way)).pixels
    assert np.abs(found.astype(int) - expected).mean() < 0.05


def test_scenes_of_the_original(tmp_path: Path) -> None:
    calls = Calls()
    for name, document in original_documents().items():
        calls.add(name, original_scene(document), text=json.dumps(document))
    rng = np.random.default_rng(7)
    for number in range(200):
        light = some(
            rng,
            lightPos=(rng.normal(size=3) * 50).tolist(),
            lightDiffPower=rng.uniform(0, 9000),
            lightSpecPower=rng.uniform(-1000, 9000),
            inverseShininess=rng.uniform(-5, 200),
            lightColDiff=rng.uniform(0, 300, 3).tolist(),
            lightColSpec=rng.integers(0, 256, 3).tolist(),
        )
        changes = some(rng, objScale=rng.normal(), rotation=rng.uniform(-360, 360, 3).tolist(), perspCamera=False)
        document = original_document(light={"lightPos": [9, 9, 9]} | light, **changes)
        calls.add(f"light {number}", original_scene(document), text=json.dumps(document))
    assert calls.differences(tmp_path) == []


POINT = {"positions": [[0, 0, 0]], "faces": [[0, 0, 0]]}
WRONG: tuple[dict[str, Any], ...] = (
    {"zzz": 1},
    *({name: {"zzz": 1}} for name in ("camera", "background", "hemisphere", "rim", "fog", "tone", "ground")),
    {"lights": [{"kind": "point", "zzz": 1}]},
    {"objects": [{"zzz": 1}]},
    {"objects": [{"mesh": {"zzz": 1}}]},
    *({"objects": [{"mesh": POINT, name: {"zzz": 1}}]} for name in ("material", "rotation")),
)


def test_the_keys_of_scene_files(tmp_path: Path) -> None:
    """Both read the same keys, and name them where one is unknown."""
    said = calls_made([{"text": json.dumps(document)} for document in WRONG], tmp_path)
    for document, found in zip(WRONG, said, strict=True):
        path = tmp_path / "scene.json"
        path.write_text(json.dumps(document))
        with pytest.raises(InputError, match="unknown key 'zzz'") as error:
            load(path)
        place, keys = str(error.value).split("unknown key 'zzz'")[1].split("; known are ")
        text = str(found).split("\n")[0].removeprefix('InputError: unknown key "zzz"')
        assert text.startswith(f"{place}; known are ")
        # mesh files, of which an axis points up, are not read there; the keys of all kinds of lights are named there
        spot = {"direction", "inner_angle", "outer_angle"}
        assert {*text.split("; known are ")[1].split(", ")} - spot == {*keys.split(", ")} - spot - {"up_axis"}


#: Keys that may be left out, and keys of colours.
OPTIONAL = {
    *("size", "background", "invert", "antialias", "ambient_light", "hemisphere", "rim", "fog", "tone", "lights"),
    *("top", "bottom", "ground", "power", "exposure", "filmic", "gamma", "shadow", "position", "rotation", "scale"),
    *("cull", "two_sided", "wireframe", "opacity", "normals", "shading", "ambient", "diffuse", "specular", "shininess"),
}
COLORS = {"background", "top", "bottom", "ambient_light", "sky", "ground", "color"}


def in_other_words(value: Any, rng: np.random.Generator, key: str = "") -> Any:
    """What a scene file has at a key of a table, as people write it: some keys left out, others in another form."""
    if key in COLORS and (key != "background" or rng.random() < 0.5):
        return color(rng)
    if key == "size" and rng.random() < 0.5:
        return int(rng.integers(1, 2049))
    if key == "camera":
        return camera(rng)
    if key == "rotation":
        angle = one(rng, [rng.uniform(-1000, 1000), int(rng.integers(-12, 12)) * 90])
        axis = {"axis": rng.normal(size=3).tolist(), "angle": angle}
        return one(rng, [(rng.integers(-8, 9, 3) * 45).tolist(), rng.uniform(-400, 400, 3).tolist(), axis, value])
    if isinstance(value, dict):
        kept = [name for name in value if name not in OPTIONAL or key == "lights" or rng.random() < 0.6]
        return {name: in_other_words(value[name], rng, name) for name in kept}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [in_other_words(each, rng, key) for each in value]
    return value


def some(rng: np.random.Generator, **keys: Any) -> dict[str, Any]:
    return {name: value for name, value in keys.items() if rng.random() < 0.6}


def one(rng: np.random.Generator, choices: Sequence[Any]) -> Any:
    return choices[int(rng.integers(len(choices)))]


def color(rng: np.random.Generator) -> Any:
    choices: list[Callable[[], Any]] = [
        lambda: rng.integers(0, 256, 3).tolist(),
        lambda: rng.uniform(0, 1, 3).tolist(),
        lambda: rng.integers(0, 2, 3).tolist(),
        lambda: rng.integers(0, 2, 3).astype(float).tolist(),
        lambda: [1, 0.0, int(rng.integers(2))],
        lambda: f"#{rng.integers(1 << 24):06X}",
        lambda: f"#{rng.integers(1 << 12):03x}",
        lambda: f"#{rng.integers(1 << 24):06x}FF",
        lambda: one(rng, [*ImageColor.colormap]),
    ]
    return one(rng, choices)()


def camera(rng: np.random.Generator) -> dict[str, Any]:
    eye, target, up = rng.normal(size=(3, 3)).tolist()
    azimuth = one(rng, [rng.uniform(-1000, 1000), int(rng.integers(-12, 12)) * 30])
    elevation = one(rng, [rng.uniform(-90, 90), int(rng.integers(-3, 4)) * 30])
    lens: dict[str, Any] = one(rng, [{}, {"fov": rng.uniform(0.2, 179.8)}, {"half_height": rng.uniform(0.1, 10)}])
    if rng.random() < 0.5:
        place = some(rng, azimuth=azimuth, elevation=elevation, margin=rng.uniform(0, 0.9))
    else:
        place = {"eye": eye, "target": target} | some(rng, up=up)
    if "fov" not in lens and ("half_height" in lens or "eye" not in place):
        lens |= some(rng, projection=one(rng, ["orthographic", "perspective"]))
    return lens | place | ({"near": rng.uniform(0.001, 1)} if rng.random() < 0.2 else {})


def test_shadows_and_grounds(tmp_path: Path) -> None:
    calls = Calls()
    kinds: list[dict[str, Any]] = [{}, {"height": -1.5, "radius": 7}, {"center": (1 / 3, -2), "inner": 0.01}]
    for seed in range(40):
        scene = evolve(random_scene("shadows", seed), width=32, height=32)
        calls.add(f"shadows {seed}", scene)
        ground = Ground(np.random.default_rng(seed).integers(0, 256, 3), **kinds[seed % 3])
        scene = evolve(scene, objects=[each for each in scene.objects if each.fade is None], ground=ground)
        calls.add(f"ground {seed}", scene)
        scene = decode(render_call(scene))
        assert scene.ground is not None
        calls.add(f"decoded ground {seed}", scene)
    assert calls.differences(tmp_path) == []


def test_what_casts_shadows(tmp_path: Path) -> None:
    """Closed or not, thick or as thin as rounding, once or twice at one place, of two halves."""
    calls, rng = Calls(), np.random.default_rng(8)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
    faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    triangles = np.concatenate([faces[:, :3], faces[:, [0, 2, 3]]])
    for number in range(120):
        objects = []
        for _ in range(int(rng.integers(1, 4))):
            thin = rng.choice([1, 1, 10.0 ** rng.uniform(-7, -2)], 3)
            position, rotation, scale = rng.normal(size=3) * 3, rng.normal(size=4), rng.uniform(0.1, 2)
            inside_out = slice(None, None, -1 if rng.random() < 0.2 else 1)
            half = rng.integers(2, 11) if rng.random() < 0.4 else 12
            parts = [triangles[:half], triangles[half:]][: rng.integers(1, 3)]
            objects += [
                Object(Mesh(corners * thin, part[:, inside_out]), position, rotation, scale)
                for part in parts
                if len(part)
            ]
        scene = Scene(objects, lights=[evolve(Light.directional(toward=(1, 2, 3)), shadow=True)], width=32, height=32)
        calls.add(f"casters {number}", scene)
    rules = {int.from_bytes(call[-32:], "big") for call in calls.expected}
    assert len(rules) == 2
    assert calls.differences(tmp_path) == []
