"""Animations as files."""

from __future__ import annotations

import io
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage
from PIL import ImageSequence

from shackled import Animation, Image, InputError
from shackled.animation import FORMATS, check_animation, frame_names
from shackled.image import encode_bmp


def picture(pixels: np.ndarray) -> Image:
    return Image(pixels, encode_bmp(pixels), 10, 2, "nowhere", 0.1)


RNG = np.random.default_rng(5)
FEW = Animation([picture(RNG.choice(np.array([0, 90, 255], np.uint8), (6, 9, 3))) for _ in range(4)], 100)
MANY = Animation([picture(RNG.integers(0, 256, (30, 40, 3), np.uint8)) for _ in range(3)])


#: What Pillow reads; test_mp4.py judges the other.
EXACT = [extension for extension in FORMATS if extension != ".mp4"]


def frames(data: bytes) -> list[np.ndarray]:
    with PillowImage.open(io.BytesIO(data)) as file:
        return [np.array(frame.convert("RGB")) for frame in ImageSequence.Iterator(file)]


@pytest.mark.parametrize(("animation", "extension"), [*((FEW, each) for each in EXACT), (MANY, ".png")])
def test_every_pixel_is_kept(animation: Animation, extension: str) -> None:
    found = frames(animation.encode(extension))
    assert len(found) == len(animation.frames)
    assert (np.stack(found) == animation.pixels).all()


def test_a_gif_has_one_palette() -> None:
    data = MANY.encode(".gif")
    colors = np.unique(np.concatenate([frame.reshape(-1, 3) for frame in frames(data)]), axis=0)
    assert len(colors) <= 256
    error = np.abs(np.stack(frames(data)).astype(int) - MANY.pixels).mean()
    assert error < 25


def test_a_palette_of_exactly_256_colours_is_exact() -> None:
    # all greys, near one another, in two frames
    greys = np.arange(256, dtype=np.uint8).reshape(16, 16, 1).repeat(3, axis=2)
    film = Animation([picture(greys[:8]), picture(greys[8:])])
    assert (np.stack(frames(film.encode(".gif"))) == film.pixels).all()
    rng = np.random.default_rng(8)
    for count, is_exact in ((255, True), (256, True), (257, False)):
        chosen = rng.permutation(1 << 24)[:count]
        pixels = np.stack([chosen >> 16, chosen >> 8 & 255, chosen & 255], axis=1).astype(np.uint8)[None]
        (found,) = frames(Animation([picture(pixels)]).encode(".gif"))
        assert (found == pixels).all() == is_exact


def test_formats_with_and_without_a_dot() -> None:
    assert FEW.encode("gif") == FEW.encode(".GIF")
    assert FEW.encode("png") == FEW.encode(".png")
    for wrong in (".bmp", "jpg", "", None):
        with pytest.raises(InputError, match=re.escape(f"the format must be one of {' '.join(FORMATS)}, not ")):
            FEW.encode(wrong)  # type: ignore[arg-type]


def test_it_shows_itself_in_a_line() -> None:
    assert repr(FEW) == "<Animation 9x6, 4 frames, 40 gas>"
    assert repr(Animation(FEW.frames[:1])) == "<Animation 9x6, 1 frame, 10 gas>"


def test_animations_are_values() -> None:
    assert Animation(list(FEW.frames), 100) == FEW
    assert hash(Animation(list(FEW.frames), 100)) == hash(FEW)
    assert Animation(FEW.frames, 101) != FEW
    assert Animation(FEW.frames[::-1], 100) != FEW
    assert (Animation(FEW.pixels).pixels == FEW.pixels).all()


def test_frames_of_one_size_are_needed() -> None:
    for wrong in ([], [FEW.frames[0], MANY.frames[0]]):
        with pytest.raises(InputError, match="all of one size"):
            Animation(wrong)


def test_frames_that_are_alike_take_their_time() -> None:
    for extension in EXACT:
        with PillowImage.open(io.BytesIO(Animation([FEW.frames[i] for i in (0, 0, 1)], 50).encode(extension))) as file:
            shown = 0
            for frame in ImageSequence.Iterator(file):
                frame.load()  # some formats say only then how long a frame is shown
                shown += frame.info["duration"]
            assert shown == 150
            assert file.info["loop"] == 0


def test_the_sums() -> None:
    assert (FEW.gas, FEW.intrinsic_gas) == (40, 8)


def test_files_and_folders(tmp_path: Path) -> None:
    FEW.save(tmp_path / "a.gif")
    FEW.save(tmp_path / "a.png")
    FEW.save(f"{tmp_path}/a/")
    assert (tmp_path / "a.gif").read_bytes() == FEW.encode(".gif")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "a.gif", "a.png"]
    assert [path.name for path in sorted((tmp_path / "a").iterdir())] == frame_names(4)
    assert frame_names(2000)[-1] == "1999.png"
    for path, message in (
        ("b.bmp", "must end in .gif"),
        ("no/b.gif", "the folder .*no"),
        ("a.gif/b.gif", "the folder"),
    ):
        with pytest.raises(InputError, match=message):
            check_animation(tmp_path / path)
    with pytest.raises(InputError, match="from 20 to 10000"):
        Animation(FEW.frames, 5)


def test_it_shows_itself() -> None:
    assert FEW._repr_mimebundle_()["image/png"].startswith(b"\x89PNG")
