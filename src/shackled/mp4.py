"""MP4 files, of H.264, by PyAV."""

from __future__ import annotations

import io
from collections.abc import Sequence
from fractions import Fraction
from importlib.util import find_spec

import numpy as np

from .errors import not_installed
from .image import Pixels

#: How near to the frames it is: 0 is exact, and 18 is taken as hardly to be told from that.
_QUALITY = "12"
#: Units of time in a second: milliseconds.
_UNITS = 1000


def check_mp4() -> None:
    """Raise an InputError if MP4 files cannot be written here."""
    if find_spec("av") is None:
        raise not_installed("an .mp4 file", "mp4")


def encode_mp4(frames: Sequence[Pixels], duration: int) -> bytes:
    """Return the file of frames, (H, W, 3), each shown for `duration` milliseconds. InputError as `check_mp4`.

    Every player shows such files, whose colours have half the size, so sides are even: an odd one gets one more pixel.
    """
    check_mp4()
    import av

    file = io.BytesIO()
    height, width = (side + side % 2 for side in frames[0].shape[:2])
    with av.open(file, "w", format="mp4") as container:
        stream = container.add_stream("libx264", rate=Fraction(_UNITS, duration), options={"crf": _QUALITY})
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.codec_context.time_base = Fraction(1, _UNITS)
        for number, pixels in enumerate(frames):
            more = (height - pixels.shape[0], width - pixels.shape[1])
            frame = av.VideoFrame.from_ndarray(np.pad(pixels, [(0, more[0]), (0, more[1]), (0, 0)], "edge"), "rgb24")
            frame.pts, frame.time_base = number * duration, Fraction(1, _UNITS)
            container.mux(stream.encode(frame))
        container.mux(stream.encode(None))
    return file.getvalue()
