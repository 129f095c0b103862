"""A picture of the result of each stage of the pipeline: the pipeline figure of the paper.

Stages 3 to 6 are drawn by the contracts: the same scene as wireframe, in plain colours, with light, and complete. The
contracts return pixels only, so the points of stages 1 and 2 come from the reference renderer, which has the same
numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray
from PIL import Image as PillowImage
from PIL import ImageDraw, ImageFont

from .chain import Chain, open_chain
from .image import decode_bmp
from .reference.call import read_call
from .reference.layout import PIXEL_BIAS
from .reference.pipeline import Geometry, assemble
from .reference.vector import to_matrix
from .scene import MAX_VERTICES, Background, Material, Mesh, Object, Scene, encode

Pixels = NDArray[np.uint8]

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
    data = encode(b"\0\0\0\0", scene)
    geometry = assemble(*read_call(data))[2]
    drawing = chain.draw(scene)
    triangles, lit_pixels = chain.count(scene)
    given = sum(len(part.mesh.faces) for part in geometry)
    seen, on_canvas = projected_points(geometry, scene)
    points = sum(len(part.vertices) for part in geometry)
    plain = evolve(scene, invert=False, antialias=False)
    gas = "" if drawing.gas is None else f", {drawing.gas:,} gas"
    return [
        Stage(
            "1-vertices",
            "Vertex specification",
            f"{points:,} points, {given:,} faces",
            specified_points(geometry, scene),
        ),
        Stage("2-projected", "Vertex shader", f"{on_canvas:,} points on the canvas", seen),
        Stage(
            "3-triangles",
            "Primitive assembly",
            f"{triangles:,} triangles left",
            over_nothing(_each(plain, edges), chain),
        ),
        Stage("4-filled", "Rasterization", f"{lit_pixels:,} pixels covered", over_nothing(_each(plain, filled), chain)),
        Stage("5-lit", "Fragment shader", _lights(scene), over_nothing(plain, chain)),
        Stage(
            "6-picture",
            "Compositing",
            f"{scene.width} x {scene.height} pixels{gas}",
            decode_bmp(drawing.bmp, scene.width, scene.height),
        ),
    ]


# ---- points ----


def specified_points(geometry: Iterable[Geometry], scene: Scene) -> Pixels:
    """Draw the vertices in world space, from the front (+z), without a camera, filling the canvas."""
    places, colors = [], []
    for part in geometry:
        # the columns of the rotation matrix are the images of the axes
        axes = np.array(to_matrix(part.object.rotation), float) / 2**32
        scale = part.object.scale / 2**32
        places.append(scale * np.array(part.mesh.positions, float) @ axes + np.array(part.object.position) / 2**32)
        colors.append(np.array(part.mesh.colors))
    if not places:
        return nothing(scene)
    world = np.concatenate(places)
    low, high = world.min(axis=0), world.max(axis=0)
    size = np.array([scene.width, scene.height])
    unit = float(((high - low)[:2] / (0.75 * size)).max()) or 1.0
    middle = (low + high)[:2] / 2
    flat = (world[:, :2] - middle) / unit * (1, -1) + size / 2
    return with_points(nothing(scene), flat, np.concatenate(colors), world[:, 2])


def projected_points(geometry: Iterable[Geometry], scene: Scene) -> tuple[Pixels, int]:
    """Draw the vertices where the vertex shader put them, and count those on the canvas."""
    places, colors, depths = [], [], []
    for part in geometry:
        for vertex, color in zip(part.vertices, part.mesh.colors, strict=True):
            if not vertex.must_clip:
                # from 1/256 pixels, the centre of pixel 0 at 0
                places.append((vertex.x / 256 - PIXEL_BIAS + 0.5, vertex.y / 256 - PIXEL_BIAS + 0.5))
                colors.append(color)
                depths.append(float(vertex.attributes >> 168))
    if not places:
        return nothing(scene), 0
    flat = np.array(places)
    inside = int(((flat >= 0) & (flat < (scene.width, scene.height))).all(axis=1).sum())
    return with_points(nothing(scene), flat, np.array(colors), np.array(depths)), inside


def with_points(pixels: Pixels, places: NDArray[np.float64], colors: ArrayLike, order: NDArray[np.float64]) -> Pixels:
    """Draw points as dots, the highest order last. places: (n, 2) pixels from the top left corner."""
    picture = PillowImage.fromarray(pixels)
    brush = ImageDraw.Draw(picture)
    few = np.clip(5 - 1.6 * np.log10(len(places)), 1, 4)
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
    if o.wireframe or faces.size > MAX_VERTICES:
        return evolve(o, material=UNLIT)
    shades = DARKEST + (1 - DARKEST) * (np.arange(len(faces)) * GOLDEN % 1)
    colors = o.mesh.colors[faces] * shades[:, None, None]
    split = Mesh(
        o.mesh.positions[faces].reshape(-1, 3),
        np.arange(faces.size).reshape(-1, 3),
        np.rint(colors).astype(np.uint8).reshape(-1, 3),
    )
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


def _each(scene: Scene, change: Callable[[Object], Object]) -> Scene:
    return evolve(scene, objects=[change(o) for o in scene.objects])


def _lights(scene: Scene) -> str:
    shadings = sorted({o.material.shading for o in scene.objects})
    lights = f"{len(scene.lights)} light{'' if len(scene.lights) == 1 else 's'}"
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
