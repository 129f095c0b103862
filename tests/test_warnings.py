"""Warnings are at the line of the program that calls the package, not inside of it."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

import shackled
from shackled.errors import InputWarning, caller
from shackled.parallel import Listener

OBJ = "mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture
def obj(tmp_path: Path) -> Path:
    (tmp_path / "a.obj").write_text(OBJ)
    return tmp_path / "a.obj"


def with_points() -> trimesh.Scene:
    scene = trimesh.Scene([trimesh.creation.box()])
    scene.add_geometry(trimesh.PointCloud(np.eye(3)))  # type: ignore[no-untyped-call]
    return scene


def large_texture() -> Any:
    box: Any = trimesh.creation.box()
    image = Image.new("RGB", (512, 512), "red")
    image.putpixel((0, 0), (0, 0, 0))
    box.visual = trimesh.visual.TextureVisuals(np.zeros((8, 2)), image=image)  # type: ignore[no-untyped-call]
    return box


@pytest.mark.parametrize(
    "function", [shackled.load, shackled.render, shackled.turntable], ids=lambda each: each.__name__
)
def test_the_line_is_that_of_the_caller(function: Callable[..., object], obj: Path) -> None:
    lines = Path(__file__).read_text().splitlines()
    for thing, message in (
        (obj, "its materials are left out"),
        ([obj, obj], "its materials are left out"),
        (with_points(), "has no faces and is left out"),
        (large_texture(), "is reduced from 512 x 512"),
    ):
        arguments = (thing, 2, 8) if function is shackled.turntable else (thing, 8)
        with pytest.warns(InputWarning, match=message) as told:
            function(*arguments)
        assert {each.filename for each in told} == {__file__}
        assert {lines[each.lineno - 1].strip() for each in told} == {"function(*arguments)"}


def test_a_line_warns_once(obj: Path) -> None:
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("default")
        for _ in range(3):
            shackled.load(obj)
        shackled.load(obj)
    assert [each.lineno for each in told] == [told[0].lineno, told[0].lineno + 1]


def test_threads_know_the_line_of_the_job() -> None:
    listener = Listener()
    listener.place = caller()
    with ThreadPoolExecutor(1) as threads, pytest.warns(RuntimeWarning, match="^a node is left out$") as told:
        threads.submit(listener.warned, "a node is left out").result()
    assert [each.filename for each in told] == [__file__]


def test_a_job_tells_its_listener_the_line() -> None:
    nodes = shackled.Nodes("http://127.0.0.1:1", "http://127.0.0.1:2", timeout=5)
    listener = Listener()
    with pytest.warns(RuntimeWarning, match="it is left out") as told, pytest.raises(shackled.ChainError):
        shackled.render("cube", 8, on=nodes, listener=listener)
    assert {each.filename for each in told} == {__file__}
    assert listener.place is not None
    assert listener.place[0] == __file__
