"""The report of `shackled gas`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..chain import ContractChain
from ..scene import Scene
from ._exact import Exact, Margin, margin, measure, render_call
from ._limits import limits
from ._profile import Profile, profile
from ._search import Caller, Search, Step, search, suffices

GWEI_PER_ETHER = 10**9


@dataclass(frozen=True)
class Report:
    """The gas of one picture.

    triangles, lit_pixels: as returned by `Chain.count`.
    profile: None if not requested.
    chain: name of the chain that measured it.
    """

    scene: Scene
    exact: Exact
    search: Search
    triangles: int
    lit_pixels: int
    profile: Profile | None
    chain: str

    @property
    def margin(self) -> Margin:
        """The difference between the lowest sufficient limit and the gas used."""
        return margin(self.exact, self.search.gas)

    @property
    def request_limit(self) -> int:
        """The gas limit of a transaction or an eth_call, which includes intrinsic gas."""
        return self.exact.limit(self.search.gas)

    def per(self, count: int) -> float | None:
        """Return the gas divided by a count; None for 0."""
        return self.exact.gas / count if count else None

    def ether(self, gas_price: float) -> float:
        """Return the price of a transaction in ether, for a gas price in gwei."""
        return self.exact.transaction_gas * gas_price / GWEI_PER_ETHER

    def to_json(self, gas_price: float, eth_price: float | None) -> dict[str, Any]:
        """Return the object that `shackled gas --json` prints."""
        ether = self.ether(gas_price)
        return {
            "width": self.scene.width,
            "height": self.scene.height,
            "triangles": self.triangles,
            "lit_pixels": self.lit_pixels,
            "gas": self.exact.gas,
            "engine_gas": self.exact.engine_gas,
            "searched_gas": self.search.gas,
            "search_calls": self.search.calls,
            "search_steps": [
                {"limit": step.limit, "enough": step.enough, "lower": step.lower, "upper": step.upper}
                for step in self.search.steps
            ],
            "margin": {"gas": self.margin.gas, "kept": self.margin.kept, "after": self.margin.after},
            "intrinsic_gas": self.exact.intrinsic_gas,
            "stages": None if self.profile is None else self.profile.stages(),
            "gas_per_triangle": self.per(self.triangles),
            "gas_per_lit_pixel": self.per(self.lit_pixels),
            "transaction": {
                "gas": self.exact.transaction_gas,
                "gas_limit": self.request_limit,
                "gas_price_gwei": gas_price,
                "ether": ether,
                "usd": None if eth_price is None else ether * eth_price,
            },
            "fits": [
                {
                    "name": limit.name,
                    "limit": limit.gas,
                    "fits": self.request_limit <= limit.gas,
                    "source": limit.source,
                    "date": limit.date,
                    "remark": limit.remark,
                }
                for limit in limits()
            ],
            "chain": self.chain,
        }


def make_report(
    scene: Scene,
    chain: ContractChain,
    lower: int = 0,
    upper: int | None = None,
    stages: bool = True,
    on_step: Callable[[Step], None] | None = None,
    on_trace: Callable[[int, int], None] | None = None,
    searched: Caller | None = None,
) -> Report:
    """Measure a render, search for its gas limit, and profile it.

    lower, upper: limits of the search.
    stages: whether to profile.
    on_step: receives each step of the search.
    on_trace: receives the gas traced so far, and the total.
    searched: the chain of the search, if not `chain`.

    Raises InputError if `stages` is true and py-evm is not installed.
    """
    exact = measure(scene, chain)
    data = render_call(scene)
    found = search(suffices(searched or chain, "Renderer", data), lower, upper, on_step)
    triangles, lit_pixels = chain.count(scene)
    tell = None if on_trace is None else lambda used: on_trace(used, exact.gas)
    costs = profile(scene, tell) if stages else None
    return Report(scene, exact, found, triangles, lit_pixels, costs, chain.name)
