"""Conversion of scenes to the number ranges of the contracts, without a change of the picture.

Lengths are multiples of 2^-32 up to 2^26, and coordinates of vertices are integers. A scene that is exact in that form
is not changed; such are also fitted scenes that were encoded and decoded. Any other is translated, so that the eye is
at the origin, and scaled by a power of two, so that its largest object is about 2^12 units. Its meshes, unless their
coordinates are integers, are quantized to a grid of 2^16 steps across their largest side, or to a finer one, with three
more bytes per vertex, where a step would be visible. Objects with more vertices or triangles than a contract takes are
divided last, so that their parts have one grid.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from attrs import evolve

from ..base.checks import Floats, Ints
from ..errors import InputError
from . import _constants as constant
from ._arithmetic import dot, length, rotate, unit
from ._camera import Camera
from ._light import Light
from ._mesh import MAX_FACES, MAX_VERTICES, part_of_faces, vertex_normals
from ._object import Object
from ._packed import MAX_SHORT, MAX_WIDE, bits_of
from ._scene import Scene

#: A mesh of so many bits a coordinate must not be scaled by more; one of other coordinates is quantized.
MAX_SCALE = {16: constant.MAX_SCALE_SHORT, 24: constant.MAX_SCALE_WIDE, None: -1.0}


@np.errstate(over="ignore", invalid="ignore")
def in_range(scene: Scene) -> Scene:
    """Return the scene in the number ranges of the contracts; meshes that are too large become several objects."""
    _check_view(scene.camera)
    scene = _prepared(scene)
    if _is_exact(scene):
        scene = evolve(scene, camera=evolve(scene.camera, near=near_plane(scene, most=1.0)))
    else:
        scene = _moved(scene, _factor(scene))
    objects = [part for o in scene.objects for part in divided(evolve(o, rotation=_direction(o.rotation)))]
    camera = evolve(scene.camera, up=_direction(scene.camera.up))
    return evolve(scene, objects=objects, camera=camera, lights=map(_pointed, scene.lights))


def _prepared(scene: Scene) -> Scene:
    """Return the scene with its ground as an object, and all objects prepared."""
    grounds = [] if scene.ground is None else [scene.ground.under(scene.world_positions())]
    return evolve(scene, objects=[_prepare(o) for o in (*scene.objects, *grounds)], ground=None)


def _pointed(light: Light) -> Light:
    if light.kind == "directional":
        return evolve(light, vector=_direction(light.vector))
    return light if light.direction is None else evolve(light, direction=_direction(light.direction))


def _check_view(camera: Camera) -> None:
    forward, up = camera.target - camera.eye, camera.up
    if not forward.any():
        raise InputError("the camera's eye and target are the same point, ({:g}, {:g}, {:g})".format(*camera.eye))
    if not up.any():
        raise InputError("the camera's up must not be (0, 0, 0)")
    if length(np.cross(unit(forward), unit(up))) < 1e-9:
        raise InputError("the camera looks along its up direction, ({:g}, {:g}, {:g}); choose another up".format(*up))


def _prepare(o: Object) -> Object:
    """Return the object without unused vertices, and with the normals that smooth shading needs."""
    mesh = o.mesh
    is_smooth = o.material.shading == "smooth"
    if not is_smooth and mesh.normals is not None:
        mesh = evolve(mesh, normals=None)
    if is_smooth and mesh.normals is None:
        center, radius = _box(mesh.positions)
        # of any size: squares of its lengths stay within floats
        mesh = evolve(mesh, normals=vertex_normals((mesh.positions - center) / (radius or 1.0), mesh.faces))
    if len(np.unique(mesh.faces)) < len(mesh.positions):
        mesh = part_of_faces(mesh, mesh.faces)
    return evolve(o, mesh=mesh)


def _is_exact(scene: Scene) -> bool:
    """Return whether the contracts represent the scene exactly, well within their ranges."""
    camera = scene.camera
    lengths = [*camera.eye, *camera.target, camera.near or 0.0]
    lengths += [camera.half_height] if camera.projection == "orthographic" else []
    lengths += [each for light in scene.lights if light.kind != "directional" for each in light.vector]
    reach = max(map(abs, lengths))
    for o in scene.objects:
        positions = o.mesh.positions
        if o.scale > MAX_SCALE[bits_of(positions)]:
            return False
        lengths += [o.scale, *o.position]
        reach = max(reach, np.abs(o.position).max() + o.scale * np.abs(positions).max())
    view = np.cross(unit(camera.target - camera.eye), unit(camera.up))
    # by `_move_camera`: a scene decoded from a call must not be moved again
    is_moved = not camera.eye.any() and (camera.near is not None or camera.projection == "orthographic")
    largest = max(map(abs, lengths))
    return (
        constant.EXACT_SIZES[0] <= reach
        and (reach <= constant.EXACT_SIZES[1] or (is_moved and largest <= constant.MAX_COORDINATE))
        and all(each % constant.STEP == 0 for each in lengths)
        and (camera.projection == "perspective" or camera.half_height >= constant.MIN_HALF_HEIGHT)
        and bool(length(view) >= constant.DIRECTION_LENGTHS[0])
        and (scene.fog is None or scene.fog.far <= constant.MAX_COORDINATE)
    )


def _factor(scene: Scene) -> float:
    """Return the factor by which a scene is scaled, a power of two."""
    size, reach = _extent(scene)
    if scene.camera.projection == "orthographic":
        reach = max(reach, scene.camera.half_height)
    for light in scene.lights:
        if light.kind != "directional":
            # lights far beyond the scene may be moved nearer: their direction hardly changes
            distance = float(np.abs(light.vector - scene.camera.eye).max())
            reach = max(reach, min(distance, 1024 * reach))
    if scene.fog is not None:
        # what is so near to the eye is clear in fog that ends beyond
        reach = max(reach, min(scene.fog.far, 1024 * reach))
    exponent = constant.REACH_EXPONENT - math.frexp(reach)[1] if reach else 0
    exponent = min(exponent, constant.SIZE_EXPONENT - math.frexp(size)[1]) if size else exponent
    return math.ldexp(1.0, min(max(exponent, -1000), 1000))


def _extent(scene: Scene) -> tuple[float, float]:
    """Return half the largest side of an object, and how far any reaches from the eye along an axis."""
    sizes, reaches = [0.0], [0.0]
    for o in scene.objects:
        center, radius = _box(o.mesh.positions)
        place = o.position + rotate(o.rotation, o.scale * center) - scene.camera.eye
        sizes.append(o.scale * radius)
        reaches.append(float(np.abs(place).max()) + o.scale * radius)
    if not np.isfinite(reaches).all():
        raise InputError("the scene is too large: its coordinates, scaled and moved, are beyond what a float holds")
    return max(sizes), max(reaches)


def _moved(scene: Scene, factor: float) -> Scene:
    """Return the scene about the eye, times the factor."""
    eye, fog, camera = scene.camera.eye, scene.fog, _move_camera(scene, factor)
    if fog is not None:
        # nothing is as far away as the largest distances
        far = min(max(fog.far * factor, constant.STEP), constant.MAX_COORDINATE)
        fog = evolve(fog, near=min(fog.near * factor, constant.MAX_COORDINATE - 1), far=far)
    lights = [light if light.kind == "directional" else _move_light(light, eye, factor) for light in scene.lights]
    objects = [_move_object(o, scene, factor, camera.near or 0.0) for o in scene.objects]
    return evolve(scene, objects=objects, camera=camera, lights=lights, fog=fog)


def _move_camera(scene: Scene, factor: float) -> Camera:
    camera = scene.camera
    forward, up = unit(camera.target - camera.eye), unit(camera.up)
    half_height = camera.half_height * (factor if camera.projection == "orthographic" else 1)
    if camera.projection == "orthographic" and half_height < constant.MIN_HALF_HEIGHT:
        raise InputError(f"the camera's half_height {camera.half_height:g} is too small for the size of the scene")
    return evolve(
        camera,
        eye=(0, 0, 0),
        target=forward * 2.0**constant.SIZE_EXPONENT,
        # upright on the line of sight, so that the cross product loses nothing
        up=unit(up - dot(up, forward) * forward),
        half_height=half_height,
        near=near_plane(scene, factor, most=constant.MAX_COORDINATE),
    )


def near_plane(scene: Scene, factor: float = 1.0, most: float = math.inf) -> float:
    """Return the distance of the near plane, times the factor: the camera's own, or else `NEAR_PART` of how far any
    object reaches from the eye, at most `most`.
    """
    camera = scene.camera
    if camera.projection == "orthographic":
        near = -math.inf if camera.near is None else camera.near * factor
        return min(max(near, -constant.MAX_COORDINATE), constant.MAX_COORDINATE)
    if camera.near is not None:
        return min(max(camera.near * factor, constant.STEP), constant.MAX_COORDINATE)
    _, farthest = _extent(scene)
    return max(min(farthest * factor * constant.NEAR_PART, most), constant.STEP) if farthest else 1.0


def _move_light(light: Light, eye: Floats, factor: float) -> Light:
    place = (light.vector - eye) * factor
    # a light so far away keeps its direction
    largest = float(np.abs(place).max())
    return evolve(light, vector=place * min(1.0, 2.0**constant.REACH_EXPONENT / largest) if largest else place)


def _move_object(o: Object, scene: Scene, factor: float, near: float) -> Object:
    """Return the object about the eye. near: the distance of the near plane, times the factor."""
    positions = o.mesh.positions
    center, step = np.zeros(3), 1.0
    if o.scale * factor > MAX_SCALE[bits_of(positions)]:
        # the radii of a fade are about the object's position, which therefore stays
        center, radius = _box(positions) if o.fade is None else (center, float(np.abs(positions).max()))
        step = radius / _steps(o, radius, scene, factor, near)
        grid = np.rint((positions - center) / step) if step else np.zeros_like(positions)
        o = evolve(o, mesh=evolve(o.mesh, positions=grid))
    place = o.position + rotate(o.rotation, o.scale * center) - scene.camera.eye
    fade = None if o.fade is None else (o.fade[0] * factor, o.fade[1] * factor)
    return evolve(o, position=place * factor, scale=o.scale * step * factor, fade=fade)


def _steps(o: Object, radius: float, scene: Scene, factor: float, near: float) -> int:
    """Return how many steps the grid of an object has across half its largest side."""
    camera = scene.camera
    pixels = scene.height / (2 * camera.half_height)
    if camera.projection == "perspective":
        forward = unit(camera.target - camera.eye)
        places = o.world_positions() - camera.eye
        pixels /= max(float(dot(places, forward).min()), near / factor)
    size = o.scale * radius
    if size * pixels <= constant.STEP_IN_PIXELS * MAX_SHORT:
        return MAX_SHORT
    # the contract's matrix is rounded to 2^-32 units a step: with more steps that would be more than one of them
    return int(min(max(math.sqrt(size * factor / constant.STEP), MAX_SHORT), MAX_WIDE))


def _box(positions: Floats) -> tuple[Floats, float]:
    """Return the middle of the bounding box, and the largest distance from it along an axis."""
    low, high = positions.min(axis=0) / 2, positions.max(axis=0) / 2
    return low + high, float((high - low).max())


def _direction(v: Floats) -> Floats:
    low, high = constant.DIRECTION_LENGTHS
    return v if low <= np.abs(v).max() <= high else unit(v)


def divided(o: Object) -> list[Object]:
    """Return the object, or, if its mesh is too large for a contract, several that together are the same: each has the
    next faces, so that what is close together in a file stays together.
    """
    mesh = o.mesh
    if len(mesh.positions) <= MAX_VERTICES and mesh.triangles <= MAX_FACES:
        return [o]
    return [evolve(o, mesh=part_of_faces(mesh, faces)) for faces in _runs(mesh.faces)]


def _runs(faces: Ints) -> Iterator[Ints]:
    while len(faces):
        run = faces[:MAX_FACES]
        # where each vertex is named first: the run ends before the one that is too many
        firsts = np.sort(np.unique(run, return_index=True)[1])
        if len(firsts) > MAX_VERTICES:
            run = run[: firsts[MAX_VERTICES] // 3]
        yield run
        faces = faces[len(run) :]
