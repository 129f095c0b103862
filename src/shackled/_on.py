"""The values of the argument `on` of `render`: where calls run."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from attrs import field, frozen

from .chain import CHAINS, Chain, check_chain, check_timeout, check_url
from .checks import choice, whole
from .errors import InputError
from .ethereum import parse_address

if TYPE_CHECKING:
    from .parallel import Where


#: The most jobs, and how much of the pixels of nodes and clusters is compared.
MOST_JOBS = 256
VERIFY = ("all", "some", "none")


def _jobs(value: int | None) -> int | None:
    return None if value is None else whole(value, "`jobs`", 1, MOST_JOBS)


def _evm(value: str | None) -> str | None:
    return None if value is None else check_chain(value, "`evm`")


def _verify(value: str | None) -> str | None:
    return None if value is None else choice(value, "`verify`", VERIFY)


@frozen
class Processes:
    """Worker processes on this machine.

    jobs: number of processes, 1..256; None for one per processor.
    evm: "revm", "pyrevm" or "pyevm"; None for the first.
    """

    jobs: int | None = field(default=None, converter=_jobs)
    evm: str | None = field(default=None, converter=_evm)


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


def _timeout(value: float | None) -> float | None:
    return None if value is None else check_timeout(value)


def _scheduler(value: str | None) -> str | None:
    if value is not None and (not isinstance(value, str) or ":" not in value):
        raise InputError(f"`address` must be that of a scheduler, such as tcp://host:8786, not {value!r:.60}")
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
    timeout: float | None = field(default=None, converter=_timeout)
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


@frozen
class Cluster:
    """A dask cluster (the extra `cluster`).

    address: address of the scheduler, such as tcp://host:8786; None starts a cluster on this machine.
    jobs: number of workers of a cluster on this machine; None for one per processor.
    evm: as in `Processes`.
    verify: as in `Nodes`; None compares nothing.
    """

    address: str | None = field(default=None, converter=_scheduler)
    jobs: int | None = field(default=None, converter=_jobs)
    evm: str | None = field(default=None, converter=_evm)
    verify: str | None = field(default=None, converter=_verify)


#: Where calls run: in the EVM of this name, at the node of this address, in this EVM, or in one of these.
On = str | Chain | Processes | Nodes | Cluster


def where_of(on: On | None, gas_limit: int | None = None, tile: tuple[int, int] | None = None) -> Where:
    """Return where to render. InputError if `on` is something else."""
    from .parallel import Where

    if isinstance(on, str) and "://" in on:
        on = Nodes(on)
    if on is None or isinstance(on, str):
        return Where(None if on is None else check_chain(on, "`on`"), gas_limit=gas_limit, tile=tile)
    if isinstance(on, Processes):
        jobs = (os.cpu_count() or 1) if on.jobs is None else on.jobs
        return Where(on.evm, jobs, gas_limit=gas_limit, tile=tile)
    if isinstance(on, Nodes):
        return Where(
            jobs=on.jobs,
            rpc=on.urls,
            address=on.address,
            timeout=on.timeout,
            gas_limit=gas_limit,
            tile=tile,
            verify=on.verify,
        )
    if isinstance(on, Cluster):
        return Where(on.evm, on.jobs, cluster=on.address or "", gas_limit=gas_limit, tile=tile, verify=on.verify)
    if not hasattr(on, "draw"):
        raise InputError(f"`on` must be one of {', '.join(CHAINS)}, Processes, Nodes or Cluster, not {on!r:.60}")
    return Where(on, gas_limit=gas_limit, tile=tile)
