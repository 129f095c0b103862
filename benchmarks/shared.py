"""Load the scenes of the cost table, which are not part of the repository.

They are the scenes with which the original was measured: 15 meshes of about 1,000 triangles, pieces of its collection,
cubes and a square, as JSON files in the format of the original. SHACKLED_SHARED names the folder that contains them in
`scenes`; by default it is a folder `shared` beside the repository. Measurements that need them are skipped if they are
missing.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

from attrs import evolve

from shackled import InputError, Light, Material, Scene, load
from shackled.bench.scenes import GLOSSY, UNLIT

from .scenes import LAMP

ROOT = Path(__file__).resolve().parent.parent
SHARED = Path(os.environ.get("SHACKLED_SHARED") or ROOT.parent / "shared")
FOLDER = SHARED / "scenes"

SKIPPED = "skipped: the scenes of the cost table are missing (SHACKLED_SHARED names the folder that contains them)"
MESHES_SKIPPED = SKIPPED.replace("scenes of the cost table", "meshes of the cost table")

FRONTAL_LAMP = Light("point", (0, 0, -1500))

CUBE, LARGE_CUBE, QUAD = "cube_persp_128", "cube_persp_512", "fullquad_128"
UNLIT_SUFFIX, SMOOTH_SUFFIX, OWN_SUFFIX, LAMP_SUFFIX = " unlit", " smooth", " smooth, own material", " lamp"


def is_there() -> bool:
    """Return whether the scenes are there, and not only those that need no download."""
    needed = (CUBE, LARGE_CUBE, QUAD, *genesis())
    return bool(objects()) and all((FOLDER / f"{name}.json").is_file() for name in needed)


@cache
def scene(name: str) -> Scene:
    """Load the scene of that name."""
    return load(FOLDER / f"{name}.json")


def objects() -> list[str]:
    """Return the names of the scenes of real meshes."""
    return sorted(path.stem for path in FOLDER.glob("obj_*_cull.json"))


def meshes() -> list[Path]:
    """Return the files of the real meshes, about 1,000 triangles each; none if they are missing."""
    return sorted((SHARED / "meshes" / "decimated").glob("*.ply"))


def genesis() -> list[str]:
    """Return the names of the first pieces of the original's collection."""
    return [f"genesis_{i:03}" for i in range(24)]


def _with(of: Scene, change: Callable[[Material], Material], *lights: Light) -> Scene:
    """Return a scene with other materials, and with these lights if there are any."""
    objects = [evolve(each, material=change(each.material)) for each in of.objects]
    return evolve(of, objects=objects, lights=lights or of.lights)


@cache
def table_scenes() -> dict[str, Scene]:
    """Return the scenes of the cost table, by name and change; none if the folder is missing."""
    if not is_there():
        return {}
    scenes = {}
    for name in objects():
        plain = scenes[name] = scene(name)
        scenes[name + UNLIT_SUFFIX] = _with(plain, lambda _: UNLIT)
        # smooth normals and a point light, with the glossy material or the coefficients of the scene
        scenes[name + SMOOTH_SUFFIX] = _with(plain, lambda _: evolve(GLOSSY, shading="smooth"), LAMP)
        scenes[name + OWN_SUFFIX] = _with(plain, lambda own: evolve(own, shading="smooth"), LAMP)
    for name in (*genesis(), CUBE, LARGE_CUBE):
        scenes[name] = scene(name)
    scenes[QUAD + LAMP_SUFFIX] = _with(scene(QUAD), lambda _: GLOSSY, FRONTAL_LAMP)
    return scenes


def all_scenes() -> dict[str, Scene]:
    """Return all scenes of the folder that can be loaded; some are invalid on purpose."""
    scenes = {}
    for path in sorted(FOLDER.glob("*.json")):
        with suppress(InputError):
            scenes[path.stem] = scene(path.stem)
    return scenes
