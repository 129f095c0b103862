"""Where a picture is rendered, as it is said to `render`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from attrs import field, frozen

from .chain import CHAINS, Chain
from .errors import InputError

if TYPE_CHECKING:
    from .parallel import Where


@frozen
class Processes:
    """Worker processes on this machine.

    jobs: how many, 1..256; None for one for each processor. evm: "pyrevm", "pyevm" or "reference"; None for the
    fastest that is installed.
    """

    jobs: int | None = None
    evm: str | None = None


def _urls(urls: tuple[str, ...]) -> tuple[str, ...]:
    if not urls or not all(isinstance(url, str) for url in urls):
        raise InputError(f"the addresses of nodes are needed, such as http://127.0.0.1:8545, not {urls!r:.60}")
    return urls


@frozen(init=False)
class Nodes:
    """Nodes with a JSON-RPC interface, by their addresses; several share the work.

    address: of a renderer that is deployed there; None takes the one that is known, or brings it along.
    timeout: seconds that a call may take. jobs: how many calls at a time to each node.
    verify: how much of what they draw is compared with what is drawn here, "all", "some" or "none"; None compares all,
    or some from 500 million gas on.
    """

    urls: tuple[str, ...] = field(converter=_urls)
    address: str | None = None
    timeout: float | None = None
    jobs: int = 1
    verify: str | None = None

    def __init__(
        self,
        *urls: str,
        address: str | None = None,
        timeout: float | None = None,
        jobs: int = 1,
        verify: str | None = None,
    ) -> None:
        """Name the nodes."""
        self.__attrs_init__(urls, address, timeout, jobs, verify)


@frozen
class Cluster:
    """Machines that share the work, with dask (the extra `cluster`).

    address: of its scheduler, such as tcp://host:8786; None for a cluster on this machine.
    jobs: workers of a cluster on this machine; None for one for each processor.
    evm, verify: as of `Processes` and `Nodes`; of a cluster nothing is compared unless asked for.
    """

    address: str | None = None
    jobs: int | None = None
    evm: str | None = None
    verify: str | None = None


#: Where: here, by an EVM of this name or itself; or in one of these places.
On = str | Chain | Processes | Nodes | Cluster


def where_of(on: On | None, gas_limit: int | None = None, tile: tuple[int, int] | None = None) -> Where:
    """Return where to render. InputError for what is no place."""
    from .parallel import Where

    if isinstance(on, str) and "://" in on:
        raise InputError(f"`on` must be Nodes({on!r:.60}) for a node, not its address alone")
    if on is None or isinstance(on, str):
        return Where(on, gas_limit=gas_limit, tile=tile)
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
