"""The registers of the pipeline are numbered by hand: none may lie over another."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

SOURCE = Path(__file__).parents[1] / "contracts" / "src" / "pipeline" / "Registers.sol"
CONSTANTS = {
    name: int(value, 0)
    for name, value in re.findall(r"^uint256 constant (\w+) = (\w+);", SOURCE.read_text("utf-8"), re.MULTILINE)
}
#: Records and tables, by the words that they take.
SIZES = {"LIGHTS": 4 * 0x160, "SPECULAR_TABLE": 65 * 32}
MODES = {name: value for name, value in CONSTANTS.items() if name.startswith("IS_") or name == "HAS_SPECULAR"}
NO_ADDRESSES = {"REGISTERS", "REGISTERS_END", "ONES", "PIXEL_BIAS", "GUARD_BAND", "GUARD_BITS", "LIGHT_SIZE"}
OFFSETS = {name: value for name, value in CONSTANTS.items() if name.startswith("LIGHT_") and name != "LIGHT_SIZE"}
ADDRESSES = {
    name: value
    for name, value in CONSTANTS.items()
    if name not in MODES and name not in OFFSETS and name not in NO_ADDRESSES
}


def test_no_register_lies_over_another() -> None:
    assert len(ADDRESSES) > 80
    places = sorted((address, address + SIZES.get(name, 32), name) for name, address in ADDRESSES.items())
    assert places[0][0] == CONSTANTS["REGISTERS"]
    assert places[-1][1] <= CONSTANTS["REGISTERS_END"]
    for (_, end, name), (begin, _, other) in pairwise(places):
        assert end <= begin, f"{name} and {other}"


def test_records_of_lights_hold_their_fields() -> None:
    assert sorted(OFFSETS.values()) == list(range(0, CONSTANTS["LIGHT_SIZE"], 32))
    assert 4 * CONSTANTS["LIGHT_SIZE"] == SIZES["LIGHTS"]


def test_mode_bits_are_bits_of_their_own() -> None:
    assert len(set(MODES.values())) == len(MODES)
    assert all(value & (value - 1) == 0 for value in MODES.values())
    # what the code gets from one bit by shifting another
    assert CONSTANTS["HAS_SPECULAR"] == 4 * CONSTANTS["IS_LIT"]
    assert CONSTANTS["IS_BLOCKED"] | CONSTANTS["IS_BARYCENTRIC"] == 0x240
    assert CONSTANTS["IS_CROSSING"] == 1 << (147 - 139)
