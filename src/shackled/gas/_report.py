"""All figures of the gas of one picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from ..chain._chain import ContractChain
from ..chain._node import NodeChain
from ..ethereum._amounts import ETHER, GWEI
from ..scene._scene import Scene
from ._limits import ExactGas, Fit, fits_as_json, fits_of, measure, render_call
from ._profile import Profile, profile
from ._quick_path import missed_quick_path
from ._search import Search, SearchStep, search, suffices


@dataclass(frozen=True)
class GasReport:
    """What a picture costs.

    triangles, lit_pixels: as `Chain.count` counts them. profile: None if it was not wanted. chain: the name of the
    chain that measured it.
    """

    scene: Scene
    exact: ExactGas
    search: Search
    triangles: int
    lit_pixels: int
    profile: Profile | None
    chain: str

    @property
    def request_limit(self) -> int:
        """Return the gas limit that a transaction or an eth_call needs, intrinsic gas included."""
        return self.exact.limit(self.search.gas)

    @property
    def fits(self) -> tuple[Fit, ...]:
        """Return how the picture fits into each known limit, the smallest first."""
        return fits_of(self.exact.gas, render_call(self.scene), lambda gas: gas >= self.search.gas)

    def per(self, count: int) -> float | None:
        """Return the gas for each of so many; None for none."""
        return self.exact.gas / count if count else None

    def ether(self, gas_price: float) -> float:
        """Return the price of a transaction, by the price of gas in gwei."""
        return self.exact.transaction_gas * gas_price / (ETHER // GWEI)

    def to_json(self, gas_price: float, eth_price: float | None) -> dict[str, Any]:
        """Return the object that `shackled gas --json` prints."""
        ether = self.ether(gas_price)
        return {
            "width": self.scene.width,
            "height": self.scene.height,
            "triangles": self.triangles,
            "lit_pixels": self.lit_pixels,
            "gas": self.exact.gas,
            "searched_gas": self.search.gas,
            "search_calls": self.search.calls,
            "search_steps": [asdict(step) for step in self.search.steps],
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
            "missed_quick_path": missed_quick_path(self.scene),
            "fits": fits_as_json(self.fits),
            "chain": self.chain,
        }


def make_report(
    scene: Scene,
    chain: ContractChain,
    stages: bool = True,
    on_step: Callable[[SearchStep], None] | None = None,
    searched: NodeChain | None = None,
) -> GasReport:
    """Measure a render, search for its gas limit, and trace it.

    on_step: called after each step of the search. searched: where to search; None is `chain`.
    """
    exact = measure(scene, chain)
    data = render_call(scene)
    found = search(suffices(searched or chain, "Renderer", data), on_step)
    triangles, lit_pixels = chain.count(scene)
    costs = profile(scene) if stages else None
    return GasReport(scene, exact, found, triangles, lit_pixels, costs, chain.name)
