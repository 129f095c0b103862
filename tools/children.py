"""Child processes that can be interrupted, and that do not outlive what started them."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any


@contextmanager
def child(*command: str | Path, **options: Any) -> Iterator[subprocess.Popen[str]]:
    """Yield a process, which is killed at the end if it still runs. options: those of Popen; its output is piped.

    SIGINT interrupts it, as Ctrl-C does in a terminal: a process that `nohup` or `&` started ignores the signal, and so
    would its children.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        process = subprocess.Popen(command, text=True, **pipes | options)
    finally:
        signal.signal(signal.SIGINT, before)
    # its pipes are closed at the end
    with process:
        try:
            yield process
        finally:
            process.kill()
