"""Undo and redo."""

from __future__ import annotations

from collections.abc import Hashable

from .state import State

#: Steps that can be undone.
DEPTH = 200


class History:
    """The states that a picture has been in. What is dragged is one step, however many states it went through."""

    def __init__(self, state: State) -> None:
        """It begins with one state, before which there is nothing."""
        self._past: list[State] = []
        self._future: list[State] = []
        self._merge: Hashable | None = None
        self.state = state

    def change(self, state: State, merge: Hashable | None = None) -> None:
        """A new state. Changes that follow each other with the same `merge` are one step, until `settle`.

        What was undone before is gone; a state that is as before is no step.
        """
        if state == self.state:
            return
        if merge is None or merge != self._merge:
            self._past = [*self._past, self.state][-DEPTH:]
        self._merge = merge
        self._future = []
        self.state = state

    def settle(self) -> None:
        """What comes now is another step: the finger was lifted."""
        self._merge = None

    def undo(self) -> State:
        """The state one step back, if there is one."""
        self.settle()
        if self._past:
            self._future.append(self.state)
            self.state = self._past.pop()
        return self.state

    def redo(self) -> State:
        """The state that was undone last, if there is one."""
        self.settle()
        if self._future:
            self._past.append(self.state)
            self.state = self._future.pop()
        return self.state

    @property
    def can_undo(self) -> bool:
        """Whether there is a step back."""
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        """Whether anything was undone."""
        return bool(self._future)
