"""Calls of the Renderer contract: the scene in their data."""

from __future__ import annotations

from ..artifacts import artifact
from ..errors import RenderError
from .checks import check_layout, word
from .structs import Camera, Canvas, Light, Material, Object, Rectangle, Scene
from .vector import Vector
from .words import signed

#: Bytes of the struct of a scene before its arrays.
SCENE_SIZE = 32 * 21


class Reader:
    """Reads the words of an ABI encoding, one after the other; offsets count from where the reader began."""

    def __init__(self, data: bytes, begin: int) -> None:
        """`begin`: where in the data of the call."""
        self.data = data
        self.begin = begin
        self.place = begin

    def unsigned(self) -> int:
        """The next word."""
        self.place += 32
        return word(self.data, self.place - 32)

    def signed(self) -> int:
        """The next word as a two's complement number."""
        return signed(self.unsigned())

    def vector(self) -> Vector:
        """The next three words."""
        return self.signed(), self.signed(), self.signed()

    def jump(self) -> Reader:
        """A reader of what the next word, an offset, points to."""
        return Reader(self.data, self.begin + self.unsigned())

    def elements(self) -> tuple[int, Reader]:
        """The length of the array that the next word points to, and a reader of its elements."""
        reader = self.jump()
        return reader.unsigned(), Reader(self.data, reader.place)


def read_call(data: bytes) -> tuple[Scene, Rectangle]:
    """What the data of a call of the Renderer that draws a scene ask for: a scene and the part to draw."""
    selectors = artifact("Renderer").selectors
    is_tile = data[:4] in (selectors["renderTile"], selectors["renderTileCounted"])
    reader = Reader(data, 4)
    base = 4 + reader.unsigned()
    if len(data) < (4 + 32 * 5 if is_tile else 4 + 32) or base + SCENE_SIZE > len(data):
        raise RenderError("the contract refused: the data of the call is not a scene as it should be encoded")
    check_layout(data, base)
    scene = read_scene(Reader(data, base))
    if is_tile:
        return scene, Rectangle(reader.unsigned(), reader.unsigned(), reader.unsigned(), reader.unsigned())
    return scene, Rectangle(0, 0, scene.canvas.width, scene.canvas.height)


def read_scene(reader: Reader) -> Scene:
    """The struct of a scene."""
    canvas = Canvas(reader.unsigned(), reader.unsigned())
    camera = Camera(
        eye=reader.vector(),
        target=reader.vector(),
        up=reader.vector(),
        projection=reader.unsigned(),
        half_height=reader.signed(),
        near=reader.signed(),
    )
    top, bottom = reader.unsigned(), reader.unsigned()
    invert, ambient_light = reader.unsigned(), reader.unsigned()
    count, elements = reader.elements()
    lights = tuple(Light(elements.unsigned(), elements.vector(), elements.unsigned()) for _ in range(count))
    count, elements = reader.elements()
    objects = tuple(read_object(elements.jump()) for _ in range(count))
    length, content = reader.elements()
    extensions = reader.data[content.begin : content.begin + length]
    return Scene(canvas, camera, top, bottom, invert, ambient_light, lights, objects, extensions)


def read_object(reader: Reader) -> Object:
    """The struct of an object."""
    length, content = reader.elements()
    return Object(
        mesh=reader.data[content.begin : content.begin + length],
        mesh_header=content.unsigned() >> 216,
        position=reader.vector(),
        rotation=(*reader.vector(), reader.signed()),
        scale=reader.signed(),
        material=Material(reader.unsigned(), reader.signed(), reader.signed(), reader.signed(), reader.unsigned()),
        flags=reader.unsigned(),
    )
