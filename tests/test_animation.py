"""Animations as files."""

from __future__ import annotations

import io
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage
from PIL import ImageSequence

from pictures import frames_of, pixels_of
from shackled import Animation, Image, InputError
from shackled.animation import FORMATS, check_animation, frame_names

RNG = np.random.default_rng(5)
FEW = Animation(
    [Image(RNG.choice(np.array([0, 90, 255], np.uint8), (6, 9, 3)), gas=10, intrinsic_gas=2) for _ in range(4)], 100
)
MANY = Animation([RNG.integers(0, 256, (30, 40, 3), np.uint8) for _ in range(3)])
#: What Pillow reads; test_mp4.py judges the other.
EXACT = [extension for extension in FORMATS if extension != ".mp4"]


@pytest.mark.parametrize(("animation", "extension"), [*((FEW, each) for each in EXACT), (MANY, ".png")])
def test_every_pixel_is_kept(animation: Animation, extension: str) -> None:
    assert np.array_equal(frames_of(animation.encode(extension)), animation.pixels)


def test_a_gif_has_one_palette() -> None:
    found = np.stack(frames_of(MANY.encode(".gif")))
    assert len(np.unique(found.reshape(-1, 3), axis=0)) <= 256
    assert np.abs(found.astype(int) - MANY.pixels).mean() < 25
    # all greys, near one another, in two frames
    greys = np.arange(256, dtype=np.uint8).reshape(16, 16, 1).repeat(3, axis=2)
    film = Animation([greys[:8], greys[8:]])
    assert np.array_equal(frames_of(film.encode(".gif")), film.pixels)
    for count, is_exact in ((255, True), (256, True), (257, False)):
        chosen = RNG.choice(1 << 24, count, replace=False)
        pixels = np.stack([chosen >> 16, chosen >> 8 & 255, chosen & 255], axis=1).astype(np.uint8)[None]
        assert np.array_equal(pixels_of(Animation([pixels]).encode(".gif")), pixels) == is_exact


def test_formats_with_and_without_a_dot() -> None:
    assert FEW.encode("gif") == FEW.encode(".GIF")
    assert FEW._repr_mimebundle_()["image/png"] == FEW.encode("png") == FEW.encode(".png")
    for wrong in (".bmp", "jpg", "", None):
        with pytest.raises(InputError, match=re.escape(f"the format must be one of {' '.join(FORMATS)}, not ")):
            FEW.encode(wrong)  # type: ignore[arg-type]


def test_animations_are_values() -> None:
    assert repr(FEW) == "<Animation 9x6, 4 frames, 40 gas>"
    assert repr(Animation(FEW.frames[:1])) == "<Animation 9x6, 1 frame, 10 gas>"
    assert (FEW.gas, FEW.intrinsic_gas) == (40, 8)
    assert Animation(list(FEW.frames), 100) == FEW
    assert hash(Animation(list(FEW.frames), 100)) == hash(FEW)
    assert Animation(FEW.frames, 101) != FEW
    assert Animation(FEW.frames[::-1], 100) != FEW
    for wrong in ([], [FEW.frames[0], MANY.frames[0]]):
        with pytest.raises(InputError, match="all of one size"):
            Animation(wrong)
    with pytest.raises(InputError, match="from 20 to 10000"):
        Animation(FEW.frames, 5)


@pytest.mark.parametrize("extension", EXACT)
def test_frames_that_are_alike_take_their_time(extension: str) -> None:
    film = Animation([FEW.frames[i] for i in (0, 0, 1)], 50)
    with PillowImage.open(io.BytesIO(film.encode(extension))) as file:
        shown = 0
        for frame in ImageSequence.Iterator(file):
            frame.load()  # some formats say only then how long a frame is shown
            shown += frame.info["duration"]
        assert shown == 150
        assert file.info["loop"] == 0


def test_files_and_folders(tmp_path: Path) -> None:
    FEW.save(tmp_path / "a.gif")
    FEW.save(f"{tmp_path}/a/")
    assert (tmp_path / "a.gif").read_bytes() == FEW.encode(".gif")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "a.gif"]
    assert [path.name for path in sorted((tmp_path / "a").iterdir())] == frame_names(4)
    assert frame_names(2000)[-1] == "1999.png"
    for path, message in (("b.bmp", "must end in .gif"), ("no/b.gif", "the folder .*no")):
        with pytest.raises(InputError, match=message):
            check_animation(tmp_path / path)
