"""The process that computes for visitors: it is asked one thing after the other, and may be ended at any time."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Any

from ..errors import ChainError, InputError
from .limits import Limits

#: What stands first in an answer. After DONE come the result and the seconds that the processor took for it.
READY, DONE, PROGRESS, INPUT, RENDER, MISSING, MEMORY, FAULT = range(8)


MakeDesk = Callable[[Limits, Callable[[int, int], None]], Any]


@dataclass(frozen=True)
class Request:
    """task: the name of a method of the desk. uploads: files that the worker did not have, by their SHA-256."""

    task: str
    arguments: tuple[Any, ...]
    uploads: dict[str, Any] = field(default_factory=dict)


class MissingUploadError(Exception):
    """The worker needs a file that it has not been given."""

    def __init__(self, sha256: str) -> None:
        """`sha256`: of the file."""
        super().__init__(sha256)
        self.sha256 = sha256


def serve(pipe: Connection, make_desk: MakeDesk, limits: Limits, niceness: int, guarded: bool) -> None:
    """Answers requests until the other end of the pipe is closed.

    make_desk: makes what has a method for each task, of the limits and of what is told the progress. guarded: whether
    this process reads files of strangers; it then opens no file but the one that it is given.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent closes the pipe
    _restrict(limits.memory, niceness)
    desk = make_desk(limits, lambda done, total: pipe.send((PROGRESS, done, total)))
    if guarded:
        from .guard import prepare_guard

        prepare_guard()
    try:
        pipe.send((READY,))
        while True:
            request = pipe.recv()
            pipe.send(_answer(desk, request))
    except (EOFError, BrokenPipeError, ConnectionResetError):
        return


def _answer(desk: Any, request: Request) -> tuple[Any, ...]:
    try:
        desk.receive(request.uploads)
        task: Callable[..., Any] = getattr(desk, request.task)
        begun = time.process_time()
        result = task(*request.arguments)
        return DONE, result, time.process_time() - begun
    except MissingUploadError as error:
        return MISSING, error.sha256
    except InputError as error:
        return INPUT, str(error)
    except ChainError as error:
        return RENDER, str(error)
    except (MemoryError, RecursionError):
        return (MEMORY,)
    except Exception as error:  # a fault of ours: told without what might be private in it
        import traceback

        return FAULT, type(error).__name__, traceback.format_exc()


def _restrict(memory: int, niceness: int) -> None:
    if hasattr(os, "nice"):
        os.nice(niceness)
    try:
        import resource
    except ImportError:  # Windows has no such limits
        return
    for what, bound in ((resource.RLIMIT_AS, memory), (resource.RLIMIT_CORE, 0)):
        _, hard = resource.getrlimit(what)
        if hard == resource.RLIM_INFINITY or bound <= hard:
            try:
                resource.setrlimit(what, (bound, hard))
            except (OSError, ValueError):  # some systems know the limit and do not take it
                continue
