"""Where pictures are rendered, and in what portions."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from ..chain import DEFAULT_GAS_LIMIT, Chain, open_node
from ..checks import integer
from ..errors import ChainError, InputError, NodeError, OutOfGasError
from ._evm import limited
from ._listener import Listener
from ._place import ChainPlace, Place
from ._processes import ProcessPlace

MOST_JOBS = 256
#: How much of what nodes draw is compared.
VERIFY = ("all", "some", "none")
#: How often a node that is busy is asked while we get to know it.
ATTEMPTS = 4


@dataclass(frozen=True)
class Where:
    """chain: by name or itself; None takes the fastest EVM here.
    jobs: worker processes here, calls at a time to each node, or workers of a cluster of our own; None is 1, and for a
    cluster one for each processor.
    rpc: addresses of nodes. address: of a renderer that is deployed there. timeout: seconds that a node may take.
    cluster: address of a dask scheduler, "" for a cluster of our own.
    gas_limit: what a call may use. tile: width and height of the parts of a picture; None takes what fits.
    verify: how much of what nodes, or the machines of a cluster, draw is drawn once more here and compared: "all",
    "some" or "none"; None compares all of the pictures of nodes that take little gas, and some of others.
    """

    chain: Chain | str | None = None
    jobs: int | None = None
    rpc: Sequence[str] = ()
    address: str | None = None
    timeout: float | None = None
    cluster: str | None = None
    gas_limit: int | None = None
    tile: tuple[int, int] | None = None
    verify: str | None = None

    def __post_init__(self) -> None:
        jobs, gas = integer(self.jobs), integer(self.gas_limit)
        if self.jobs is not None and (jobs is None or not 1 <= jobs <= MOST_JOBS):
            raise InputError(f"`jobs` must be from 1 to {MOST_JOBS}, not {self.jobs!r}")
        if self.gas_limit is not None and (gas is None or not 1 <= gas <= DEFAULT_GAS_LIMIT):
            raise InputError(
                f"`gas_limit` must be a whole number of gas from 1 to {DEFAULT_GAS_LIMIT:,}, not {self.gas_limit!r}"
            )
        object.__setattr__(self, "jobs", jobs)
        object.__setattr__(self, "gas_limit", gas)
        if self.tile is not None:
            sides = tuple(integer(side) or 0 for side in self.tile)
            if min(sides) < 1:
                raise InputError(f"the sides of a `tile` must be whole numbers from 1, not {self.tile!r}")
            object.__setattr__(self, "tile", sides)
        if self.verify not in (None, *VERIFY):
            raise InputError(f"`verify` must be {', '.join(VERIFY[:-1])} or {VERIFY[-1]}, not {self.verify!r}")
        named = self.chain is None or isinstance(self.chain, str)
        if not named and (self.count > 1 or self.cluster is not None):
            raise InputError("a chain itself cannot be given to other processes: give its name")

    @property
    def count(self) -> int:
        """How many jobs there are."""
        return self.jobs or (os.cpu_count() or 1 if self.cluster == "" else 1)

    @property
    def alone(self) -> bool:
        """Whether a picture is one call in this process."""
        several = self.count > 1 or self.rpc or self.cluster is not None
        return not (several or self.gas_limit is not None or self.tile is not None)

    def open(self, listener: Listener) -> list[Place]:
        """The places. Nodes that cannot be used are left out with a warning, as long as there are others."""
        chain = self.chain
        if self.cluster is not None:
            from ._cluster import ClusterPlace

            assert chain is None or isinstance(chain, str)
            # of workers with the same contracts only what is asked for is compared
            return [ClusterPlace(self.cluster or None, self.count, chain, self.gas_limit, self.verify is not None)]
        if self.rpc:
            return self._open_nodes(listener)
        if chain is not None and not isinstance(chain, str):
            return [ChainPlace(chain, gas=self.gas_limit)]
        if self.count > 1:
            limited(chain, self.gas_limit)
            return [ProcessPlace(chain, self.count, self.gas_limit)]
        return [ChainPlace(limited(chain, self.gas_limit), gas=self.gas_limit)]

    def _open_nodes(self, listener: Listener) -> list[Place]:
        places: list[Place] = []
        last: ChainError
        urls = list(dict.fromkeys(self.rpc))
        for url in urls:
            try:
                places.append(self._open_node(url))
            except (NodeError, OutOfGasError) as error:
                if len(urls) == 1:
                    raise
                listener.warned(f"{error}; it is left out")
                last = error
        if not places:
            raise last
        return places

    def _open_node(self, url: str) -> Place:
        node = open_node(url, self.address, self.timeout)
        node.connection.attempts = ATTEMPTS
        most = node.gas_limit
        node.place("Renderer")  # an address with something else is refused before anything is rendered
        if not most:
            raise node.too_little()
        node.connection.attempts = 1
        gas = most if self.gas_limit is None else min(most, self.gas_limit)
        return ChainPlace(node, self.count, distant=True, gas=gas)
