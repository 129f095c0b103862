"""The contracts' colours, against a float64 renderer of the same formulas: see accuracy.py."""

from __future__ import annotations

from dataclasses import replace

import float64
import numpy as np
import pytest
from accuracy import interior, made_scenes, measure, shared_scenes, teapot_scene
from pictures import shared_scene
from random_scenes import random_case

from shackled.image import decode_bmp
from pictures import chain

SHARED, MADE = shared_scenes(), made_scenes()


def check(accuracy: object) -> None:
    assert getattr(accuracy, "is_good"), f"pixels, mean, worst, within 4, of all: {accuracy}"


@pytest.mark.parametrize("name", MADE)
def test_scenes_made_by_hand(name: str) -> None:
    accuracy = measure(MADE[name]())
    assert accuracy.pixels > 200
    check(accuracy)
