"""A picture of the result of each stage of the pipeline: the pipeline figure of the paper.

Stages 3 to 6 are drawn by the contracts: the same scene as wireframe, in plain colours, with light, and complete. The
contracts return pixels only, so the points of stages 1 and 2 are projected here, in double precision.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike
from PIL import Image as PillowImage
from PIL import ImageDraw, ImageFont

from .base.checks import Floats
from .base.values import plural
from .chain._chain import Chain
from .chain._opening import open_chain
from .image import Pixels, decode_bmp
from .scene._effects import Background
from .scene._in_range import in_range
from .scene._mesh import Mesh
from .scene._object import Material, Object
from .scene._scene import Scene

BLACK, WHITE = Background((0, 0, 0)), Background((255, 255, 255))
#: The two greys of the checkerboard, and the side of its squares at 128 pixels.
CHECKS, CHECK_SIDE = (46, 54), 8
UNLIT = Material("unlit")

#: Multiples of the golden ratio, modulo 1, are evenly distributed for any count.
GOLDEN = (5**0.5 - 1) / 2
DARKEST = 0.45

#: The strip: minimum side of a picture, margin, and height of the caption.
STRIP_SIDE, MARGIN, CAPTION = 224, 12, 44
PAPER, PRINT, FINE_PRINT = (22, 25, 31), (236, 239, 243), (150, 158, 168)


@dataclass(frozen=True)
class Stage:
    """The result of a stage. pixels: (H, W, 3), rows from the top. detail: figures in words."""

    name: str
    title: str
    detail: str
    pixels: Pixels


def draw_stages(scene: Scene, chain: Chain | None = None) -> list[Stage]:
    """Return the six stages of the paper, in their order. Errors as `render` raises them."""
    chain = chain or open_chain()
    sent = in_range(scene)
    colors = np.concatenate([np.zeros((0, 3), np.uint8), *(o.mesh.colors for o in sent.objects)])
    seen, on_canvas = projected_points(sent, colors)
    drawing = chain.draw(scene)
    triangles, lit_pixels = chain.count(scene)
    plain = evolve(scene, invert=False, antialias=False)
    wires, fill = (over_nothing(evolve(plain, objects=list(map(to, plain.objects))), chain) for to in (edges, filled))
    gas = "" if drawing.gas is None else f", {drawing.gas:,} gas"
    specified = f"{len(colors):,} points, {sent.triangles:,} faces"
    composited = f"{scene.width} x {scene.height} pixels{gas}"
    picture = decode_bmp(drawing.bmp, scene.width, scene.height)
    return [
        Stage("1-vertices", "Vertex specification", specified, specified_points(sent, colors)),
        Stage("2-projected", "Vertex shader", f"{on_canvas:,} points on the canvas", seen),
        Stage("3-triangles", "Primitive assembly", f"{triangles:,} triangles left", wires),
        Stage("4-filled", "Rasterization", f"{lit_pixels:,} pixels covered", fill),
        Stage("5-lit", "Fragment shader", _lights(scene), over_nothing(plain, chain)),
        Stage("6-picture", "Compositing", composited, picture),
    ]


# ---- points ----


def specified_points(scene: Scene, colors: Pixels) -> Pixels:
    """Draw the vertices in world space, from the front (+z), without a camera, filling the canvas."""
    world = scene.world_positions()
    if not len(world):
        return nothing(scene)
    low, high = scene.bounds
    size = np.array([scene.width, scene.height])
    unit = float(((high - low)[:2] / (0.75 * size)).max()) or 1.0
    middle = (low + high)[:2] / 2
    flat = (world[:, :2] - middle) / unit * (1, -1) + size / 2
    return with_points(nothing(scene), flat, colors, world[:, 2])


def projected_points(scene: Scene, colors: Pixels) -> tuple[Pixels, int]:
    """Draw the vertices on the canvas that the near plane does not clip, and count them."""
    places, distances = project(scene.world_positions(), scene)
    size = scene.width, scene.height
    inside = (distances >= (scene.camera.near or 0.0)) & ((places >= 0) & (places < size)).all(axis=1)
    return with_points(nothing(scene), places[inside], colors[inside], -distances[inside]), int(inside.sum())


def project(points: Floats, scene: Scene) -> tuple[Floats, Floats]:
    """Return where points of the world (n, 3) appear, in pixels from the top left corner, and their distances."""
    camera = scene.camera
    forward = camera.target - camera.eye
    right = np.cross(forward, camera.up)
    up = np.cross(right, forward)
    x, y, distances = ((points - camera.eye) @ (axis / np.linalg.norm(axis)) for axis in (right, up, forward))
    flat = np.stack([x, -y], axis=1) * scene.height / (2 * camera.half_height)
    if camera.projection == "perspective":
        # nothing is seen behind the eye
        flat /= np.where(distances > 0, distances, np.inf)[:, None]
    return flat + np.array([scene.width, scene.height]) / 2, distances


def with_points(pixels: Pixels, places: Floats, colors: ArrayLike, order: Floats) -> Pixels:
    """Draw points as dots, the highest order last. places: (n, 2) pixels from the top left corner."""
    picture = PillowImage.fromarray(pixels)
    brush = ImageDraw.Draw(picture)
    few = np.clip(5 - 1.6 * np.log10(max(1, len(places))), 1, 4)
    radius = max(0.5, min(pixels.shape[:2]) / 256 * float(few))
    table = np.asarray(colors).tolist()
    for i in np.argsort(order, kind="stable"):
        x, y = places[i] - 0.5
        if -radius <= x <= pixels.shape[1] + radius and -radius <= y <= pixels.shape[0] + radius:
            brush.ellipse((x - radius, y - radius, x + radius, y + radius), fill=tuple(table[i]))
    return np.array(picture)


# ---- what the contracts draw ----


def edges(o: Object) -> Object:
    """Return an object as wireframe."""
    return evolve(o, wireframe=True, material=UNLIT)


def filled(o: Object) -> Object:
    """Return an object in the colours of its vertices, with varied brightness per triangle."""
    faces = o.mesh.faces
    if o.wireframe:
        return evolve(o, material=UNLIT)
    shades = DARKEST + (1 - DARKEST) * (np.arange(len(faces)) * GOLDEN % 1)
    colors = o.mesh.colors[faces] * shades[:, None, None]
    corners = np.arange(faces.size).reshape(-1, 3)
    split = Mesh(o.mesh.positions[faces].reshape(-1, 3), corners, np.rint(colors).astype(np.uint8).reshape(-1, 3))
    return evolve(o, mesh=split, material=UNLIT)


def over_nothing(scene: Scene, chain: Chain) -> Pixels:
    """Draw the fragments of a scene without its background: the pixels that do not depend on it."""
    on_black, on_white = (
        decode_bmp(chain.draw(evolve(scene, background=background)).bmp, scene.width, scene.height)
        for background in (BLACK, WHITE)
    )
    is_fragment = (on_black == on_white).all(axis=2, keepdims=True)
    return np.where(is_fragment, on_black, nothing(scene))


def nothing(scene: Scene) -> Pixels:
    """Return a checkerboard, which stands for transparency."""
    side = max(1, CHECK_SIDE * min(scene.width, scene.height) // 128)
    rows, columns = np.indices((scene.height, scene.width)) // side
    grey = np.where((rows + columns) % 2, *CHECKS).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)


def _lights(scene: Scene) -> str:
    shadings = sorted({o.material.shading for o in scene.objects})
    lights = plural(len(scene.lights), "light")
    return f"{' and '.join(shadings)}, {lights}" if shadings else lights


# ---- the strip ----


def strip(stages: list[Stage]) -> PillowImage.Image:
    """Draw the stages side by side, each with its name and number below."""
    height, width = stages[0].pixels.shape[:2]
    enlarged = max(1, -(-STRIP_SIDE // min(width, height)))
    width, height = width * enlarged, height * enlarged
    title, fine = ImageFont.load_default(15), ImageFont.load_default(12)
    across = (width + MARGIN) * len(stages) + MARGIN
    picture = PillowImage.new("RGB", (across, height + 2 * MARGIN + CAPTION), PAPER)
    brush = ImageDraw.Draw(picture)
    for number, stage in enumerate(stages):
        left = MARGIN + number * (width + MARGIN)
        shown = PillowImage.fromarray(stage.pixels).resize((width, height), PillowImage.Resampling.NEAREST)
        picture.paste(shown, (left, MARGIN))
        brush.text((left, height + MARGIN + 8), f"{number + 1}  {stage.title}", PRINT, title)
        brush.text((left, height + MARGIN + 30), stage.detail, FINE_PRINT, fine)
    return picture
