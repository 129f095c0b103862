"""Worker processes: a function is called in another process, which may be ended at any time.

Threads would not do for an embedded EVM: pyrevm and py-evm keep the interpreter's lock while they run.

The processes are started as programs of their own and not by `multiprocessing`, which would run the script of whoever
calls us once more in each of them. They end with this process, however it ends.
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

#: What stands first in a message of a worker.
_DONE, _FAILED, _TOLD = range(3)
#: Errors of streams to and from a process that has ended.
_BROKEN = (EOFError, OSError, ValueError, pickle.UnpicklingError)
#: What a worker runs. The modules of the functions that it is to call may be found only where this process finds them.
_PROGRAM = """
import pickle, sys
try:
    sys.path[:] = pickle.load(sys.stdin.buffer)
except (EOFError, pickle.UnpicklingError):  # whoever started this has ended meanwhile
    sys.exit()
from shackled.workers import _serve
_serve()
"""
#: Seconds for a process to start and to prepare itself, on a machine that is busy.
STARTING = 60.0


class WorkerEndedError(RenderError):
    """The process ended before it answered: it was killed, perhaps for want of memory."""


class WorkerLateError(RenderError):
    """The process did not answer in time, and was ended."""


class _Traceback(Exception):
    """Shows where in the worker an error was raised."""


class Worker:
    """A process that calls functions, one after the other. It is started when it is first needed, and another one
    when it has ended. One thread at a time may use `call`; any thread `kill` and `close`.
    """

    def __init__(
        self,
        prepare: Callable[..., object] | None = None,
        *arguments: Any,
        memory: int | None = None,
        niceness: int = 0,
    ) -> None:
        """Start nothing yet.

        prepare: called in each new process with the arguments. memory: bytes of address space, where the system knows
        such a limit. niceness: added to that of this process.
        """
        self._prepare = (prepare, *arguments)
        self._limits = memory, niceness
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()
        self._closed = False

    @property
    def pid(self) -> int | None:
        """The id of the process, if there is one."""
        process = self._process
        return None if process is None else process.pid

    def call(
        self,
        function: Callable[..., Result],
        *arguments: Any,
        seconds: float | None = None,
        told: Callable[..., object] | None = None,
        unwanted: Callable[[], bool] = bool,
    ) -> Result:
        """Call a function, which must be one of a module, in the process; return its result or raise its error.

        seconds: that it may take. told: called with what the function hands to `tell`. unwanted: whether nobody wants
        the result any more; who says so then calls `kill`.
        Raises WorkerLateError or WorkerEndedError if there is no answer.
        """
        for is_last in (False, True):
            process = self._start()
            if unwanted():
                # a process that was not there yet when it was to be killed is not given the work
                raise WorkerEndedError("nobody wants the result any more")
            try:
                _hand_over(process, function, arguments)
                break
            except _BROKEN:  # it had ended while it had nothing to do
                self.end()
                if is_last:
                    raise WorkerEndedError("a worker process ended before it began its work") from None
        return self._answer(process, seconds, told)  # type: ignore[no-any-return]

    def kill(self) -> None:
        """End the process at once. Who waits for an answer gets a WorkerEndedError."""
        process = self._process
        if process is not None:
            process.kill()

    def end(self) -> None:
        """End the process and free what it held; the next call starts another one."""
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
        """End the process, and start none from now on."""
        self._closed = True
        self.end()

    def _start(self) -> subprocess.Popen[bytes]:
        process = self._process
        if process is not None and process.poll() is None:
            return process
        self.end()
        # in a session of its own, so that Ctrl-C reaches only the process that decides what happens then
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
        self, process: subprocess.Popen[bytes], seconds: float | None, told: Callable[..., object] | None
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
                if kind != _TOLD:
                    break
                if told is not None:
                    told(*content)
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
    """Give a process its work, and wait until it has begun."""
    _send(process.stdin, pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL))
    assert process.stdout is not None
    pickle.load(process.stdout)


def each(function: Callable[[Item], Result], items: Iterable[Item], processes: int) -> Iterator[tuple[int, Result]]:
    """Call a function for each item in several processes; yield (place of the item, result) as they are done."""
    items = list(items)
    workers = [Worker() for _ in range(min(processes, len(items)))]
    idle: queue.SimpleQueue[Worker] = queue.SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def work(item: Item) -> Result:
        worker = idle.get()
        try:
            return worker.call(function, item)
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


def tell(*values: Any) -> None:
    """Hand something to the caller of the function that is being called in this worker, before its result."""
    _send(_answers, pickle.dumps((_TOLD, values), pickle.HIGHEST_PROTOCOL))


# ---- in the process ----

_answers: IO[bytes] | None = None


def _serve() -> None:
    """Call what comes in by standard input until that is closed."""
    global _answers
    _answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    # what a library may print goes where people look
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
    for what, bound in ((resource.RLIMIT_AS, memory), (resource.RLIMIT_CORE, 0)):
        _, hard = resource.getrlimit(what)
        if hard == resource.RLIM_INFINITY or bound <= hard:
            with suppress(OSError, ValueError):  # some systems know the limit and do not take it
                resource.setrlimit(what, (bound, hard))
