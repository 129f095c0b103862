"""The command `shackled render`."""

from __future__ import annotations

import hashlib
import json
import re
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from commands import Shackled
from pictures import pixels_of
from shackled import Camera, InputError, Mesh, Object, Rim, Scene, Tone, load, render
from shackled.base import whole_file
from shackled.chain._embedded import RevmChain
from shackled.chain._opening import CHAINS
from shackled.cli.app import run
from shackled.gas import limits
from shackled.scene import Hemisphere
from shackled.scene._codec import render_call
from shackled.studio import make_apng


def rendered(options: str = "") -> np.ndarray:
    """The pixels of the shape at 32 x 32 with these options."""
    assert run(["render", "shape.obj", "-o", "out.png", "--size", "32", *options.split()]) == 0
    return pixels_of("out.png")


def test_a_mesh_becomes_a_picture(shackled: Shackled) -> None:
    said = shackled("render shape.obj")
    expected = render(load("shape.obj"))
    assert (pixels_of("shape.png") == expected.pixels).all()
    assert len(np.unique(expected.pixels.reshape(-1, 3), axis=0)) > 50
    assert "shape.png, 256 x 256 pixels" in said.out
    assert f"{expected.gas:,} (and {expected.intrinsic_gas:,} to send the scene)" in said.out
    assert f"{expected.triangles:,} triangles, {expected.covered_pixels:,} lit pixels" in said.out
    assert expected.made_by in said.out
    assert said.err == ""


def test_one_json_object_says_it_all(shackled: Shackled) -> None:
    said = shackled("render shape.obj -o a.bmp --size 30x20 --json")
    report, image = said.json, pixels_of("a.bmp")
    keys = "input width height triangles lit_pixels gas intrinsic_gas seconds chain output sha256 scene_bytes fits"
    assert " ".join(report) == f"{keys} frames calls"
    assert report["scene_bytes"] is None
    assert (report["input"], report["output"]) == ("shape.obj", "a.bmp")
    assert (report["width"], report["height"]) == (30, 20)
    assert report["sha256"] == hashlib.sha256(image.tobytes()).hexdigest()
    assert report["gas"] > report["intrinsic_gas"] > 21000
    assert 0 < report["triangles"] <= 4
    assert 0 < report["lit_pixels"] <= 600
    assert 0 < report["seconds"] < 60
    assert said.err == ""


def test_where_it_fits(shackled: Shackled) -> None:
    def fits(options: str) -> tuple[str, dict[str, list[str]]]:
        (line,) = re.findall("^fits     (.*)$", shackled(f"render shape.obj {options}").out, re.MULTILINE)
        found = shackled(f"render shape.obj --json {options}").json["fits"]
        assert found == shackled(f"gas shape.obj --json --no-stages {options}").json["fits"]
        return line, found

    places = {f"{kind}s": [e.place for e in limits() if e.kind == kind] for kind in ("transaction", "call")}
    anywhere = "free to read on most nodes; a contract can draw it inside a transaction"
    assert fits("--size 16") == (anywhere, places)
    line, found = fits("--size 600")
    assert line == "free to read on most nodes; too much for a contract to draw inside a transaction"
    assert found == places | {"transactions": []}
    # of several calls, that of each
    said = shackled("render shape.obj --size 600 --tile 600x60")
    assert f"fits     each of its 10 calls: {anywhere}" in said.out


def test_a_picture_is_made_to_fit(shackled: Shackled) -> None:
    said = shackled("render shape.obj --size 700 --fit transaction")
    width = len(pixels_of("shape.png"))
    assert 128 < width < 700
    assert "fits     free to read on most nodes; a contract can draw it inside a transaction\n" in said.out
    size = f"at {width} x {width} instead of 700 x 700 pixels"
    note = f"shackled: note: to fit one transaction on Ethereum, the picture is drawn without antialiasing and {size}: "
    assert said.err.startswith(note)
    assert said.err.count("\n") == 1
    said = shackled("gas shape.obj --size 700 --fit transaction --no-stages --json")
    assert said.err.startswith(note)
    assert said.json["width"] == width


def test_every_chain_makes_the_same_picture(shackled: Shackled) -> None:
    installed = [chain for chain, module in CHAINS.items() if find_spec(module)]
    reports = [shackled(f"render shape.obj --size 16 --json --evm {chain}").json for chain in installed]
    assert len({(each["sha256"], each["lit_pixels"], each["gas"]) for each in reports}) == 1
    assert len({each["chain"] for each in reports}) == len(installed)


@pytest.mark.parametrize(
    "options",
    [
        "--rotate -30,45,10",
        "--eye -1,-2,3",
        "--light point:1,2,3:#ff0000",
        "--light spot:1,2,3:-1,-2,-3:30",
        "--light spot:1,2,3:-1,-2,-3:20,40:#ff8000",
        "--background #ffffff",
        "--background #ff0000,#0000ff",
        "--shading smooth --crease 180",
        "--unlit",
        "--ambient-light #ff0000",
        "--color tomato",
    ],
)
def test_values_of_each_kind_change_the_picture(options: str) -> None:
    assert (rendered(options) != rendered()).any()


def test_options_mean_what_they_say() -> None:
    plain = rendered()
    assert (rendered("--invert") == 255 - plain).all()
    assert (rendered("--smooth") == rendered("--shading smooth")).all()
    assert (rendered("--perspective") == plain).all()
    gradient = rendered("--background #ff0000,#0000ff --eye 0,0,5 --target 0,0,9")
    assert gradient[0].tolist() == [[255, 0, 0]] * 32
    assert gradient[-1].tolist() == [[0, 0, 255]] * 32
    colors = rendered("--unlit --no-antialias --color #336699 --background #000000").reshape(-1, 3)
    assert set(map(tuple, colors.tolist())) == {(0, 0, 0), (0x33, 0x66, 0x99)}
    # seen from behind, what turns away is left out
    behind = "--eye 0,0,0 --target 0,0,-1 --background #000000 --unlit"
    assert not rendered(f"{behind} --cull").any()
    assert rendered(f"{behind} --no-cull").any()


def test_a_scene_turns_about_its_middle(shackled: Shackled) -> None:
    mesh = Mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])
    # far from the origin, about which half a turn would take it to the other side
    Scene([Object(mesh, (9, 0, 0))], Camera((9, 0, 5), (9, 0, 0))).save("scene.json")
    shackled("render scene.json -o a.png --rotate 0,180,0 --size 8")
    assert load("a.png").objects[0].position == pytest.approx((9, 0, 0))


def test_meshes_are_simplified_on_request(shackled: Shackled) -> None:
    assert 0 < shackled("render teapot --size 16 --json --max-triangles 200").json["triangles"] <= 200


@pytest.mark.parametrize(
    "words",
    [
        "shape.obj --near 1e30",
        "empty.json --json",
        "shape.obj --near 1e30 --tile 8",
        "shape.obj --near 1e30 --turntable 2 -o a.gif",
    ],
)
def test_an_empty_picture_is_told(words: str, shackled: Shackled) -> None:
    Path("empty.json").write_text("{}", "utf-8")
    said = shackled(f"render {words} --size 16")
    assert said.error == "nothing is visible; the picture shows only the background"
    assert "--json" not in words or said.json["lit_pixels"] == 0


def test_the_seconds_are_those_that_were_waited(monkeypatch: pytest.MonkeyPatch, shackled: Shackled) -> None:
    count, write = RevmChain.count, whole_file.write_output

    def slow_count(chain: RevmChain, scene: Scene, *tile: None) -> tuple[int, int]:
        time.sleep(0.2)
        return count(chain, scene, *tile)

    def slow_write(path: Path, data: bytes) -> None:
        time.sleep(0.2)
        write(path, data)

    monkeypatch.setattr(RevmChain, "count", slow_count)
    monkeypatch.setattr("shackled.image.write_output", slow_write)
    for options in ("", "--tile 8"):
        started = time.perf_counter()
        seconds = shackled(f"render shape.obj --size 16 --json {options}").json["seconds"]
        assert 0.4 <= seconds <= time.perf_counter() - started


def test_a_gif_of_256_colours_is_exact(shackled: Shackled) -> None:
    for bottom, told in (((255, 255, 255), False), ((255, 255, 254), True)):
        scene = {"size": [1, 512], "background": {"top": [0, 0, 0], "bottom": bottom}}
        Path("grey.json").write_text(json.dumps(scene), "utf-8")
        assert ("a GIF has at most 256 colours" in shackled("render grey.json -o grey.gif").err) == told
        shackled("render grey.json -o grey.png")
        assert (pixels_of("grey.gif") == pixels_of("grey.png")).all() != told


# ---- scenes in pictures ----


def scene_line(output: str) -> str | None:
    return dict(line.split(None, 1) for line in output.splitlines()).get("scene")


def test_a_picture_is_a_scene_file(shackled: Shackled) -> None:
    line = scene_line(shackled("render shape.obj --size 20 --smooth -o a.png").out)
    assert re.fullmatch(r"in the file, \d\.\d KB", line or "")
    assert render_call(load("a.png")) == render_call(load("shape.obj", 20, smooth=True))
    # not written over its own scene
    report = shackled("render a.png --json").json
    assert report["output"] == "a-rendered.png"
    assert 100 < report["scene_bytes"] < 1000
    assert Path("a-rendered.png").read_bytes() == Path("a.png").read_bytes()
    shackled("render a.png --tile 8 -o tiles.png")
    assert Path("tiles.png").read_bytes() == Path("a.png").read_bytes()


def test_options_override_the_scene(shackled: Shackled) -> None:
    Path("smooth.json").write_text('{"antialias": true, "size": 8}')
    for options, antialias in (("", True), ("--no-antialias", False), ("--antialias", True)):
        shackled(f"render smooth.json -o a.png {options}")
        assert load("a.png").antialias is antialias
    Path("foggy.json").write_text('{"fog": {"color": "red", "near": 1, "far": 2}, "tone": {"gamma": true}, "size": 8}')
    options = "--hemisphere skyblue,#102030 --rim white,4 --fog gray,1.5,3 --exposure 2 --filmic --no-gamma"
    shackled(f"render foggy.json -o a.png {options}")
    scene = load("a.png")
    assert (scene.hemisphere, scene.rim) == (Hemisphere("skyblue", "#102030"), Rim("white", 4))
    assert scene.tone == Tone(2, filmic=True)
    assert scene.fog is not None
    assert (scene.fog.color, scene.fog.far) == ((128, 128, 128), 2 * scene.fog.near)
    shackled("render foggy.json -o a.png --fog none --no-gamma")
    assert (load("a.png").fog, load("a.png").tone) == (None, None)


def test_the_scene_is_left_out(shackled: Shackled) -> None:
    for options in ("-o a.png --no-scene", "-o a.bmp", "-o a.gif --no-scene"):
        assert scene_line(shackled(f"render shape.obj {options}").out) is None
    with pytest.raises(InputError, match="carries no scene"):
        load("a.png")


@pytest.mark.filterwarnings("ignore:.* no area")
def test_a_large_scene_is_left_out_unless_asked_for(shackled: Shackled) -> None:
    rng = np.random.default_rng(1)
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in rng.integers(-30_000, 30_000, (6000, 3)))
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in rng.integers(1, 6001, (6000, 3)))
    Path("large.obj").write_text(corners + faces)
    small = "render large.obj --size 2 --unlit"
    line = scene_line(shackled(small).out)
    assert re.fullmatch(r"not in the file, as it takes \d\d\.\d KB: --scene writes it", line or "")
    assert shackled(f"{small} --json").json["scene_bytes"] is None
    assert (scene_line(shackled(f"{small} --scene").out) or "").startswith("in the file, ")
    assert render_call(load("large.png")) == render_call(load("large.obj", 2, unlit=True))


@pytest.mark.parametrize("output", ["a.png", "frames"])
def test_a_turntable_carries_its_scene(output: str, shackled: Shackled) -> None:
    turned = f"render shape.obj --size 8 --turntable 2 -o {output}"
    assert scene_line(shackled(turned).out) is not None
    first = output if output.endswith(".png") else f"{output}/000.png"
    assert (render(load(first)).pixels == pixels_of(first)).all()
    shackled(f"{turned} --no-scene")
    with pytest.raises(InputError, match="carries no scene"):
        load(first)


def test_a_turntable_of_one_call(shackled: Shackled) -> None:
    turned = "render shape.obj --size 16 --turntable 5 --one-call --duration 50"
    report = shackled(f"{turned} -o one.png --json").json
    made = make_apng(load("shape.obj", 16), 5, 50)
    assert Path("one.png").read_bytes() == made.content
    assert (report["frames"], report["calls"], report["gas"]) == (5, 1, made.gas)
    assert "visible" not in shackled(f"{turned} -o one").err
    assert len(list(Path("one").iterdir())) == 5
