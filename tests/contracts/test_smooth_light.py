"""The bounds within which the light of smooth triangles is made of quadratic products: see SmoothTriangle.sol.

A search in float64 looks for the largest error that they let through; the judge looks for it in pictures. Beyond them,
light is that of each point.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from judge import render
from pictures import call_data, draw
from shackled import Camera, Light, Material, Mesh, Object, Scene

Array = NDArray[np.float64]
Booleans = NDArray[np.bool_]
#: Many triangles: places on the screen (m, 3, 2), by the focal length; depths (m, 3); normals (m, 3, 3); whether
#: the light is a lamp; its direction and its place (m, 3); shininess, specular and diffuse coefficients (m,).
Triangles = dict[str, Array]

ENDS = ([0, 0, 1], [1, 2, 2])
#: Barycentric coordinates: the vertices, the middles of the edges, and the inner point; and all over a triangle.
NODES = np.vstack([np.eye(3), (np.eye(3)[ENDS[0]] + np.eye(3)[ENDS[1]]) / 2, [[0.5, 0.25, 0.25]]])
GRID = np.array([(i, j, 8 - i - j) for i in range(9) for j in range(9 - i)]) / 8
#: Levels that no accepted triangle may be off (searches of minutes find 12.1 with products of vertices, 10.9 with those
#: of midpoints); the largest specular coefficient.
FOUND, SPECULAR = 12.5, 1.5


def dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(axis=-1))


def unit(v: Array) -> Array:
    return np.asarray(v / np.linalg.norm(v, axis=-1, keepdims=True))


def some_triangles(rng: np.random.Generator, m: int) -> Triangles:
    """Of all sizes, with a highlight on most of them."""
    xy = rng.uniform(-1, 1, (m, 1, 2)) * rng.choice([0.2, 0.6, 1], (m, 1, 1))
    xy = xy + rng.normal(size=(m, 3, 2)) * 10 ** rng.uniform(-2.2, -0.2, (m, 1, 1))
    depth = np.exp(rng.uniform(-1, 1, (m, 3)) * 10 ** rng.uniform(-3, -0.3, (m, 1)))
    toward = unit(rng.normal(size=(m, 3)))
    middle = (np.dstack([xy, np.ones((m, 3))]) * depth[..., None]).mean(axis=1)
    t = {"xy": xy, "depth": depth, "lamp": rng.random(m) < 0.4, "toward": toward}
    t |= {"place": middle + toward * 10 ** rng.uniform(-0.2, 1.5, (m, 1)), "n": 2.0 ** rng.integers(1, 8, m)}
    t |= {"k": np.exp(rng.uniform(np.log(0.1), np.log(SPECULAR), m)), "kd": rng.uniform(-0.4, 1, m).clip(0)}
    spread = rng.normal(size=(m, 1, 3)) * 10 ** rng.uniform(-3, -0.3, (m, 1, 1))
    spread = spread + rng.normal(size=(m, 3, 3)) * 10 ** rng.uniform(-2.5, 0.1, (m, 1, 1))
    t["normal"] = np.zeros((m, 3, 3))
    return t | {"normal": unit(vectors(t, NODES[:3])[2].mean(axis=1, keepdims=True) + spread)}


def changed(rng: np.random.Generator, t: Triangles) -> Triangles:
    """A little."""
    m = len(t["n"])
    amount = 10 ** rng.uniform(-3, -0.5, m)

    def noise(name: str, factor: float) -> Array:
        shape = t[name].shape
        return np.asarray(rng.normal(size=shape) * factor * amount.reshape(m, *[1] * (len(shape) - 1)))

    return t | {
        "xy": t["xy"] + noise("xy", 0.3) * rng.integers(0, 2, (m, 1, 1)),
        "depth": t["depth"] * np.exp(noise("depth", 0.3)),
        "normal": unit(t["normal"] + noise("normal", 0.5) * rng.integers(0, 2, (m, 1, 1))),
        "toward": unit(t["toward"] + noise("toward", 0.5) * rng.integers(0, 2, (m, 1))),
        "place": t["place"] + noise("place", 1),
        "n": (t["n"] * 2.0 ** rng.integers(-1, 2, m)).clip(2, 128),
        "k": (t["k"] * np.exp(noise("k", 1))).clip(0.05, SPECULAR),
    }


def vectors(t: Triangles, at: Array) -> tuple[Array, Array, Array, Array, Booleans]:
    """At (p, 3): N times the relative depth word, L, H, |L + V|^2, and whether the lamp is far enough; (m, p, ...)."""
    ray = np.concatenate([at @ t["xy"], np.ones((len(t["n"]), len(at), 1))], axis=2)
    word = 1 / t["depth"]
    point = ray / (word @ at.T)[..., None]
    to_lamp, lamp = t["place"][:, None] - point, t["lamp"][:, None].astype(bool)
    light = np.where(lamp[..., None], unit(to_lamp), t["toward"][:, None])
    half = light - unit(ray)
    normal = at @ (t["normal"] * (word / word.max(axis=1, keepdims=True))[..., None])
    far = ~lamp | (dot(point, point) <= 1.25 * dot(to_lamp, to_lamp))
    return normal, light, unit(half), dot(half, half), far


def judged(t: Triangles, exact_middles: bool, by_nodes: bool) -> tuple[Booleans, Array]:
    """Whether triangles are accepted, by the bounds of SmoothTriangle.sol, and their errors in levels.

    by_nodes: whether the light itself is interpolated, from that of products at six nodes: see SmoothLight.sol.
    """
    n, k, kd = t["n"], t["k"], np.maximum(t["kd"], 1e-9)
    normal, light, half, length, far = vectors(t, NODES)
    bends, turns = (v[:, ENDS[0]] - v[:, ENDS[1]] for v in (normal, half))
    bend, turn = (dot(v, v).max(axis=1) for v in (bends, turns))
    square = dot(normal, normal)
    q = square[:, :3].min(axis=1) - bend / 3
    # products at the nodes, and between them
    sums = [v[:, ENDS[0]] + v[:, ENDS[1]] for v in (light, half)]
    diffuse, specular = dot(normal, light), dot(normal, half)
    if not exact_middles:
        diffuse[:, 3:6] = dot(normal[:, 3:6], sums[0]) / 2
        specular[:, 3:6] = dot(normal[:, 3:6], sums[1]) / 2 + dot(turns, turns) / 8
    shape = [np.hstack([w * (2 * w - 1), 4 * w[:, ENDS[0]] * w[:, ENDS[1]]]).T for w in (GRID, NODES[6:])]
    products = [v[:, :6] @ shape[0] for v in (square, diffuse, specular)]
    # the light of these, and that of each point
    true = vectors(t, GRID)
    lit, shine = (dot(unit(true[0]), v) for v in true[1:3])
    root = np.sqrt(products[0].clip(1e-9))
    cosine = np.where(products[1] > 0, (products[2] / root).clip(0, 1), 0)
    cosines = [v[:, :6] / np.sqrt(square[:, :6]) for v in (diffuse, specular)]
    if by_nodes:
        products[1], root = cosines[0] @ shape[0], np.ones_like(root)
        cosine = np.where(products[1] > 0, (cosines[1] @ shape[0]).clip(0, 1), 0)
    error = 255 * t["kd"][:, None] * np.abs(products[1].clip(0) / root - lit.clip(0))
    highlight = np.abs(cosine ** n[:, None] - np.where(lit > 0, shine.clip(0) ** n[:, None], 0))
    # where the light is in the surface the highlight ends
    error += 255 * k[:, None] * highlight * (np.abs(lit) >= 0.04)
    # bounds
    word = t["depth"].min(axis=1) / t["depth"].max(axis=1)
    size = ((t["xy"][:, 1:] - t["xy"][:, :1]) ** 2).sum(axis=(1, 2))
    lamp_reach = np.where(t["lamp"], 13 / (255 * kd), np.inf)
    nodes = 6 if exact_middles else 3
    good = (q >= 0.25) & far[:, :nodes].all(axis=1) & (length[:, :nodes] > 1).all(axis=1)
    # a plausible field of view
    good &= (np.abs(t["xy"]) < 1.1).all(axis=(1, 2)) & (np.abs(np.log(t["depth"])) < 3).all(axis=1)
    levels = 255 * k * n
    size = size + t["lamp"] * (word < 980 / 1024) * ((1 - word) / word) ** 2
    reach = 0.174 / (k * np.sqrt(n))
    if not exact_middles:
        reach = np.minimum(reach, lamp_reach) / np.where((length[:, :3] >= 3).all(axis=1), 1, 4)
        good &= (size < reach) & (levels * turn * (1 - q) / (12 * q) <= 3.5)
        if by_nodes:
            is_shiny = (cosines[1].clip(0) ** 2).max(axis=1) > 1 - 2.8 / n - 0.19
            good &= bend < np.where(is_shiny, np.minimum(1 / np.sqrt(n * k), 0.65), 0.65)
            good &= square[:, :3].min(axis=1) > 0.75
        return good, error.max(axis=1)
    good &= (size < np.minimum(20 * reach, 8 * lamp_reach)) & (turn < 3 / 8)
    skew = 2 * np.abs(dot(half[:, 3:6], turns)) + np.abs(dot(bends, 2 * half[:, 3:6] - sums[1]))
    inner = np.abs(specular[:, :6] @ shape[1][:, 0] - specular[:, 6])
    near = (specular.clip(0) ** 2 / square).max(axis=1) > 1 - 2.8 / n - (bend + turn) / 4
    good &= ~near | ((skew.max(axis=1) / 8 + inner) * levels * (1 + q) / (2 * q) <= 3.5)
    return good, error.max(axis=1)


def worst(exact_middles: bool, by_nodes: bool, generations: int = 14, seed: int = 0) -> float:
    """The largest error of an accepted triangle: of random ones, and of those that resemble the worst."""
    rng, best, scores = np.random.default_rng(seed), some_triangles(np.random.default_rng(seed), 1), np.full(1, -1.0)
    for generation in range(generations):
        count = 400 if generation > 3 else 1500
        more = some_triangles(rng, count)
        near = changed(rng, {name: v[rng.integers(0, len(scores), 1500 - count)] for name, v in best.items()})
        more = {name: np.concatenate([best[name], near[name], v]) for name, v in more.items()}
        good, error = judged({name: v[len(scores) :] for name, v in more.items()}, exact_middles, by_nodes)
        scores = np.concatenate([scores, np.where(good, error, -1)])
        order = np.argsort(-scores)[:100]
        best, scores = {name: v[order] for name, v in more.items()}, scores[order]
    return float(scores[0])


@pytest.mark.parametrize(
    ("exact_middles", "by_nodes"),
    [(False, False), (True, False), (False, True)],
    ids=["vertices", "midpoints", "light at nodes"],
)
def test_accepted_triangles_have_the_light_of_their_points(exact_middles: bool, by_nodes: bool) -> None:
    """Within the bounds of SmoothTriangle.sol, for products of vertices and of midpoints, and of SmoothLight.sol."""
    assert 4 < worst(exact_middles, by_nodes) < FOUND


# ---- beyond the bounds ----

SHINY = Material("smooth", ambient=0.2, diffuse=0.7, specular=0.5, shininess=20)
AHEAD = (0.0, 0.0, 1.0)
LIGHTS = [Light("point", (4, 6, 3)), Light("point", (-3, 2, 2), (255, 200, 120))]


def one_triangle(normals: list[tuple[float, float, float]], light: Light) -> Scene:
    """A triangle before the camera."""
    mesh = Mesh([[-200, -160, 0], [200, -160, 0], [0, 180, 0]], [[0, 1, 2]], [(200, 180, 160)] * 3, normals)
    thing = Object(mesh, (0, 0, -5), scale=2**-10, material=SHINY, cull=False)
    return Scene([thing], Camera(near=0.1), [light], width=64, height=64)


def error(scene: Scene) -> int:
    """How far the contract's picture is from the judge's where there is a triangle away from its edges."""
    expected = render(call_data("render", scene))
    there = expected.triangle >= 0
    inner = there.copy()
    inner[1:-1, 1:-1] &= there[:-2, 1:-1] & there[2:, 1:-1] & there[1:-1, :-2] & there[1:-1, 2:]
    assert inner.any()
    return int(np.abs(draw(scene).astype(int) - expected.pixels)[inner].max())


def leaning(angle: float, turn: float) -> tuple[float, float, float]:
    """A normal that leans away from the eye by an angle, in degrees."""
    a, b = np.radians(angle), np.radians(turn)
    return float(np.sin(a) * np.cos(b)), float(np.sin(a) * np.sin(b)), float(np.cos(a))


#: Triangles whose light no quadratic function is near: it is computed at each of their points.
EXACT = {
    "normals that almost lie in the surface": ([leaning(88, turn) for turn in (0, 120, 240)], LIGHTS[0]),
    "opposite normals": ([leaning(89, 0), leaning(89, 180), AHEAD], LIGHTS[1]),
    "a lamp nearer than the eye": ([AHEAD] * 3, Light("point", (0, 0, -3))),
    "a half vector against the light": ([AHEAD] * 3, Light("directional", (0.05, 0, -1))),
}


@pytest.mark.parametrize("name", EXACT)
def test_light_that_is_computed_point_by_point(name: str) -> None:
    assert error(one_triangle(*EXACT[name])) <= 1
