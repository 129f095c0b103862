"""The Cornell box, from the measurements that the Cornell University Program of Computer Graphics published.

C. M. Goral, K. E. Torrance, D. P. Greenberg, B. Battaile: Modeling the interaction of light between diffuse surfaces,
SIGGRAPH 1984; the numbers are those of the box with two blocks, "The Cornell Box: Data", Cornell University Program of
Computer Graphics, 1998. In millimetres; the viewer is at -z, and x grows to the left.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...scene._camera import Camera
from ...scene._effects import Background
from ...scene._light import Light
from ...scene._mesh import Mesh
from ...scene._object import Material, Object
from ...scene._scene import Scene

Point = tuple[float, float, float]
Color = tuple[int, int, int]
Quad = tuple[Point, Point, Point, Point]

#: The measured reflectances are spectra; these are colours for a screen that look like photographs of the box.
WHITE, RED, GREEN = (226, 219, 203), (190, 52, 40), (74, 148, 62)
LAMP_COLOR = (255, 250, 228)

HEIGHT = 548.8
LAMP: Quad = ((343, HEIGHT, 227), (343, HEIGHT, 332), (213, HEIGHT, 332), (213, HEIGHT, 227))
CEILING: Quad = ((556, HEIGHT, 0), (556, HEIGHT, 559.2), (0, HEIGHT, 559.2), (0, HEIGHT, 0))
FLOOR: Quad = ((552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
BACK_WALL: Quad = ((549.6, 0, 559.2), (0, 0, 559.2), (0, HEIGHT, 559.2), (556, HEIGHT, 559.2))
RIGHT_WALL: Quad = ((0, 0, 559.2), (0, 0, 0), (0, HEIGHT, 0), (0, HEIGHT, 559.2))
LEFT_WALL: Quad = ((552.8, 0, 0), (549.6, 0, 559.2), (556, HEIGHT, 559.2), (556, HEIGHT, 0))
#: Height, and the corners (x, z) of the top, in the order of the published data.
SHORT_BLOCK = (165.0, ((130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)))
TALL_BLOCK = (330.0, ((423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)))

EYE: Point = (278, 273, -800)
#: The camera's focal length is 0.035, its film 0.025 by 0.025.
HALF_HEIGHT = 0.025 / 2 / 0.035


def cornell_box() -> Scene:
    """Return the box with its lamp in the ceiling, seen by the published camera.

    Its light casts no shadows.
    """
    ceiling = [(CEILING[k], CEILING[(k + 1) % 4], LAMP[(k + 1) % 4], LAMP[k]) for k in range(4)]
    room = [FLOOR, *ceiling, BACK_WALL, RIGHT_WALL, LEFT_WALL]
    material = Material("flat", ambient=0.35, diffuse=0.75, specular=0, shininess=1)
    # in the place of the light that the walls throw back at them
    brighter = Material("flat", ambient=0.52, diffuse=0.6, specular=0, shininess=1)
    middle = np.mean(LAMP, axis=0)
    return Scene(
        [
            Object(_quads(room, *[WHITE] * 6, GREEN, RED), material=material),
            Object(_block(*SHORT_BLOCK), material=brighter),
            Object(_block(*TALL_BLOCK), material=brighter),
            Object(_quads([LAMP], LAMP_COLOR), material=Material("unlit")),
        ],
        camera=Camera(EYE, (EYE[0], EYE[1], 0), half_height=HALF_HEIGHT),
        # a little below the ceiling, so that its light brushes along it
        lights=[Light("point", (middle[0], HEIGHT - 60, middle[2]))],
        background=Background((0, 0, 0)),
    )


def _block(height: float, corners: Sequence[tuple[float, float]]) -> Mesh:
    """Return the top and the four sides of a block, seen from outside."""
    top, bottom = ([(x, y, z) for x, z in corners] for y in (height, 0.0))
    sides = [(top[k], bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4]) for k in range(4)]
    return _quads([(top[0], top[1], top[2], top[3]), *sides], *[WHITE] * 5)


def _quads(quads: Sequence[Quad], *colors: Color) -> Mesh:
    first = 4 * np.arange(len(quads))[:, None]
    faces = np.concatenate([first + np.array(half) for half in ((0, 1, 2), (0, 2, 3))])
    return Mesh(np.reshape(quads, (-1, 3)), faces, np.repeat(colors, 4, axis=0))
