"""The command `shackled gas`."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from typing import Any

import click
import pytest

from commands import Shackled
from nodes import anvil, needs_anvil
from shackled import load, render
from shackled.cli.app import app
from shackled.datasets import Piece
from shackled.gas import limits
from shackled.gas._profile import KINDS
from shackled.gas._stages import STAGES
from shackled.scene._settings import SETTINGS


@pytest.fixture
def report(shackled: Shackled) -> Any:
    """Returns the object of --json, with these options."""

    def measure(words: str = "") -> dict[str, Any]:
        said = shackled(f"gas shape.obj --json --size 20x12 {words}")
        assert said.err == ""
        found: dict[str, Any] = said.json
        return found

    return measure


def test_one_json_object_says_it_all(report: Any, shackled: Shackled) -> None:
    found = report("--gas-price 2 --eth-price 3000")
    image = shackled("render shape.obj --json --size 20x12").json
    for key in ("input", "gas", "intrinsic_gas", "triangles", "lit_pixels", "width", "height", "chain"):
        assert found[key] == image[key]
    assert list(found["stages"]) == list(STAGES)
    assert sum(found["stages"].values()) == found["gas"]
    steps = found["search_steps"]
    assert found["search_calls"] == len(steps)
    assert steps[-1]["upper"] == found["searched_gas"] == steps[-1]["lower"] + 1
    assert found["searched_gas"] > found["gas"]
    assert found["gas_per_triangle"] == pytest.approx(image["gas"] / image["triangles"])
    assert found["gas_per_lit_pixel"] == pytest.approx(image["gas"] / image["lit_pixels"])
    transaction = found["transaction"]
    assert transaction["gas"] == found["gas"] + found["intrinsic_gas"]
    assert transaction["gas_limit"] == found["searched_gas"] + found["intrinsic_gas"]
    assert transaction["ether"] == pytest.approx(transaction["gas"] * 2e-9)
    assert transaction["usd"] == pytest.approx(transaction["gas"] * 6e-6)
    for limit in limits():
        assert (limit.place in found["fits"][f"{limit.kind}s"]) == (transaction["gas_limit"] <= limit.gas)
    assert found["missed_quick_path"] == {}


def test_the_quick_path(shackled: Shackled, report: Any) -> None:
    assert "quick path" not in shackled("gas shape.obj --no-stages --size 20").out
    words = "--no-stages --size 20 --hemisphere white --shading flat --color tan --specular 0.08"
    missed = report(words)["missed_quick_path"]
    note = f"quick path   of 4 faces, these miss the quick path of effects: 4 because of {''.join(missed)}"
    assert (note in shackled(f"gas shape.obj {words}").out, missed) == (True, {"a highlight of 8 percent": 4})


def test_the_look_is_that_of_render(report: Any, shackled: Shackled) -> None:
    words = "--light point:1,2,3:#ff0000 --light directional:0,0,1 --color #c8553d --no-cull --rotate 20,30,40 --invert"
    found = report(f"--no-stages {words}")
    image = shackled(f"render shape.obj -o out.png --json --size 20x12 {words}").json
    for key in ("gas", "intrinsic_gas", "triangles", "lit_pixels"):
        assert found[key] == image[key]
    assert found["gas"] != report("--no-stages")["gas"]


def test_the_options_of_a_look_are_the_same_everywhere() -> None:
    look = {setting.option.partition("/")[0] for setting in SETTINGS}
    assert len(look) > 20
    for name in ("render", "gas", "stages"):
        command = app.get_command(click.Context(app), name)
        assert command is not None
        assert look <= {option for parameter in command.params for option in parameter.opts}


def test_who_made_a_piece_is_said_once(shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    piece = Piece("set/shape", "set", "A shape", "CC BY 4.0", lambda: load("shape.obj"), credit="Somebody")
    monkeypatch.setattr("shackled.cli.look_options.locate", lambda _: piece)
    said = shackled("gas set/shape --json --no-stages --size 8")
    assert said.err == "set/shape: A shape by Somebody; licence: CC BY 4.0\n"


def test_tables_for_people(shackled: Shackled) -> None:
    said = shackled("gas shape.obj --size 16 --eth-price 2500")
    image = render(load("shape.obj"), size=16)
    assert f"{image.gas:,} of the execution, exact" in said.out
    for text in (*STAGES, "16,777,216", "https://eips.ethereum.org/EIPS/eip-7825", "US dollars", "not measured", "yes"):
        assert text in said.out
    # the bracket as it narrows
    lines = said.err.splitlines()
    assert len(lines) > 15
    assert all(" < gas" in line for line in lines)


def test_profiles_and_opcodes(report: Any, shackled: Shackled) -> None:
    found = report("--opcodes --profile other.svg")
    assert found["profile"] == "other.svg"
    assert list(found["opcodes"]) == list(KINDS)
    assert sum(found["opcodes"].values()) == found["gas"]
    assert {stage: sum(each.values()) for stage, each in found["opcodes_of_stages"].items()} == found["stages"]
    assert "opcodes" not in report()
    output = shackled("gas shape.obj --size 20x12 --opcodes --profile flame.svg").out
    assert "flame graph: flame.svg" in output
    assert ElementTree.parse("flame.svg").getroot().tag.endswith("svg")
    # place, function and gas of the dearest lines
    assert re.search(r"pipeline/\w+\.sol:\d+ +\w+\.\w+ +[\d,]+ +\d+\.\d\d %", output)
    for kind, gas in found["opcodes"].items():
        assert re.search(rf"{kind} +{gas:,} +{100 * gas / found['gas']:.2f} %", output)
    # the shares of a stage, and of a function
    assert re.search(r"fragment shader( +\d+\.\d\d %){5}", output)
    assert re.search(r"Renderer\.\w+ +[\d,]+ +\d+\.\d\d % +[\d,]+ +\d+\.\d\d %", output)


@needs_anvil
def test_a_node_counts_too(report: Any, shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    here = report("--no-stages")
    assert here["stages"] is None
    with anvil() as node:
        found = report(f"--no-stages --rpc {node.url} --rpc-timeout 60")
        name = f"{node.connection.name} (state override)"
        assert found["node"] == {"name": name, "gas": here["gas"]}
        assert found["searched_gas"] == here["searched_gas"]
        monkeypatch.setenv("SHACKLED_RPC", f"{node.url} http://127.0.0.1:1")
        said = shackled("gas shape.obj --size 8 --no-stages")
        assert f"the {name}, on which the search was made, counts " in said.out
        said = shackled(f"gas shape.obj --no-stages --address 0x{'5' * 40}", expect=1)
        assert "there is no contract at" in said.error
