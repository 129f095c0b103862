"""The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple


class Field(NamedTuple):
    """A field of a class.

    kind: as in the table; "" for one that is checked by hand. called: how messages call it. limits: the least and the
    greatest number, or the words of a choice. only: "file" for a key of scene files that is no field, "class" for a
    field that is no key. lights: the kinds of lights that have it; of all if empty.
    """

    kind: str
    called: str
    limits: tuple[Any, ...] = ()
    default: Any = None
    is_needed: bool = False
    only: str = ""
    lights: tuple[str, ...] = ()


Shading = Literal["unlit", "flat", "smooth"]
SHADINGS: tuple[Shading, ...] = ("unlit", "flat", "smooth")
Projection = Literal["perspective", "orthographic"]
PROJECTIONS: tuple[Projection, ...] = ("perspective", "orthographic")
LightKind = Literal["directional", "point", "spot"]
LIGHT_KINDS: tuple[LightKind, ...] = ("directional", "point", "spot")
Filter = Literal["nearest", "bilinear"]
FILTERS: tuple[Filter, ...] = ("nearest", "bilinear")
Wrap = Literal["repeat", "clamp"]
WRAPS: tuple[Wrap, ...] = ("repeat", "clamp")
Axis = Literal["x", "y", "z"]
AXES: tuple[Axis, ...] = ("x", "y", "z")

FIELDS: dict[str, dict[str, Field]] = {
    "Mesh": {
        "positions": Field("", "the positions", is_needed=True),
        "faces": Field("", "the faces", is_needed=True),
        "colors": Field("", "the colors"),
        "normals": Field("", "the normals"),
        "uvs": Field("", "the uvs"),
        "opacities": Field("", "the opacities"),
    },
    "Texture": {
        "image": Field("", "the image of a texture", only="file"),
        "width": Field("whole", "the width of a texture", (1, 256), is_needed=True),
        "height": Field("whole", "the height of a texture", (1, 256), is_needed=True),
        "pixels": Field("", "the pixels of a texture", is_needed=True),
        "filter": Field("choice", "the filter of a texture", (FILTERS,), default="bilinear"),
        "wrap": Field("choice", "the wrap of a texture", (WRAPS,), default="repeat"),
        "alpha": Field("", "the alpha of a texture"),
        "cutoff": Field("whole", "the cutoff of a texture", (0, 255), default=0),
    },
    "Material": {
        "shading": Field("choice", "the shading of a material", (SHADINGS,), default="flat"),
        "ambient": Field("number", "the ambient coefficient of a material", (0, 4), default=0.3),
        "diffuse": Field("number", "the diffuse coefficient of a material", (0, 4), default=0.75),
        "specular": Field("number", "the specular coefficient of a material", (0, 4), default=0.3),
        "shininess": Field("whole", "the shininess of a material", (1, 128), default=24),
        "texture": Field("", "the texture of a material"),
        "emission": Field("color", "the emission of a material", default=(0, 0, 0)),
    },
    "Object": {
        "mesh": Field("", "the mesh of an object", is_needed=True),
        "position": Field("vector", "the position of an object", default=(0, 0, 0)),
        "rotation": Field("", "the rotation of an object", default=(0, 0, 0, 1)),
        "up_axis": Field("choice", "the up_axis of an object", (AXES,), only="file"),
        "scale": Field("number", "the scale of an object", (0,), default=1),
        "color": Field("color", "the colour of an object", only="file"),
        "crease": Field("number", "the crease of an object", (0, 180), only="file"),
        "material": Field("", "the material of an object"),
        "cull": Field("flag", "cull of an object", default=True),
        "wireframe": Field("flag", "wireframe of an object", default=False),
        "two_sided": Field("flag", "two_sided of an object", default=False),
        "opacity": Field("number", "the opacity of an object", (0, 1), default=1),
        "fade": Field("pair", "the fade of an object"),
    },
    "Camera": {
        "eye": Field("vector", "the camera's eye", default=(0, 0, 0)),
        "target": Field("vector", "the camera's target", default=(0, 0, -1)),
        "up": Field("vector", "the camera's up", default=(0, 1, 0)),
        "azimuth": Field("number", "the camera's azimuth", default=30, only="file"),
        "elevation": Field("number", "the camera's elevation", (-90, 90), default=20, only="file"),
        "margin": Field("number", "the camera's margin", (0, 0.9), default=0.08, only="file"),
        "projection": Field("choice", "the camera's projection", (PROJECTIONS,), default="perspective"),
        "fov": Field("number", "the camera's fov", (0.2, 179.8), only="file"),
        "half_height": Field("number", "the camera's half_height", (0,), default=1 / 2.145),
        "near": Field("number", "the camera's near distance"),
    },
    "Light": {
        "kind": Field("choice", "the kind of a light", (LIGHT_KINDS,), is_needed=True),
        "position": Field("vector", "the position of a light", is_needed=True, lights=("point", "spot")),
        "direction": Field("vector", "the direction of a spot light", is_needed=True, lights=("directional", "spot")),
        "color": Field("color", "the colour of a light", default=(255, 255, 255)),
        "inner_angle": Field("number", "the inner_angle of a spot light", (0, 180), default=0, lights=("spot",)),
        "outer_angle": Field("number", "the outer_angle of a spot light", (0, 180), default=45, lights=("spot",)),
        "shadow": Field("flag", "shadow of a light", default=False),
    },
    "Background": {
        "top": Field("color", "the background colour", default=(0, 0, 0)),
        "bottom": Field("color", "the colour at the bottom of the background"),
    },
    "Hemisphere": {
        "sky": Field("color", "the sky of a hemisphere", is_needed=True),
        "ground": Field("color", "the ground of a hemisphere", default=(0, 0, 0)),
    },
    "Rim": {
        "color": Field("color", "the colour of a rim", is_needed=True),
        "power": Field("whole", "the power of a rim", (1, 16), default=3),
    },
    "Fog": {
        "color": Field("color", "the colour of the fog", is_needed=True),
        "near": Field("number", "the near distance of the fog", (0,), is_needed=True),
        "far": Field("number", "the far distance of the fog", (0,), is_needed=True),
    },
    "Tone": {
        "exposure": Field("number", "the exposure", (0, 64), default=1),
        "filmic": Field("flag", "filmic of a tone", default=False),
        "gamma": Field("flag", "gamma of a tone", default=False),
    },
    "Ground": {
        "color": Field("color", "the colour of a ground", is_needed=True),
        "height": Field("number", "the height of a ground"),
        "radius": Field("number", "the radius of a ground", (0,)),
        "center": Field("pair", "the center of a ground"),
        "inner": Field("number", "the inner radius of a ground", (0,)),
    },
    "Scene": {
        "size": Field("", "the size of a scene", only="file"),
        "objects": Field("", "the objects of a scene", is_needed=True),
        "camera": Field("", "the camera of a scene"),
        "lights": Field("", "the lights of a scene"),
        "background": Field("", "the background of a scene"),
        "ambient_light": Field("color", "the ambient light", default=(255, 255, 255)),
        "invert": Field("flag", "invert of a scene", default=False),
        "antialias": Field("flag", "antialias of a scene", default=False),
        "hemisphere": Field("", "the hemisphere of a scene"),
        "rim": Field("", "the rim of a scene"),
        "fog": Field("", "the fog of a scene"),
        "tone": Field("", "the tone of a scene"),
        "ground": Field("", "the ground of a scene"),
        "width": Field("whole", "width", (1, 2048), default=128, only="class"),
        "height": Field("whole", "height", (1, 2048), default=128, only="class"),
        "creator": Field("", "the creator of a scene", only="file"),
    },
}
