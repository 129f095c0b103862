"""Call functions in worker processes, which may be killed at any time.

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
from typing import IO, Any, TypeVar

from .errors import RenderError

Item = TypeVar("Item")
Result = TypeVar("Result")

#: The kinds of messages of a worker.
_DONE, _FAILED, _PROGRESS = range(3)
#: Errors of streams to and from a process that has ended.
_BROKEN = (EOFError, OSError, ValueError, pickle.UnpicklingError)
#: The program of a worker. It imports the modules of functions by the same path as this process.
_PROGRAM = """
import pickle, sys
try:
    sys.path[:] = pickle.load(sys.stdin.buffer)
except (EOFError, pickle.UnpicklingError):  # the parent has ended meanwhile
    sys.exit()
from shackled.workers import _serve
_serve()
"""
#: Seconds for a process to start and to prepare itself, on a busy machine.
STARTING = 60.0


class WorkerEndedError(RenderError):
    """The process ended before it answered; it may have been killed for lack of memory."""


class WorkerLateError(RenderError):
    """The process did not answer in time, and was killed."""


class _Traceback(Exception):
    """Shows where in the worker an error was raised."""


class Worker:
    """A process that calls functions, one after the other.

    It is started by the first call, and again by a call after it has ended. One thread at a time may use `call`; any
    thread may use `kill` and `close`.
    """

    def __init__(
        self,
        prepare: Callable[..., object] | None = None,
        *arguments: Any,
        memory: int | None = None,
        niceness: int = 0,
    ) -> None:
        """Start nothing yet.

        prepare: called in each new process with the arguments. memory: limit of written memory in bytes, where the
        system has such a limit. niceness: added to that of this process.
        """
        self._prepare = (prepare, *arguments)
        self._limits = memory, niceness
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()
        self._closed = False

    @property
    def pid(self) -> int | None:
        """Return the id of the process, or None if there is none."""
        process = self._process
        return None if process is None else process.pid

    def call(
        self,
        function: Callable[..., Result],
        *arguments: Any,
        seconds: float | None = None,
        on_progress: Callable[..., object] | None = None,
        cancelled: Callable[[], bool] = bool,
    ) -> Result:
        """Call a function of a module in the process; return its result or raise its error.

        seconds: time limit. on_progress: called with the arguments of each `report_progress`. cancelled: whether the
        result is no longer wanted; whoever cancels also calls `kill`.
        Raises WorkerLateError or WorkerEndedError if there is no answer.
        """
        for is_last in (False, True):
            process = self._start()
            if cancelled():
                # the call was cancelled before there was a process to kill
                raise WorkerEndedError("the call was cancelled")
            try:
                _hand_over(process, function, arguments)
                break
            except _BROKEN:  # it had ended while it was idle
                self.end()
                if is_last:
                    raise WorkerEndedError("a worker process ended before it began its work") from None
        return self._answer(process, seconds, on_progress)  # type: ignore[no-any-return]

    def kill(self) -> None:
        """Kill the process; a call that waits for it raises WorkerEndedError."""
        process = self._process
        if process is not None:
            process.kill()

    def end(self) -> None:
        """End the process and close its streams; the next call starts another one."""
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for stream in (process.stdin, process.stdout):
                with suppress(OSError):
                    assert stream is not None
                    stream.close()

    def close(self) -> None:
        """End the process, and start none again."""
        self._closed = True
        self.end()

    def _start(self) -> subprocess.Popen[bytes]:
        process = self._process
        if process is not None and process.poll() is None:
            return process
        self.end()
        # in a new session, so that Ctrl-C reaches only this process
        process = self._process = subprocess.Popen(
            [sys.executable, "-c", _PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
        )
        if self._closed:
            self.end()
            raise WorkerEndedError("the worker has been closed")
        try:
            pickle.dump(sys.path, process.stdin)  # type: ignore[arg-type]
            _send(process.stdin, pickle.dumps(self._limits))
            if self._prepare[0] is not None:
                _hand_over(process, self._prepare[0], self._prepare[1:])
                self._answer(process, STARTING, None)
        except _BROKEN:
            self.end()
            raise WorkerEndedError("a worker process did not start") from None
        return process

    def _answer(
        self, process: subprocess.Popen[bytes], seconds: float | None, on_progress: Callable[..., object] | None
    ) -> Any:
        late = threading.Event()

        def expire() -> None:
            late.set()
            process.kill()

        timer = None if seconds is None else threading.Timer(seconds, expire)
        if timer is not None:
            timer.daemon = True
            timer.start()
        assert process.stdout is not None
        try:
            while True:
                kind, content = pickle.loads(pickle.load(process.stdout))
                if kind != _PROGRESS:
                    break
                if on_progress is not None:
                    on_progress(*content)
        except _BROKEN:
            self.end()
            if late.is_set():
                raise WorkerLateError(f"a worker process took longer than {seconds:g} seconds") from None
            raise WorkerEndedError("a worker process ended; is there enough memory?") from None
        finally:
            if timer is not None:
                timer.cancel()
        if kind == _DONE:
            return content
        error, text = content
        raise error from _Traceback(f"\n{text}")


def _hand_over(process: subprocess.Popen[bytes], function: Callable[..., object], arguments: tuple[Any, ...]) -> None:
    """Send a call to a process, and wait until it has begun."""
    _send(process.stdin, pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL))
    assert process.stdout is not None
    pickle.load(process.stdout)


def each(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    processes: int,
    lost: Callable[[WorkerEndedError], Result] | None = None,
) -> Iterator[tuple[int, Result]]:
    """Call a function for each item in several processes; yield (index of the item, result) as they are done.

    lost: returns the result of an item whose process ended; None raises the error.
    """
    items = list(items)
    workers = [Worker() for _ in range(min(processes, len(items)))]
    idle: queue.SimpleQueue[Worker] = queue.SimpleQueue()
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


def report_progress(*values: Any) -> None:
    """Send values from the function that this worker runs to the `on_progress` of its caller."""
    _send(_answers, pickle.dumps((_PROGRESS, values), pickle.HIGHEST_PROTOCOL))


# ---- in the worker ----

_answers: IO[bytes] | None = None


def _serve() -> None:
    """Make the calls that come by standard input until it is closed."""
    global _answers
    _answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    # what a library prints goes to stderr
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    with suppress(EOFError, OSError):
        _restrict(*pickle.loads(pickle.load(sys.stdin.buffer)))
        while True:
            question = pickle.load(sys.stdin.buffer)
            _send(_answers, b"begun")
            _send(_answers, _perform(question))


def _perform(question: bytes) -> bytes:
    try:
        function, arguments = pickle.loads(question)
        return pickle.dumps((_DONE, function(*arguments)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        text = traceback.format_exc()
        try:
            answer = pickle.dumps((_FAILED, (error, text)))
            pickle.loads(answer)
        except Exception:  # some errors cannot be sent
            words = " ".join(str(error).split()) or type(error).__name__
            answer = pickle.dumps((_FAILED, (RenderError(words), text)))
        return answer


def _send(stream: IO[bytes] | None, message: bytes) -> None:
    assert stream is not None
    pickle.dump(message, stream, pickle.HIGHEST_PROTOCOL)
    stream.flush()


def _restrict(memory: int | None, niceness: int) -> None:
    if niceness and hasattr(os, "nice"):
        os.nice(niceness)
    try:
        import resource
    except ImportError:  # Windows has no such limits
        return
    if memory is None:
        return
    for what, bound in ((resource.RLIMIT_DATA, memory), (resource.RLIMIT_CORE, 0)):
        _, hard = resource.getrlimit(what)
        if hard == resource.RLIM_INFINITY or bound <= hard:
            with suppress(OSError, ValueError):  # some systems know the limit and do not take it
                resource.setrlimit(what, (bound, hard))
