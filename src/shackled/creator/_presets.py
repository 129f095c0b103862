"""Looks: presets of lights, material, background and drawing. They leave object, camera and size as they are."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ._controls import around
from ._scene import Facts, filled
from ._state import Backdrop, Lamp, State, Surface


@dataclass(frozen=True)
class Preset:
    """A look.

    lamps: with azimuths relative to the camera, so that the look does not depend on the direction of the view.
    cull: None culls back faces if the object is closed.
    """

    name: str
    title: str
    help: str
    surface: Surface
    lamps: tuple[Lamp, ...]
    background: Backdrop
    ambient_light: str = "#ffffff"
    cull: bool | None = None
    wireframe: bool = False
    invert: bool = False


def _lamp(azimuth: float, elevation: float, color: str = "#ffffff") -> Lamp:
    return Lamp("directional", azimuth, elevation, color=color)


PRESETS: tuple[Preset, ...] = (
    Preset(
        "studio",
        "Studio",
        "Its own colours under one soft white light.",
        Surface("smooth", 0.32, 0.72, 0.25, 24),
        (_lamp(-30, 42),),
        Backdrop("#e9edf2", "#9aa5b4"),
    ),
    Preset(
        "clay",
        "Clay",
        "Terracotta on warm paper.",
        Surface("smooth", 0.3, 0.8, 0.12, 8, "#c8674a"),
        (_lamp(-38, 50),),
        Backdrop("#f6ecdf", "#d8c3a9"),
        "#ffeadb",
    ),
    Preset(
        "gold",
        "Gold",
        "Polished metal in the dark.",
        Surface("smooth", 0.22, 0.62, 0.95, 34, "#e0a52e"),
        (_lamp(-35, 45, "#fff3d6"), _lamp(60, 10, "#ff9a3c")),
        Backdrop("#1c130a", "#4a3212"),
        "#ffd98a",
    ),
    Preset(
        "neon",
        "Neon",
        "Cyan from the left, magenta from the right.",
        Surface("smooth", 0.12, 0.85, 0.8, 40, "#d8dcff"),
        (_lamp(-70, 15, "#00e5ff"), _lamp(70, 10, "#ff2bd6")),
        Backdrop("#070312", "#1d0b3a"),
        "#5a4bff",
    ),
    Preset(
        "noir",
        "Noir",
        "One hard light from the side on black.",
        Surface("smooth", 0.03, 1.0, 0.6, 30, "#dddddd"),
        (_lamp(-75, 25),),
        Backdrop("#000000", "#1b1b1b"),
    ),
    Preset(
        "sunset",
        "Sunset",
        "A low orange sun against a violet sky.",
        Surface("flat", 0.34, 0.9, 0.35, 16),
        (_lamp(-60, 12, "#ff9b54"), _lamp(80, 40, "#5a63c8")),
        Backdrop("#2b1b52", "#ff8f5a"),
        "#b9a4ff",
    ),
    Preset(
        "facets",
        "Facets",
        "Every triangle is visible, as in a cut gem.",
        Surface("flat", 0.2, 0.75, 0.85, 12, "#5fc7c1"),
        (_lamp(-40, 50), _lamp(65, -5, "#7d8cff")),
        Backdrop("#0f2027", "#2c5364"),
    ),
    Preset(
        "blueprint",
        "Blueprint",
        "White lines on blue.",
        Surface("unlit", color="#e8f1ff"),
        (),
        Backdrop("#0b3d91", "#072a66"),
        wireframe=True,
    ),
    Preset(
        "xray",
        "X-ray",
        "Light and dark are swapped.",
        Surface("smooth", 0.1, 0.9, 0.2, 10, "#f2e6dc"),
        (_lamp(0, 0),),
        Backdrop("#f4f1ea", "#ffffff"),
        invert=True,
    ),
    Preset(
        "flat",
        "Unlit",
        "Unlit colours; lowest gas.",
        Surface("unlit"),
        (),
        Backdrop("#f4f1ea", "#f4f1ea"),
    ),
)


def preset(name: str) -> Preset | None:
    """Return the look of that name, or None."""
    return next((each for each in PRESETS if each.name == name), None)


def apply_look(look: Preset, state: State, facts: Facts) -> State:
    """Return the state with a look."""
    camera = filled(state, facts).camera
    azimuth = camera.azimuth if camera is not None else 0.0
    lamps = tuple(replace(lamp, azimuth=round(around(lamp.azimuth + azimuth), 1)) for lamp in look.lamps)
    return replace(
        state,
        surface=look.surface,
        opacities=State(state.source).opacities,
        lights=lamps,
        lights_follow=False,
        ambient_light=look.ambient_light,
        background=look.background,
        cull=facts.closed if look.cull is None else look.cull,
        wireframe=look.wireframe,
        invert=look.invert,
    )
