"""What the fragment shader needs to know of lights and material, prepared once for the scene, an object, or a face."""

from __future__ import annotations

from .mesh import Mesh
from .registers import (
    HAS_SPECULAR,
    IS_DIFFUSE,
    IS_FLAT,
    IS_GREY,
    IS_LIT,
    IS_ORTHOGRAPHIC,
    IS_SMOOTH,
    LightRecord,
    Registers,
)
from .roots import sqrt
from .structs import FLAT, POINT, UNLIT, Light, Material, Object, Scene
from .vector import Matrix, Vector, normalize, subtract, transposed_times
from .view import View
from .words import LANES_32, MASK, ONES, color_lanes, divide_signed, signed

#: The scale that makes Q24 of a unit vector in the space of the mesh.
DIRECTION = 1 << 40


def set_lights(view: View, lights: tuple[Light, ...], registers: Registers) -> None:
    """Lights in camera space."""
    registers.lights = []
    for light in lights:
        is_point = light.kind == POINT
        v = view.to_camera(subtract(light.vector, view.eye) if is_point else normalize(light.vector))
        x, y, z = (component >> (16 if is_point else 8) for component in v)
        registers.lights.append(LightRecord(is_point, x, y, z, color=color_lanes(light.color)))


def scaled(color: int, coefficient: int) -> int:
    """Colour bytes times a coefficient (Q32), lanes of Q16 where 255 is one."""
    k = coefficient >> 16
    return sum(((color >> (8 * i)) & 0xFF) * k // 255 << (56 * i) for i in range(3))


def set_object(view: View, scene: Scene, obj: Object, rotation: Matrix, registers: Registers) -> None:
    """Material, and eye and lights in the space of the mesh."""
    material = obj.material
    mode = IS_ORTHOGRAPHIC if view.orthographic else 0
    registers.object_mode = mode
    if material.shading == UNLIT:
        return
    set_reach(view, scene.lights, material, registers)
    registers.ambient = scaled(scene.ambient_light, material.ambient)
    grey = is_grey(registers.ambient)
    for record, light in zip(registers.lights, scene.lights, strict=True):
        record.diffuse = scaled(light.color, material.diffuse)
        grey = grey and is_grey(record.diffuse)
    if material.specular != 0:
        mode |= HAS_SPECULAR
    set_specular(material.specular, material.shininess, registers)
    # without lights the normal makes no difference
    if material.shading == FLAT or not scene.lights:
        mode |= IS_FLAT
        registers.fragment_square = 1 << 48
        registers.fragment_normal_length = 1 << 24
        set_mesh_space(view, scene, obj, rotation, registers)
    else:
        registers.face_light = registers.ambient
        registers.face_light_40 = registers.ambient << 24
        focal = view.focal >> 32
        registers.varying_reach = 1 << 60 if view.orthographic else focal * focal // 16
        registers.half_reach = -1 if is_broad(material) else half_reach(material.specular, material.shininess)
        mode |= IS_SMOOTH | IS_LIT | IS_DIFFUSE | (IS_GREY if grey else 0)
    registers.object_mode = mode


def is_grey(light: int) -> bool:
    """Whether all lanes are equal."""
    return light == (light & 0xFFFFFFFF) * ONES


def set_reach(view: View, lights: tuple[Light, ...], material: Material, registers: Registers) -> None:
    """The square of the distance, in sub-pixels, over which light is as good as linear."""
    focal = view.focal >> 32
    strength = material.shininess * material.specular
    point = any(light.kind == POINT for light in lights)
    if point:
        strength += 2 * material.diffuse
    strength *= len(lights)
    if view.orthographic:
        registers.reach = 0 if point else 1 << 60
    else:
        registers.reach = 1 << 60 if strength == 0 else ((48 * focal * focal << 32) & MASK) // (255 * strength)
    if is_broad(material):
        registers.reach = 0


def is_broad(material: Material) -> bool:
    """Whether the highlight is the cosine itself.

    Over its square, where the others are tabulated, it is too steep near zero to be interpolated, and each fragment
    takes the root.
    """
    return material.shininess == 1 and material.specular != 0


def half_reach(coefficient: int, shininess: int) -> int:
    """The square, Q40, of how much half vectors may differ in a triangle.

    If they are interpolated, their direction is off by d^2/8 at most for a difference d, and cos^n is steepest with
    about 0.6 * sqrt(n): four levels of 255 are allowed, or d = 1/4.
    """
    slope = (sqrt(shininess << 64) * coefficient) >> 32
    return min((1 << 72) // (5 * slope), 1 << 36) if slope else 1 << 36


def set_mesh_space(view: View, scene: Scene, obj: Object, rotation: Matrix, registers: Registers) -> None:
    """Eye and lights in the space of the mesh."""
    if obj.scale == 0:
        return
    registers.scale = obj.scale
    if not view.orthographic:
        registers.scale_per_near = divide_signed(obj.scale << 64, registers.near)

    def to_mesh(v: Vector, scale: int) -> Vector:
        x, y, z = transposed_times(rotation, v)
        return divide_signed(x << 32, scale), divide_signed(y << 32, scale), divide_signed(z << 32, scale)

    if view.orthographic:
        eye = to_mesh(view.forward, DIRECTION)
    else:
        eye = to_mesh(subtract(view.eye, obj.position), obj.scale)
    registers.eye_x, registers.eye_y, registers.eye_z = eye
    for record, light in zip(registers.lights, scene.lights, strict=True):
        if light.kind == POINT:
            v = to_mesh(subtract(light.vector, obj.position), obj.scale)
        else:
            v = to_mesh(normalize(light.vector), DIRECTION)
        record.mesh_x, record.mesh_y, record.mesh_z = v


def set_specular(coefficient: int, shininess: int, registers: Registers) -> None:
    """Tabulates coefficient * cos^shininess over cos^2, where it is at least half a level."""
    registers.specular_root = coefficient >> 16 if shininess == 1 else 0
    if coefficient == 0 or shininess == 1:
        # no square is greater than this
        registers.specular_begin = MASK
        return
    width = 13
    k = 1 << 32
    while k < coefficient:
        width += 2
        k <<= 1
    width = min((width << 24) // shininess, 1 << 24)
    begin = (1 << 24) - width
    registers.specular_begin = begin
    registers.specular_scale = (64 << 40) // width
    last = (coefficient * power(1 << 24, shininess)) >> 48
    table = [0] * 64 + [last << 128]
    for i in reversed(range(64)):
        value = (coefficient * power(begin + width * i // 64, shininess)) >> 48
        table[i] = ((value << 128) | ((last - value) & MASK)) & MASK
        last = value
    registers.specular_table = table


def power(square: int, exponent: int) -> int:
    """square^(exponent / 2), where square is Q24 and the result Q32."""
    base = square << 8
    result = sqrt(base << 32) if exponent & 1 else 1 << 32
    exponent >>= 1
    while exponent:
        if exponent & 1:
            result = (result * base) >> 32
        base = (base * base) >> 32
        exponent >>= 1
    return result


def set_face(mesh: Mesh, face: int, registers: Registers) -> int:
    """Normal and light of a flat face, from its corners in the mesh; returns its mode."""
    r = registers
    length = sqrt(set_face_normal(mesh, face, r))
    mode = r.object_mode
    total = r.ambient
    nx, ny, nz = r.face_normal_x, r.face_normal_y, r.face_normal_z
    for record in r.lights:
        if not record.is_point:
            # normal * direction
            lambert = nx * record.mesh_x + ny * record.mesh_y + nz * record.mesh_z
            record.facing = divide_signed(lambert << 16, length)
            if record.facing > 0:
                total += ((record.diffuse * record.facing) >> 24) & LANES_32
                # a highlight wants the light of each fragment
                if mode & HAS_SPECULAR:
                    mode |= IS_LIT
        else:
            mode |= face_point_light(record, length, r)
    # where fragments add the diffuse light of all lights themselves, only the ambient light is left
    r.face_light = total if mode & IS_DIFFUSE == 0 else r.ambient
    if mode & IS_ORTHOGRAPHIC == 0:
        # normal * (corner - eye)
        product = nx * (r.face_corner_x - r.eye_x) + ny * (r.face_corner_y - r.eye_y) + nz * (r.face_corner_z - r.eye_z)
        r.face_facing_slope = divide_signed(signed(product * r.scale_per_near), length)
        r.face_facing = 0
    else:
        # normal * line of sight
        product = nx * r.eye_x + ny * r.eye_y + nz * r.eye_z
        r.face_facing_slope = 0
        r.face_facing = divide_signed(signed(product << 40), length)
    return mode


def face_point_light(record: LightRecord, length: int, registers: Registers) -> int:
    """How a point light meets the face; returns what it adds to the mode."""
    r = registers
    x = record.mesh_x - r.face_corner_x
    y = record.mesh_y - r.face_corner_y
    z = record.mesh_z - r.face_corner_z
    lambert = r.face_normal_x * x + r.face_normal_y * y + r.face_normal_z * z
    record.facing = divide_signed(signed(lambert * r.scale) >> 32, length)
    return IS_LIT | IS_DIFFUSE if record.facing > 0 else 0


def point_reach(farthest: int, registers: Registers) -> int:
    """The square of the distance, in sub-pixels, over which the light of point lights on the face is as good as linear.

    Their directions turn as well as V: by as much where the light is as near as the eye and the face is seen from the
    front; where the face is seen at an angle, by more, since a pixel is a longer way on it. `farthest` is the depth of
    its farthest vertex.
    """
    r = registers
    # of the vertex from the eye, and of the nearest light and the eye from the plane of the face, Q16
    distance = (r.depth_scale >> 16) // (farthest + 1) + 1
    height = min(record.facing for record in r.lights if record.is_point and record.facing > 0)
    eye_height = abs(r.face_facing_slope * r.depth_scale) >> 151
    # the cosine of the angle at the vertex is about eye_height / distance, and larger elsewhere: take a third more
    eye_height = 4 * eye_height // 3
    if eye_height < distance:
        height = height * eye_height // distance
    return r.reach * height // (height + distance) * height // (height + distance)


def set_face_normal(mesh: Mesh, face: int, registers: Registers) -> int:
    """The normal of a face (twice its area long, in units of the mesh) and its first corner; returns its square."""
    p, a, b = (mesh.positions[number] for number in mesh.faces[face])
    registers.face_corner_x, registers.face_corner_y, registers.face_corner_z = (component << 32 for component in p)
    ax, ay, az = a[0] - p[0], a[1] - p[1], a[2] - p[2]
    bx, by, bz = b[0] - p[0], b[1] - p[1], b[2] - p[2]
    registers.face_normal_x = x = ay * bz - az * by
    registers.face_normal_y = y = az * bx - ax * bz
    registers.face_normal_z = z = ax * by - ay * bx
    return (x * x + y * y + z * z) << 32
