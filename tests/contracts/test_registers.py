"""The registers and words of the pipeline are made of one table: none may lie over another."""

from __future__ import annotations

import re
import tomllib
from itertools import pairwise
from pathlib import Path
from runpy import run_path

from tools import layout

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "contracts" / "src" / "words"
TABLE = tomllib.loads((ROOT / "contracts" / "layout.toml").read_text("utf-8"))


def constants(name: str) -> dict[str, int]:
    """The constants of a file of the contracts, as they stand there."""
    text = (FOLDER / name).read_text("utf-8")
    return {key: int(value, 0) for key, value in re.findall(r"^uint256 constant (\w+) = (\w+);", text, re.MULTILINE)}


WORDS = constants("Words.sol")
#: The registers of all engines, then of fewer.
FILES = [constants(f"{name}.sol") for name in layout.registers(TABLE)]
REGISTERS = {name: value for constants in FILES for name, value in constants.items()}
#: The names of registers, and the words of each.
SIZES = {
    name: words
    for part in TABLE["registers"]
    for names, words, _ in layout.rows_of_registers(part)
    for name in names.split()
    if words
}


def test_no_register_lies_over_another() -> None:
    assert len(SIZES) > 80
    places = sorted((REGISTERS[name], REGISTERS[name] + 32 * words, name) for name, words in SIZES.items())
    assert places[0][0] == REGISTERS["REGISTERS"]
    assert places[-1][1] == REGISTERS["EFFECT_REGISTERS_END"]
    for (_, end, name), (begin, _, other) in pairwise(places):
        assert end == begin, f"{name} and {other}"


def test_registers_of_fewer_engines_follow_the_others() -> None:
    ends = [max(value for name, value in names.items() if name in SIZES) for names in FILES]
    begins = [min(value for name, value in names.items() if name in SIZES) for names in FILES]
    for (before, end), begin in zip(
        zip(ends, ("REGISTERS_END", "SAMPLE_REGISTERS_END"), strict=False), begins[1:], strict=True
    ):
        assert before < REGISTERS[end] == begin


def test_records_of_lights_hold_their_fields() -> None:
    for part in TABLE["records"]:
        fields = [name for names, _, _ in layout.rows_of_registers(part) for name in names.split()]
        offsets = [REGISTERS[f"{part['name']}_{field}"] for field in fields]
        first = 0
        if "behind" in part:
            first = REGISTERS[part["behind"][1]] - REGISTERS[part["behind"][0]]
        assert offsets == list(range(first, first + 32 * len(fields), 32))
        assert offsets[-1] + 32 - first <= REGISTERS[f"{part['name']}_SIZE"]
    assert 4 * REGISTERS["LIGHT_SIZE"] == 32 * SIZES["LIGHTS"] == 32 * SIZES["OBJECT_LIGHTS"]


def test_mode_bits_are_bits_of_their_own() -> None:
    modes = [REGISTERS[name] for part in TABLE["flags"] for names, _ in part["rows"] for name in names.split()]
    assert len(set(modes)) == len(modes)
    assert all(value & (value - 1) == 0 for value in modes)
    # what the code gets from one bit by shifting another
    assert REGISTERS["HAS_SPECULAR"] == 4 * REGISTERS["IS_LIT"]
    assert REGISTERS["CROSSES_COLUMNS"] == WORDS["CROSSING_BIT"] >> WORDS["TRIANGLE_CROSSING_SHIFT"]


def test_fields_of_packed_words_do_not_overlap() -> None:
    for part in TABLE["words"]:
        fields = sorted((at, at + width, name) for name, at, width, _ in part["rows"])
        assert fields[-1][1] <= 256
        for (_, end, name), (begin, _, other) in pairwise(fields):
            assert end <= begin, f"{part['name']}: {name} and {other}"


def test_packed_words_are_drawn() -> None:
    """Each field of each word, with all its bits, in one line above the constants."""
    text = (FOLDER / "Words.sol").read_text("utf-8")
    for part in TABLE["words"]:
        (head,) = re.findall(rf"^// -+ {part['title']}\n((?:// .*\n)+)", text, re.MULTILINE)
        line = head.splitlines()[-1]
        drawn = re.findall(r"\| (\d+)(?:\.\.(\d+))? ([^|]+?)(?= \||$)", line)
        assert line == "// " + " ".join(f"| {low}{'..' * bool(high)}{high} {name}" for low, high, name in drawn)
        places = [(int(low), int(high or low)) for low, high, _ in drawn]
        assert all(low <= high < above for (low, high), (above, _) in pairwise(reversed(places)))
        fields = {(at, at + width - 1): name for name, at, width, _ in part["rows"]}
        names = {place: name for place, (_, _, name) in zip(places, drawn, strict=True)}
        assert {place: names[place].upper().replace(" ", "_") for place in fields} == fields


def test_kinds_of_records() -> None:
    """The tables of the contracts say what those of Python do, and those of the package of contracts' authors too."""
    found, made = constants("Records.sol"), run_path(str(ROOT / "src" / "shackled" / "scene" / "_records.py"))
    names = {found["OF_SCENE"]: "scene", found["OF_LIGHT"]: "light", found["OF_OBJECT"]: "object", 0: None}
    owners = {kind: owner for _, kind, owner, _, _ in TABLE["extensions"]["kinds"]}
    for kind in range(256):
        assert names[found["RECORD_OWNERS"] >> 2 * kind & 3] == owners.get(kind)
        size = found["RECORD_SIZES"] >> 8 * kind & 255
        assert (None if size == found["ANY_WORDS"] else size) == made["SIZES"].get(kind, 0)
        assert kind < made["LONG_KINDS"] or size == found["ANY_WORDS"] or size % 32 == 0
    kinds = [kind for _, kind, *_ in TABLE["extensions"]["kinds"]]
    assert kinds == sorted(set(kinds)) == list(made["SIZES"])
    web = (ROOT / "web" / "src" / "scene" / "records.ts").read_text("utf-8")
    for name, value in re.findall(r"^export const (\w+) = (\d+);", web, re.MULTILINE):
        assert found[name] == made[name] == int(value)


def test_every_number_of_the_table_is_used() -> None:
    """Fields of words and registers stand for their places; what is only a number is there for code."""
    files = [path for path in (ROOT / "contracts" / "src").rglob("*.sol") if path.name != "Words.sol"]
    used = {word for path in files for word in re.findall(r"\b[A-Z]\w+", path.read_text("utf-8"))}
    rows = [row[0] for kind in ("numbers", "lanes", "unions", "shifts") for part in TABLE[kind] for row in part["rows"]]
    assert not set(rows) - used


def test_no_number_of_39_to_41_hexadecimal_digits_which_would_be_an_address() -> None:
    assert layout.solidity_literal((1 << 160) - 1) == "0x00" + "f" * 40
    assert layout.solidity_literal(1 << 160) == "0x01" + "0" * 40
    assert layout.solidity_literal(1 << 152) == "0x0001" + "0" * 38
    assert layout.solidity_literal(1 << 164) == "0x1" + "0" * 41
