"""Where calls run: the values of the argument `on` of `render`, and the backends that make them."""

from __future__ import annotations

import os
from pathlib import Path

from attrs import field, frozen
from attrs.converters import optional

from ..base.checks import choice, flag, integer, whole
from ..chain._chain import Chain
from ..chain._connection import check_timeout, check_url
from ..chain._embedded import DEFAULT_GAS_LIMIT, RevmChain
from ..chain._opening import CHAINS, check_chain, open_chain, open_node
from ..errors import ChainError, InputError, NodeError, OutOfGasError
from ..ethereum._encoding import parse_address
from ..scene._scene import Scene
from ..scene._settings import size_of
from ._backends import Backend, ChainBackend
from ._scheduler import Listener
from ._tiles import is_large

#: The most jobs, and how much of the pixels of nodes and clusters is compared.
MOST_JOBS = 256
VERIFY = ("all", "some", "none")
#: Attempts of a request to a node that is busy, before the job begins.
ATTEMPTS = 4


def _jobs(value: int | None) -> int | None:
    return None if value is None else whole(value, "`jobs`", 1, MOST_JOBS)


def _evm(value: str | None) -> str | None:
    return None if value is None else check_chain(value, "`evm`")


def _verify(value: str | None) -> str | None:
    return None if value is None else choice(value, "`verify`", VERIFY)


@frozen
class Embedded:
    """One call at a time: in the EVM of a name, or on a chain that the caller made. None for revm."""

    chain: Chain | str | None = None
    verify: str | None = None

    @property
    def evm(self) -> str | None:
        """Return the name of the EVM; None for a chain that the caller made."""
        return self.chain if isinstance(self.chain, str) else None

    def opened(self, gas_limit: int | None = None) -> Chain:
        """Return the chain; one with a name has this limit for each call."""
        return open_chain(self.chain, gas_limit) if self.chain is None or isinstance(self.chain, str) else self.chain

    def open(self, listener: Listener, gas_limit: int | None = None) -> list[Backend]:
        """Return the backends of a job."""
        return [ChainBackend(self.opened(gas_limit), gas=gas_limit)]


@frozen
class Processes:
    """Calls at the same time on this machine, in threads; in processes only for several files of one command.

    jobs: number of calls at a time, 1..256; None for one per processor.
    evm: "revm", "pyrevm" or "pyevm"; None for the first. The others hold the lock of the interpreter, so that their
        calls run one after the other, which a warning says.
    """

    jobs: int | None = field(default=None, converter=_jobs)
    evm: str | None = field(default=None, converter=_evm)
    verify: None = field(default=None, init=False, repr=False)

    @property
    def count(self) -> int:
        """Return the number of calls at a time."""
        return self.jobs or os.cpu_count() or 1

    def open(self, listener: Listener, gas_limit: int | None = None) -> list[Backend]:
        """Return the backends of a job."""
        if self.evm in (None, "revm"):
            chain = RevmChain(gas_limit or DEFAULT_GAS_LIMIT, is_stoppable=True)
            chain.address("Renderer")  # set up here, before several threads ask for it
            return [ChainBackend(chain, self.count, gas=gas_limit)]
        listener.warned(f"{self.evm} holds the lock of the Python interpreter: its calls run one after the other")
        return Embedded(self.evm).open(listener, gas_limit)


def _urls(urls: tuple[str, ...]) -> tuple[str, ...]:
    if not urls or not all(isinstance(url, str) for url in urls):
        raise InputError(f"`urls` must be addresses of nodes, such as http://127.0.0.1:8545, not {urls!r:.60}")
    for url in urls:
        check_url(url, "`urls`")
    return urls


def _renderer(value: str | None) -> str | None:
    if value is not None:
        parse_address(value, "`address`")
    return value


def _scheduler(value: str) -> str:
    if not isinstance(value, str) or ":" not in value:
        raise InputError(f"a cluster needs the address of its scheduler, such as tcp://host:8786, not {value!r:.60}")
    return value


@frozen(init=False)
class Nodes:
    """JSON-RPC nodes, which share the work.

    urls: addresses of the nodes.
    address: address of a deployed renderer; None uses the known one, or sends the contracts with the call.
    timeout: time limit of a call in seconds; None for 120.
    jobs: number of concurrent calls per node.
    verify: how much is compared with the embedded EVM: "all", "some" or "none"; None compares all of a picture below
        500 million gas, and some of a larger one.
    """

    urls: tuple[str, ...] = field(converter=_urls)
    address: str | None = field(default=None, converter=_renderer)
    timeout: float | None = field(default=None, converter=optional(check_timeout))
    jobs: int | None = field(default=1, converter=_jobs)
    verify: str | None = field(default=None, converter=_verify)

    def __init__(
        self,
        *urls: str,
        address: str | None = None,
        timeout: float | None = None,
        jobs: int = 1,
        verify: str | None = None,
    ) -> None:
        """Take the addresses of the nodes."""
        self.__attrs_init__(urls, address, timeout, jobs, verify)

    def open(self, listener: Listener, gas_limit: int | None = None) -> list[Backend]:
        """Return the backends of a job. Nodes that fail are left out with a warning, as long as others work."""
        backends: list[Backend] = []
        last: ChainError
        urls = list(dict.fromkeys(self.urls))
        for url in urls:
            try:
                backends.append(self._open(url, gas_limit))
            except (NodeError, OutOfGasError) as error:
                if len(urls) == 1:
                    raise
                listener.warned(f"{error}; it is left out")
                last = error
        if not backends:
            raise last
        return backends

    def _open(self, url: str, gas_limit: int | None) -> Backend:
        node = open_node(url, self.address, self.timeout)
        node.connection.attempts = ATTEMPTS
        most = node.gas_limit
        node.place("Renderer")  # fail early if something else is deployed at the address
        if not most:
            raise node.too_little()
        node.connection.attempts = 1
        gas = most if gas_limit is None else min(most, gas_limit)
        return ChainBackend(node, self.jobs or 1, untrusted=True, gas=gas)


@frozen
class Cluster:
    """A dask cluster (the extra `cluster`).

    address: address of the scheduler, such as tcp://host:8786.
    evm: as in `Processes`.
    verify: as in `Nodes`; None compares nothing.
    """

    address: str = field(converter=_scheduler)
    evm: str | None = field(default=None, converter=_evm)
    verify: str | None = field(default=None, converter=_verify)

    def open(self, listener: Listener, gas_limit: int | None = None) -> list[Backend]:
        """Return the backends of a job."""
        from ._cluster import ClusterBackend  # takes a moment

        # workers with the same contracts are trusted, unless `verify` is given
        return [ClusterBackend(self.address, self.evm, gas_limit, self.verify is not None)]


#: Where calls run: in the EVM of this name, at the node of this address, in this EVM, or in one of these.
On = str | Chain | Processes | Nodes | Cluster
#: The same, as `place_of` returns it.
Place = Embedded | Processes | Nodes | Cluster


def place_of(on: On | Place | None) -> Place:
    """Return where calls run. InputError if `on` is something else."""
    if isinstance(on, str) and "://" in on:
        on = Nodes(on)
    if on is None or isinstance(on, str):
        return Embedded(None if on is None else check_chain(on, "`on`"))
    if isinstance(on, Processes):
        return Embedded(on.evm) if on.count == 1 else on
    if isinstance(on, Embedded | Nodes | Cluster):
        return on
    if not hasattr(on, "draw"):
        raise InputError(f"`on` must be one of {', '.join(CHAINS)}, Processes, Nodes or Cluster, not {on!r:.60}")
    return Embedded(on)


def _gas(value: int | None) -> int | None:
    gas = integer(value)
    if value is not None and (gas is None or not 1 <= gas <= DEFAULT_GAS_LIMIT):
        raise InputError(f"`gas_limit` must be a whole number of gas from 1 to {DEFAULT_GAS_LIMIT:,}, not {value!r}")
    return gas


def _tile(value: int | tuple[int, int] | None) -> tuple[int, int] | None:
    sides = None if value is None else size_of(value, "`tile`")
    if sides is not None and min(sides) < 1:
        raise InputError(f"the sides of a `tile` must be whole numbers from 1, not {value!r}")
    return sides


def _transparent(value: bool) -> bool:
    return flag(value, "`transparent`")


@frozen
class RenderOptions:
    """The arguments of `render` of these names, checked: where and how pictures are made."""

    on: Place = field(default=None, converter=place_of)
    gas_limit: int | None = field(default=None, converter=_gas)
    tile: tuple[int, int] | None = field(default=None, converter=_tile)
    listener: Listener | None = None
    keep: Path | None = None
    transparent: bool = field(default=False, converter=_transparent)

    def is_one_call(self, scene: Scene) -> bool:
        """Return whether a picture is made by one call in this process."""
        is_bounded = self.gas_limit is not None or self.tile is not None
        return isinstance(self.on, Embedded) and not is_bounded and not is_large(scene)
