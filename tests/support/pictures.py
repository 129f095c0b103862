"""What the tests ask of the contracts, and the scenes that they share."""

from __future__ import annotations

import io
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray
from PIL import Image as PillowImage
from PIL import ImageSequence

from shackled import Camera, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.chain._chain import CallResult, ContractChain
from shackled.chain._embedded import EmbeddedChain
from shackled.image import decode_bmp
from shackled.scene._codec import Rectangle, encode_scene

Pixels = NDArray[np.uint8]

UNLIT = Material("unlit")
WHITE = (255, 255, 255)


@cache
def chain() -> ContractChain:
    """Where the contracts run."""
    return open_chain()


def local() -> EmbeddedChain:
    """The same chain, which knows where contracts are."""
    found = chain()
    assert isinstance(found, EmbeddedChain)
    return found


def words(*values: int) -> bytes:
    """ABI words."""
    return b"".join((value % (1 << 256)).to_bytes(32, "big") for value in values)


@cache
def scene_types() -> list[str]:
    """The ABI types of the arguments of render(Scene), from the compiled contract."""
    function = next(entry for entry in artifact("Renderer").abi if entry.get("name") == "render")
    return [type_of(parameter) for parameter in function["inputs"]]


def type_of(parameter: dict[str, Any]) -> str:
    """The ABI type of a parameter."""
    if not parameter["type"].startswith("tuple"):
        return str(parameter["type"])
    return f"({','.join(map(type_of, parameter['components']))}){parameter['type'].removeprefix('tuple')}"


def call_data(function: str, scene: Scene, tile: Rectangle | None = None) -> bytes:
    """A call of the Renderer with a scene as it is: with whole coordinates of meshes, and a near distance."""
    head = words(0x20) if tile is None else words(0xA0, tile.x, tile.y, tile.width, tile.height)
    return artifact("Renderer").selectors[function] + head + encode_scene(scene)


def call(function: str, scene: Scene, tile: Rectangle | None = None) -> CallResult:
    """Calls the Renderer."""
    return chain().call("Renderer", call_data(function, scene, tile))


def dynamic(output: bytes, word: int = 0) -> bytes:
    """The bytes or string that a word of an output points to."""
    start = int.from_bytes(output[32 * word : 32 * word + 32], "big")
    size = int.from_bytes(output[start : start + 32], "big")
    assert start + 32 + size <= len(output)
    return output[start + 32 : start + 32 + size]


def draw(scene: Scene, tile: Rectangle | None = None) -> Pixels:
    """The picture of a scene, or of a part of its canvas: (H, W, 3)."""
    bmp = dynamic(call("render" if tile is None else "renderTile", scene, tile).output)
    return decode_bmp(bmp, tile.width if tile else scene.width, tile.height if tile else scene.height)


def counts(scene: Scene) -> tuple[int, int]:
    """How many triangles the contract drew, and how many pixels they cover."""
    output = call("renderCounted", scene).output
    return int.from_bytes(output[32:64], "big"), int.from_bytes(output[64:96], "big")


def covered(scene: Scene) -> NDArray[np.bool_]:
    """(H, W): where anything is drawn, of whatever colour."""
    white = [
        evolve(o, mesh=recolored(o.mesh, WHITE), material=UNLIT if o.material.shading != "unlit" else o.material)
        for o in scene.objects
    ]
    return draw(evolve(scene, objects=white))[:, :, 0] > 0


def frames_of(file: bytes | str | Path) -> list[Pixels]:
    """The pictures of a file, or of its content, which may be animated."""
    with PillowImage.open(io.BytesIO(file) if isinstance(file, bytes) else file) as opened:
        return [np.array(frame.convert("RGB")) for frame in ImageSequence.Iterator(opened)]


def pixels_of(file: bytes | str | Path) -> Pixels:
    """The first of them, or the only one."""
    return frames_of(file)[0]


def recolored(mesh: Mesh, color: ArrayLike) -> Mesh:
    """The mesh in one colour."""
    return evolve(mesh, colors=np.tile(np.asarray(color), (len(mesh.positions), 1)))


def soup(corners: ArrayLike, colors: ArrayLike = WHITE) -> Mesh:
    """A mesh of (n, 3, 3) corners; `colors` is one colour, or one for each triangle."""
    points = np.asarray(corners, dtype=np.float64).reshape(-1, 3)
    each = np.repeat(np.broadcast_to(np.asarray(colors), (len(points) // 3, 3)), 3, axis=0)
    return Mesh(points, np.arange(len(points)).reshape(-1, 3), each)


def pixel_grid_camera(height: int, near: float = 0.0) -> Camera:
    """An orthographic camera for which one unit is 1/256 of a pixel, on a canvas of so many rows."""
    return Camera(projection="orthographic", half_height=128.0 * height, near=near)


def on_pixel_grid(points: ArrayLike, width: int, height: int, z: float = -1.0) -> NDArray[np.float64]:
    """(..., 2) columns and rows in 1/256 of a pixel, from the top left corner, as points that `pixel_grid_camera` puts
    there.
    """
    grid = np.asarray(points, dtype=np.float64)
    x, y = grid[..., 0] - 128 * width, 128 * height - grid[..., 1]
    return np.stack([x, y, np.full_like(x, z)], axis=-1)


def unlit_scene(objects: Any, camera: Camera, width: int, height: int | None = None, **more: Any) -> Scene:
    """A scene on a canvas; one mesh stands for an unlit object of which both sides are seen."""
    if isinstance(objects, Mesh):
        objects = [Object(objects, material=UNLIT, cull=False)]
    return Scene(objects, camera, width=width, height=height or width, **more)


def projected(scene: Scene) -> NDArray[np.float64]:
    """(n, 2): where the vertices are in the picture, -1..1 to the right and upward; all must be before the eye."""
    camera = scene.camera
    eye, back = camera.eye, camera.eye - camera.target
    back = back / np.linalg.norm(back)
    right = np.cross(camera.up, back)
    right /= np.linalg.norm(right)
    seen = scene.world_positions() - eye
    depth = -seen @ back
    assert (depth > 0).all()
    size = camera.half_height * (depth if camera.projection == "perspective" else 1)
    return np.stack([seen @ right / size * scene.height / scene.width, seen @ np.cross(back, right) / size], axis=1)
