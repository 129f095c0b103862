"""A backend of the workers of a dask.distributed cluster, each with an embedded EVM.

`python -m shackled.parallel._cluster WORKERS` starts a cluster on this machine, prints its address, and ends with its
standard input. It runs in a process of its own, since dask runs the main script again in each worker.
"""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..chain import Drawing, open_chain
from ..errors import InputError, RenderError, ShackledError, not_installed
from ..scene import Rectangle, Scene
from ._backends import ChainBackend, limited
from ._store import contracts_digest

if TYPE_CHECKING:
    from distributed import Client

#: Seconds within which a scheduler must answer.
PATIENCE = 15
#: Parts that are queued for each worker, so that none is idle between two.
AHEAD = 2
#: Seconds for a local cluster to stop, before it is killed.
STOPPING = 10
#: Parts of dask's messages when the connection to its scheduler has broken.
LOST = ("connection-lost", "ConnectionResetError", "CommClosedError")


class ClusterBackend:
    """A cluster at an address, or a local one, which ends with the job."""

    def __init__(
        self,
        address: str | None,
        jobs: int,
        chain: str | None = None,
        gas: int | None = None,
        untrusted: bool = False,
    ) -> None:
        """Connect to a cluster, and check that its workers have the same contracts.

        address: of a scheduler, as tcp://host:8786; None starts `jobs` local workers. chain: the name of an EVM.
        gas: limit of a call.
        Raises InputError if dask.distributed is missing, here or in a worker, or a worker has other contracts;
        RenderError if no cluster answers.
        """
        try:
            from distributed import Client
        except ImportError:
            raise not_installed("`cluster`", "cluster") from None

        class QuietClient(Client):  # type: ignore[misc,unused-ignore]
            def __del__(self) -> None:
                """Do not wait for a client that could not be opened."""

        self.gas, self._chain, self.untrusted = gas, chain, untrusted
        limited(chain, gas)
        # a lost connection is raised as an error here: do not log its traceback as well
        self._logger = logging.getLogger("distributed.client")
        self._level = self._logger.level
        self._logger.setLevel(logging.CRITICAL)
        self._local: subprocess.Popen[str] | None = None
        try:
            if address:
                _greet(address)
            found = address or self._start(jobs)
            self._client: Client = QuietClient(  # type: ignore[no-untyped-call]
                found, timeout=PATIENCE, set_as_default=False
            )
            workers = self._check()
        except BaseException as error:
            self.close()
            if isinstance(error, ShackledError) or not isinstance(error, Exception):
                raise
            raise RenderError(
                f"no dask scheduler answers at {address or 'a port of this machine'}: {_line(error)}"
            ) from None
        self.slots = AHEAD * workers
        self._name = f"dask cluster, {open_chain(chain).name}, {workers} worker" + ("s" if workers != 1 else "")

    @property
    def name(self) -> str:
        """Return the kind of cluster and the number of workers."""
        return self._name

    def render(self, slot: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Render a part on any free worker."""
        piece: Drawing = self._call("render", scene, tile)
        return piece

    def count(self, slot: int, scene: Scene, tile: Rectangle) -> tuple[int, int]:
        """Count the triangles of a part, and the pixels that they cover."""
        counts: tuple[int, int] = self._call("count", scene, tile)
        return counts

    def _call(self, method: str, scene: Scene, tile: Rectangle) -> Any:
        from distributed import KilledWorker

        try:
            return self._client.submit(_answer, method, self._chain, self.gas, scene, tile, pure=False).result()
        except KilledWorker:
            raise RenderError(
                "the workers of the cluster died over the same part of the picture, one after the other"
            ) from None
        except ShackledError:
            raise
        except Exception as error:
            said = f"{type(error).__name__}: {error}"
            lost = any(sign in said for sign in LOST)
            what = "its scheduler cannot be reached any more; is it running?" if lost else _line(error)
            raise RenderError(f"the cluster failed: {what}") from None

    def close(self) -> None:
        """Disconnect, which cancels queued parts, and stop a local cluster."""
        if hasattr(self, "_client"):
            with suppress(Exception):
                self._client.close(timeout=5)  # type: ignore[no-untyped-call]
        self._logger.setLevel(self._level)
        local, self._local = self._local, None
        if local is not None:
            # it ends with its standard input
            local.stdin.close()  # type: ignore[union-attr]
            try:
                local.wait(STOPPING)
            except subprocess.TimeoutExpired:
                local.kill()
                local.wait()
            local.stdout.close()  # type: ignore[union-attr]

    def _start(self, jobs: int) -> str:
        """Start a local cluster in a process that ends with this one; return its address."""
        self._local = subprocess.Popen(
            [sys.executable, "-m", __name__, str(jobs)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        address = self._local.stdout.readline().strip()  # type: ignore[union-attr]
        if not address:
            raise OSError("the cluster did not start")
        return address

    def _check(self) -> int:
        """Return the number of workers; raise InputError if one lacks the contracts."""
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
            facts = self._client.run(_facts_function())
        except (OSError, TimeoutError) as error:
            raise RenderError(f"the dask cluster has no workers: {_line(error)}") from None
        except Exception as error:
            raise InputError(
                f"a worker of the cluster cannot run this code; has it the same Python? {_line(error)}"
            ) from None
        for worker, found in facts.items():
            if found is None:
                raise InputError(f"the worker {worker} lacks shackled: pip install shackled there")
            if found != contracts_digest().hex():
                raise InputError(f"the worker {worker} has other contracts: install the same version of shackled there")
        return len(facts)


def _answer(method: str, chain: str | None, gas: int | None, scene: Scene, tile: Rectangle) -> Any:
    """Make a call of a worker, in its process. method: of `Backend`."""
    return getattr(ChainBackend(limited(chain, gas), gas=gas), method)(0, scene, tile)


def _facts_function() -> Any:
    """Return a function that dask pickles by value, since it must run where shackled may be missing."""

    def facts() -> str | None:
        try:
            from shackled.parallel._store import contracts_digest

            return contracts_digest().hex()
        except ImportError:
            return None

    return facts


def _greet(address: str) -> None:
    """Connect to a scheduler once; raise an error if none answers.

    A client would wait without limit for a server that accepts connections and is no scheduler.
    """
    from distributed.comm.core import connect
    from distributed.security import Security

    async def hands() -> None:
        arguments = Security().get_connection_args("client")  # type: ignore[no-untyped-call]
        made = connect(address, timeout=PATIENCE, **arguments)  # type: ignore[no-untyped-call]
        comm = await asyncio.wait_for(made, PATIENCE)
        await comm.close()

    def run() -> None:
        try:
            asyncio.run(hands())
            ended.append(None)
        except Exception as error:
            ended.append(error)

    ended: list[Exception | None] = []
    # in a thread, since a notebook already runs an event loop in its own
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(2 * PATIENCE)
    error = ended[0] if ended else TimeoutError()
    if error is not None:
        raise OSError("it does not answer") if isinstance(error, TimeoutError) else error


def _line(error: BaseException) -> str:
    return " ".join((str(error) or type(error).__name__).split())[:200]


def _run_cluster() -> None:
    from distributed import LocalCluster

    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=int(sys.argv[1]), threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
    ) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    _run_cluster()
