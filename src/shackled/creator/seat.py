"""One worker process, seen from the page's process."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from .limits import Limits
from .worker import PROGRESS, READY, MakeDesk, Request, serve

#: Answers that the worker itself cannot give: it took too long, or it ended.
LATE, GONE = -1, -2

Progress = Callable[[int, int], None]

#: Seconds for a process to start, on a machine that is busy.
STARTING = 60.0


class Seat:
    """Holds a process, and another one when that has ended. `ask` runs in the thread of the seat."""

    def __init__(self, make_desk: MakeDesk, limits: Limits, niceness: int, guarded: bool) -> None:
        """As `worker.serve` takes them. Nothing is started yet."""
        self.thread = ThreadPoolExecutor(1, "creator")
        self._settings = make_desk, limits, niceness, guarded
        self._process: Any = None
        self._pipe: Connection | None = None
        self._closed = False

    def ask(
        self, request: Request, seconds: float, progress: Progress, is_stopped: Callable[[], bool] = bool
    ) -> tuple[Any, ...]:
        """The worker's answer, which begins with one of the codes of `worker`, or LATE or GONE.

        is_stopped: whether nobody wants it any more. Who says so then calls `kill`.
        """
        for attempt in range(2):
            # a process that was not there yet when it was to be killed is not given the work
            if not self._start() or is_stopped():
                return (GONE,)
            assert self._pipe is not None
            pipe = self._pipe
            try:
                pipe.send(request)
                break
            except (BrokenPipeError, ConnectionResetError):  # it had ended while it had nothing to do
                self.end()
                if attempt:
                    return (GONE,)
        deadline = time.monotonic() + seconds
        try:
            while pipe.poll(max(0.0, deadline - time.monotonic())):
                answer: tuple[Any, ...] = pipe.recv()
                if answer[0] != PROGRESS:
                    return answer
                progress(answer[1], answer[2])
        except (EOFError, OSError):
            self.end()
            return (GONE,)
        self.end()
        return (LATE,)

    def kill(self) -> None:
        """Ends the process at once, whatever it is at; from any thread. Who waits for its answer is told GONE."""
        process = self._process
        if process is not None:
            with suppress(OSError, ValueError, AttributeError):
                process.kill()

    def end(self) -> None:
        """Ends the process and frees what it held."""
        process, pipe = self._process, self._pipe
        self._process = self._pipe = None
        if process is not None:
            process.kill()
            process.join()
            process.close()
        if pipe is not None:
            pipe.close()

    def close(self) -> None:
        """No process from now on. Blocks until the thread has ended."""
        self._closed = True
        self.kill()
        self.thread.submit(self.end)
        self.thread.shutdown()

    @property
    def pid(self) -> int | None:
        """Of the process, if there is one."""
        process = self._process
        return None if process is None else process.pid

    def _start(self) -> bool:
        if self._process is not None and self._process.is_alive():
            return True
        self.end()
        if self._closed:
            return False
        context = multiprocessing.get_context("spawn")
        self._pipe, other = context.Pipe()
        self._process = context.Process(
            target=serve, args=(other, *self._settings), daemon=True, name="shackled creator worker"
        )
        self._process.start()
        other.close()
        try:
            if not self._closed and self._pipe.poll(STARTING) and self._pipe.recv() == (READY,):
                return True
        except (EOFError, OSError):
            pass
        self.end()
        return False
