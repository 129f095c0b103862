"""Any state, for tests of properties."""

from __future__ import annotations

from hypothesis import strategies as st

from shackled.creator import (
    MAX_OPACITIES,
    Backdrop,
    Curve,
    Haze,
    Lamp,
    Orbit,
    Outline,
    Pose,
    Size,
    Sky,
    Source,
    State,
    Surface,
    control,
)
from shackled.scene import LIGHT_KINDS


def numbers(path: str) -> st.SearchStrategy[float]:
    """What a control takes."""
    of = control(path)
    if of.whole:
        return st.integers(int(of.low), int(of.high))
    return st.floats(of.low, of.high).map(lambda value: value + 0.0)


def vectors(path: str) -> st.SearchStrategy[tuple[float, float, float]]:
    """Three of them."""
    return st.tuples(*(numbers(f"{path}.{axis}") for axis in "xyz"))


colors = st.integers(0, 0xFFFFFF).map("#{:06x}".format)
flags = st.none() | st.booleans()


def states() -> st.SearchStrategy[State]:
    """Of any source."""
    names = st.sampled_from(["teapot", "icons/coin", "genesis/7", "genesis/" + "0f" * 32])
    sources = st.builds(Source, st.just("piece"), names) | st.builds(
        Source, st.just("upload"), st.binary(min_size=32, max_size=32).map(bytes.hex)
    )
    orbits = st.builds(
        Orbit,
        vectors("camera.target"),
        numbers("camera.distance"),
        numbers("camera.azimuth"),
        numbers("camera.elevation"),
        numbers("camera.roll"),
        st.sampled_from(["perspective", "orthographic"]),
        numbers("camera.fov"),
    )
    lamps = st.builds(
        Lamp,
        st.sampled_from(LIGHT_KINDS),
        numbers("lights.0.azimuth"),
        numbers("lights.0.elevation"),
        numbers("lights.0.distance"),
        colors,
        vectors("lights.0.target"),
        numbers("lights.0.inner_angle"),
        numbers("lights.0.outer_angle"),
    )
    surfaces = st.builds(
        Surface,
        st.none() | st.sampled_from(["unlit", "flat", "smooth"]),
        *(st.none() | numbers(f"surface.{name}") for name in ("ambient", "diffuse", "specular", "shininess")),
        st.none() | colors,
        st.none() | numbers("surface.opacity"),
    )
    return st.builds(
        State,
        sources,
        st.builds(Pose, vectors("pose.position"), vectors("pose.rotation"), numbers("pose.scale")),
        st.none() | orbits,
        st.none() | st.lists(lamps, max_size=4).map(tuple),
        st.booleans(),
        st.none() | colors,
        st.none() | st.builds(Sky, st.booleans(), colors, colors),
        st.none() | st.builds(Outline, st.booleans(), colors, numbers("rim.power")),
        st.none() | st.builds(Haze, st.booleans(), colors, numbers("fog.near"), numbers("fog.far")),
        st.none() | st.builds(Curve, numbers("tone.exposure"), st.booleans(), st.booleans()),
        surfaces,
        st.tuples(*[st.none() | numbers("opacities.0")] * MAX_OPACITIES),
        st.none() | st.builds(Backdrop, colors, colors),
        flags,
        flags,
        flags,
        flags,
        st.none() | st.builds(Size, numbers("size.width"), numbers("size.height")),
        st.none() | numbers("max_triangles"),
    )
