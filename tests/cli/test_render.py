"""The command `shackled render`."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled import InputError, Rim, Scene, Tone, __version__, load, render
from shackled.chain import CHAINS, RevmChain
from shackled.cli.app import run
from shackled.scene import Hemisphere, render_call
from shackled.studio import make_apng


def pixels(path: str) -> np.ndarray:
    with PillowImage.open(path) as picture:
        return np.array(picture.convert("RGB"))


def rendered(*options: str) -> np.ndarray:
    """The pixels of the shape at 32 x 32 with these options."""
    assert run(["render", "shape.obj", "-o", "out.png", "--size", "32", *options]) == 0
    return pixels("out.png")


def test_a_mesh_becomes_a_picture(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj"]) == 0
    output, messages = capsys.readouterr()
    expected = render(load("shape.obj"))
    assert (pixels("shape.png") == expected.pixels).all()
    assert len(np.unique(expected.pixels.reshape(-1, 3), axis=0)) > 50
    assert "shape.png, 256 x 256 pixels" in output
    assert f"{expected.gas:,} (and {expected.intrinsic_gas:,} to send the scene)" in output
    assert f"{expected.triangles:,} triangles, {expected.covered_pixels:,} lit pixels" in output
    assert expected.made_by in output
    assert messages == ""


def test_one_json_object_says_it_all(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "-o", "a.bmp", "--size", "30x20", "--json"]) == 0
    output, messages = capsys.readouterr()
    report = json.loads(output)
    image = pixels("a.bmp")
    keys = "input width height triangles lit_pixels gas intrinsic_gas seconds chain output sha256 scene_bytes fits"
    assert " ".join(report) == keys
    assert report["scene_bytes"] is None
    assert (report["input"], report["output"]) == ("shape.obj", "a.bmp")
    assert (report["width"], report["height"]) == (30, 20)
    assert report["sha256"] == hashlib.sha256(image.tobytes()).hexdigest()
    assert report["gas"] > report["intrinsic_gas"] > 21000
    assert 0 < report["triangles"] <= 4
    assert 0 < report["lit_pixels"] <= 600
    assert 0 < report["seconds"] < 60
    assert messages == ""


def test_where_it_fits(capsys: pytest.CaptureFixture[str]) -> None:
    def fits(*options: str) -> tuple[str, list[bool]]:
        assert run(["render", "shape.obj", *options]) == 0
        (line,) = (each for each in capsys.readouterr().out.splitlines() if each.startswith("fits "))
        assert run(["render", "shape.obj", "--json", *options]) == 0
        found = json.loads(capsys.readouterr().out)["fits"]
        assert run(["gas", "shape.obj", "--json", "--no-stages", *options]) == 0
        assert found == json.loads(capsys.readouterr().out)["fits"]
        return line[9:], [each["fits"] for each in found]

    everywhere, by_limit = fits("--size", "16")
    assert everywhere == "one transaction, and any node's read call"
    assert all(by_limit)
    large, by_limit = fits("--size", "600")
    assert large == "any node's read call; no transaction"
    assert by_limit == [False] + [True] * 6
    # of several calls, that of each
    assert run(["render", "shape.obj", "--size", "600", "--tile", "600x60"]) == 0
    assert "fits     each of its 10 calls: one transaction, and any node's read call" in capsys.readouterr().out


def test_a_picture_is_made_to_fit(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "--size", "700", "--fit", "transaction"]) == 0
    output, messages = capsys.readouterr()
    width = len(pixels("shape.png"))
    assert 128 < width < 700
    assert "fits     one transaction, and any node's read call" in output
    size = f"at {width} x {width} instead of 700 x 700 pixels"
    note = f"shackled: note: to fit one transaction, the picture is drawn without antialiasing and {size}: "
    assert messages.startswith(note)
    assert messages.count("\n") == 1
    assert run(["gas", "shape.obj", "--size", "700", "--fit", "transaction", "--no-stages", "--json"]) == 0
    output, messages = capsys.readouterr()
    assert messages.startswith(note)
    assert json.loads(output)["width"] == width
    for option, value in (("--tile", "64"), ("--gas-limit", "1000000"), ("--turntable", "4")):
        assert run(["render", "shape.obj", "--fit", "call", option, value]) == 2
        assert capsys.readouterr().err == f"shackled: --fit and {option} exclude each other: give one of them\n"
    assert run(["render", "shape.obj", "--fit", "block"]) == 2
    assert capsys.readouterr().err == "shackled: --fit must be one of transaction, call, not 'block'\n"


def test_every_chain_makes_the_same_picture(capsys: pytest.CaptureFixture[str]) -> None:
    reports = {}
    installed = [chain for chain, module in CHAINS.items() if find_spec(module)]
    for chain in installed:
        assert run(["render", "shape.obj", "--size", "16", "--json", "--evm", chain]) == 0
        reports[chain] = json.loads(capsys.readouterr().out)
    assert len({report["sha256"] for report in reports.values()}) == 1
    assert len({report["lit_pixels"] for report in reports.values()}) == 1
    assert len({report["gas"] for report in reports.values()}) == 1
    assert len({report["chain"] for report in reports.values()}) == len(installed)


@pytest.mark.parametrize(
    "options",
    [
        ["--rotate", "-30,45,10"],
        ["--eye", "-1,-2,3"],
        ["--target", "0.5,0,0"],
        ["--up", "1,1,0"],
        ["--fov", "20", "--eye", "0,0,5", "--target", "0,0,0"],
        ["--near", "4.5"],
        ["--half-height", "3", "--orthographic"],
        ["--orthographic"],
        ["--light", "point:1,2,3:#ff0000"],
        ["--light", "directional:0,0,1", "--light", "directional:1,0,0:00ff00"],
        ["--light", "spot:1,2,3:-1,-2,-3:30"],
        ["--light", "spot:1,2,3:-1,-2,-3:20,40:#ff8000"],
        ["--ambient", "1.5"],
        ["--diffuse", "0"],
        ["--specular", "2", "--shininess", "3"],
        ["--color", "#336699"],
        ["--background", "#ffffff"],
        ["--background", "#ff0000,#0000ff"],
        ["--shading", "smooth", "--crease", "180"],
        ["--unlit"],
        ["--wireframe"],
        ["--opacity", "0.5"],
        ["--invert"],
        ["--azimuth", "-60"],
        ["--elevation", "70"],
        ["--margin", "0.5"],
        ["--ambient-light", "#ff0000"],
        ["--color", "tomato"],
    ],
    ids=" ".join,
)
def test_every_option_changes_the_picture(options: list[str]) -> None:
    assert (rendered(*options) != rendered()).any()


def test_options_mean_what_they_say() -> None:
    plain = rendered()
    assert (rendered("--invert") == 255 - plain).all()
    assert (rendered("--smooth") == rendered("--shading", "smooth")).all()
    assert (rendered("--perspective") == plain).all()
    gradient = rendered("--background", "#ff0000,#0000ff", "--eye", "0,0,5", "--target", "0,0,9")
    assert gradient[0].tolist() == [[255, 0, 0]] * 32
    assert gradient[-1].tolist() == [[0, 0, 255]] * 32
    colors = rendered("--unlit", "--no-antialias", "--color", "#336699", "--background", "#000000").reshape(-1, 3)
    assert set(map(tuple, colors.tolist())) == {(0, 0, 0), (0x33, 0x66, 0x99)}
    # seen from behind, what turns away is left out
    behind = ("--eye", "0,0,0", "--target", "0,0,-1", "--background", "#000000", "--unlit")
    assert not rendered(*behind, "--cull").any()
    assert rendered(*behind, "--no-cull").any()


def test_a_scene_turns_about_its_middle() -> None:
    # a triangle on the axis of view, far from the origin: half a turn leaves it where it is
    scene = {
        "canvasDim": 32,
        "verts": [[-300, -300, 0], [300, -300, 0], [0, 300, 0]],
        "faces": [[0, 1, 2]],
        "cols": [[255, 255, 255]] * 3,
        "renderParams": {"objPosition": [100, 0, -2500], "objScale": 1, "backgroundColor": [[0, 0, 0], [0, 0, 0]]},
    }
    Path("scene.json").write_text(json.dumps(scene), "utf-8")
    options = ["render", "scene.json", "-o", "out.png", "--no-cull", "--unlit"]
    assert run(options) == 0
    plain = pixels("out.png")
    assert run([*options, "--rotate", "0,180,0"]) == 0
    turned = pixels("out.png")
    assert plain.any()
    assert np.count_nonzero(plain[:, :, 0] != turned[:, :, 0]) <= 8
    assert run([*options, "--rotate", "0,0,180"]) == 0
    upside_down = pixels("out.png")
    assert np.count_nonzero(upside_down[:16]) > np.count_nonzero(plain[:16])


def test_meshes_are_simplified_on_request(capsys: pytest.CaptureFixture[str]) -> None:
    side = 40
    lines = [f"v {x} {y} {(x * y) % 7 / 20}" for y in range(side) for x in range(side)]
    for y in range(side - 1):
        for x in range(side - 1):
            a = y * side + x + 1
            lines += [f"f {a} {a + 1} {a + side}", f"f {a + 1} {a + side + 1} {a + side}"]
    Path("grid.obj").write_text("\n".join(lines), "utf-8")
    assert run(["render", "grid.obj", "--json", "--max-triangles", "200"]) == 0
    assert 0 < json.loads(capsys.readouterr().out)["triangles"] <= 200


def test_a_gif_says_when_colours_are_lost(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--size", "300", "--light", "point:1,2,3:#ff8040", "--background", "#000000,#ffff00"]
    assert run(["render", "shape.obj", "-o", "a.gif", *options]) == 0
    output, messages = capsys.readouterr()
    assert "a.gif" in output
    assert "a GIF has at most 256 colours" in messages


WRONG = [
    (["render"], "INPUT"),
    (["render", "missing.obj"], "missing.obj"),
    (["render", "folder.obj"], "folder.obj"),
    (["render", "empty.obj"], "empty.obj"),
    (["render", "binary.obj"], "binary.obj"),
    (["render", "shape.xyz"], "shape.xyz"),
    (["render", "shape.obj", "-o", "a.tiff"], "must end in one of .png .bmp .svg .gif"),
    (["render", "shape.obj", "-o", "missing/a.png"], "the folder missing"),
    (["render", "shape.obj", "--size", "0"], "from 1 to 2048 pixels a side"),
    (["render", "shape.obj", "--size", "100x0"], "from 1 to 2048 pixels a side"),
    (["render", "shape.obj", "--size", "3000"], "from 1 to 2048 pixels a side"),
    (["render", "shape.obj", "--size", "big"], "WIDTHxHEIGHT"),
    (["render", "shape.obj", "--size", "-5"], "--size"),
    (["render", "shape.obj", "--evm", "moon"], "--evm must be one of revm, pyrevm, pyevm, not 'moon'"),
    (["render", "shape.obj", "--evm", "reference"], "is gone: use one of revm, pyrevm, pyevm"),
    (["render", "shape.obj", "--rotate", "1,2"], "--rotate must be three numbers"),
    (["render", "shape.obj", "--rotate", "nan,0,0"], "finite"),
    (["render", "shape.obj", "--eye", "a,b,c"], "--eye must be three numbers"),
    (["render", "shape.obj", "--eye", "0,0,0", "--target", "0,0,0"], "same point"),
    (["render", "shape.obj", "--eye", "0,5,0", "--target", "0,0,0"], "choose another up"),
    (["render", "shape.obj", "--fov", "180"], "--fov must be a finite number from 0.2 to 179.8"),
    (["render", "shape.obj", "--fov", "wide"], "--fov"),
    (["render", "shape.obj", "--fov", "40", "--half-height", "1"], "give one of them"),
    (["render", "shape.obj", "--fov", "40", "--orthographic"], "--half-height instead"),
    (["render", "shape.obj", "--near", "-1"], "near"),
    (["render", "shape.obj", "--azimuth", "5", "--eye", "1,2,3"], "--azimuth and --eye exclude each other"),
    (["render", "shape.obj", "--margin", "1"], "--margin must be a finite number from 0 to 0.9"),
    (["render", "shape.obj", "--ambient-light", "dim"], "--ambient-light must be red, green and blue"),
    (["render", "shape.obj", "--light", "lamp:1,2,3"], "--light must be directional:x,y,z"),
    (["render", "shape.obj", "--light", "directional:0,0,0"], "must not be zero"),
    (["render", "shape.obj", "--light", "point:1,2,3:reddish"], "#rrggbb"),
    (["render", "shape.obj", "--light", "spot:1,2,3"], "spot:position:direction:angle"),
    (["render", "shape.obj", "--light", "spot:1,2,3:0,0,1:wide"], "--light spot needs its outer angle in degrees"),
    (["render", "shape.obj", "--light", "spot:1,2,3:0,0,1:1,2,3"], "--light spot needs its outer angle in degrees"),
    (["render", "shape.obj", "--light", "spot:1,2,3:0,0,1:200"], "from 0 to 180"),
    (["render", "shape.obj", "--opacity", "1.5"], "--opacity must be"),
    (["render", "shape.obj", *(["--light", "point:1,2,3"] * 5)], "up to 4 lights"),
    (["render", "shape.obj", "--ambient", "-1"], "ambient"),
    (["render", "shape.obj", "--shininess", "0"], "shininess"),
    (["render", "shape.obj", "--shininess", "2.5"], "--shininess"),
    (["render", "shape.obj", "--color", "#12345"], "#rrggbb"),
    (["render", "shape.obj", "--background", "#000000,#111111,#222222"], "--background"),
    (["render", "shape.obj", "--shading", "toon"], "unlit, flat, smooth"),
    (["render", "shape.obj", "--smooth", "--unlit"], "smooth and unlit at once"),
    (["render", "shape.obj", "--max-triangles", "0"], "0"),
    (["render", "shape.obj", "--bogus"], "--bogus"),
    (["draw", "shape.obj"], "draw"),
    (["--bogus"], "--bogus"),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[" ".join(arguments) for arguments, _ in WRONG])
def test_wrong_usage_is_one_line(
    arguments: list[str], message: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "folder.obj").mkdir()
    (folder / "empty.obj").write_text("")
    (folder / "binary.obj").write_bytes(bytes(range(256)) * 20)
    (folder / "shape.xyz").write_text("1 2 3")
    before = sorted(folder.iterdir())
    assert run(arguments) == 2
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.startswith("shackled: ")
    assert messages.count("\n") == 1
    assert message in messages
    assert sorted(folder.iterdir()) == before


@pytest.mark.parametrize(
    "arguments",
    [
        ["shape.obj", "--near", "1e30"],
        ["empty.json", "--json"],
        ["shape.obj", "--near", "1e30", "--tile", "8"],
        ["shape.obj", "--near", "1e30", "--turntable", "2", "-o", "a.gif"],
    ],
    ids=" ".join,
)
def test_an_empty_picture_is_told(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    Path("empty.json").write_text("{}", "utf-8")
    assert run(["render", *arguments, "--size", "16"]) == 0
    output, messages = capsys.readouterr()
    assert messages.splitlines()[-1] == "nothing is visible; the picture shows only the background"
    if "--json" in arguments:
        assert json.loads(output)["lit_pixels"] == 0


def test_the_seconds_are_those_that_were_waited(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from shackled import whole_file

    count, write = RevmChain.count, whole_file.write_output

    def slow_count(chain: RevmChain, scene: Scene, *tile: None) -> tuple[int, int]:
        time.sleep(0.2)
        return count(chain, scene, *tile)

    def slow_write(path: Path, data: bytes) -> None:
        time.sleep(0.2)
        write(path, data)

    monkeypatch.setattr(RevmChain, "count", slow_count)
    monkeypatch.setattr("shackled.image.write_output", slow_write)
    for options in ([], ["--tile", "8"]):
        started = time.perf_counter()
        assert run(["render", "shape.obj", "--size", "16", "--json", *options]) == 0
        waited = time.perf_counter() - started
        assert 0.4 <= json.loads(capsys.readouterr().out)["seconds"] <= waited


def test_a_gif_of_256_colours_is_exact(capsys: pytest.CaptureFixture[str]) -> None:
    for bottom, told in (((255, 255, 255), False), ((255, 255, 254), True)):
        scene = {"size": [1, 512], "background": {"top": [0, 0, 0], "bottom": bottom}}
        Path("grey.json").write_text(json.dumps(scene), "utf-8")
        assert run(["render", "grey.json", "-o", "grey.gif"]) == 0
        assert ("a GIF has at most 256 colours" in capsys.readouterr().err) == told
        assert run(["render", "grey.json", "-o", "grey.png"]) == 0
        assert (pixels("grey.gif") == pixels("grey.png")).all() != told


def test_a_mesh_may_have_more_vertices_than_a_contract_takes(capsys: pytest.CaptureFixture[str]) -> None:
    rng = np.random.default_rng(3)
    vertices = "\n".join(f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in rng.normal(size=(70000, 3)))
    faces = "\n".join(f"f {a} {b} {c}" for a, b, c in rng.permutation(70000)[:69999].reshape(-1, 3) + 1)
    Path("large.obj").write_text(f"{vertices}\n{faces}\n", "utf-8")
    assert run(["render", "large.obj", "--size", "8", "--json", "--max-triangles", "all"]) == 0
    assert json.loads(capsys.readouterr().out)["lit_pixels"] > 0


def test_refusals_and_interrupts_exit_with_1(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from shackled.chain import EmbeddedChain, RevmChain

    monkeypatch.setattr("shackled._on.open_chain", lambda *_: RevmChain(gas_limit=50_000))
    assert run(["render", "shape.obj"]) == 1
    assert capsys.readouterr().err == "shackled: the call ran out of gas: 50,000 gas is not enough\n"

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(EmbeddedChain, "call", interrupt)
    assert run(["render", "shape.obj"]) == 1
    assert capsys.readouterr().err == "shackled: stopped\n"


def test_help_and_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--version"]) == 0
    assert capsys.readouterr().out == f"shackled {__version__}\n"
    for arguments, word in (([], "render"), (["render"], "--max-triangles"), (["token", "mint"], "--icon")):
        texts = []
        for option in ("--help", "-h"):
            assert run([*arguments, option]) == 0
            texts.append(capsys.readouterr().out)
        assert word in texts[0]
        assert texts[0] == texts[1]
    assert run([]) == 0
    assert "render" in capsys.readouterr().out


def scene_line(output: str) -> str | None:
    rows = dict(line.split(None, 1) for line in output.splitlines())
    return rows.get("scene")


def test_a_picture_is_a_scene_file(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "shape.obj", "--size", "20", "--smooth", "-o", "a.png"]) == 0
    line = scene_line(capsys.readouterr().out)
    assert line is not None
    assert re.fullmatch(r"in the file, \d\.\d KB", line)
    assert render_call(load("a.png")) == render_call(load("shape.obj", 20, smooth=True))
    # not written over its own scene
    assert run(["render", "a.png", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["output"] == "a-rendered.png"
    assert 100 < report["scene_bytes"] < 1000
    assert Path("a-rendered.png").read_bytes() == Path("a.png").read_bytes()
    assert run(["render", "a.png", "--tile", "8", "-o", "tiles.png"]) == 0
    assert Path("tiles.png").read_bytes() == Path("a.png").read_bytes()


def test_options_override_the_scene() -> None:
    Path("smooth.json").write_text('{"antialias": true, "size": 8}')
    for options, antialias in (([], True), (["--no-antialias"], False), (["--antialias"], True)):
        assert run(["render", "smooth.json", "-o", "a.png", *options]) == 0
        assert load("a.png").antialias is antialias


def test_effects_override_the_scene(capsys: pytest.CaptureFixture[str]) -> None:
    Path("foggy.json").write_text('{"fog": {"color": "red", "near": 1, "far": 2}, "tone": {"gamma": true}, "size": 8}')
    options = ["--hemisphere", "skyblue,#102030", "--rim", "white,4", "--fog", "gray,1.5,3", "--exposure", "2"]
    assert run(["render", "foggy.json", "-o", "a.png", *options, "--filmic", "--no-gamma"]) == 0
    scene = load("a.png")
    assert (scene.hemisphere, scene.rim) == (Hemisphere("skyblue", "#102030"), Rim("white", 4))
    assert scene.tone == Tone(2, filmic=True)
    assert scene.fog is not None
    assert (scene.fog.color, scene.fog.far) == ((128, 128, 128), 2 * scene.fog.near)
    assert run(["render", "foggy.json", "-o", "a.png", "--fog", "none", "--no-gamma"]) == 0
    assert (load("a.png").fog, load("a.png").tone) == (None, None)
    capsys.readouterr()
    for wrong, message in (
        (["--fog", "red,1"], "--fog must be a colour, or #rrggbb,near,far, not 'red,1'"),
        (["--fog", "red,1,x"], "--fog must be a colour, or #rrggbb,near,far, not 'red,1,x'"),
        (["--rim", "red,2.5"], "the power of a rim must be a whole number from 1 to 16, not 2.5"),
        (["--hemisphere", "red,red,red"], "--hemisphere must be one colour or two, #rrggbb,#rrggbb, not"),
    ):
        assert run(["render", "foggy.json", *wrong]) == 2
        assert message in capsys.readouterr().err


def test_the_scene_is_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    for options in (["-o", "a.png", "--no-scene"], ["-o", "a.bmp"], ["-o", "a.gif", "--no-scene"]):
        assert run(["render", "shape.obj", *options]) == 0
        assert scene_line(capsys.readouterr().out) is None
    with pytest.raises(InputError, match="carries no scene"):
        load("a.png")
    assert run(["render", "shape.obj", "-o", "a.bmp", "--scene"]) == 2
    assert capsys.readouterr().err == "shackled: --scene needs a .png file, not a.bmp\n"


@pytest.mark.filterwarnings("ignore:.* no area")
def test_a_large_scene_is_left_out_unless_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    rng = np.random.default_rng(1)
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in rng.integers(-30_000, 30_000, (6000, 3)))
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in rng.integers(1, 6001, (6000, 3)))
    Path("large.obj").write_text(corners + faces)
    small = ["render", "large.obj", "--size", "2", "--unlit"]
    assert run(small) == 0
    line = scene_line(capsys.readouterr().out)
    assert line is not None
    assert re.fullmatch(r"not in the file, as it takes \d\d\.\d KB: --scene writes it", line)
    assert run([*small, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["scene_bytes"] is None
    assert run([*small, "--scene"]) == 0
    line = scene_line(capsys.readouterr().out)
    assert line is not None
    assert line.startswith("in the file, ")
    assert render_call(load("large.png")) == render_call(load("large.obj", 2, unlit=True))


@pytest.mark.parametrize("output", ["a.png", "frames"])
def test_a_turntable_carries_its_scene(output: str, capsys: pytest.CaptureFixture[str]) -> None:
    turned = ["render", "shape.obj", "--size", "8", "--turntable", "2", "-o", output]
    assert run(turned) == 0
    assert scene_line(capsys.readouterr().out) is not None
    first = output if output.endswith(".png") else f"{output}/000.png"
    assert (render(load(first)).pixels == pixels(first)).all()
    assert run([*turned, "--no-scene"]) == 0
    with pytest.raises(InputError, match="carries no scene"):
        load(first)


def test_a_turntable_of_one_call(capsys: pytest.CaptureFixture[str]) -> None:
    turned = ["render", "shape.obj", "--size", "16", "--turntable", "5", "--one-call", "--duration", "50"]
    assert run([*turned, "-o", "one.png", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    made = make_apng(load("shape.obj", 16), 5, 50)
    assert Path("one.png").read_bytes() == made.content
    assert (report["frames"], report["calls"], report["gas"]) == (5, 1, made.gas)
    assert run([*turned, "-o", "one"]) == 0
    assert len(list(Path("one").iterdir())) == 5
    assert "visible" not in capsys.readouterr().err
    wrong = {
        ("--tile", "8"): "has no tiles: leave out --tile or --one-call",
        ("--jobs", "2"): "needs an EVM that runs the contracts, or a node; not several processes",
        ("--scene", "-o", "a.png"): "--scene and --one-call exclude each other",
    }
    for options, message in wrong.items():
        assert run([*turned, *options]) == 2
        assert message in capsys.readouterr().err
    assert run(["render", "shape.obj", "--one-call"]) == 2
    assert "--one-call needs --turntable" in capsys.readouterr().err


def test_as_a_process(folder: Path) -> None:
    def process(*arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "shackled", *arguments]
        return subprocess.run(command, capture_output=True, text=True, cwd=folder)

    done = process("render", "shape.obj", "--json", "--size", "16")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["output"] == "shape.png"
    for arguments in (["render", "missing.obj"], ["render", "shape.obj", "--size", "0"], ["render", "--bogus"]):
        failed = process(*arguments)
        assert (failed.returncode, failed.stdout) == (2, "")
        assert failed.stderr.count("\n") == 1
        assert "Traceback" not in failed.stderr
