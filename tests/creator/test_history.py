"""Undo and redo."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from shackled.creator import MAX_STEPS, History, Pose, Source, State


def at(x: float) -> State:
    return State(Source("piece", "teapot"), Pose((float(x), 0.0, 0.0)))


def test_steps_are_undone_and_done_again() -> None:
    history = History(at(0))
    assert not history.can_undo
    for x in (1, 2, 3):
        history.change(at(x))
    assert [history.undo(), history.undo()] == [at(2), at(1)]
    assert history.can_redo
    assert history.redo() == at(2)
    history.change(at(9))
    assert not history.can_redo
    assert [history.undo(), history.undo(), history.undo()] == [at(2), at(1), at(0)]
    assert history.undo() == at(0)


def test_a_drag_is_one_step() -> None:
    history = History(at(0))
    for x in range(1, 50):
        history.change(at(x), merge="drag")
    history.settle()
    history.change(at(60), merge="drag")
    assert history.undo() == at(49)
    assert history.undo() == at(0)
    assert not history.can_undo


def test_another_control_is_another_step() -> None:
    history = History(at(0))
    history.change(at(1), merge="a")
    history.change(at(2), merge="b")
    history.change(at(3))
    history.change(at(4))
    assert [history.undo().pose.position[0] for _ in range(4)] == [3, 2, 1, 0]


def test_what_does_not_change_is_no_step() -> None:
    history = History(at(0))
    history.change(at(0))
    assert not history.can_undo


def test_history_is_bounded() -> None:
    history = History(at(0))
    for x in range(MAX_STEPS + 50):
        history.change(at(x / 100))
    steps = 0
    while history.can_undo:
        history.undo()
        steps += 1
    assert steps == MAX_STEPS


@given(st.lists(st.tuples(st.integers(0, 5), st.sampled_from([None, "a", "b"])), max_size=30))
def test_undoing_all_and_redoing_all_changes_nothing(changes: list[tuple[int, str | None]]) -> None:
    history = History(at(99))
    for x, merge in changes:
        history.change(at(x), merge)
    last = history.state
    while history.can_undo:
        history.undo()
    assert history.state == at(99)
    while history.can_redo:
        history.redo()
    assert history.state == last
