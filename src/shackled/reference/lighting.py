"""Light flat faces."""

from __future__ import annotations

from .layout import HAS_SPECULAR, IS_DIFFUSE, IS_LIT, IS_ORTHOGRAPHIC, LANES_32, MIDDLE_86_AT, UPPER_86_AT
from .mesh import Mesh
from .registers import LightRecord, Registers
from .words import divide_signed, signed


def set_face(mesh: Mesh, face: int, registers: Registers) -> tuple[int, int]:
    """Set normal and light of a flat face, from its corners in the mesh.

    Returns its mode, and the light that does not depend on the fragment, lanes of Q16: without meaning if IS_DIFFUSE,
    where fragments add up the diffuse light of all lights.
    """
    r = registers
    length = face_length(set_face_normal(mesh, face, r))
    mode = r.object_mode
    total = r.ambient
    nx, ny, nz = r.face_normal_x, r.face_normal_y, r.face_normal_z
    for record in r.lights:
        if not record.is_point:
            # normal * direction: the middle coefficient of the product; the lower lane borrows one at most
            lambert = signed(r.face_normal * record.mesh_lanes) >> UPPER_86_AT
            record.n_dot_l = divide_signed(lambert << 16, length)
            if record.n_dot_l > 0:
                total += ((record.diffuse * record.n_dot_l) >> 24) & LANES_32
                # a highlight needs the light of each fragment
                if mode & HAS_SPECULAR:
                    mode |= IS_LIT
        else:
            mode |= face_point_light(record, length, r)
    if mode & IS_ORTHOGRAPHIC == 0:
        # normal * (corner - eye)
        product = nx * (r.face_corner_x - r.eye_x) + ny * (r.face_corner_y - r.eye_y) + nz * (r.face_corner_z - r.eye_z)
        r.face_n_dot_ray_slope = divide_signed(signed(product * r.scale_per_near), length)
        r.face_n_dot_ray = 0
    else:
        # normal * line of sight
        product = nx * r.eye_x + ny * r.eye_y + nz * r.eye_z
        r.face_n_dot_ray_slope = 0
        r.face_n_dot_ray = divide_signed(signed(product << 40), length)
    return mode, total


def set_face_up(r: Registers) -> None:
    """Set how much the normal of the face points up."""
    up = signed(r.face_normal * r.up_in_mesh) >> UPPER_86_AT
    r.face_up = divide_signed(up << 16, face_length(r.face_square << 32))


def face_length(square: int) -> int:
    """Return the root of the square of a normal, within 2^-22 of it.

    With h, a multiple of 3, such that the square is m * 4^h and 1 <= m < 64, the line 0.1367 * (m + 8) is within 0.231
    of the root of m, relatively; then three steps of Newton's method. Where the normal is zero, all products are,
    whatever they are divided by.
    """
    square = max(square, 1)
    h = (square.bit_length() - 1) // 6 * 3
    root = 140 * ((square >> h) + (8 << h)) >> 10
    for _ in range(3):
        root = (root + square // root) >> 1
    return root


def face_point_light(record: LightRecord, length: int, registers: Registers) -> int:
    """Set how a point light meets the face; return what it adds to the mode."""
    r = registers
    x = record.mesh_x - r.face_corner_x
    y = record.mesh_y - r.face_corner_y
    z = record.mesh_z - r.face_corner_z
    lambert = r.face_normal_x * x + r.face_normal_y * y + r.face_normal_z * z
    record.n_dot_l = divide_signed(signed(lambert * r.scale) >> 32, length)
    return IS_LIT | IS_DIFFUSE if record.n_dot_l > 0 else 0


def point_reach(farthest: int, registers: Registers) -> int:
    """Return the square of the distance, in sub-pixels, over which point lights on the face are nearly linear.

    Their directions turn as well as V: by as much where the light is as near as the eye and the face is seen from the
    front; where the face is seen at an angle, by more, since a pixel is a longer way on it. `farthest` is the depth of
    its farthest vertex. A face that is seen from behind may hide the light: its highlight ends where L = -V.
    """
    r = registers
    reaching = [record for record in r.lights if record.is_point and record.n_dot_l > 0]
    is_behind = r.object_mode & HAS_SPECULAR and r.face_n_dot_ray_slope > 0
    if is_behind and any(record.z > 0 for record in reaching):
        return 0
    # of the vertex from the eye, and of the nearest light and the eye from the plane of the face, Q16
    distance = (r.depth_scale >> 16) // (farthest + 1) + 1
    height = min(record.n_dot_l for record in reaching)
    eye_height = abs(r.face_n_dot_ray_slope * r.depth_scale) >> 150
    # the cosine of the angle at the vertex is about eye_height / distance, and larger elsewhere: take a third more
    eye_height = 4 * eye_height // 3
    if eye_height < distance:
        height = height * eye_height // distance
    return r.reach * height // (height + distance) * height // (height + distance)


def set_face_normal(mesh: Mesh, face: int, registers: Registers) -> int:
    """Set the normal of a face (its length is twice the area, in units of the mesh) and its first corner; return its
    square.
    """
    p, a, b = (mesh.positions[number] for number in mesh.faces[face])
    registers.face_corner_x, registers.face_corner_y, registers.face_corner_z = (component << 32 for component in p)
    ax, ay, az = a[0] - p[0], a[1] - p[1], a[2] - p[2]
    bx, by, bz = b[0] - p[0], b[1] - p[1], b[2] - p[2]
    registers.face_normal_x = x = ay * bz - az * by
    registers.face_normal_y = y = az * bx - ax * bz
    registers.face_normal_z = z = ax * by - ay * bx
    registers.face_normal = x + (y << MIDDLE_86_AT) + (z << UPPER_86_AT)
    registers.face_square = x * x + y * y + z * z
    return registers.face_square << 32
