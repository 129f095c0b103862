"""`tokenURI` of every icon fits the gas of a transaction; those that do so with anti-aliasing use it."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from attrs import evolve
from benchmarks import icons
from benchmarks.snapshot import changes

from shackled.datasets import pieces
from shackled.tokens import token_scene

COMMAND = "python -m benchmarks.icons"


@pytest.fixture(scope="module")
def measured() -> icons.Figures:
    return icons.take()


def flat(figures: icons.Figures) -> dict[str, int]:
    return {f"{name}: {kind}": int(each[kind]) for name, each in figures.items() for kind in ("plain", "antialiased")}


def test_no_figure_rises(measured: icons.Figures) -> None:
    worse, _ = changes({"icons": flat(icons.recorded())}, {"icons": flat(measured)})
    assert not worse, "\n  ".join([f"figures have risen; if for a good reason, run {COMMAND}:", *worse])


def test_all_fit_without_antialiasing(measured: icons.Figures) -> None:
    assert all(each["plain fits"] for each in measured.values())
    assert len(measured) == len(list(pieces("icons")))


def test_those_that_fit_with_antialiasing_use_it(measured: icons.Figures) -> None:
    used = [piece.name for piece in pieces("icons") if token_scene(piece).antialias]
    assert sorted(used) == icons.fitting(measured), f"run {COMMAND}"


def test_the_scene_of_a_token_is_that_of_its_piece() -> None:
    for name, antialias in (("lightning", True), ("saucer", False)):
        (piece,) = (each for each in pieces("icons") if each.name == f"icons/{name}")
        assert token_scene(piece) == evolve(piece.make(), antialias=antialias)
    assert not token_scene(next(iter(pieces("common")))).antialias


def test_the_documentation_has_them() -> None:
    assert icons.table(icons.recorded()) in icons.PAGE.read_text("utf-8"), f"run {COMMAND}"


def test_models_would_not_fit_beside_all_pictures(measured: icons.Figures) -> None:
    """docs/tokens.md gives this as a reason why tokens have no `animation_url`."""
    motion = json.loads(icons.FILE.with_name("motion.json").read_text("utf-8"))
    models = {name: motion[f"{name}: model: gas"] for name in measured}
    shares = [100 * models[name] / each["plain"] for name, each in measured.items()]
    assert [round(min(shares)), round(max(shares))] == [5, 29]
    antialiased = {name: int(each["antialiased"]) for name, each in measured.items() if each["antialiased fits"]}
    assert any(gas + models[name] > icons.LIMIT for name, gas in antialiased.items())
