"""The tool that compiles the contracts."""

from __future__ import annotations

import builtins
import json
import re
import sys
from pathlib import Path
from random import Random

import pytest
from tools import build_contracts as tool
from tools import comment_lines

from compiler import needs_compiler
from shackled.artifacts import RENDERER, artifact, contracts, source, standard_input

ROOT = Path(__file__).resolve().parent.parent
#: Bytes that every contract keeps free.
ROOM = 500


def build(monkeypatch: pytest.MonkeyPatch, folder: Path, group: str, files: dict[str, str]) -> None:
    """Let the tool find that these are the files of a group, and write into a folder."""
    monkeypatch.setattr(tool, "ARTIFACTS", folder)
    monkeypatch.setattr(tool, "build", lambda **_: files)
    monkeypatch.setattr(sys, "argv", ["build_contracts.py", "--group", group])


def test_a_closed_pipe_leaves_no_old_artifacts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `tools/build_contracts.py | head -1`: what was built is written before anything is printed."""
    text = '{"contract": "Thing", "deployedBytecode": "00", "group": "calls"}\n'
    build(monkeypatch, tmp_path, "calls", {"Thing.json": text, tool.SOURCE_MAPS: "{}"})
    (tmp_path / "Old.json").write_text(text)
    (tmp_path / "of-no-group.json").write_text("{}")

    def closed(*_: object, **__: object) -> None:
        raise BrokenPipeError

    monkeypatch.setattr(builtins, "print", closed)
    with pytest.raises(BrokenPipeError):
        tool.main()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["Thing.json", tool.SOURCE_MAPS]


def test_every_contract_is_in_one_group(monkeypatch: pytest.MonkeyPatch) -> None:
    found = tool.find_contracts()
    assert sorted(found) == sorted(contracts())
    for name in found:
        built = json.loads((tool.ARTIFACTS / f"{name}.json").read_text("utf-8"))
        assert (built["group"], built["source"]) == (tool.group_of(name), found[name])
        assert built["settings"] == tool.settings_of(name)
        # room below the limit of EIP-170, so that a repair fits
        room = tool.MAX_RUNTIME_SIZE - len(artifact(name).runtime)
        assert room >= ROOM, f"see tools/build_contracts.py --functions {name}"
    monkeypatch.setattr(tool, "GROUPS", {"one": {"contracts": [*found, "Engine", "Nothing"]}})
    with pytest.raises(SystemExit, match="each contract once: Engine, Nothing"):
        tool.find_contracts()


@needs_compiler
def test_inputs_of_the_package_are_those_of_the_sources() -> None:
    for group in tool.GROUPS:
        assert standard_input(group) == tool.standard_input(group), f"run tools/build_contracts.py --group {group}"


def test_groups_of_another_text_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After `--group glb`, when a source that other groups share has changed; and the build fails."""
    build(monkeypatch, tmp_path, "glb", {"Glb.json": "{}"})
    sources = {"scene/Scene.sol": tool.digest("old"), "scene/Mesh.sol": tool.digest(source("scene/Mesh.sol") or "")}
    (tmp_path / "Engine.json").write_text(json.dumps({"group": "engine", "sources": sources}))
    assert tool.outdated(["glb"]) == ["compile the groups engine, too: scene/Scene.sol has changed"]
    assert tool.outdated(["engine"]) == []
    monkeypatch.setattr(tool, "report_sizes", lambda _: True)
    assert tool.main() == 1
    assert (tmp_path / "Glb.json").read_text() == "{}"


def test_source_maps_of_groups_are_merged() -> None:
    """Each run of the compiler numbers sources in its own way; what is no source of ours has none."""
    a, b = {"name": "a.sol", "functions": []}, {"name": "b.sol", "functions": []}
    one = {"contracts": {"Two": {"map": "1:2:7:-;;3:4:9:i", "entries": {}}}, "sources": {"7": b}}
    other = {"contracts": {"One": {"map": "5:6:0:o;:7;0:0:7:-", "entries": {}}}, "sources": {"0": a, "7": b}}
    merged = json.loads(tool.merge_maps([one, other]))
    assert merged["sources"] == {"0": a, "1": b}
    assert merged["contracts"]["One"]["map"] == "5:6:0:o;:7;0:0:1:-"
    assert merged["contracts"]["Two"]["map"] == "1:2:1:-;;3:4:-1:i"


def test_functions_that_grew_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def files(code: str, entries: str) -> dict[str, str]:
        """`A.f` and `A.g` have the bytes of the file from 0 and from 10 on."""
        maps = {
            "contracts": {"Thing": {"map": entries, "entries": {}}},
            "sources": {"0": {"name": "a.sol", "functions": [["A.f", 0, 10], ["A.g", 10, 10]]}},
        }
        thing = {"contract": "Thing", "deployedBytecode": code, "group": "calls"}
        return {"Thing.json": json.dumps(thing), tool.SOURCE_MAPS: json.dumps(maps)}

    monkeypatch.setattr(tool, "outdated", lambda _: [])
    for code, entries, said in (
        ("5b5b5b", "0:1:0;10;11", []),  # nothing was there before
        # three bytes more of f, one less of g
        ("5b61ffff5b", "0:1:0;1;11", ["functions with more bytes than before:", "Thing: A.f 1 -> 4"]),
        ("5b61ffff5b", "0:1:0;1;11", []),
    ):
        build(monkeypatch, tmp_path, "calls", files(code, entries))
        assert tool.main() == 0
        assert capsys.readouterr().out.splitlines()[1:] == said


def test_bytes_are_counted_for_their_function() -> None:
    """By hand: pushed values belong to their instruction, and an empty field repeats the one before."""
    sources = {"0": {"name": "a.sol", "functions": [["A.g", 50, 10], ["A.f", 10, 20]]}}
    # PUSH2 in f, PUSH1 in g; ADD before any function, DUP1 between the two, STOP behind both; two of no source
    code = bytes.fromhex("610102600301800050fe")
    entries = "10:5:0:-;59:1;9;30;60;1:1:-1;10"
    assert tool.function_sizes(code, entries, sources) == {"A.f": 3, "A.g": 2, "a.sol": 3, "compiler": 2}
    maps = json.loads((tool.ARTIFACTS / tool.SOURCE_MAPS).read_text("utf-8"))
    for name in contracts():
        code = artifact(name).runtime
        counted = tool.function_sizes(code, maps["contracts"][name]["map"], maps["sources"])
        assert counted.total() == len(code)
        # most of it is ours
        assert counted["compiler"] < 0.4 * len(code), name


#: A constant that is not pushed but read from behind the code, at 27 gas in place of 3: PUSH0 MLOAD (what the scratch
#: word held), PUSH1 32, PUSH2 where, PUSH0 CODECOPY.
READ_BY_CODECOPY = re.compile(rb"\x5f\x51\x60\x20\x61..\x5f\x39", re.DOTALL)


@pytest.mark.parametrize("name", RENDERER)
def test_no_constant_is_read_by_codecopy(name: str) -> None:
    """Below some number of runs, the compiler does that with large constants that are used often, in loops, too."""
    assert READ_BY_CODECOPY.search(bytes.fromhex("5b5f5160206112345f395f51905f525b"))
    found = READ_BY_CODECOPY.search(artifact(name).runtime)
    assert found is None, f"at {found.start()}: see tools/gas_blocks.py; fewer uses, or more runs in groups.toml"


def test_lines_of_documentation_stand_before_declarations_that_have_none() -> None:
    text = source("words/Memory.sol") or ""
    lines = text.split("\n")
    found = [lines[i] for i in comment_lines.places(text)]
    assert "function freeMemory() pure returns (uint256) {" in found
    assert any(line.startswith("function load(") for line in found)
    assert not any("ZERO_SLOT" in line or "function reserveRegisters" in line for line in found)
    sources = {"words/Memory.sol": text, "of-a-library.sol": text}
    made = comment_lines.commented(sources, 5, Random(1))
    assert made["of-a-library.sol"] == text
    assert made["words/Memory.sol"].split("\n").count("/// @dev x.") == 5
    assert made["words/Memory.sol"].replace("/// @dev x.\n", "") == text


@needs_compiler
def test_lines_of_documentation_change_no_byte() -> None:
    """All groups: tools/comment_lines.py."""
    assert comment_lines.changes("antialiased-fragments", tool.compile_once) == []


def test_documentation_names_one_thing_a_tag_in_lines_that_are_not_too_long() -> None:
    """In `@param a The ... b The ...` what is said of `b` would be part of the text of `a`."""
    inherited = "".join(path.read_text("utf-8") for path in (ROOT / "contracts" / "src" / "interfaces").glob("I*.sol"))
    for path in (ROOT / "contracts" / "src").rglob("*.sol"):
        text = path.read_text("utf-8")
        assert max(map(len, text.splitlines())) <= 140, path.name
        for found in re.finditer(
            r"((?:^ *///.*\n)*)^ +function (\w+)\([^{;]*?\) (?:external|public)[^{;]*[{;]", text, re.MULTILINE
        ):
            documented = "@notice" in found[1] or "@inheritdoc" in found[1] or " override" in found[0]
            # of an interface that the contract inherits
            documented |= "/interfaces/I" in text and f"function {found[2]}(" in inherited
            assert documented, f"{path.name}: {found[2]}"
