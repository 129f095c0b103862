"""The backends of a job, as a user chooses them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from ..chain import DEFAULT_GAS_LIMIT, Chain, open_node
from ..checks import integer
from ..errors import ChainError, InputError, NodeError, OutOfGasError
from ..scene import Scene
from ._backends import Backend, ChainBackend, ProcessBackend, limited
from ._estimate import is_large
from ._scheduler import Listener

#: Attempts of a request to a node that is busy, before the job begins.
ATTEMPTS = 4


@dataclass(frozen=True)
class Where:
    """Where to render, and in parts of what size.

    chain: a name or a chain; None takes the fastest EVM here.
    jobs: worker processes, concurrent calls to each node, or workers of a local cluster; None is 1, and for a local
    cluster the number of processors.
    rpc: addresses of nodes. address: of a renderer that is deployed there. timeout: seconds for a call of a node.
    cluster: address of a dask scheduler; "" starts a local cluster.
    gas_limit: of a call. tile: width and height of parts; None chooses.
    verify: how many parts that nodes or a cluster rendered are rendered again here and compared: "all", "some" or
    "none"; None compares all parts of nodes' pictures that take little gas, and a sample of others.
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
        gas = integer(self.gas_limit)
        if self.gas_limit is not None and (gas is None or not 1 <= gas <= DEFAULT_GAS_LIMIT):
            raise InputError(
                f"`gas_limit` must be a whole number of gas from 1 to {DEFAULT_GAS_LIMIT:,}, not {self.gas_limit!r}"
            )
        object.__setattr__(self, "gas_limit", gas)
        if self.tile is not None:
            sides = tuple(integer(side) or 0 for side in self.tile)
            if min(sides) < 1:
                raise InputError(f"the sides of a `tile` must be whole numbers from 1, not {self.tile!r}")
            object.__setattr__(self, "tile", sides)

    @property
    def count(self) -> int:
        """Return the number of jobs."""
        return self.jobs or (os.cpu_count() or 1 if self.cluster == "" else 1)

    def is_one_call(self, scene: Scene) -> bool:
        """Return whether a picture is one call in this process."""
        several = self.count > 1 or self.rpc or self.cluster is not None or is_large(scene)
        return not (several or self.gas_limit is not None or self.tile is not None)

    def open(self, listener: Listener) -> list[Backend]:
        """Open the backends; nodes that fail are dropped with a warning, as long as others work."""
        chain = self.chain
        if self.cluster is not None:
            from ._cluster import ClusterBackend

            assert chain is None or isinstance(chain, str)
            # workers with the same contracts are trusted, unless `verify` is given
            return [ClusterBackend(self.cluster or None, self.count, chain, self.gas_limit, self.verify is not None)]
        if self.rpc:
            return self._open_nodes(listener)
        if chain is not None and not isinstance(chain, str):
            return [ChainBackend(chain, gas=self.gas_limit)]
        if self.count > 1:
            limited(chain, self.gas_limit)
            return [ProcessBackend(chain, self.count, self.gas_limit)]
        return [ChainBackend(limited(chain, self.gas_limit), gas=self.gas_limit)]

    def _open_nodes(self, listener: Listener) -> list[Backend]:
        backends: list[Backend] = []
        last: ChainError
        urls = list(dict.fromkeys(self.rpc))
        for url in urls:
            try:
                backends.append(self._open_node(url))
            except (NodeError, OutOfGasError) as error:
                if len(urls) == 1:
                    raise
                listener.warned(f"{error}; it is left out")
                last = error
        if not backends:
            raise last
        return backends

    def _open_node(self, url: str) -> Backend:
        node = open_node(url, self.address, self.timeout)
        node.connection.attempts = ATTEMPTS
        most = node.gas_limit
        node.place("Renderer")  # fail early if something else is deployed at the address
        if not most:
            raise node.too_little()
        node.connection.attempts = 1
        gas = most if self.gas_limit is None else min(most, self.gas_limit)
        return ChainBackend(node, self.count, untrusted=True, gas=gas)
