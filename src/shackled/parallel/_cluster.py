"""Machines: the workers of a dask.distributed cluster, each with an embedded EVM."""

from __future__ import annotations

import asyncio
import logging
import subprocess
import sys
import threading
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..chain import Drawing, open_chain
from ..errors import InputError, RenderError, ShackledError
from ..scene import Rectangle, Scene
from ._evm import draw_limited, limited
from ._store import contracts_digest

if TYPE_CHECKING:
    from distributed import Client

#: Seconds within which a scheduler must answer.
PATIENCE = 15
#: The parts that are on their way to each worker, so that none has to wait for the next.
AHEAD = 2
#: Seconds that a cluster of our own has to stop by itself.
STOPPING = 10
#: What dask says when the connection to its scheduler has broken.
LOST = ("connection-lost", "ConnectionResetError", "CommClosedError")


class ClusterPlace:
    """A cluster: one that runs at an address, or one of this machine, which ends with the job."""

    def __init__(
        self,
        address: str | None,
        jobs: int,
        chain: str | None = None,
        gas: int | None = None,
        distant: bool = False,
    ) -> None:
        """address: of a scheduler, as tcp://host:8786; None starts `jobs` workers here. chain, gas: as `ProcessPlace`.
        distant: whether what its workers draw may be wrong, although they are found to have the contracts that we have.

        InputError if dask.distributed is not installed, or a worker does not fit; RenderError if no cluster is there.
        """
        try:
            from distributed import Client
        except ImportError:
            raise InputError(
                "`cluster` needs a package that is not installed: pip install 'shackled[cluster]'"
            ) from None

        class QuietClient(Client):  # type: ignore[misc,unused-ignore]
            def __del__(self) -> None:
                """We close it, and one that could not be opened is not waited for."""

        self.gas, self._chain, self.distant = gas, chain, distant
        limited(chain, gas)
        # what it reports of a lost connection, with a traceback, comes out as an error here
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
        self.seats = AHEAD * workers
        self._name = f"dask cluster, {open_chain(chain).name}, {workers} worker" + ("s" if workers != 1 else "")

    @property
    def name(self) -> str:
        """What it is, for people."""
        return self._name

    def work(self, seat: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Renders a part on whichever worker is free."""
        from distributed import KilledWorker

        try:
            future = self._client.submit(draw_limited, self._chain, self.gas, scene, tile, pure=False)
            answer = future.result()
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
        assert isinstance(answer, Drawing)
        return answer

    def close(self) -> None:
        """Leaves the cluster, which drops what it still has to do for us; one of our own is stopped."""
        if hasattr(self, "_client"):
            with suppress(Exception):
                self._client.close(timeout=5)  # type: ignore[no-untyped-call]
        self._logger.setLevel(self._level)
        local, self._local = self._local, None
        if local is not None:
            # the end of its input ends it
            local.stdin.close()  # type: ignore[union-attr]
            try:
                local.wait(STOPPING)
            except subprocess.TimeoutExpired:
                local.kill()
                local.wait()
            local.stdout.close()  # type: ignore[union-attr]

    def _start(self, jobs: int) -> str:
        """The address of a cluster of our own, in a process that ends with this one."""
        self._local = subprocess.Popen(
            [sys.executable, "-m", f"{__package__}._local_cluster", str(jobs)],
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
        """How many workers there are; InputError if one cannot render what we do."""
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
            facts = self._client.run(_facts_function())
        except (OSError, TimeoutError) as error:
            raise RenderError(f"the dask cluster has no workers: {_line(error)}") from None
        except Exception as error:
            raise InputError(
                f"a worker of the cluster cannot run our code; has it the same Python? {_line(error)}"
            ) from None
        for worker, found in facts.items():
            if found is None:
                raise InputError(f"the worker {worker} lacks shackled: pip install shackled there")
            if found != contracts_digest().hex():
                raise InputError(f"the worker {worker} has other contracts: install the same version of shackled there")
        return len(facts)


def _facts_function() -> Any:
    """A function that is sent whole, as it must run where shackled may be missing."""

    def facts() -> str | None:
        try:
            from shackled.parallel._store import contracts_digest

            return contracts_digest().hex()
        except ImportError:
            return None

    return facts


def _greet(address: str) -> None:
    """Shakes hands with a scheduler. An error, whatever it may be, if none is there: a client would wait for ever for
    something else that says nothing.
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
    # a notebook has a loop in its thread already
    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    thread.join(2 * PATIENCE)
    error = ended[0] if ended else TimeoutError()
    if error is not None:
        raise OSError("it says nothing") if isinstance(error, TimeoutError) else error


def _line(error: BaseException) -> str:
    return " ".join((str(error) or type(error).__name__).split())[:200]
