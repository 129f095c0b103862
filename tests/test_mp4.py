"""MP4 files, as a decoder reads them."""

from __future__ import annotations

import io
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from shackled import Animation, Image, InputError
from shackled.animation import check_animation

#: Frames of colours that change slowly, as light does, with a bright square that moves.
HEIGHT, WIDTH = 48, 64
RAMP = np.linspace(20, 200, WIDTH)[None, :, None] * np.ones((HEIGHT, 1, 1)) * np.array([1, 0.8, 0.5])


def frame(number: int) -> np.ndarray:
    pixels: np.ndarray = RAMP.astype(np.uint8)
    pixels[16:32, 8 * number : 8 * number + 16] = (250, 240, 230)
    return pixels


FRAMES = [frame(number) for number in range(5)]


def decoded(data: bytes) -> tuple[list[np.ndarray], list[Fraction]]:
    with av.open(io.BytesIO(data), "r") as file:
        assert file.streams.video[0].codec_context.name == "h264"
        assert file.streams.video[0].codec_context.pix_fmt == "yuv420p"
        found = [*file.decode(video=0)]
        times = [each.pts * each.time_base for each in found if each.pts is not None and each.time_base is not None]
        times.append(Fraction(file.duration or 0, av.time_base))
    return [each.to_ndarray(format="rgb24") for each in found], times


@pytest.mark.parametrize("duration", [20, 80, 333, 10_000])
def test_the_frames_and_their_times(duration: int) -> None:
    pixels, times = decoded(Animation(FRAMES, duration).encode(".mp4"))
    assert len(pixels) == 5
    for number, found in enumerate(pixels):
        # no other frame is as near
        errors = [np.abs(found.astype(int) - other).mean() for other in FRAMES]
        assert errors[number] == min(errors) < 2
    assert times == [Fraction(duration * number, 1000) for number in range(6)]


def test_odd_sides_get_one_more_pixel() -> None:
    pixels, _ = decoded(Animation([each[:33, :47] for each in FRAMES]).encode("mp4"))
    assert {each.shape for each in pixels} == {(34, 48, 3)}
    assert np.abs(pixels[0][:33, :47].astype(int) - FRAMES[0][:33, :47]).mean() < 2


def test_a_file_is_written_and_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    film = Animation(FRAMES)
    film.save(tmp_path / "a.MP4")
    assert len(decoded((tmp_path / "a.MP4").read_bytes())[0]) == 5
    clear = Animation([Image(each, alpha=each[:, :, 0]) for each in FRAMES])
    with pytest.raises(InputError, match=r"a transparent picture needs a \.png or \.webp file: \.mp4 has no alpha"):
        clear.encode(".mp4")
    monkeypatch.setattr("shackled.animation.find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"^an \.mp4 file needs a package .*: pip install 'shackled\[mp4\]'$"):
        check_animation(tmp_path / "b.mp4")
