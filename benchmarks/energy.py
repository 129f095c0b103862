"""Estimate electricity and carbon dioxide of transactions and read calls, from figures that can be changed.

Under proof of stake a network draws the same power whether its blocks are full or empty. What a transaction "uses" is
thus a share: its part of the gas of a year, of the electricity of that year. A read call runs on one computer.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, log10

from shackled.bench._report import table

BLOCKS_PER_YEAR = 365.25 * 24 * 3600 / 12


@dataclass(frozen=True)
class Network:
    """A year of a proof-of-stake network.

    electricity: kWh. emissions: tonnes of CO2 equivalent. gas_per_block: on average, in blocks of 12 seconds.
    """

    name: str
    electricity: float
    emissions: float
    gas_per_block: float = 15e6

    def kilowatt_hours(self, gas: float) -> float:
        """Return the share of so much gas."""
        return self.electricity * gas / (self.gas_per_block * BLOCKS_PER_YEAR)

    def grams(self, gas: float) -> float:
        """Return the grams of CO2 equivalent of so much gas."""
        return self.emissions * 1e6 * gas / (self.gas_per_block * BLOCKS_PER_YEAR)


@dataclass(frozen=True)
class Computer:
    """A computer that answers read calls. watts: what it draws beyond idling. gas_per_second: its speed."""

    watts: float = 65
    gas_per_second: float = 500e6
    grams_per_kilowatt_hour: float = 480

    def kilowatt_hours(self, gas: float) -> float:
        """Return the electricity of a call of so much gas."""
        return self.watts * gas / self.gas_per_second / 3.6e6

    def grams(self, gas: float) -> float:
        """Return the grams of CO2 equivalent of a call of so much gas."""
        return self.kilowatt_hours(gas) * self.grams_per_kilowatt_hour


#: Crypto Carbon Ratings Institute, "The Merge", September 2022: 2,601 MWh and 870 t a year.
CCRI_2022 = Network("CCRI 2022", 2_601_000, 870)
#: Cambridge Centre for Alternative Finance, December 2023: 7.50 GWh and 2.8 kt a year.
CCAF_2023 = Network("CCAF 2023", 7_500_000, 2_800)


def estimates(transactions: Mapping[str, float], calls: Mapping[str, float]) -> str:
    """Return a table: for each transaction the share of each network by its gas, for each call that of one computer."""
    networks, computer = (CCRI_2022, CCAF_2023), Computer()
    rows = [
        [f"transaction: {name}", f"{gas:,.0f}", *(_cell(network, gas) for network in networks), ""]
        for name, gas in transactions.items()
    ]
    rows += [
        [f"read call: {name}", f"{gas:,.0f}", *("" for _ in networks), _cell(computer, gas)]
        for name, gas in calls.items()
    ]
    return table(["what", "gas", *(network.name for network in networks), "one computer"], rows)


def _cell(of: Network | Computer, gas: float) -> str:
    watt_hours, grams = of.kilowatt_hours(gas) * 1000, of.grams(gas)
    return f"{_figures(watt_hours)} Wh, {_figures(grams)} g"


def _figures(value: float) -> str:
    """Format two significant digits, without an exponent."""
    places = 1 - floor(log10(value)) if value else 0
    return f"{round(value, places):,.{max(0, places)}f}"
