"""Small files of each kind, read by the page and by Python: the same triangles, places, colours and kinds of notes.

What may differ is in ACCEPTED, with the reason.
"""

from __future__ import annotations

import json
import re
import runpy
import subprocess
import warnings
from collections import defaultdict
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import shackled
from node_scripts import WEB, needs_web

pytestmark = needs_web

MAKERS = Path(__file__).parents[1] / "scene" / "files"
OTHERS = runpy.run_path(str(MAKERS / "test_corpus.py"))["FILES"]
KINDS = runpy.run_path(str(MAKERS / "test_gltf_kinds.py"))
POINTS, File = KINDS["POINTS"], KINDS["File"]

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
UVS = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
#: OBJ files, and materials that they name.
OBJ = {
    "plain": f"{SQUARE}f 1 2 3 4\n",
    "backward": f"{SQUARE}f -4 -3 -2 -1\n",
    "l-shape": "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 6 1 2 3 4 5\n",
    "colours": re.sub(r"(v.*)\n", r"\1 1 0.5 0\n", SQUARE) + "f 1 2 3 4\n",
    "bytes": re.sub(r"(v.*)\n", r"\1 255 128 0\n", SQUARE) + "f 1 2 3 4\n",
    "some-colours": f"{SQUARE}v 2 2 0 1 0 0\nf 1 2 3\nf 3 4 5\n",
    "lines": f"o a\n{SQUARE}f 1 2 3 4\nl 1 2\np 1 2\nl 2 3 4\n",
    "normals": f"{SQUARE}vn 0 0 1\nf 1//1 2//1 3//1 4//1\n",
    "materials": f'mtllib "m one.mtl" # both\n{SQUARE}usemtl red # warm\nf 1 2 3\nusemtl  "see through"\nf 1 3 4\n',
    "no-material": f"mtllib lost.mtl\n{SQUARE}usemtl red\nf 1 2 3 4\n",
    "texture": f"mtllib m one.mtl\n{SQUARE}{UVS}usemtl picture\nf 1/1 2/2 3/3 4/4\n",
    "one-colour": f"mtllib m one.mtl\n{SQUARE}{UVS}usemtl blue\nf 1/1 2/2 3/3 4/4\n",
    "missing-texture": f"mtllib m one.mtl\n{SQUARE}{UVS}usemtl lost\nf 1/1 2/2 3/3 4/4\n",
    "inside-out": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n",
}
MTL = """newmtl red
Kd 1 0 0
Ke 0 0.5 0
newmtl see through
Kd 0 0 1
d 0.5
newmtl picture
map_Kd -s 2 2 1 stripes.png
newmtl blue
map_Kd blue.png
bump -bm 2 dents.png
newmtl lost
Kd 0 1 0
map_Kd lost.png
"""


def gltf() -> dict[str, Any]:
    """Documents of one triangle, by the kind that they show."""
    made: dict[str, Any] = defaultdict(File, plain=File())
    stripes = [[[255, 0, 0], [0, 0, 255]] * 2] * 4
    made["skin"].skin([{"translation": [1, 2, 3]}, {"rotation": KINDS["about_z"](90)}], None, [[0, 1, 0, 0]] * 3,
                      [[0.5, 0.5, 0, 0]] * 3)  # fmt: skip
    made["morph"].primitive["targets"] = [{"POSITION": made["morph"].rows(POINTS)}]
    made["morph"].node["weights"] = [0.5]
    attributes = {"TRANSLATION": made["instances"].rows([[0, 0, 0], [5, 0, 0]])}
    made["instances"].node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    made["colours"].primitive["attributes"]["COLOR_0"] = made["colours"].rows([[1, 0.2, 0], [0, 0.5, 1], [0, 0, 0]])
    made["bytes"].primitive["attributes"]["COLOR_0"] = made["bytes"].rows([[255, 9, 0, 128]] * 3, "u1", normalized=True)
    quantized = made["quantized"].rows([[0, 0, 0], [127, 0, 0], [0, 127, 0]], "i1", normalized=True)
    made["quantized"].primitive["attributes"]["POSITION"] = quantized
    for name, mode in (("strip", 5), ("fan", 6), ("points", 0)):
        primitive = {"attributes": {"POSITION": made[name].rows([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]])}}
        made[name].document["meshes"][0]["primitives"].append({**primitive, "mode": mode})
    made["mirrored"].node["scale"] = [-1, 2, 1]
    half = {"baseColorFactor": [0.5, 0.1, 1, 0.25]}
    made["base-colour"].material(pbrMetallicRoughness={**half, "roughnessFactor": 0.3})
    made["blended"].material(pbrMetallicRoughness=half, alphaMode="BLEND")
    made["blended-vertices"].material(alphaMode="BLEND")
    made["blended-vertices"].primitive["attributes"]["COLOR_0"] = made["blended-vertices"].rows([[1, 1, 1, 0.5]] * 3)
    rgba = [[[*color, alpha] for color in row for alpha in (0, 255)] for row in stripes]
    made["masked"].material(
        alphaMode="MASK", pbrMetallicRoughness={"baseColorTexture": made["masked"].texture(rgba, "RGBA")}
    )
    made["hidden"].material(alphaMode="MASK", pbrMetallicRoughness=half)
    made["hidden"].document["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}})
    made["unlit"].material(extensions={"KHR_materials_unlit": {}})
    made["emissive"].material(emissiveFactor=[0.2, 0, 1])
    made["emissive-texture"].material(
        emissiveFactor=[1, 1, 1], emissiveTexture=made["emissive-texture"].texture(stripes, "RGB")
    )
    made["black-emissive"].material(emissiveFactor=[1, 1, 1], pbrMetallicRoughness={"baseColorFactor": [0, 0, 0, 1]},
                                    emissiveTexture=made["black-emissive"].texture(stripes, "RGB"))  # fmt: skip
    older = {"diffuseFactor": [0.2, 0.4, 0.6, 1], "glossinessFactor": 0.5}
    made["glossiness"].material(extensions={"KHR_materials_pbrSpecularGlossiness": older})
    made["two-sided"].material(doubleSided=True)
    for name in ("texture", "nearest", "transform", "normal-map"):
        info: dict[str, Any] = made[name].texture(stripes, "RGB")
        if name == "transform":
            info["extensions"] = {"KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.5, "scale": [3, 2]}}
        made[name].material(pbrMetallicRoughness={"baseColorTexture": info})
    made["normal-map"].document["materials"][0]["normalTexture"] = {"index": 0}
    made["nearest"].document["samplers"] = [{"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}]
    made["nearest"].document["textures"][0]["sampler"] = 0
    made["palette"].material(
        pbrMetallicRoughness={"baseColorTexture": made["palette"].texture([[[9, 99, 199]] * 2] * 2, "RGB")}
    )
    made["visibility"].document["nodes"].append(
        {"mesh": 0, "translation": [9, 0, 0], "extensions": {"KHR_node_visibility": {"visible": False}}}
    )
    made["visibility"].document["scenes"][0]["nodes"].append(1)
    made["cameras"].document["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]
    made["cameras"].node["camera"] = 0
    made["light"].node["extensions"] = {"KHR_lights_punctual": {"light": 0}}
    made["light"].document["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
    made["animation"].animation("translation", [0, 1], [[0, 0, 0], [4, 0, 0]])
    made["extensions"].material(extensions={"KHR_materials_clearcoat": {"clearcoatFactor": 1}})
    made["scenes"].document["scenes"].append({"nodes": []})
    sparse = {"count": 1, "indices": {"bufferView": made["sparse"].view(b"\2"), "componentType": 5121},
              "values": {"bufferView": made["sparse"].view(np.array([0, 5, 0], dtype="f4").tobytes())}}  # fmt: skip
    made["sparse"].document["accessors"][0]["sparse"] = sparse
    if find_spec("DracoPy"):
        faces = np.array([[0, 1, 2], [2, 1, 3]], dtype="u4")
        packed = import_module("DracoPy").encode(np.eye(4, 3, dtype="f4"), faces, colors=np.full((4, 3), 99, "u1"))
        made["draco"] = KINDS["draco_file"](packed)
    return made


#: What the page does in another way, and why. Beyond these files, it reads meshopt, Python does not; vertices hang
#: on four joints at most; and images that repeat as mirror images only repeat. Notes tell of the latter two.
ACCEPTED = {
    "strip.ply": "strips of triangles are rare: an error that says so",
    "animation.gltf": "the page says that an animation is left out, Python has an option for it",
    "one-colour.obj": "statements of materials that are left out are told by another word",
}
#: Words of notes that are the same kind of note.
NOTES = ("texture", "colour", "normal", "material", "camera", "light", "point", "extension", "inside out", "z up",
         "facets", "element", "other scene", "behind", "emissive", "animation")  # fmt: skip


def kinds_of(notes: list[str]) -> set[str]:
    return {word for word in NOTES for note in notes if word in note.split(";")[0]}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All files, and what beside them they name."""
    folder = tmp_path_factory.mktemp("corpus")
    Image.new("RGB", (2, 2), (0, 0, 255)).save(folder / "blue.png")
    Image.fromarray(np.array([[[255, 0, 0], [0, 255, 0]] * 2] * 4, dtype=np.uint8)).save(folder / "stripes.png")
    (folder / "m one.mtl").write_text(MTL)
    for name, (content, _, _) in OTHERS.items():
        (folder / name).write_bytes(content)
    for name, text in OBJ.items():
        (folder / f"{name}.obj").write_text(text)
    for name, file in gltf().items():
        file.write(folder).rename(folder / f"{name}.gltf")
    return folder


@pytest.fixture(scope="module")
def of_page(folder: Path) -> dict[str, Any]:
    """What the page reads of each file, by its name: by the command of the npm package, which is built."""
    subprocess.run(["node", "build.mjs", "package"], cwd=WEB, check=True)
    command = WEB / "dist" / "cli.js"
    paths = sorted(path for path in folder.iterdir() if path.suffix not in (".png", ".mtl"))
    ran = subprocess.run(["node", command, "poster", "--json", *paths], capture_output=True, text=True, check=False)
    lines = [json.loads(line) for line in ran.stdout.splitlines()]
    return {Path(line["input"]).name: line for line in lines}


def of_python(path: Path) -> dict[str, Any]:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        scene = shackled.load(path, size=256)
    corners = np.concatenate([each.mesh.colors[each.mesh.faces].reshape(-1, 3) for each in scene.objects])
    points = scene.world_positions()
    return {
        "triangles": scene.triangles,
        "bounds": [points.min(axis=0), points.max(axis=0)],
        "color": corners.mean(axis=0),
        "notes": [str(each.message).replace(f"{path}: ", "").replace(str(path.parent), "") for each in told],
    }


NAMES = [*OTHERS, *(f"{name}.obj" for name in OBJ), *(f"{name}.gltf" for name in gltf())]


@pytest.mark.parametrize("name", NAMES)
def test_both_read_the_same(name: str, folder: Path, of_page: dict[str, Any]) -> None:
    found = of_page[name]
    wanted = of_python(folder / name)
    differs = [key for key in ("triangles", "bounds", "color") if "error" in found or not np.allclose(
        wanted[key], found[key], atol=1 if key == "color" else 1e-5)]  # fmt: skip
    differs += [] if "error" in found or kinds_of(wanted["notes"]) == kinds_of(found["notes"]) else ["notes"]
    assert bool(differs) == (name in ACCEPTED), (differs, wanted, found)


#: Names of a picture in files, and whether it is found: in the folder of the file only, links resolved.
PLACES = {
    **dict.fromkeys(("t.png", "T.PNG", "t.png?v=1#top", "%74.png", "C:\\art\\t.png", "/art/t.png"), True),
    **dict.fromkeys(("https://host/art/t.png", "../art/t.png", "sub/u.png", "SUB\\U.png", "sub/../t.png"), True),
    **dict.fromkeys(("../private.png", "..\\private.png", "%2e%2e/private.png", "sub/../../private.png"), False),
    **dict.fromkeys(("FOLDER/private.png", "file://FOLDER/private.png", "link.png", "out/private.png"), False),
}


@pytest.mark.usefixtures("of_page")
def test_files_beside_a_file(tmp_path: Path) -> None:
    home = tmp_path / "home"
    (home / "sub").mkdir(parents=True)
    for path in (tmp_path / "private.png", home / "t.png", home / "sub" / "u.png"):
        Image.new("RGB", (2, 2), (0, 0, 255)).save(path)
    (home / "link.png").symlink_to(tmp_path / "private.png")
    (home / "out").symlink_to(tmp_path)
    wanted: dict[str, bool] = {}
    for number, (place, found) in enumerate(PLACES.items()):
        name = place.replace("FOLDER", str(tmp_path))
        (home / f"{number}.mtl").write_text(f"newmtl m\nmap_Kd {name}\n")
        (home / f"{number}.obj").write_text(f"mtllib {number}.mtl\n{SQUARE}{UVS}usemtl m\nf 1/1 2/2 3/3 4/4\n")
        file = File()
        file.material(pbrMetallicRoughness={"baseColorTexture": file.texture([[[0, 0, 0]]])})
        file.document["images"] = [{"uri": name}]
        file.write(home).rename(home / f"{number}.gltf")
        wanted |= {f"{number}.{kind}": found for kind in ("obj", "gltf")}
    paths = [home / name for name in wanted]
    ran = subprocess.run(["node", WEB / "dist" / "cli.js", "poster", "--json", *paths], capture_output=True, text=True)
    lines = {Path(line["input"]).name: line for line in map(json.loads, ran.stdout.splitlines())}
    for name, found in wanted.items():
        assert np.allclose(lines[name]["color"], [0, 0, 255] if found else 255), (name, lines[name])
        assert bool(lines[name]["notes"]) == (not found), lines[name]
