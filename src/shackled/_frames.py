"""The frames of an animation of a glTF file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Unpack

import numpy as np
from attrs import evolve

from ._load import locate, pose_of, read_posed
from .errors import InputError
from .scene import GLTF, LookOptions, Scene, about, animation_length, checked_look, frame_count, look_at


def load_frames(
    thing: str | os.PathLike[str],
    frames: int,
    size: int | tuple[int, int] | None = None,
    **look: Unpack[LookOptions],
) -> tuple[list[Scene], float]:
    """Return scenes at equal steps of the time of an animation of a glTF file, and its length in seconds.

    The first is at time 0, and the last a step before the end, so that a cycle goes on. The model has one scale in all
    of them, and the camera sees all of its poses.

    frames: how many, 2..720. size, look: as in `load`, but for `time`.
    """
    chosen = checked_look({"size": size, **look})
    path = locate(thing)
    if not isinstance(path, Path) or path.suffix.lower() not in GLTF:
        raise InputError(f"{thing} has no animation: those of glTF files are read, {' or '.join(GLTF)}")
    if "time" in chosen:
        raise InputError("`time` is for one picture: frames take all times of an animation")
    count, pose = frame_count(frames, "an animation"), pose_of(chosen)
    with about(str(path)):
        length = animation_length(path, pose.setdefault("animation", 0))
    poses = [read_posed(path, chosen, {**pose, "time": length * step / count}) for step in range(count)]
    models = [each for each in poses if not isinstance(each, Scene)]  # all, unless the file has the camera
    around = np.concatenate([part.world_positions() for parts in models for part in parts]) if models else None
    with about(str(path)):
        return _alike([look_at(each, chosen, around=around) for each in poses]), length


def _alike(scenes: list[Scene]) -> list[Scene]:
    """Return the scenes with the ground and the fog that suit all of them, where those follow from the objects."""
    ground, fogs = scenes[0].ground, [each.fog for each in scenes if each.fog is not None]
    if ground is not None:
        ground = ground.settled(np.concatenate([each.world_positions() for each in scenes]))
    fog = evolve(fogs[0], near=min(f.near for f in fogs), far=max(f.far for f in fogs)) if fogs else None
    return [evolve(each, ground=ground, fog=fog) for each in scenes]
