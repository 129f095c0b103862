"""Shares of a year, computed by hand."""

from __future__ import annotations

from benchmarks.energy import CCAF_2023, CCRI_2022, estimates


def test_the_table_has_two_digits() -> None:
    text = estimates({"a block": 15e6}, {"a second": 500e6})
    lines = text.splitlines()
    names = ["what", "gas", CCRI_2022.name, CCAF_2023.name, "one computer"]
    assert [cell.strip() for cell in lines[0].strip("|").split("|")] == names
    # 2,601,000 kWh and 870 t in 2,629,800 blocks
    assert "| 990 Wh, 330 g |" in lines[2]
    assert "| 2,900 Wh, 1,100 g |" in lines[2]
    # 65 W for a second
    assert "| 0.018 Wh, 0.0087 g |" in lines[3]
