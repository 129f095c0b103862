"""Gas by stage, by function and by line: from the artifacts alone, and adding up."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree

import pytest

from made_scenes import SMALL_SCENES
from pictures import call, dynamic
from shackled import load
from shackled.artifacts import artifact, source
from shackled.chain import open_chain
from shackled.deploy._contract import STANDARD
from shackled.gas import measure, profile, render_call
from shackled.gas._flame_graph import MARGIN, WIDTH, flame_graph
from shackled.gas._profile import KINDS, Profile
from shackled.gas._source_map import source_map
from shackled.gas._stages import STAGES
from shackled.gas._trace import CallFrame, trace
from shackled.scene._codec import Rectangle
from shackled.scene._in_range import in_range

NAMES = tuple(SMALL_SCENES)

#: The engine of scenes that one draws.
ENGINE_OF = {"smooth": "FragmentEngine", "empty": "Engine"}
JUMPDEST = 0x5B


@pytest.fixture(scope="module")
def profiles() -> dict[str, Profile]:
    return {name: profile(scene) for name, scene in SMALL_SCENES.items()}


@pytest.mark.parametrize("name", NAMES)
def test_all_add_up_to_the_gas(name: str, profiles: dict[str, Profile]) -> None:
    chain = open_chain()
    exact = measure(SMALL_SCENES[name], chain)
    found = profiles[name]
    assert found.gas == exact.gas
    assert list(found.stages()) == list(STAGES)
    assert sum(found.stages().values()) == exact.gas
    assert sum(each.own for each in found.functions()) == exact.gas
    assert sum(gas for _, _, gas in found.lines()) == exact.gas
    totals = {each.name: each.total for each in found.functions()}
    assert totals["Renderer"] == exact.gas
    if name in ENGINE_OF:  # measured by a call of its own
        engine, whole = ENGINE_OF[name], Rectangle(0, 0, SMALL_SCENES[name].width, SMALL_SCENES[name].height)
        data = dynamic(call("engineCall", in_range(SMALL_SCENES[name]), whole).output)
        assert totals[engine] == chain.call(engine, data).gas
    assert all(cost.gas > 0 for cost in found.costs)


#: A mnemonic of each kind of opcode, in the order of `KINDS`.
MNEMONICS = (
    r"PUSH\d+|DUP\d+|SWAP\d+|POP",
    "JUMP|JUMPI|JUMPDEST|PC",
    "MUL|S?DIV|S?MOD|ADDMOD|MULMOD|EXP",
    "MLOAD|MSTORE8?|MSIZE|MCOPY|CALLDATALOAD|(CALLDATA|(EXT)?CODE|RETURNDATA)COPY",
)


@pytest.mark.parametrize("name", NAMES)
def test_opcodes_are_of_the_kind_of_their_name(name: str, profiles: dict[str, Profile]) -> None:
    from eth.vm.forks.cancun.opcodes import CANCUN_OPCODES

    gas = dict.fromkeys(KINDS, 0)
    root, result = trace("Renderer", render_call(SMALL_SCENES[name]))
    for frame in root.frames():
        code = artifact(frame.contract).runtime
        for costs in frame.costs.values():
            for at, each in costs.items():
                mnemonic = CANCUN_OPCODES[code[at]].mnemonic
                number = next((n for n, names in enumerate(MNEMONICS) if re.fullmatch(names, mnemonic)), -1)
                gas[KINDS[number]] += each
    found = profiles[name]
    assert found.opcodes() == gas
    assert sum(gas.values()) == result.gas
    assert min(gas.values()) > 0
    for stage, whole in found.stages().items():
        assert sum(found.opcodes(stage).values()) == whole
    for function in found.functions():
        assert sum(found.opcodes(function=function.name).values()) == function.own


def test_stages_are_where_their_work_is(profiles: dict[str, Profile]) -> None:
    smooth, mixed, empty = (profiles[name].stages() for name in NAMES)
    assert all(smooth[stage] > 0 for stage in STAGES if stage != "rows of plain triangles")
    assert empty["compositor"] > 0
    for stage in ("primitive assembly", "shading set-up", "triangle set-up", "rows of plain triangles"):
        assert empty[stage] == 0
    # wires are drawn row by row
    assert mixed["rows of plain triangles"] > 0
    clipper = {each.name: each.own for each in profiles["clipped, wires, inverted"].functions()}
    assert any(name.startswith("Clipper.") for name in clipper)
    assert clipper["Compositor.invert"] > 0


def test_the_stack_of_calls_is_that_of_the_sources(profiles: dict[str, Profile]) -> None:
    found = profiles["smooth"]
    for cost in found.costs:
        assert cost.calls[0] == "Renderer"
        if cost.function.startswith("FragmentShader."):
            before = [call for call in cost.calls if not call.startswith("FragmentShader.")]
            assert "Renderer.callEngine" in before
            assert "Rasterizer.run" in before
            assert before.index("Engine") == before.index("Renderer.callEngine") + 1
        if cost.function == "VertexShader.project":
            assert "VertexShader.run" in cost.calls
            assert not any(call.startswith("Rasterizer") for call in cost.calls)


def test_calls_are_left_where_they_were_entered() -> None:
    """A missed way out of a function, or ends that the compiler has joined, would nest without end."""
    for scene in (SMALL_SCENES["smooth"], load("teapot", unlit=True, cull=True, size=64)):
        root, result = trace("Renderer", render_call(scene))
        assert 8 <= depth(root) <= 32
        assert sum(frame.gas() for frame in root.frames()) == result.gas
        assert sum(frame.contract.endswith("Engine") and frame.entry == 0 for frame in root.frames()) == 1


def depth(frame: CallFrame) -> int:
    """Return how deep calls nest in a frame."""
    return 1 + max(map(depth, frame.calls), default=0)


def test_lines_are_in_their_files(profiles: dict[str, Profile]) -> None:
    for found in profiles.values():
        for cost in found.costs:
            if cost.file:
                lines = (source(cost.file) or "").splitlines()
                assert 1 <= cost.line <= len(lines)
                assert lines[cost.line - 1].strip()
    # functions of Yul are found within their block of assembly; a constant may be told to be where it is declared
    found_in_assembly = 0
    for place, function, _ in profile(load("teapot", size=32, antialias=False)).lines():
        for owner, name in (("shading/SmoothTriangle", "along"), ("pixels/SmoothSpans", "span")):
            if function == f"{owner.partition('/')[2]}.{name}" and place.startswith(f"pipeline/{owner}.sol"):
                file, _, line = place.rpartition(":")
                assert f"function {name}(" in (source(file) or "").splitlines()[int(line) - 1]
                found_in_assembly += 1
    assert found_in_assembly == 2


@pytest.mark.parametrize("name", STANDARD)
def test_maps_cover_the_code(name: str) -> None:
    code = artifact(name).runtime
    found = source_map(name)
    at = 0
    # constants may stand behind the code
    end = max(found.places) + 1
    assert len(code) - end <= 32 * 4
    while at < end:
        assert at in found.places
        at += 1 + (code[at] - 0x5F if 0x60 <= code[at] <= 0x7F else 0)
    assert len(found.entries) > 20
    assert all(code[entry] == JUMPDEST for entry in found.entries)
    kinds = {place.jump for place in found.places.values()}
    assert kinds == {"i", "o", "-"}
    assert all(code[at] in (0x56, 0x57) for at, place in found.places.items() if place.jump != "-")


def test_the_flame_graph(profiles: dict[str, Profile]) -> None:
    found = profiles["smooth"]
    text = flame_graph(found, "<pot>")
    root = ElementTree.fromstring(text)
    boxes: list[tuple[str, float, float, float]] = []
    for title, rect, *_ in root.findall("{*}g"):
        x, y, width = (float(rect.attrib[key]) for key in ("x", "y", "width"))
        boxes.append((title.text or "", x, y, width))
    top = min(y for _, _, y, _ in boxes)
    first = [(title, width) for title, _, y, width in boxes if y == top]
    assert sum(width for _, width in first) == pytest.approx(WIDTH - 2 * MARGIN, rel=0.01)
    for title_of, width in first:
        stage, _, rest = title_of.rpartition(": ")
        gas = int(rest.split(" ")[0].replace(",", ""))
        assert gas == found.stages()[stage]
        assert width == pytest.approx((WIDTH - 2 * MARGIN) * gas / found.gas, abs=0.01)
    # boxes lie within those above them
    for _, x, y, width in boxes:
        above = [(left - 0.02, left + wide + 0.02) for _, left, row, wide in boxes if abs(row - (y - 18)) < 0.1]
        assert y == top or any(left <= x and x + width <= right for left, right in above)
    assert "prefers-color-scheme:dark" in text
    assert "&lt;pot&gt;" in text
