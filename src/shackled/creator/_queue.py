"""A queue of jobs for worker processes, whose time is shared fairly between visitors."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

from ..errors import ChainError, InputError, ShackledError
from ..workers import Worker, WorkerEndedError, WorkerLateError
from ._store import Limits
from ._tasks import MakeTasks, MissingUploadError, Tasks, perform, prepare

log = logging.getLogger(__name__)

Supply = Callable[[], dict[str, Any]]
Progress = Callable[[int, int], None]

#: Largest number of seconds by which a visitor can be behind the others; it bounds the waiting after large jobs.
BEHIND = 1.0
#: Largest number of waiting jobs of one visitor; a page has far fewer.
MAX_OF_ONE = 50


class PoolError(ShackledError):
    """A job could not be done: it took too long or too much memory, or too many jobs are waiting. One line."""


@dataclass(eq=False)
class Job:
    """A task that a visitor waits for.

    newest: whether it replaces waiting jobs of the same visitor and channel. supply: returns the uploads that a worker
    may lack. worker: that does the task. stopped: whether its result is no longer awaited.
    """

    visitor: str
    channel: str
    task: str
    arguments: tuple[Any, ...]
    newest: bool
    supply: Supply | None
    progress: Progress | None
    answer: asyncio.Future[Any]
    worker: Worker | None = None
    stopped: bool = False
    timer: asyncio.TimerHandle | None = None


class Queue:
    """Jobs of all visitors for one kind of worker.

    Of each channel of a visitor, one job runs at a time. The next job is that of the waiting visitor on whom the least
    time was spent; for jobs of equal cost this is round robin. A new or returning visitor begins level with those who
    are being served.
    """

    def __init__(
        self,
        what: str,
        workers: int,
        limits: Limits,
        seconds: float,
        grace: float = 0.0,
        niceness: int = 0,
        guarded: bool = False,
        make_tasks: MakeTasks = Tasks,
    ) -> None:
        """Start no worker yet.

        what: name of the work in messages. workers: number of processes. seconds: time limit of a job. grace: seconds
        that a job may continue after its result is no longer awaited. niceness, guarded, make_tasks: of the workers;
        see `prepare`.
        """
        self._what = what
        self._seconds = seconds
        self._most = limits.waiting
        self._grace = grace
        self._workers = [
            Worker(prepare, make_tasks, limits, guarded, memory=limits.memory, niceness=niceness)
            for _ in range(workers)
        ]
        self._threads = ThreadPoolExecutor(workers, "creator")
        self._idle = list(self._workers)
        self._waiting: dict[str, list[Job]] = {}
        self._spent: dict[str, float] = {}
        self._served = 0.0
        self._running: set[Job] = set()
        self._tasks: set[asyncio.Task[None]] = set()
        self._closed = False

    async def warm(self) -> None:
        """Start all workers. PoolError if one does not start."""
        try:
            await asyncio.gather(*(self._call(worker, "warm", ()) for worker in self._workers))
        except Exception as error:
            raise self._error(error) from None

    async def ask(
        self,
        visitor: str,
        channel: str,
        task: str,
        arguments: tuple[Any, ...],
        newest: bool = False,
        supply: Supply | None = None,
        progress: Progress | None = None,
    ) -> Any:
        """Return the result of a task; None if a newer job replaced it or the visitor left. See `Job`.

        visitor: "" for jobs of which all visitors use the result. PoolError if too many jobs are waiting.
        """
        if self._closed:
            raise PoolError("the Creator is being closed")
        if sum(map(len, self._waiting.values())) >= self._most:
            raise PoolError("too many visitors are waiting; try again in a moment")
        if visitor and len(self._waiting.get(visitor, ())) >= MAX_OF_ONE:
            raise PoolError("too many of your requests are waiting; try again in a moment")
        loop = asyncio.get_running_loop()
        job = Job(visitor, channel, task, arguments, newest, supply, progress, loop.create_future())
        if newest:
            self.supersede(visitor, channel)
        self._arrive(visitor)
        self._waiting.setdefault(visitor, []).append(job)
        self._dispatch()
        try:
            return await job.answer
        except asyncio.CancelledError:
            self._stop(job)
            raise

    def leave(self, visitor: str) -> None:
        """Drop all jobs of a visitor; their results are None."""
        for job in [*self._waiting.get(visitor, ()), *(job for job in self._running if job.visitor == visitor)]:
            self._stop(job)
            _settle(job, None)
        self._spent.pop(visitor, None)

    def supersede(self, visitor: str, channel: str) -> None:
        """Drop the waiting jobs of a channel; end a running one after the grace period."""
        for job in [job for job in self._waiting.get(visitor, ()) if job.channel == channel]:
            self._stop(job)
            _settle(job, None)
        for job in self._running:
            if job.visitor == visitor and job.channel == channel:
                self._end_later(job)

    async def close(self) -> None:
        """End the workers; the results of all jobs are None."""
        self._closed = True
        for job in [*self._running, *(job for jobs in self._waiting.values() for job in jobs)]:
            job.stopped = True
            if job.timer is not None:
                job.timer.cancel()
            _settle(job, None)
        self._waiting.clear()
        await asyncio.gather(*(asyncio.to_thread(worker.close) for worker in self._workers))
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self._threads.shutdown()

    @property
    def processes(self) -> list[int]:
        """Process ids of the workers that have been started."""
        return [worker.pid for worker in self._workers if worker.pid is not None]

    def _arrive(self, visitor: str) -> None:
        """Bring a visitor without jobs level with those who are being served: it gains no priority by absence."""
        if visitor in self._waiting or any(job.visitor == visitor for job in self._running):
            return
        if len(self._spent) > 4 * self._most:
            active = {*self._waiting, *(job.visitor for job in self._running)}
            self._spent = {each: spent for each, spent in self._spent.items() if each in active}
        self._spent[visitor] = max(self._spent.get(visitor, 0.0), self._served)

    def _stop(self, job: Job) -> None:
        job.stopped = True
        if job in self._running:
            self._end_later(job)
            return
        jobs = self._waiting.get(job.visitor, [])
        if job in jobs:
            jobs.remove(job)
        if not jobs:
            self._waiting.pop(job.visitor, None)

    def _end_later(self, job: Job) -> None:
        if job.timer is None and not self._closed:
            job.timer = asyncio.get_running_loop().call_later(self._grace, self._end, job)

    def _end(self, job: Job) -> None:
        if job in self._running and job.worker is not None:
            job.stopped = True
            job.worker.kill()

    def _dispatch(self) -> None:
        while self._idle and not self._closed:
            job = self._next()
            if job is None:
                return
            job.worker = self._idle.pop()
            self._running.add(job)
            task = asyncio.get_running_loop().create_task(self._work(job, job.worker))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    def _next(self) -> Job | None:
        busy = {(job.visitor, job.channel) for job in self._running}
        for visitor in sorted(self._waiting, key=lambda each: self._spent.get(each, 0.0)):
            jobs = self._waiting[visitor]
            free = [job for job in jobs if (visitor, job.channel) not in busy]
            if free:
                job = next((job for job in free if job.newest), free[0])
                jobs.remove(job)
                # to the end, behind others on whom as much time was spent
                del self._waiting[visitor]
                if jobs:
                    self._waiting[visitor] = jobs
                self._served = max(self._served, self._spent.get(visitor, 0.0))
                return job
        return None

    async def _work(self, job: Job, worker: Worker) -> None:
        begun, seconds = time.monotonic(), None
        try:
            try:
                result, seconds = await self._call(worker, job.task, job.arguments, job)
            except MissingUploadError:
                if job.supply is None:
                    raise
                result, seconds = await self._call(worker, job.task, job.arguments, job, job.supply())
            _settle(job, result)
        except Exception as error:
            if isinstance(error, MemoryError | RecursionError):  # what is still in memory could affect later jobs
                await asyncio.to_thread(worker.end)
            if job.stopped:
                _settle(job, None)
            elif not job.answer.done():
                job.answer.set_exception(self._error(error))
        finally:
            if job.timer is not None:
                job.timer.cancel()
            self._running.discard(job)
            self._idle.append(worker)
            if job.visitor in self._spent:
                # a failed job counts with the time that passed
                spent = time.monotonic() - begun if seconds is None else seconds
                self._spent[job.visitor] = min(self._spent[job.visitor] + spent, self._served + BEHIND)
            self._dispatch()

    async def _call(
        self,
        worker: Worker,
        task: str,
        arguments: tuple[Any, ...],
        job: Job | None = None,
        uploads: dict[str, Any] | None = None,
    ) -> tuple[Any, float]:
        """Let a worker do a task; return its result and the seconds of processor time."""
        loop = asyncio.get_running_loop()

        def told(done: int, total: int) -> None:
            if job is not None and job.progress is not None:
                loop.call_soon_threadsafe(_report, job, done, total)

        def unwanted() -> bool:
            return self._closed or (job is not None and job.stopped)

        call = partial(
            worker.call,
            perform,
            task,
            arguments,
            uploads or {},
            seconds=self._seconds,
            on_progress=told,
            cancelled=unwanted,
        )
        return await loop.run_in_executor(self._threads, call)

    def _error(self, error: Exception) -> Exception:
        """Return an error for visitors."""
        if isinstance(error, WorkerLateError):
            return PoolError(
                f"the {self._what} took longer than the limit of {self._seconds:g} seconds; choose a smaller size or"
                " fewer triangles"
            )
        if isinstance(error, WorkerEndedError):
            return PoolError(f"the worker process of the {self._what} ended, perhaps for lack of memory; try again")
        if isinstance(error, InputError | ChainError):
            return error
        if isinstance(error, MemoryError | RecursionError):
            return PoolError(
                f"the {self._what} needs more memory than the limit; choose a smaller size or fewer triangles"
            )
        if isinstance(error, MissingUploadError):
            return PoolError(f"the {self._what} could not be made")
        # details may be private: they are logged and not shown
        log.error("an error in a worker:\n%s", error.__cause__ or repr(error))
        return PoolError(f"the {self._what} failed with an internal error ({type(error).__name__}), which was logged")


def _settle(job: Job, result: Any) -> None:
    if not job.answer.done():
        job.answer.set_result(result)


def _report(job: Job, done: int, total: int) -> None:
    if job.progress is not None and not job.stopped:
        job.progress(done, total)
