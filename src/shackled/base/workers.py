"""Call a function for many items in worker processes, each of which may end at any time.

The processes are started as separate programs and not by `multiprocessing`, which would run the main script again in
each of them. They end with this process, however it ends.
"""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
import traceback
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from typing import IO, TypeVar

from ..errors import RenderError

Item = TypeVar("Item")
Result = TypeVar("Result")

#: Errors of streams to and from a process that has ended.
_BROKEN = (EOFError, OSError, ValueError, pickle.UnpicklingError)


class WorkerEndedError(RenderError):
    """The process ended before it answered; it may have been killed for lack of memory."""


def each(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    processes: int,
    lost: Callable[[WorkerEndedError], Result] | None = None,
) -> Iterator[tuple[int, Result]]:
    """Call a function for each item in several processes; yield (index of the item, result) as they are done.

    processes: 1 calls it in this process. lost: returns the result of an item whose process ended; None raises the
    error.
    """
    items = list(items)
    if processes <= 1:
        yield from ((place, function(item)) for place, item in enumerate(items))
        return
    workers = [_Worker() for _ in range(min(processes, len(items)))]
    idle: queue.SimpleQueue[_Worker] = queue.SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def work(item: Item) -> Result:
        worker = idle.get()
        try:
            return worker.call(function, item)
        except WorkerEndedError as error:
            if lost is None:
                raise
            return lost(error)
        finally:
            idle.put(worker)

    with ThreadPoolExecutor(max(1, len(workers))) as threads:
        try:
            futures = {threads.submit(work, item): place for place, item in enumerate(items)}
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            threads.shutdown(wait=False, cancel_futures=True)
            for worker in workers:
                worker.close()


class _Worker:
    """A process that calls functions, one after the other; started by the first call, and again after it has ended."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()
        self._closed = False

    def call(self, function: Callable[[Item], Result], item: Item) -> Result:
        """Call a function of a module in the process; return its result or raise its error, or WorkerEndedError."""
        process = self._started()
        assert process.stdout is not None
        try:
            _send(process.stdin, pickle.dumps((function, item), pickle.HIGHEST_PROTOCOL))
            succeeded, content = pickle.loads(pickle.load(process.stdout))
        except _BROKEN:
            with self._lock:
                self._end()
            raise WorkerEndedError("a worker process ended; is there enough memory?") from None
        if not succeeded:
            raise content
        return content  # type: ignore[no-any-return]

    def close(self) -> None:
        """Kill the process, from any thread, and start none again."""
        with self._lock:
            self._closed = True
            self._end()

    def _started(self) -> subprocess.Popen[bytes]:
        with self._lock:
            if self._closed:
                raise WorkerEndedError("the worker has been closed")
            if self._process is None or self._process.poll() is not None:
                self._end()
                # it imports the modules of functions by the same path, and in a new session Ctrl-C does not reach it
                self._process = subprocess.Popen(
                    [sys.executable, "-P", "-c", "from shackled.base.workers import _serve; _serve()"],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    env=os.environ | {"PYTHONPATH": os.pathsep.join(map(str, sys.path))},
                    start_new_session=True,
                )
            return self._process

    def _end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for stream in (process.stdin, process.stdout):
                with suppress(OSError):
                    assert stream is not None
                    stream.close()


def _send(stream: IO[bytes] | None, message: object) -> None:
    assert stream is not None
    pickle.dump(message, stream, pickle.HIGHEST_PROTOCOL)
    stream.flush()


# ---- in the worker ----


def _serve() -> None:
    """Make the calls that come by standard input until it is closed, which ends one that runs."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    # what a library prints goes to stderr
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    questions: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def read() -> None:
        with suppress(EOFError, OSError, pickle.UnpicklingError):
            while True:
                questions.put(pickle.load(sys.stdin.buffer))
        os._exit(0)

    threading.Thread(target=read, daemon=True).start()
    with suppress(OSError):
        while True:
            _send(answers, _perform(questions.get()))


def _perform(question: bytes) -> bytes:
    try:
        function, item = pickle.loads(question)
        return pickle.dumps((True, function(item)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        where = f"in a worker process:\n{traceback.format_exc()}"
        try:
            error.add_note(where)
            answer = pickle.dumps((False, error))
            pickle.loads(answer)
        except Exception:  # some errors cannot be sent
            sent = RenderError(" ".join(str(error).split()) or type(error).__name__)
            sent.add_note(where)
            answer = pickle.dumps((False, sent))
        return answer
