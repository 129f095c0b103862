"""What runs in the processes that compute for visitors."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from ..workers import report_progress
from .limits import Limits

MakeDesk = Callable[[Limits, Callable[[int, int], None]], Any]

#: What has a method for each task, in a worker.
_desk: Any = None


class MissingUploadError(Exception):
    """The worker needs a file that it has not been given."""

    def __init__(self, sha256: str) -> None:
        """`sha256`: of the file."""
        super().__init__(sha256)
        self.sha256 = sha256


def prepare(make_desk: MakeDesk, limits: Limits, guarded: bool) -> None:
    """Make the desk of this process. guarded: whether it reads untrusted files; it then opens no other file."""
    global _desk
    _desk = make_desk(limits, report_progress)
    if guarded:
        from .guard import prepare_guard

        prepare_guard()


def perform(task: str, arguments: tuple[Any, ...], uploads: dict[str, Any]) -> tuple[Any, float]:
    """Do a task, a method of the desk; return its result and the seconds that the processor took for it.

    uploads: files that the worker did not have, by their SHA-256.
    """
    _desk.receive(uploads)
    begun = time.process_time()
    result = getattr(_desk, task)(*arguments)
    return result, time.process_time() - begun
