"""Workers that misbehave, for the tests of those who must stand it."""

from __future__ import annotations

import os
import signal
import time

from shackled.creator import Tasks


class StrangeTasks(Tasks):
    """Can also wait, end, and take all memory."""

    def wait(self, seconds: float, answer: object) -> object:
        """Answers after a while."""
        time.sleep(seconds)
        return answer

    def work(self, seconds: float, answer: object) -> object:
        """Keeps the processor busy for a while, then answers."""
        until = time.process_time() + seconds
        while time.process_time() < until:
            sum(range(1000))
        return answer

    def pid(self) -> int:
        """Who works here."""
        return os.getpid()

    def vanish(self) -> None:
        """Ends at once, as when the system takes the memory back."""
        os.kill(os.getpid(), signal.SIGKILL)

    def eat(self) -> int:
        """Takes more memory than there is."""
        return len(bytearray(2**34))

    def stumble(self) -> None:
        """Has a fault."""
        raise ZeroDivisionError("a secret")

    def count(self, to: int) -> str:
        """Tells how far it is."""
        for done in range(1, to + 1):
            self._progress(done, to)
        return "counted"
