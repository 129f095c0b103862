"""The command `shackled gas`."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import click
import pytest

from nodes import anvil, needs_anvil
from shackled import load, render
from shackled.cli.app import app, run
from shackled.datasets import Piece
from shackled.gas import KINDS, STAGES
from shackled.scene import SETTINGS


def report(capsys: pytest.CaptureFixture[str], *options: str) -> dict[str, Any]:
    assert run(["gas", "shape.obj", "--json", "--size", "20x12", *options]) == 0
    output, messages = capsys.readouterr()
    assert messages == ""
    found: dict[str, Any] = json.loads(output)
    return found


def error(capsys: pytest.CaptureFixture[str], code: int, *options: str) -> str:
    assert run(["gas", "shape.obj", "--size", "8", *options]) == code
    output, messages = capsys.readouterr()
    assert output == ""
    last = messages.splitlines()[-1]
    assert last.startswith("shackled: ")
    assert "Traceback" not in messages
    return last


def test_one_json_object_says_it_all(capsys: pytest.CaptureFixture[str]) -> None:
    found = report(capsys, "--gas-price", "2", "--eth-price", "3000")
    assert run(["render", "shape.obj", "--json", "--size", "20x12"]) == 0
    image = json.loads(capsys.readouterr().out)
    for key in ("input", "gas", "intrinsic_gas", "triangles", "lit_pixels", "width", "height", "chain"):
        assert found[key] == image[key]
    assert list(found["stages"]) == list(STAGES)
    assert sum(found["stages"].values()) == found["gas"]
    steps = found["search_steps"]
    assert found["search_calls"] == len(steps)
    assert steps[-1]["upper"] == found["searched_gas"] == steps[-1]["lower"] + 1
    margin = found["margin"]
    assert found["searched_gas"] - found["gas"] == margin["gas"] == margin["kept"] - margin["after"] > 0
    assert found["gas_per_triangle"] == pytest.approx(image["gas"] / image["triangles"])
    assert found["gas_per_lit_pixel"] == pytest.approx(image["gas"] / image["lit_pixels"])
    transaction = found["transaction"]
    assert transaction["gas"] == found["gas"] + found["intrinsic_gas"]
    assert transaction["gas_limit"] == found["searched_gas"] + found["intrinsic_gas"]
    assert transaction["ether"] == pytest.approx(transaction["gas"] * 2e-9)
    assert transaction["usd"] == pytest.approx(transaction["gas"] * 6e-6)
    assert all(entry["fits"] == (transaction["gas_limit"] <= entry["limit"]) for entry in found["fits"])
    assert {entry["limit"] for entry in found["fits"]} >= {1 << 24, 50_000_000, 100_000_000}


def test_limits_of_the_search_and_no_stages(capsys: pytest.CaptureFixture[str]) -> None:
    whole = report(capsys, "--no-stages")
    assert whole["stages"] is None
    least = whole["searched_gas"]
    near = report(capsys, "--no-stages", "--lower", str(least - 8), "--upper", str(least + 8))
    assert near["searched_gas"] == least
    assert near["search_calls"] == 5 < whole["search_calls"]


def test_the_look_changes_the_gas(capsys: pytest.CaptureFixture[str]) -> None:
    plain = report(capsys, "--no-stages")["gas"]
    for options in (["--crease", "180"], ["--unlit"], ["--wireframe"], ["--no-cull"], ["--rotate", "40,0,0"]):
        assert report(capsys, "--no-stages", *options)["gas"] != plain


@pytest.mark.parametrize(
    "options",
    [
        ("--light", "point:1,2,3:#ff0000", "--light", "directional:0,0,1", "--background", "#102030,#405060"),
        ("--eye", "2,1,4", "--target", "0,0.2,0", "--up", "0,1,0.1", "--fov", "30", "--near", "0.5"),
        ("--orthographic", "--half-height", "0.7", "--invert", "--max-triangles", "3"),
        ("--shading", "smooth", "--specular", "0.9", "--shininess", "9", "--ambient", "0", "--diffuse", "2"),
        ("--color", "#c8553d", "--unlit", "--no-cull", "--rotate", "20,30,40"),
    ],
)
def test_the_look_is_that_of_render(capsys: pytest.CaptureFixture[str], options: tuple[str, ...]) -> None:
    found = report(capsys, "--no-stages", *options)
    assert run(["render", "shape.obj", "-o", "out.png", "--json", "--size", "20x12", *options]) == 0
    image = json.loads(capsys.readouterr().out)
    for key in ("gas", "intrinsic_gas", "triangles", "lit_pixels"):
        assert found[key] == image[key]
    assert found["gas"] != report(capsys, "--no-stages")["gas"]


def test_the_options_of_a_look_are_the_same_everywhere() -> None:
    options = {}
    for name in ("render", "gas", "stages"):
        command = app.get_command(click.Context(app), name)
        assert command is not None
        options[name] = {option for parameter in command.params for option in parameter.opts}
    look = {setting.option.partition("/")[0] for setting in SETTINGS}
    assert len(look) > 20
    for given in options.values():
        assert look <= given


def test_who_made_a_piece_is_said_once(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    piece = Piece("set/shape", "set", "A shape", "CC BY 4.0", lambda: load("shape.obj"), credit="Somebody")
    monkeypatch.setattr("shackled.cli.look_options.locate", lambda _: piece)
    assert run(["gas", "set/shape", "--json", "--no-stages", "--size", "8"]) == 0
    assert capsys.readouterr().err == "set/shape: A shape by Somebody; licence: CC BY 4.0\n"


def test_tables_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["gas", "shape.obj", "--size", "16", "--eth-price", "2500"]) == 0
    output, messages = capsys.readouterr()
    image = render(load("shape.obj"), size=16)
    assert f"{image.gas:,} of the execution, exact" in output
    for text in (*STAGES, "16,777,216", "https://eips.ethereum.org/EIPS/eip-7825", "US dollars", "not measured", "yes"):
        assert text in output
    # the bracket as it narrows
    lines = messages.splitlines()
    assert len(lines) > 15
    assert all(" < gas" in line for line in lines)


def test_flame_graphs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["gas", "shape.obj", "--size", "16", "--profile", "flame.svg"]) == 0
    output, _ = capsys.readouterr()
    assert "flame graph: flame.svg" in output
    # place, function and gas of the dearest lines
    assert re.search(r"pipeline/\w+\.sol:\d+ +\w+\.\w+ +[\d,]+ +\d+\.\d\d %", output)
    assert ElementTree.parse("flame.svg").getroot().tag.endswith("svg")
    assert report(capsys, "--profile", "other.svg")["profile"] == "other.svg"


def test_opcodes(capsys: pytest.CaptureFixture[str]) -> None:
    found = report(capsys, "--opcodes")
    assert list(found["opcodes"]) == list(KINDS)
    assert sum(found["opcodes"].values()) == found["gas"]
    assert {stage: sum(each.values()) for stage, each in found["opcodes_of_stages"].items()} == found["stages"]
    assert "opcodes" not in report(capsys)
    assert run(["gas", "shape.obj", "--size", "20x12", "--opcodes", "--profile", "flame.svg"]) == 0
    output = capsys.readouterr().out
    for kind, gas in found["opcodes"].items():
        assert re.search(rf"{kind} +{gas:,} +{100 * gas / found['gas']:.2f} %", output)
    # the shares of a stage, and of a function
    assert re.search(r"fragment shader( +\d+\.\d\d %){5}", output)
    assert re.search(r"Renderer\.\w+ +[\d,]+ +\d+\.\d\d % +[\d,]+ +\d+\.\d\d %", output)
    assert "--opcodes and --no-stages exclude" in error(capsys, 2, "--opcodes", "--no-stages")


def test_mistakes_are_told_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    Path("folder.svg").mkdir()
    assert "use one of revm, pyrevm, pyevm" in error(capsys, 2, "--evm", "reference")
    assert "an .svg file" in error(capsys, 2, "--profile", "flame.png")
    assert "does not exist" in error(capsys, 2, "--profile", "nowhere/flame.svg")
    assert "is a folder" in error(capsys, 2, "--profile", "folder.svg")
    assert "--no-stages" in error(capsys, 2, "--profile", "flame.svg", "--no-stages")
    assert "--gas-price" in error(capsys, 2, "--gas-price", "-1")
    assert "--eth-price" in error(capsys, 2, "--eth-price", "nan")
    assert "0 <= lower < upper" in error(capsys, 2, "--no-stages", "--lower", "9", "--upper", "9")
    assert "1,000 gas, the upper limit of the search" in error(capsys, 1, "--no-stages", "--upper", "1000")
    assert "--light must be" in error(capsys, 2, "--light", "lamp:1,2,3")
    assert "--background must be" in error(capsys, 2, "--background", "#000000,#111111,#222222")
    assert "--fov and --half-height" in error(capsys, 2, "--no-stages", "--fov", "30", "--half-height", "1")
    assert run(["gas", "missing.obj"]) == 2


@needs_anvil
def test_a_node_counts_too(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    here = report(capsys, "--no-stages")
    with anvil() as node:
        found = report(capsys, "--no-stages", "--rpc", node.url, "--rpc-timeout", "60")
        name = f"{node.connection.name} (state override)"
        assert found["node"] == {"name": name, "gas": here["gas"]}
        assert found["searched_gas"] == here["searched_gas"]
        monkeypatch.setenv("SHACKLED_RPC", f"{node.url} http://127.0.0.1:1")
        assert run(["gas", "shape.obj", "--size", "8", "--no-stages"]) == 0
        assert f"the {name}, on which the search was made, counts " in capsys.readouterr().out
        address = "0x" + 40 * "5"
        assert "there is no contract at" in error(capsys, 1, "--no-stages", "--address", address)


def test_options_of_a_node_without_one(capsys: pytest.CaptureFixture[str]) -> None:
    for option, value in (("--address", "0x" + 40 * "5"), ("--rpc-timeout", "5")):
        assert f"{option} needs --rpc" in error(capsys, 2, "--no-stages", option, value)
