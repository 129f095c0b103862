"""The encoder of the TypeScript package gives the bytes of Python's."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import ImageColor

import shackled
from judge import random_scene
from node_scripts import answers, bundled, needs_web
from original_scenes import document as original_document
from original_scenes import documents as original_documents
from pictures import chain, dynamic
from random_scenes import random_case
from shackled import Fog, Ground, InputError, Light, Mesh, Object, Rim, Scene, Tone, load
from shackled.artifacts import artifact
from shackled.datasets import pieces
from shackled.image import decode_bmp
from shackled.scene import Hemisphere, Rectangle, decode, encode, encode_scene_file, render_call
from shackled.scene._arithmetic import from_axis_angle, multiply
from shackled.scene._files.original import original_scene
from shackled.scene._turning import turn

SCRIPT = Path(__file__).with_name("calls.mjs")
BUNDLE = files("shackled") / "web" / "shackled.js"
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
RANDOM = 400
DOCUMENTS = 150

pytestmark = pytest.mark.skipif(not shutil.which("node"), reason="there is no Node")


def made(lines: Sequence[dict[str, Any]], folder: Path) -> list[bytes]:
    """The calls that TypeScript makes, or what it says instead."""
    found = answers(SCRIPT, BUNDLE, lines, folder)
    assert len(found) == len(lines)
    return found


class Calls:
    """Scene files, and the calls that Python makes of them."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.lines: list[dict[str, Any]] = []
        self.expected: list[bytes] = []

    def add(self, name: str, text: str, scene: Scene, function: str = "render", tile: Rectangle | None = None) -> None:
        self.names.append(name)
        self.lines.append({"name": function, "text": text} | ({"tile": vars(tile)} if tile else {}))
        self.expected.append(encode(artifact("Renderer").selectors[function], scene, tile))

    def differences(self, folder: Path) -> list[str]:
        """The names of those of which TypeScript makes other calls, with what it says."""
        calls = zip(self.names, made(self.lines, folder), self.expected, strict=True)
        return [f"{name}: {difference(call, expected)}" for name, call, expected in calls if call != expected]


def difference(call: bytes, expected: bytes) -> str:
    if len(call) != len(expected):
        return call[:200].decode(errors="replace") if call[:4] != expected[:4] else f"{len(call)}, not {len(expected)}"
    bad = [place for place in range(len(call)) if call[place] != expected[place]]
    return f"{len(bad)} bytes, from {bad[0]}"


def test_built_in_scenes(tmp_path: Path) -> None:
    calls = Calls()
    chosen = [piece for piece in pieces() if piece.ready() and piece.dataset != "genesis"]
    chosen += [piece for piece in pieces() if piece.dataset == "genesis"][::25]
    assert len(chosen) > 70
    for piece in chosen:
        scene = piece.make()
        calls.add(piece.name, encode_scene_file(scene).decode(), scene)
    assert calls.differences(tmp_path) == []


def test_the_scene_of_the_examples(tmp_path: Path) -> None:
    subprocess.run([sys.executable, EXAMPLES / "meshes.py", "--into", tmp_path / "meshes"], check=True)
    scene = load(shutil.copy(EXAMPLES / "scene.toml", tmp_path))
    calls = Calls()
    calls.add("scene.toml", encode_scene_file(scene).decode(), scene)
    for mesh in sorted((tmp_path / "meshes").glob("*.obj")):
        scene = load(mesh, max_triangles=500, smooth=True)
        calls.add(mesh.name, encode_scene_file(scene).decode(), scene)
    assert len(calls.names) > 3
    assert calls.differences(tmp_path) == []


def test_random_scenes(tmp_path: Path) -> None:
    calls = Calls()
    for seed in range(RANDOM):
        case = random_case(seed)
        scene = case.scene if seed % 3 == 0 else changed(case.scene, np.random.default_rng([seed, 2]))
        text = encode_scene_file(scene).decode()
        if seed % 2:
            calls.add(
                f"seed {seed}", text, scene, ("render", "renderCounted", "renderSVG", "renderDataURI")[seed // 2 % 4]
            )
        else:
            calls.add(f"seed {seed}", text, scene, ("renderTile", "renderTileCounted")[seed // 2 % 2], case.tile)
    assert calls.differences(tmp_path) == []


def test_decoded_scenes(tmp_path: Path) -> None:
    """Scenes from PNG files, which nothing rescales, however far they reach."""
    calls = Calls()
    for seed in range(DOCUMENTS):
        scene = changed(random_case(seed).scene, np.random.default_rng([seed, 2]))
        lights = [*scene.lights[:3], Light.point((1e30, 2e30, 3e30))]
        scene = decode(render_call(evolve(scene, lights=lights)))
        calls.add(f"seed {seed}", encode_scene_file(scene).decode(), scene)
    assert calls.differences(tmp_path) == []


@needs_web
def test_decoded_calls(tmp_path: Path) -> None:
    """Calls are decoded to scenes of which the same calls are made; others are refused."""
    calls: list[bytes] = []
    wrong: list[bytearray] = []
    grounds: list[Ground | None] = []
    for seed in range(RANDOM):
        rng = np.random.default_rng([seed, 3])
        scene = random_scene("shadows", seed) if seed % 4 == 0 else changed(random_case(seed).scene, rng)
        if seed % 8 == 0:
            others = [each for each in scene.objects if each.fade is None]
            scene = evolve(scene, objects=others, ground=Ground("tan", *(None, 2.5)[: rng.integers(3)]))
        calls.append(render_call(scene))
        grounds.append(decode(calls[-1]).ground)
        wrong.append(bytearray(calls[-1]))
        for place in rng.integers(0, len(calls[-1]), rng.integers(1, 4)):
            wrong[-1][place] = rng.integers(256)
    bundle = bundled(tmp_path, "scene/decode", "scene/encode")
    lines = [{"call": base64.b64encode(bytes(call)).decode()} for call in (*calls, *wrong)]
    found = answers(SCRIPT, bundle, [*lines, *({**line, "ground": True} for line in lines[: len(calls)])], tmp_path)
    assert [number for number, call in enumerate(calls) if found[number] != call] == []
    assert grounds.count(None) not in (0, len(grounds))
    for ground, text in zip(grounds, found[2 * len(calls) :], strict=True):
        values = json.loads(text)
        assert (values is None) == (ground is None)
        if ground is not None:
            assert (values["height"], values["radius"], values.get("inner")) == (
                ground.height,
                ground.radius,
                ground.inner,
            )
            assert (tuple(values["center"]), tuple(values["color"])) == (ground.center, ground.color)
    refused = 0
    for call, again in zip(wrong, found[len(calls) : 2 * len(calls)], strict=True):
        refused += again.startswith(b"InputError: ")
        assert again == call or again.startswith(b"InputError: ")
        try:
            decode(bytes(call))
        except InputError:
            assert again != call
        else:
            assert again == call
    assert refused > RANDOM / 4


def changed(scene: Scene, rng: np.random.Generator) -> Scene:
    """The scene with numbers that the contracts do not take as they are."""
    factor = 10.0 ** rng.uniform(-12, 12)
    camera = scene.camera
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
        antialias=bool(rng.random() < 0.5),
        **effects(rng, factor),
        objects=objects,
        camera=evolve(
            camera,
            eye=camera.eye * factor,
            target=camera.target * factor,
            up=camera.up * 10.0 ** rng.uniform(-12, 12),
            near=None if rng.random() < 0.5 else abs(camera.near or 1) * factor,
            half_height=camera.half_height * (1 if camera.projection == "perspective" else factor),
        ),
        lights=[cone(evolve(light, vector=light.vector * factor), rng) for light in scene.lights],
    )


def effects(rng: np.random.Generator, factor: float) -> dict[str, Any]:
    """Some effects of a scene. factor: of its lengths."""
    near = float(rng.choice([0.0, rng.uniform(0, 3000)]))
    fog = Fog(rng.integers(0, 256, 3), near * factor, (near + 10.0 ** rng.uniform(-9, 4)) * factor)
    exposure = float(rng.choice([0, 64, rng.uniform(0, 4)]))
    return some(
        rng,
        hemisphere=Hemisphere(*rng.integers(0, 256, (2, 3))),
        rim=Rim(rng.integers(0, 256, 3), int(rng.integers(1, 17))),
        fog=fog,
        tone=Tone(exposure, bool(rng.random() < 0.5), bool(rng.random() < 0.5)),
    )


def cone(light: Light, rng: np.random.Generator) -> Light:
    if light.kind != "spot":
        return light
    return evolve(light, inner_angle=rng.uniform(0, 60), outer_angle=rng.uniform(60, 180))


def test_scene_files(tmp_path: Path) -> None:
    calls = Calls()
    for seed, document in zip(range(DOCUMENTS), documents(), strict=False):
        path = tmp_path / "scene.json"
        path.write_text(json.dumps(document))
        calls.add(f"document {seed}", path.read_text(), load(path))
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
    assert made(lines, tmp_path) == expected


@pytest.mark.parametrize(("azimuth", "elevation"), [(30, 0), (-140, 20), (0, -45)])
def test_turned_calls(tmp_path: Path, azimuth: float, elevation: float) -> None:
    """A viewer who goes around objects sees what one sees who turns them the other way."""
    scene = load("teapot", size=96)
    scene = evolve(scene, lights=[*scene.lights, Light.spot((2, 2, 2), (-1, -1, -1), "orange", 10, 40)])
    line = {
        "name": "render",
        "text": encode_scene_file(scene).decode(),
        "turn": {"azimuth": azimuth, "elevation": elevation},
    }
    (call,) = made([line], tmp_path)
    found = decode_bmp(dynamic(chain().call("Renderer", call).output), 96, 96)
    right = np.cross(scene.camera.target - scene.camera.eye, scene.camera.up)
    way = multiply(from_axis_angle(right, elevation), from_axis_angle((0, 1, 0), -azimuth))
    expected = shackled.render(turn(scene, way)).pixels
    assert np.abs(found.astype(int) - expected).mean() < 0.05


def test_scenes_of_the_original(tmp_path: Path) -> None:
    calls = Calls()
    for name, document in original_documents().items():
        calls.add(name, json.dumps(document), original_scene(document))
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
        calls.add(f"light {number}", json.dumps(document), original_scene(document))
    assert calls.differences(tmp_path) == []


WRONG: tuple[dict[str, Any], ...] = (
    {"zzz": 1},
    {"camera": {"zzz": 1}},
    {"background": {"zzz": 1}},
    {"lights": [{"kind": "point", "zzz": 1}]},
    {"hemisphere": {"zzz": 1}},
    {"rim": {"zzz": 1}},
    {"fog": {"zzz": 1}},
    {"tone": {"zzz": 1}},
    {"ground": {"zzz": 1}},
    {"objects": [{"zzz": 1}]},
    {"objects": [{"mesh": {"zzz": 1}}]},
    {"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 0]]}, "material": {"zzz": 1}}]},
    {"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 0]]}, "rotation": {"zzz": 1}}]},
)


def test_the_keys_of_scene_files(tmp_path: Path) -> None:
    """Both read the same keys, and name them where one is unknown."""
    said = made([{"text": json.dumps(document)} for document in WRONG], tmp_path)
    for document, found in zip(WRONG, said, strict=True):
        path = tmp_path / "scene.json"
        path.write_text(json.dumps(document))
        with pytest.raises(InputError, match="unknown key 'zzz'") as error:
            load(path)
        place, keys = str(error.value).split("unknown key 'zzz'")[1].split("; known are ")
        text = found.decode().split("\n")[0].removeprefix('InputError: unknown key "zzz"')
        assert text.startswith(f"{place}; known are ")
        # mesh files, of which an axis points up, are not read there
        assert {*text.split("; known are ")[1].split(", ")} == {*keys.split(", ")} - {"up_axis"}


def documents() -> Iterator[dict[str, Any]]:
    """Scene files with the keys that `Scene.save` does not write, some of them at random."""
    rng = np.random.default_rng(5)
    while True:
        yield some(
            rng,
            size=rng.integers(1, 2049, 2).tolist() if rng.random() < 0.5 else int(rng.integers(1, 2049)),
            background=color(rng) if rng.random() < 0.5 else some(rng, top=color(rng), bottom=color(rng)),
            invert=bool(rng.random() < 0.5),
            antialias=bool(rng.random() < 0.5),
            ambient_light=color(rng),
            hemisphere={"sky": color(rng)} | some(rng, ground=color(rng)),
            rim={"color": color(rng)} | some(rng, power=int(rng.integers(1, 17))),
            fog={"color": color(rng), "near": (near := rng.uniform(0, 9)), "far": near + rng.uniform(0.01, 9)},
            tone=some(
                rng,
                exposure=one(rng, [0, 3, rng.uniform(0, 64)]),
                filmic=bool(rng.random() < 0.5),
                gamma=bool(rng.random() < 0.5),
            ),
            camera=camera(rng),
            lights=[light(rng) for _ in range(rng.integers(5))],
        ) | {"objects": [thing(rng) for _ in range(rng.integers(4))]}


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
    orthographic = rng.random() < 0.3
    keys: dict[str, Any] = {"projection": "orthographic"} if orthographic else some(rng, projection="perspective")
    if not orthographic and rng.random() < 0.4:
        keys |= {"fov": rng.uniform(0.2, 179.8)}
    elif rng.random() < 0.5:
        keys |= {"half_height": rng.uniform(0.1, 10)}
    if rng.random() < 0.5 and (not orthographic or "half_height" in keys):
        keys |= {name: rng.normal(size=3).tolist() for name in ("eye", "target")} | some(
            rng, up=rng.normal(size=3).tolist()
        )
    else:
        keys |= some(
            rng,
            azimuth=one(rng, [rng.uniform(-1000, 1000), int(rng.integers(-12, 12)) * 30]),
            elevation=one(rng, [rng.uniform(-90, 90), int(rng.integers(-3, 4)) * 30]),
            margin=rng.uniform(0, 0.9),
        )
    return keys | ({"near": rng.uniform(0.001, 1)} if rng.random() < 0.2 else {})


def light(rng: np.random.Generator) -> dict[str, Any]:
    kind = one(rng, ["directional", "point", "spot"])
    vectors = {"directional": ["direction"], "point": ["position"], "spot": ["position", "direction"]}[kind]
    keys = {"kind": kind} | {name: rng.normal(size=3).tolist() for name in vectors} | some(rng, color=color(rng))
    if kind == "spot":
        keys |= some(rng, inner_angle=round(rng.uniform(0, 45), 2), outer_angle=round(rng.uniform(45, 180), 2))
    return keys


def thing(rng: np.random.Generator) -> dict[str, Any]:
    count, faces = int(rng.integers(3, 20)), int(rng.integers(1, 30))
    mesh = {"positions": rng.normal(size=(count, 3)).tolist(), "faces": rng.integers(0, count, (faces, 3)).tolist()}
    mesh |= some(rng, colors=rng.integers(0, 256, (count, 3)).tolist(), normals=rng.normal(size=(count, 3)).tolist())
    angle = one(rng, [rng.uniform(-1000, 1000), int(rng.integers(-12, 12)) * 90])
    rotations = (
        (rng.integers(-8, 9, 3) * 45).tolist(),
        rng.uniform(-400, 400, 3).tolist(),
        {"axis": rng.normal(size=3).tolist(), "angle": angle},
        {"quaternion": rng.normal(size=4).tolist()},
    )
    return {"mesh": mesh} | some(
        rng,
        position=rng.normal(size=3).tolist(),
        rotation=one(rng, rotations),
        scale=rng.uniform(0, 3),
        color=color(rng),
        cull=bool(rng.random() < 0.5),
        wireframe=bool(rng.random() < 0.5),
        opacity=rng.uniform(0, 1),
        material=some(
            rng,
            shading=one(rng, ["unlit", "flat", "smooth", "smooth"]),
            ambient=rng.uniform(0, 4),
            diffuse=rng.uniform(0, 4),
            specular=rng.uniform(0, 4),
            shininess=one(rng, [int(rng.integers(1, 129)), float(rng.integers(1, 129))]),
        ),
    )


def test_shadows_and_grounds(tmp_path: Path) -> None:
    calls = Calls()
    for seed in range(40):
        scene = evolve(random_scene("shadows", seed), width=32, height=32)
        calls.add(f"shadows {seed}", encode_scene_file(scene).decode(), scene)
        color = tuple(np.random.default_rng(seed).integers(0, 256, 3).tolist())
        kinds: list[dict[str, Any]] = [{}, {"height": -1.5, "radius": 7}, {"center": (1 / 3, -2), "inner": 0.01}]
        ground = Ground(color, **kinds[seed % 3])
        scene = evolve(scene, objects=[each for each in scene.objects if each.fade is None], ground=ground)
        calls.add(f"ground {seed}", encode_scene_file(scene).decode(), scene)
        scene = decode(render_call(scene))
        assert scene.ground is not None
        calls.add(f"decoded ground {seed}", encode_scene_file(scene).decode(), scene)
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
            place: dict[str, Any] = {
                "position": rng.normal(size=3) * 3,
                "rotation": rng.normal(size=4),
                "scale": rng.uniform(0.1, 2),
            }
            inside_out = slice(None, None, -1 if rng.random() < 0.2 else 1)
            half = rng.integers(2, 11) if rng.random() < 0.4 else 12
            parts = [triangles[:half], triangles[half:]][: rng.integers(1, 3)]
            objects += [Object(Mesh(corners * thin, part[:, inside_out]), **place) for part in parts if len(part)]
        scene = Scene(objects, lights=[evolve(Light.directional(toward=(1, 2, 3)), shadow=True)], width=32, height=32)
        calls.add(f"casters {number}", encode_scene_file(scene).decode(), scene)
    rules = {int.from_bytes(call[-32:], "big") for call in calls.expected}
    assert len(rules) == 2
    assert calls.differences(tmp_path) == []
