"""What must not change a picture, or only in one direction, over scenes that hypothesis makes.

Colours are compared where both pictures show one triangle on all sides of a pixel. What triangles pixels show may
differ where `judge` allows it: at edges, and at equal depth.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from attrs import evolve
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray

from conformance import contracts
from conformance.neighbours import around, interior
from judge import render
from pictures import call, call_data
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.scene import Rectangle, fit, vertex_normals
from shackled.scene._object import Shading

Integers = NDArray[np.int64]
Array = NDArray[np.float64]

SIZE = 48
#: Scales that are multiples of this are whole multiples of 2^-32 after a division by any factor of FACTORS.
SCALE_STEP = 2520 / 2**16
FACTORS = (2, 3, 5, 7, 9, 10)

#: Examples are not made smaller: it takes minutes, and the first one says enough.
EACH = settings(max_examples=60, deadline=None, phases=[Phase.generate], suppress_health_check=list(HealthCheck))


# ---- scenes, in numbers that the contracts take as they are ----

colors = st.one_of(st.just((255, 255, 255)), st.tuples(*[st.integers(0, 255)] * 3))
small = st.integers(-3, 3)
directions = st.tuples(small, small, small).filter(any)


@st.composite
def meshes(draw: st.DrawFn) -> Mesh:
    """Small meshes of whole numbers. The colours are odd, so that there is one half way between any two."""
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    kind = draw(st.sampled_from(["field", "box", "triangles"]))
    if kind == "box":
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * rng.integers(1, 4, 3)
        quads = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
        positions, faces = corners, quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    elif kind == "field":
        x, z = (line.ravel() for line in np.mgrid[-1:2, -1:2])
        positions = np.stack([2 * x, rng.integers(-1, 2, 9), 2 * z], axis=1)
        quads = np.array([(a, a + 1, a + 4, a + 3) for a in (0, 1, 3, 4)])
        faces = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    else:
        positions, faces = rng.integers(-20, 21, (9, 3)), np.arange(9).reshape(3, 3)
    chosen = np.full((len(positions), 3), 255) if rng.random() < 0.3 else 2 * rng.integers(0, 128, positions.shape) + 1
    normals = vertex_normals(positions.astype(float), faces)
    normals[~normals.any(axis=1)] = [0.0, 1.0, 0.0]
    return Mesh(positions, faces, chosen, normals)


SHADINGS: tuple[Shading, ...] = ("flat", "flat", "smooth", "unlit")
coefficients = st.sampled_from([0.5, 0.0, 0.25, 1.0, 2.5])


@st.composite
def materials(draw: st.DrawFn) -> Material:
    shading = draw(st.sampled_from(SHADINGS))
    shininess = draw(st.sampled_from([1, 2, 10, 33, 128]))
    return Material(shading, draw(coefficients), draw(coefficients), draw(coefficients), shininess)


@st.composite
def objects(draw: st.DrawFn) -> Object:
    mesh = draw(meshes())
    extent = float(np.abs(mesh.positions).max())
    return Object(
        mesh,
        position=draw(st.tuples(*[st.integers(-600, 600)] * 3)),
        rotation=draw(st.one_of(st.just((0, 0, 0, 1)), st.tuples(small, small, small, small).filter(any))),
        scale=max(round(draw(st.integers(800, 3000)) / extent / SCALE_STEP), 1) * SCALE_STEP,
        material=draw(materials()),
        cull=draw(st.booleans()),
    )


@st.composite
def lights(draw: st.DrawFn) -> Light:
    if draw(st.booleans()):
        return Light("directional", draw(directions), draw(colors))
    return Light("point", draw(st.tuples(*[st.integers(-4000, 4000)] * 3)), draw(colors))


@st.composite
def scenes(draw: st.DrawFn, most_objects: int = 2) -> Scene:
    """Objects about the origin, and a camera that looks there from some way off."""
    eye = np.array(draw(directions)) * draw(st.integers(1500, 4000))
    up = draw(directions.filter(lambda up: bool(np.cross(up, eye).any())))
    perspective = draw(st.booleans())
    near = draw(st.sampled_from([16.0, 300.0, 2500.0])) if perspective else draw(st.sampled_from([-(2.0**20), 2500.0]))
    camera = Camera(
        eye,
        draw(st.tuples(*[st.integers(-300, 300)] * 3)),
        up,
        "perspective" if perspective else "orthographic",
        draw(st.sampled_from([0.5, 1 / 2.145, 0.75])) if perspective else draw(st.sampled_from([700.0, 2000.0])),
        near,
    )
    return Scene(
        draw(st.lists(objects(), min_size=1, max_size=most_objects)),
        camera,
        [draw(lights()) for _ in range(draw(st.sampled_from([1, 2, 3, 0])))],
        Background((0, 0, 0)),
        ambient_light=draw(colors),
        width=SIZE,
        height=SIZE,
    )


# ---- comparisons ----


def assert_same_picture(
    before: Scene, after: contracts.Drawing, numbers: Integers | None = None, drawn: contracts.Drawing | None = None
) -> None:
    """Asserts that `after` is the picture of `before`, to what the file says. numbers: which triangle of `before` each
    triangle of `after` is. drawn: the picture of `before`, if it is there.
    """
    first = drawn or contracts.picture(before)
    shown = after.triangle if numbers is None else np.append(numbers, -1)[after.triangle]
    judged = render(call_data("render", fit(before)))
    for row, column in np.argwhere(first.triangle != shown).tolist():
        allowed = judged.may_show(column, row)
        assert np.isin([first.triangle[row, column], shown[row, column]], allowed).all(), (column, row)
    inner = interior(first.triangle) & interior(after.triangle) & (first.triangle == shown)
    materials = [o.material for o in before.objects]
    sizes = [o.mesh.triangles for o in before.objects]
    unlit = np.repeat([m.shading == "unlit" for m in materials], sizes)
    stepped = np.repeat([m.shading == "smooth" and m.specular > 0 for m in materials], sizes)
    old, new = first.pixels.astype(int), after.pixels.astype(int)
    off = np.abs(old - new)
    # where a light ceases to reach a bent surface its highlight ends at once
    near = around(old)
    beyond = np.maximum(0, np.maximum(new - near.max(axis=0), near.min(axis=0) - new))
    off = np.where(np.append(stepped, False)[first.triangle][..., None], beyond, off).max(axis=2)
    bound = np.where(np.append(unlit, False)[first.triangle], 1, 3)
    bad = np.argwhere(inner & (off > bound))
    assert not len(bad), [(c, r, old[r, c].tolist(), new[r, c].tolist()) for r, c in bad.tolist()[:3]]


def changed(scene: Scene, **fields: Any) -> Scene:
    """The scene with other fields in each object."""
    return evolve(scene, objects=[evolve(o, **{k: f(o) for k, f in fields.items()}) for o in scene.objects])


@EACH
@given(scenes())
def test_the_numbers_of_these_scenes_are_those_of_the_contracts(scene: Scene) -> None:
    fitted = fit(scene)
    for one, other in zip(scene.objects, fitted.objects, strict=True):
        assert one.scale == other.scale
        assert (one.position == other.position).all()


# ---- what must hold ----


@EACH
@given(scenes(), st.data())
def test_more_light_is_never_darker(scene: Scene, data: st.DataObject) -> None:
    kind = data.draw(st.sampled_from(["one more", "brighter", "ambient", "coefficients"]))
    more = data.draw(st.sampled_from([1, 20, 100]))

    def brighter(color: ArrayLike) -> Integers:
        return np.minimum(np.asarray(color, np.int64) + more, 255)

    if kind == "one more":
        other = evolve(scene, lights=[*scene.lights, data.draw(lights())])
    elif kind == "brighter":
        other = evolve(scene, lights=[evolve(w, color=brighter(w.color)) for w in scene.lights])
    elif kind == "ambient":
        other = evolve(scene, ambient_light=brighter(scene.ambient_light))
    else:
        name = data.draw(st.sampled_from(["ambient", "diffuse", "specular"]))
        other = changed(scene, material=lambda o: evolve(o.material, **{name: getattr(o.material, name) + more / 333}))
    dark, bright = contracts.picture(scene), contracts.picture(other)
    assert (dark.triangle == bright.triangle).all()
    assert (bright.pixels.astype(int) >= dark.pixels.astype(int) - 1).all(), kind


@EACH
@given(scenes(), st.sampled_from([3, 4, 0, 1, 2, 5, 8, 100]), st.integers(0, 2))
def test_white_in_full_light_is_white(scene: Scene, more: int, most_lights: int) -> None:
    """Whatever shines on it besides, and however little above 255 its light is."""
    other = evolve(
        changed(
            scene,
            mesh=lambda o: evolve(o.mesh, colors=np.full_like(o.mesh.colors, 255)),
            material=lambda o: evolve(o.material, ambient=1 + more / 1024),
        ),
        ambient_light=(255, 255, 255),
        lights=scene.lights[:most_lights],
    )
    drawn = contracts.picture(other)
    assert (drawn.pixels[drawn.triangle >= 0] >= 254).all()


@EACH
@given(scenes(), st.sampled_from(FACTORS))
def test_a_mesh_times_a_factor_with_its_scale_over_it(scene: Scene, factor: int) -> None:
    other = changed(
        scene,
        mesh=lambda o: evolve(o.mesh, positions=o.mesh.positions * factor),
        scale=lambda o: o.scale / factor,
    )
    assert_same_picture(scene, contracts.picture(other))


@EACH
@given(scenes(), st.tuples(*[st.integers(-(10**6), 10**6)] * 3))
def test_all_of_the_world_moved(scene: Scene, way: tuple[int, int, int]) -> None:
    shift = np.array(way)
    camera = scene.camera
    other = evolve(
        changed(scene, position=lambda o: o.position + shift),
        camera=evolve(camera, eye=camera.eye + shift, target=camera.target + shift),
        lights=[evolve(w, vector=w.vector + shift * (w.kind != "directional")) for w in scene.lights],
    )
    assert_same_picture(scene, contracts.picture(other))


@EACH
@given(scenes(most_objects=4), st.data())
def test_the_order_of_objects_and_lights(scene: Scene, data: st.DataObject) -> None:
    order = data.draw(st.permutations(range(len(scene.objects))))
    sizes = [o.mesh.triangles for o in scene.objects]
    firsts = np.cumsum([0, *sizes])
    numbers = np.concatenate([firsts[i] + np.arange(sizes[i]) for i in order])
    other = evolve(
        scene, objects=[scene.objects[i] for i in order], lights=data.draw(st.permutations(list(scene.lights)))
    )
    assert_same_picture(scene, contracts.picture(other), numbers)


@EACH
@given(scenes(most_objects=1), st.data())
def test_a_triangle_split_in_two(scene: Scene, data: st.DataObject) -> None:
    (thing,) = scene.objects
    # a vertex half way between two others is a whole one, and its normal is theirs
    mesh = evolve(
        thing.mesh,
        positions=2 * thing.mesh.positions,
        normals=np.tile([0, 1, 0], (len(thing.mesh.positions), 1)),
    )
    scene = evolve(scene, objects=[evolve(thing, mesh=mesh, scale=thing.scale / 2)])
    positions, faces, colors = (np.asarray(part) for part in (mesh.positions, mesh.faces, mesh.colors))
    edge = np.roll(faces[data.draw(st.integers(0, len(faces) - 1))], data.draw(st.integers(0, 2)))[:2]
    middle = len(positions)
    split, numbers = [], []
    for number, face in enumerate(faces):
        # the other triangle at the edge is split too: the new vertex is not exactly on the edge on the screen
        parts = [np.where(face == end, middle, face) for end in edge] if np.isin(edge, face).all() else [face]
        split += parts
        numbers += [number] * len(parts)
    halves = Mesh(
        np.vstack([positions, positions[edge].mean(axis=0)]),
        split,
        np.vstack([colors, colors[edge].astype(int).sum(axis=0) // 2]),
        np.tile([0, 1, 0], (middle + 1, 1)),
    )
    other = evolve(scene, objects=[evolve(scene.objects[0], mesh=halves)])
    assert_same_picture(scene, contracts.picture(other), np.array(numbers))


@EACH
@given(scenes())
def test_a_mirrored_scene(scene: Scene) -> None:
    flip = np.array([-1, 1, 1])
    camera = scene.camera

    def mirrored(o: Object) -> Mesh:
        mesh = o.mesh
        return Mesh(
            mesh.positions * flip,
            mesh.faces[:, ::-1],
            mesh.colors,
            mesh.normals * flip,
        )

    other = evolve(
        changed(
            scene,
            mesh=mirrored,
            position=lambda o: o.position * flip,
            rotation=lambda o: o.rotation * [1, -1, -1, 1],
        ),
        camera=evolve(
            camera,
            eye=camera.eye * flip,
            target=camera.target * flip,
            up=camera.up * flip,
        ),
        lights=[evolve(w, vector=w.vector * flip) for w in scene.lights],
    )
    drawn = contracts.picture(other)
    assert_same_picture(scene, contracts.Drawing(drawn.pixels[:, ::-1], drawn.triangle[:, ::-1]))


# ---- the price of a part ----


@st.composite
def walls(draw: st.DrawFn) -> Scene:
    """A triangle that leaves the canvas on some sides, in one light or more."""
    reach = draw(st.integers(1, 40))
    left = draw(st.integers(-150, -50))
    corners = reach * np.array([[left, -100, 0], [left + 300, -100, 0], [left, 200, 0]])
    material = Material(draw(st.sampled_from(SHADINGS)))
    mesh = Mesh(corners, [[0, 1, 2]], normals=[(0, 0, 1)] * 3)
    turn = draw(st.tuples(*[st.integers(-20, 20)] * 2))
    wall = Object(mesh, (0, 0, -200), (*turn, 0, 40), material=material, cull=False)
    lamps = [draw(lights()) for _ in range(draw(st.integers(1, 2)))]
    return Scene([wall], Camera(near=1.0), lamps, width=96, height=64)


#: Gas of the colours of the patches that a tile cuts: two triangles, two cells each, nine colours, two lights.
PATCHES = 2 * 2 * 9 * 2 * 2_500


@EACH
@given(walls(), st.integers(1, 96), st.integers(1, 64), st.data())
def test_parts_cost_the_whole_and_what_each_needs(scene: Scene, width: int, height: int, data: st.DataObject) -> None:
    """A tile and the four around it: pixels may be of different cost, but all are shaded once."""
    x, y = data.draw(st.integers(0, 96 - width)), data.draw(st.integers(0, 64 - height))
    around = [
        (0, 0, 96, y),
        (0, y, x, height),
        (x + width, y, 96 - x - width, height),
        (0, y + height, 96, 64 - y - height),
    ]
    tiles = [Rectangle(*tile) for tile in [(x, y, width, height), *around] if tile[2] and tile[3]]
    # of a tile where nothing is; where the wall is all of the picture, one of a pixel needs all the more
    outside = np.argwhere(contracts.picture(scene).triangle < 0)
    row, column = outside[0].tolist() if len(outside) else (0, 0)
    least = call("renderTile", scene, Rectangle(column, row, 1, 1)).gas
    parts = sum(call("renderTile", scene, tile).gas for tile in tiles)
    assert parts <= 1.02 * call("render", scene).gas + len(tiles) * (least + PATCHES)
