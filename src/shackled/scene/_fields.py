"""The fields of scenes. Written by tools/scene_fields.py from contracts/scene_fields.toml."""

# ruff: noqa: E501
# fmt: off

from __future__ import annotations

from typing import Any, Literal, NamedTuple


class Field(NamedTuple):
    """A field of a class.

    kind: as in the table; "" for one that is checked by hand. called: how messages call it. limits: the least and the
    greatest number. default: None where there is none. only: "file" for a key of scene files that is no field, "class"
    for a field that is no key. lights: the kinds of lights that have it; of all if empty.
    """

    called: str
    kind: str = ""
    limits: tuple[Any, ...] = ()
    choices: tuple[str, ...] = ()
    default: Any = None
    needed: bool = False
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
        "positions": Field("the positions", needed=True),
        "faces": Field("the faces", needed=True),
        "colors": Field("the colors"),
        "normals": Field("the normals"),
        "uvs": Field("the uvs"),
        "opacities": Field("the opacities"),
    },
    "Texture": {
        "image": Field("the image of a texture", only="file"),
        "width": Field("the width of a texture", kind="whole", limits=(1, 256), needed=True),
        "height": Field("the height of a texture", kind="whole", limits=(1, 256), needed=True),
        "pixels": Field("the pixels of a texture", needed=True),
        "filter": Field("the filter of a texture", kind="choice", choices=("nearest", "bilinear"), default="bilinear"),
        "wrap": Field("the wrap of a texture", kind="choice", choices=("repeat", "clamp"), default="repeat"),
        "alpha": Field("the alpha of a texture"),
        "cutoff": Field("the cutoff of a texture", kind="whole", limits=(0, 255), default=0),
    },
    "Material": {
        "shading": Field("the shading of a material", kind="choice", choices=("unlit", "flat", "smooth"), default="flat"),
        "ambient": Field("the ambient coefficient of a material", kind="number", limits=(0, 4), default=0.3),
        "diffuse": Field("the diffuse coefficient of a material", kind="number", limits=(0, 4), default=0.75),
        "specular": Field("the specular coefficient of a material", kind="number", limits=(0, 4), default=0.3),
        "shininess": Field("the shininess of a material", kind="whole", limits=(1, 128), default=24),
        "texture": Field("the texture of a material"),
        "emission": Field("the emission of a material", kind="color", default=(0, 0, 0)),
    },
    "Object": {
        "mesh": Field("the mesh of an object", needed=True),
        "position": Field("the position of an object", kind="vector", default=(0, 0, 0)),
        "rotation": Field("the rotation of an object", default=(0, 0, 0, 1)),
        "up_axis": Field("the up_axis of an object", kind="choice", choices=("x", "y", "z"), only="file"),
        "scale": Field("the scale of an object", kind="number", limits=(0,), default=1),
        "color": Field("the colour of an object", kind="color", only="file"),
        "crease": Field("the crease of an object", kind="number", limits=(0, 180), only="file"),
        "material": Field("the material of an object"),
        "cull": Field("cull of an object", kind="flag", default=True),
        "wireframe": Field("wireframe of an object", kind="flag", default=False),
        "two_sided": Field("two_sided of an object", kind="flag", default=False),
        "opacity": Field("the opacity of an object", kind="number", limits=(0, 1), default=1),
        "fade": Field("the fade of an object", kind="pair"),
    },
    "Camera": {
        "eye": Field("the camera's eye", kind="vector", default=(0, 0, 0)),
        "target": Field("the camera's target", kind="vector", default=(0, 0, -1)),
        "up": Field("the camera's up", kind="vector", default=(0, 1, 0)),
        "azimuth": Field("the camera's azimuth", kind="number", default=30, only="file"),
        "elevation": Field("the camera's elevation", kind="number", limits=(-90, 90), default=20, only="file"),
        "margin": Field("the camera's margin", kind="number", limits=(0, 0.9), default=0.08, only="file"),
        "projection": Field("the camera's projection", kind="choice", choices=("perspective", "orthographic"), default="perspective"),
        "fov": Field("the camera's fov", kind="number", limits=(0.2, 179.8), only="file"),
        "half_height": Field("the camera's half_height", kind="number", limits=(0,), default=0.4662004662004662),
        "near": Field("the camera's near distance", kind="number"),
    },
    "Light": {
        "kind": Field("the kind of a light", kind="choice", choices=("directional", "point", "spot"), needed=True),
        "position": Field("the position of a light", kind="vector", needed=True, lights=("point", "spot")),
        "direction": Field("the direction of a spot light", kind="vector", needed=True, lights=("directional", "spot")),
        "color": Field("the colour of a light", kind="color", default=(255, 255, 255)),
        "inner_angle": Field("the inner_angle of a spot light", kind="number", limits=(0, 180), default=0, lights=("spot",)),
        "outer_angle": Field("the outer_angle of a spot light", kind="number", limits=(0, 180), default=45, lights=("spot",)),
        "shadow": Field("shadow of a light", kind="flag", default=False),
    },
    "Background": {
        "top": Field("the background colour", kind="color", default=(0, 0, 0)),
        "bottom": Field("the colour at the bottom of the background", kind="color"),
    },
    "Hemisphere": {
        "sky": Field("the sky of a hemisphere", kind="color", needed=True),
        "ground": Field("the ground of a hemisphere", kind="color", default=(0, 0, 0)),
    },
    "Rim": {
        "color": Field("the colour of a rim", kind="color", needed=True),
        "power": Field("the power of a rim", kind="whole", limits=(1, 16), default=3),
    },
    "Fog": {
        "color": Field("the colour of the fog", kind="color", needed=True),
        "near": Field("the near distance of the fog", kind="number", limits=(0,), needed=True),
        "far": Field("the far distance of the fog", kind="number", limits=(0,), needed=True),
    },
    "Tone": {
        "exposure": Field("the exposure", kind="number", limits=(0, 64), default=1),
        "filmic": Field("filmic of a tone", kind="flag", default=False),
        "gamma": Field("gamma of a tone", kind="flag", default=False),
    },
    "Ground": {
        "color": Field("the colour of a ground", kind="color", needed=True),
        "height": Field("the height of a ground", kind="number"),
        "radius": Field("the radius of a ground", kind="number", limits=(0,)),
        "center": Field("the center of a ground", kind="pair"),
        "inner": Field("the inner radius of a ground", kind="number", limits=(0,)),
    },
    "Scene": {
        "size": Field("the size of a scene", only="file"),
        "objects": Field("the objects of a scene", needed=True),
        "camera": Field("the camera of a scene"),
        "lights": Field("the lights of a scene"),
        "background": Field("the background of a scene"),
        "ambient_light": Field("the ambient light", kind="color", default=(255, 255, 255)),
        "invert": Field("invert of a scene", kind="flag", default=False),
        "antialias": Field("antialias of a scene", kind="flag", default=False),
        "hemisphere": Field("the hemisphere of a scene"),
        "rim": Field("the rim of a scene"),
        "fog": Field("the fog of a scene"),
        "tone": Field("the tone of a scene"),
        "ground": Field("the ground of a scene"),
        "width": Field("width", kind="whole", limits=(1, 2048), default=128, only="class"),
        "height": Field("height", kind="whole", limits=(1, 2048), default=128, only="class"),
        "creator": Field("the creator of a scene", only="file"),
    },
}
