"""Worker processes of this machine, each with an EVM of its own."""

from __future__ import annotations

from ..chain import Drawing, open_chain
from ..errors import RenderError
from ..scene import Rectangle, Scene
from ..workers import Worker, WorkerEndedError
from ._evm import draw_limited

#: How often a part is tried again after the process that worked on it has died.
ATTEMPTS = 2


class ProcessPlace:
    """Processes of this machine. They end with this one, however it ends."""

    distant = False

    def __init__(self, chain: str | None, jobs: int, gas: int | None = None) -> None:
        """chain: by name, as `open_chain` takes it. jobs: how many processes. gas: of a call."""
        self.seats, self.gas = jobs, gas
        self._chain = chain
        self._label = open_chain(chain).name
        self._workers = [Worker() for _ in range(jobs)]
        self._closed = False

    @property
    def name(self) -> str:
        """What it is, for people."""
        return f"{self._label}, {self.seats} processes"

    def work(self, seat: int, scene: Scene, tile: Rectangle) -> Drawing:
        """Render a part in the process of that seat."""
        for _ in range(ATTEMPTS):
            try:
                return self._workers[seat].call(draw_limited, self._chain, self.gas, scene, tile)
            except WorkerEndedError:
                if self._closed:
                    break
        raise RenderError("a worker process died twice over the same part of the picture; is there enough memory?")

    def close(self) -> None:
        """End the processes, whatever they do."""
        self._closed = True
        for worker in self._workers:
            worker.close()
