"""Load the scenes of the cost table, which are not part of the repository.

They are the scenes with which the original was measured: 15 meshes of about 1,000 triangles, pieces of its collection,
cubes and a square, as JSON files in the format of the original. SHACKLED_SHARED names the folder that contains them in
`scenes`; by default it is a folder `shared` beside the repository. Measurements that need them are skipped if they are
missing.
"""

import os
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


def unlit(of: Scene) -> Scene:
    """Make the materials unlit."""
    return _with(of, [UNLIT] * len(of.objects))


def smooth(of: Scene) -> Scene:
    """Use smooth normals, one point light and the glossy material."""
    return evolve(_with(of, [evolve(GLOSSY, shading="smooth")] * len(of.objects)), lights=[LAMP])


def smooth_own(of: Scene) -> Scene:
    """Use smooth normals and one point light, with the scene's own coefficients."""
    return evolve(_with(of, [evolve(o.material, shading="smooth") for o in of.objects]), lights=[LAMP])


def frontal(of: Scene) -> Scene:
    """Use a point light in front and the glossy material."""
    return evolve(_with(of, [GLOSSY] * len(of.objects)), lights=[FRONTAL_LAMP])


def _with(of: Scene, materials: list[Material]) -> Scene:
    pairs = zip(of.objects, materials, strict=True)
    return evolve(of, objects=[evolve(o, material=material) for o, material in pairs])


@cache
def table_scenes() -> dict[str, Scene]:
    """Return the scenes of the cost table, by name and change; none if the folder is missing."""
    if not is_there():
        return {}
    scenes = {}
    for name in objects():
        scenes[name] = scene(name)
        scenes[name + UNLIT_SUFFIX] = unlit(scene(name))
        scenes[name + SMOOTH_SUFFIX] = smooth(scene(name))
        scenes[name + OWN_SUFFIX] = smooth_own(scene(name))
    for name in (*genesis(), CUBE, LARGE_CUBE):
        scenes[name] = scene(name)
    scenes[QUAD + LAMP_SUFFIX] = frontal(scene(QUAD))
    return scenes


def all_scenes() -> dict[str, Scene]:
    """Return all scenes of the folder that can be loaded; some are invalid on purpose."""
    scenes = {}
    for path in sorted(FOLDER.glob("*.json")):
        try:
            scenes[path.stem] = scene(path.stem)
        except InputError:
            continue
    return scenes
