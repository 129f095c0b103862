"""The words of other programs: those that are taken in place of the library's, and what to give instead of others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from difflib import get_close_matches
from functools import wraps
from inspect import Parameter, signature
from types import ModuleType
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from attrs.exceptions import FrozenInstanceError

from ..errors import InputError, KeywordError

P = ParamSpec("P")
R = TypeVar("R")
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
#: Settings of other programs with their values, and what these are here.
_VALUES: dict[tuple[str, object], Given] = {
    ("smooth_shading", True): {"shading": "smooth"},
    ("smooth_shading", False): {"shading": "flat"},
    ("style", "wireframe"): {"wireframe": True},
    ("style", "surface"): {"wireframe": False},
}
#: Colours of one letter, as in matplotlib.
_LETTERS = dict(
    zip("bgrcmykw", ("#00f", "#008000", "#f00", "#00bfbf", "#bf00bf", "#bfbf00", "#000", "#fff"), strict=True)
)
_COLOR = {"colour": "color"}
_CAMERA = {"look_at": "target", "position": "eye", "yfov": "fov"}
_PICTURE = {"alpha": "transparent"}
_FILM = {**_PICTURE, "n_frames": "frames"}
#: Other words for keywords, by what has these: a class, a function, or a look.
SAME = {
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
INSTEAD = {
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


def instead_of(name: str, known: Iterable[str]) -> str:
    """Return what was meant by a name that is not known, or else what is known."""
    names = list(known)
    if name in INSTEAD:
        return INSTEAD[name]
    if close := get_close_matches(name, names, 1, CUTOFF):
        return f"did you mean {close[0]}?"
    return f"known are {', '.join(names)}" if len(names) <= MOST_NAMES else "`shackled render --help` lists all"


def in_our_words(owner: str, given: Given) -> Given:
    """Return keywords with the words of other programs replaced. KeywordError where one is given twice."""
    found: Given = {}
    for name, value in given.items():
        # a number is that of objects, not of the picture
        ours = name if name == "alpha" and isinstance(value, float) else SAME.get(owner, {}).get(name, name)
        if owner == "look" and isinstance(value, str | bool):
            value = _LETTERS.get(str(value), value) if "color" in ours or ours == "background" else value
            ((ours, value),) = _VALUES.get((name, value), {ours: value}).items()
        if ours in found or (ours != name and ours in given):
            raise KeywordError(f"`{name}` and `{ours}` are the same: give one of them")
        found[ours] = value
    return found


def with_words(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that also takes the words of other programs, as `SAME` and `INSTEAD` have them."""
    parameters = signature(function).parameters
    named = [name for name, each in parameters.items() if each.kind in (each.POSITIONAL_OR_KEYWORD, each.KEYWORD_ONLY)]
    has_look = any(each.kind == Parameter.VAR_KEYWORD for each in parameters.values())

    @wraps(function)
    def understanding(*args: Any, **given: Any) -> Any:
        given = in_our_words(function.__name__, given)
        if "thing" in named:
            if {"vertices", "faces"} <= given.keys():
                given["thing"] = (given.pop("vertices"), given.pop("faces"))
            elif len(args) > 1 and _is_rows(args[0]) and _is_rows(args[1]):
                args = ((args[0], args[1]), *args[2:])
        if "transparent" in named and str(given.get("background")).strip().lower() == "transparent":
            given = {**given, "background": None, "transparent": True}
        if "duration" in named:
            given = with_duration(given)
        if not has_look:
            _check(function.__qualname__, given, [name for name in named if name != "cls"])
        try:
            return function(*args, **given)
        except KeywordError as error:
            # one of a look is not known there, which does not know those of the function
            close = get_close_matches(error.keyword, named, 1, CUTOFF)
            if close:
                raise KeywordError(
                    f"{function.__name__} has no keyword {error.keyword!r}; did you mean {close[0]}?"
                ) from None
            raise

    return understanding


def _is_rows(value: Any) -> bool:
    """Return whether a value is a table, such as the vertices or the faces of a mesh."""
    try:
        return not isinstance(value, str) and hasattr(value[0], "__len__")
    except (TypeError, LookupError):
        return False


def with_duration(given: Given) -> Given:
    """Return keywords with the duration of a frame in milliseconds in place of `fps`, the frames in a second."""
    if "fps" not in given:
        return given
    if "duration" in given:
        raise InputError("`fps` and `duration` exclude each other: give one of them")
    fps = given.pop("fps")
    try:
        given["duration"] = round(1000 / fps)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        raise InputError(f"`fps` must be the number of frames in a second, not {fps!r:.60}") from None
    return given


def words_of(
    *more: str, read: Callable[[Given], Given] | None = None, fields: Sequence[str] = ()
) -> Callable[[type[R]], type[R]]:
    """Return a decorator of frozen attrs classes whose constructors also take the words of other programs.

    more: keywords that are no fields, which `read` replaces by some that are.
    """

    def decorated(made: type[R]) -> type[R]:
        constructor: Any = made.__init__
        names = [*fields, *(each.name for each in getattr(made, "__attrs_attrs__", ()))]

        @wraps(constructor)
        def understanding(self: Any, *args: Any, **given: Any) -> None:
            given = in_our_words(made.__name__, given)
            _check(made.__name__, given, [*names, *more])
            if read is not None and len(args) <= len(names):
                positional = dict(zip(names, args, strict=False))
                if not positional.keys() & given.keys():
                    args, given = (), read({**positional, **given})
            constructor(self, *args, **given)

        def refuse(self: Any, name: str, *value: Any) -> None:
            error = FrozenInstanceError()
            error.args = (f"a {made.__name__} does not change: shackled.replace(it, {name}=...) makes a changed copy",)
            raise error

        for name, method in (("__init__", understanding), ("__setattr__", refuse), ("__delattr__", refuse)):
            setattr(made, name, method)
        return made

    return decorated


def _check(owner: str, given: Given, names: Sequence[str]) -> None:
    for name in given:
        if name not in names:
            raise KeywordError(f"{owner} has no keyword {name!r}; {instead_of(name, names)}", name)


class Package(ModuleType):
    """A package whose name is that of what it does: called as a function, it names its functions."""

    def __call__(self, *_: object, **__: object) -> None:
        """Raise a TypeError."""
        raise TypeError(f"{self.__name__} is a package: call one of its functions, {', '.join(self.__all__)}")


class Worded(type):
    """A metaclass of values, which say what there is in place of an attribute that is not there."""

    if not TYPE_CHECKING:

        def __getattr__(cls, name: str) -> Any:
            raise _missing(cls, name)


def _missing(kind: type, name: str) -> AttributeError:
    hint = f"; {INSTEAD[name]}" if name in INSTEAD else ""
    return AttributeError(f"{kind.__name__} has no attribute {name!r}{hint}", name=name)


class Words(metaclass=Worded):
    """A base of values, which say what there is in place of an attribute that is not there."""

    __slots__ = ()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise _missing(type(self), name)
