"""Shares of a year, computed by hand."""

from __future__ import annotations

import pytest
from benchmarks.energy import BLOCKS_PER_YEAR, CCAF_2023, CCRI_2022, Computer, Network, estimates


def test_a_year_of_gas_takes_a_year_of_electricity() -> None:
    assert BLOCKS_PER_YEAR == 2_629_800
    network = Network("test", electricity=1000, emissions=2, gas_per_block=10)
    assert network.kilowatt_hours(10 * BLOCKS_PER_YEAR) == pytest.approx(1000)
    assert network.grams(10 * BLOCKS_PER_YEAR / 4) == pytest.approx(500_000)


def test_a_call_takes_the_time_that_it_runs() -> None:
    computer = Computer(watts=100, gas_per_second=1e6, grams_per_kilowatt_hour=500)
    # an hour
    assert computer.kilowatt_hours(3600e6) == pytest.approx(0.1)
    assert computer.grams(3600e6) == pytest.approx(50)


def test_the_table_has_two_digits() -> None:
    text = estimates({"a block": 15e6}, {"a second": 500e6})
    lines = text.splitlines()
    assert [cell.strip() for cell in lines[0].strip("|").split("|")] == [
        "what",
        "gas",
        CCRI_2022.name,
        CCAF_2023.name,
        "one computer",
    ]
    # 2,601,000 kWh and 870 t in 2,629,800 blocks
    assert "| 990 Wh, 330 g |" in lines[2]
    assert "| 2,900 Wh, 1,100 g |" in lines[2]
    # 65 W for a second
    assert "| 0.018 Wh, 0.0087 g |" in lines[3]
