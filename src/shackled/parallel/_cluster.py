"""A backend of the workers of a dask.distributed cluster, each with an embedded EVM."""

from __future__ import annotations

import asyncio
import logging
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from ..base.values import plural
from ..chain._chain import Drawing
from ..chain._opening import open_chain
from ..errors import InputError, RenderError, ShackledError, not_installed
from ..scene._codec import Rectangle
from ..scene._scene import Scene
from ._backends import ChainBackend
from ._store import contracts_digest

if TYPE_CHECKING:
    from distributed import Client, Future

#: Seconds within which a scheduler must answer, and a cluster without workers must get one.
PATIENCE = 15
#: Seconds between two looks at which workers there are.
PAUSE = 0.5
#: Parts that are queued for each worker, so that none is idle between two.
AHEAD = 2
#: Parts of dask's messages when the connection to its scheduler has broken.
LOST = ("connection-lost", "ConnectionResetError", "CommClosedError")


class ClusterBackend:
    """A cluster at an address."""

    def __init__(self, address: str, chain: str | None = None, gas: int | None = None, untrusted: bool = False) -> None:
        """Connect to a cluster, and check that its workers have the same contracts.

        address: of a scheduler, as tcp://host:8786. chain: the name of an EVM. gas: limit of a call.
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
        open_chain(chain, gas)
        # a lost connection is raised as an error here: do not log its traceback as well
        self._logger = logging.getLogger("distributed.client")
        self._level = self._logger.level
        self._logger.setLevel(logging.CRITICAL)
        try:
            _greet(address)
            self._client: Client = QuietClient(  # type: ignore[no-untyped-call]
                address, timeout=PATIENCE, set_as_default=False
            )
            workers = self._greet_workers()
        except BaseException as error:
            self.close()
            if isinstance(error, ShackledError) or not isinstance(error, Exception):
                raise
            raise RenderError(f"no dask scheduler answers at {address}: {_line(error)}") from None
        self._workers, self._looked, self._seen = workers, 0.0, time.monotonic()
        self.slots = AHEAD * len(workers)
        self.name = f"dask cluster, {open_chain(chain).name}, {plural(len(workers), 'worker')}"

    def render(self, scene: Scene, tile: Rectangle) -> Drawing:
        """Render a part on any free worker."""
        piece = self._result(self.submit(_answer, self._chain, self.gas, scene, tile))
        if isinstance(piece, ShackledError):
            raise piece
        assert isinstance(piece, Drawing)
        return piece

    def submit(self, function: Callable[..., object], *given: object) -> Future[Any]:
        """Have any free worker call a function."""
        return self._client.submit(function, *given, pure=False)

    def wait(self, future: Future[Any], warned: Callable[[str], object]) -> Any:
        """Return the result of a call, or its error. warned: is told what `check` returns, whose errors are raised."""
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())  # type: ignore[no-untyped-call]
        while True:
            for text in self.check():
                warned(text)
            if done.wait(PAUSE):
                return self._result(future)

    def check(self) -> list[str]:
        """Return which workers have left the cluster; raise RenderError if there has been none for `PATIENCE` s."""
        now = time.monotonic()
        if now - self._looked < PAUSE:
            return []
        self._looked = now
        try:
            present = set(self._client.nthreads())  # type: ignore[no-untyped-call]
        except Exception:  # what waits for the scheduler fails, too
            return []
        gone, self._workers = self._workers - present, present
        if present or gone:
            self._seen = now
        elif now - self._seen > PATIENCE:
            raise RenderError(f"the dask cluster has had no worker for {PATIENCE} s: start one, and run this again")
        then = "others draw its parts" if present else f"no other is left; waiting {PATIENCE} s for one"
        return [f"the worker {each} has left the cluster: {then}" for each in sorted(gone)]

    def _result(self, future: Future[Any]) -> Any:
        """Return the result of a call or its error; RenderError where the cluster failed."""
        from distributed import KilledWorker

        try:
            return future.result()
        except KilledWorker:
            return RenderError("the workers of the cluster died over the same part of the picture, one after the other")
        except ShackledError as error:
            return error
        except Exception as error:
            lost = any(sign in f"{type(error).__name__}: {error}" for sign in LOST)
            what = "its scheduler cannot be reached any more; is it running?" if lost else _line(error)
            return RenderError(f"the cluster failed: {what}")

    def close(self) -> None:
        """Disconnect, which cancels queued parts."""
        if hasattr(self, "_client"):
            with suppress(Exception):
                self._client.close(timeout=5)  # type: ignore[no-untyped-call]
        self._logger.setLevel(self._level)

    def _greet_workers(self) -> set[str]:
        """Return the addresses of the workers; raise InputError if one lacks the contracts."""
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
        return set(facts)


def _answer(chain: str | None, gas: int | None, scene: Scene, tile: Rectangle) -> Drawing:
    """Render a part in the process of a worker."""
    return ChainBackend(open_chain(chain, gas), gas=gas).render(scene, tile)


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
    """Connect to a scheduler once: a client would wait without limit for a server that is no scheduler."""
    from distributed.comm.core import connect
    from distributed.security import Security

    async def greet() -> None:
        arguments = Security().get_connection_args("client")  # type: ignore[no-untyped-call]
        comm = await connect(address, timeout=PATIENCE, **arguments)  # type: ignore[no-untyped-call]
        await comm.close()

    # in a thread, since a notebook already runs an event loop in its own
    pool = ThreadPoolExecutor(1)
    try:
        pool.submit(asyncio.run, asyncio.wait_for(greet(), PATIENCE)).result(2 * PATIENCE)
    except TimeoutError:
        raise OSError("it does not answer") from None
    finally:
        pool.shutdown(wait=False)


def _line(error: BaseException) -> str:
    return " ".join((str(error) or type(error).__name__).split())[:200]
