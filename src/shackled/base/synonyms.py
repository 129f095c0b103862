"""Synonyms: keywords of other libraries that are accepted, and hints for names that do not exist."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from difflib import get_close_matches
from functools import wraps
from inspect import Parameter, signature
from typing import TYPE_CHECKING, Any, TypeVar

from attrs.exceptions import FrozenInstanceError

from ..errors import KeywordError

Made = TypeVar("Made", bound=Callable[..., Any])
#: Keywords with their values.
Given = dict[str, Any]
#: The most names that an error lists.
MOST_NAMES = 16
#: How alike a name must be to be meant, from 0 to 1.
CUTOFF = 0.7

#: Of all that takes a look.
_LOOK = {
    "aa": "antialias",
    "azim": "azimuth",
    "bg": "background",
    "colour": "color",
    "elev": "elevation",
    "emissive": "emission",
    "light": "lights",
    "resolution": "size",
    "rotation": "rotate",
    "shadows": "shadow",
    "window_size": "size",
}
#: Settings of other libraries with their values, and what these are here.
_VALUES: dict[tuple[str, object], tuple[str, object]] = {
    ("smooth_shading", True): ("shading", "smooth"),
    ("smooth_shading", False): ("shading", "flat"),
    ("style", "wireframe"): ("wireframe", True),
    ("style", "surface"): ("wireframe", False),
}
#: Colours of one letter, as in matplotlib.
_LETTERS = dict(
    zip("bgrcmykw", ("#00f", "#008000", "#f00", "#00bfbf", "#bf00bf", "#bfbf00", "#000", "#fff"), strict=True)
)
_COLOR = {"colour": "color"}
_CAMERA = {"look_at": "target", "position": "eye", "yfov": "fov"}
_PICTURE = {"alpha": "transparent"}
_FILM = {**_PICTURE, "n_frames": "frames"}
#: Synonyms of keywords, by what takes these: a class, a function, or a look.
SYNONYMS = {
    "look": _LOOK,
    "Animation": {"images": "frames"},
    "Camera": _CAMERA,
    "Light": {**_COLOR, "pos": "position", "type": "kind"},
    "Material": {"emissive": "emission", "map": "texture"},
    "Mesh": {
        **dict.fromkeys(("points", "vertices", "verts"), "positions"),
        **dict.fromkeys(("color", "colour", "colours", "vertex_colors"), "colors"),
        "triangles": "faces",
        "uv": "uvs",
        "vertex_normals": "normals",
    },
    "Object": {
        **_COLOR,
        **dict.fromkeys(("location", "translate", "translation"), "position"),
        "matrix": "transform",
        "rotate": "rotation",
    },
    "directional": _COLOR,
    "point": _COLOR,
    "spot": _COLOR,
    "perspective": _CAMERA,
    "render": _PICTURE,
    "turntable": _FILM,
    "animate": _FILM,
}

_SURFACE = "`color`, `shading`, `specular` and others set it, or render an Object with a Material"
_FILE = "`save` of what is returned writes it to a file"
_SCENE_FIXED = "a Scene does not change: give all objects to Scene([...]), or to shackled.replace(scene, objects=...)"
#: What to give instead of a keyword, an attribute, or a name of the package.
HINTS = {
    **dict.fromkeys(("output", "path", "filename"), _FILE),
    **dict.fromkeys(("width", "height", "dpi"), "`size` is the side in pixels, or (width, height)"),
    **dict.fromkeys(("cmap", "scalars"), "Mesh(positions, faces, colors=...) has a colour for each vertex"),
    **dict.fromkeys(("smooth_shading", "style"), "`shading` is flat, smooth or unlit, `wireframe` draws edges only"),
    "shape": "`size` is the side in pixels, or (width, height); the `pixels` of a picture have a shape",
    "bounds": "mesh.positions.min(axis=0) and mesh.positions.max(axis=0) are the corners of its box",
    "camera_position": "`eye`, `target` and `up` place the camera, or `azimuth` and `elevation` turn it",
    "size": "`width` and `height` are the sides in pixels",
    "show": "shackled.render(scene).show() opens its picture, shackled.view(scene) turns it in a notebook",
    "show_edges": "`wireframe` draws edges only",
    "PointLight": "shackled.Light.point makes a light at a position",
    "DirectionalLight": "shackled.Light.directional makes a light at infinity",
    "SpotLight": "shackled.Light.spot makes a light that shines into a cone",
    "PerspectiveCamera": "shackled.Camera.perspective makes one",
    "add": _SCENE_FIXED,
    "append": _SCENE_FIXED,
    "alpha": "`transparent` of render leaves out the background, `opacity` is that of the objects",
    "camera": "`eye`, `target`, `up` and `fov` place the camera, `use_camera` takes that of a glTF file",
    "depth": "depths are not returned",
    "to_trimesh": "trimesh.Trimesh(mesh.positions, mesh.faces, vertex_colors=mesh.rgba, process=False) makes one",
    "export": "shackled.export(scene, path) writes a page, and the command `shackled export` also a .glb file",
    "fps": "`duration` is the time of a frame in milliseconds",
    "images": "`frames` has them",
    "intensity": "a light has a colour, of which darker ones are weaker; `exposure` multiplies all light",
    "list_models": "shackled.datasets.pieces() yields all pieces",
    "load": "shackled.load(path) returns a scene, shackled.scene.read_mesh(path) a mesh, Texture.open(path) a texture",
    "material": _SURFACE,
    "projection": "did you mean orthographic?",
    "texture": f"{_SURFACE} that has a texture",
}


def hint(name: str, known: Iterable[str]) -> str:
    """Return what was meant by a name that is not known, or else what is known."""
    names = list(known)
    if name in HINTS:
        return HINTS[name]
    if close := get_close_matches(name, names, 1, CUTOFF):
        return f"did you mean {close[0]}?"
    return f"known are {', '.join(names)}" if len(names) <= MOST_NAMES else "`shackled render --help` lists all"


def understood(owner: str, given: Given) -> Given:
    """Return keywords with synonyms replaced. KeywordError where one is given twice."""
    found: Given = {}
    for name, value in given.items():
        ours = SYNONYMS.get(owner, {}).get(name, name)
        if name == "alpha" and isinstance(value, float):  # of objects, not of the picture
            ours = name
        if owner == "look" and isinstance(value, str | bool):
            ours, value = _VALUES.get((name, value), (ours, value))
            value = _LETTERS.get(str(value), value) if "color" in ours or ours == "background" else value
        if ours in found or (ours != name and ours in given):
            raise KeywordError(f"`{name}` and `{ours}` are the same: give one of them")
        found[ours] = value
    return found


def with_synonyms(*more: str, read: Callable[[Given], Given] | None = None) -> Callable[[Made], Made]:
    """Return a decorator of functions, and of frozen attrs classes, that also take the synonyms of their keywords.

    more: keywords that are no parameters, which `read` replaces by some that are. A KeywordError hints at what was
    meant by any other.
    """

    def decorated(made: Made) -> Made:
        is_class = isinstance(made, type)
        function: Any = made.__init__ if is_class else made
        kinds = {name: each.kind for name, each in signature(function).parameters.items()}
        positional = [name for name, kind in kinds.items() if kind is Parameter.POSITIONAL_OR_KEYWORD]
        by_name = [name for name, kind in kinds.items() if kind is Parameter.KEYWORD_ONLY]
        known = [*(name for name in [*positional, *by_name] if name not in ("self", "cls")), *more]
        has_look = Parameter.VAR_KEYWORD in kinds.values()

        @wraps(function)
        def understanding(*args: Any, **given: Any) -> Any:
            given = understood(made.__name__, given)
            for name in () if has_look else given:
                if name not in known:
                    raise KeywordError(f"{made.__qualname__} has no keyword {name!r}; {hint(name, known)}", name)
            if "thing" in known and len(args) > 1 and _is_rows(args[0]) and _is_rows(args[1]):
                args = ((args[0], args[1]), *args[2:])
            named = dict(zip(positional, args, strict=False))
            if read is not None and len(named) == len(args) and not named.keys() & given.keys():
                args, given = (), read({**named, **given})
            try:
                return function(*args, **given)
            except KeywordError as error:
                # one of a look is not known there, which does not know those of the function
                if not (close := get_close_matches(error.keyword, known, 1, CUTOFF) if has_look else []):
                    raise
                text = f"{made.__name__} has no keyword {error.keyword!r}; did you mean {close[0]}?"
                raise KeywordError(text) from None

        if not is_class:
            return understanding  # type: ignore[return-value]

        def refuse(self: Any, name: str, *value: Any) -> None:
            error = FrozenInstanceError()
            error.args = (f"a {made.__name__} does not change: shackled.replace(it, {name}=...) makes a changed copy",)
            raise error

        for name, method in (("__init__", understanding), ("__setattr__", refuse), ("__delattr__", refuse)):
            setattr(made, name, method)
        return made

    return decorated


def _is_rows(value: Any) -> bool:
    """Return whether a value is a table, such as the vertices or the faces of a mesh."""
    try:
        return not isinstance(value, str) and hasattr(value[0], "__len__")
    except (TypeError, LookupError):
        return False


def _missing(kind: type, name: str) -> AttributeError:
    text = f"; {HINTS[name]}" if name in HINTS else ""
    return AttributeError(f"{kind.__name__} has no attribute {name!r}{text}", name=name)


class HintedType(type):
    """The type of classes that hint at what there is in place of an attribute that is not there."""

    if not TYPE_CHECKING:

        def __getattr__(cls, name: str) -> Any:
            raise _missing(cls, name)


class Hinted(metaclass=HintedType):
    """A base of values that hint at what there is in place of an attribute that is not there."""

    __slots__ = ()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise _missing(type(self), name)
