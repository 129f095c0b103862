"""Worker processes, each with an EVM of its own: an embedded EVM keeps other threads of its process from running.

They are started as programs of their own and not by `multiprocessing`, which would run the script of whoever calls us
once more in each of them.
"""

from __future__ import annotations

import pickle
import subprocess
import sys
from typing import IO, Any

from ..chain import Drawing, open_chain
from ..errors import InputError, OutOfGasError, RenderError
from ..scene.codec import Rectangle
from ..scene.scene import Scene

#: How often a part is tried again after the process that worked on it has died.
ATTEMPTS = 2
_ERRORS: dict[str, type[Exception]] = {"InputError": InputError, "OutOfGasError": OutOfGasError}


class ProcessPlace:
    """Processes of this machine. They end with this one, however it ends."""

    distant = False

    def __init__(self, chain: str | None, jobs: int, gas: int | None = None) -> None:
        """chain: by name, as `open_chain` takes it. jobs: how many processes. gas: of a call."""
        self.seats, self.gas = jobs, gas
        self._chain = chain
        self._label = open_chain(chain).name
        self._workers: list[subprocess.Popen[bytes] | None] = [None] * jobs
        self._closed = False

    @property
    def name(self) -> str:
        """What it is, for people."""
        return f"{self._label}, {self.seats} processes"

    def work(self, seat: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Renders a part in the process of that seat, which is started when it is first needed."""
        for _ in range(ATTEMPTS):
            try:
                worker = self._workers[seat] or self._start(seat)
                answer = _ask(worker, (scene, tile))
            except (EOFError, OSError, pickle.UnpicklingError, ValueError):
                # killed, perhaps for want of memory: another one takes its place
                self._end(seat)
                if self._closed:
                    break
                continue
            if isinstance(answer, Drawing):
                return answer
            kind, message = answer
            raise _ERRORS.get(kind, RenderError)(message)
        raise RenderError("a worker process died twice over the same part of the picture; is there enough memory?")

    def close(self) -> None:
        """Ends the processes, whatever they do."""
        self._closed = True
        for seat in range(self.seats):
            self._end(seat)

    def _start(self, seat: int) -> subprocess.Popen[bytes]:
        # in a session of its own, so that Ctrl-C reaches only the process that decides what happens then
        worker = subprocess.Popen(
            [sys.executable, "-m", f"{__package__}.worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
        )
        self._workers[seat] = worker
        if self._closed:
            raise EOFError
        _send(worker.stdin, (self._chain, self.gas))
        return worker

    def _end(self, seat: int) -> None:
        worker, self._workers[seat] = self._workers[seat], None
        if worker is not None:
            worker.kill()
            worker.wait()
            for stream in (worker.stdin, worker.stdout):
                try:
                    if stream is not None:
                        stream.close()
                except OSError:
                    pass


def _ask(worker: subprocess.Popen[bytes], question: Any) -> Any:
    _send(worker.stdin, question)
    assert worker.stdout is not None
    return pickle.load(worker.stdout)


def _send(stream: IO[bytes] | None, message: Any) -> None:
    assert stream is not None
    pickle.dump(message, stream, pickle.HIGHEST_PROTOCOL)
    stream.flush()
