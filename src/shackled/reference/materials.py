"""Set up a lit material: how it reflects light, and how finely it has to be shaded for that."""

from __future__ import annotations

from . import specular
from .layout import HAS_SPECULAR, IS_DIFFUSE, IS_FLAT, IS_GREY, IS_LIT, IS_QUADRATIC, IS_SMOOTH, IS_SPOT_LIT, ONES
from .registers import Registers
from .structs import FLAT, POINT, Material, Scene
from .view import View
from .words import MASK


def set_material(view: View, scene: Scene, material: Material, registers: Registers) -> int:
    """Set the registers of a material that is lit; return what it adds to the mode of the object."""
    mode = 0
    set_reach(view, scene, material, registers)
    registers.ambient = scaled(scene.ambient_light, material.ambient)
    grey = is_grey(registers.ambient)
    for record, light in zip(registers.lights, scene.lights, strict=True):
        record.diffuse = scaled(light.color, material.diffuse)
        if record.cone:
            mode = IS_SPOT_LIT
        grey = grey and is_grey(record.diffuse)
    if material.specular != 0:
        mode |= HAS_SPECULAR
    specular.set_table(material.specular, material.shininess, registers)
    # without lights the normal makes no difference
    if material.shading == FLAT or not (scene.lights or registers.has_effects):
        mode |= IS_FLAT
        registers.fragment_square = 1 << 48
        registers.fragment_normal_length = 1 << 24
    else:
        registers.face_light_40 = registers.ambient << 24
        focal = view.focal >> 32
        is_point = any(record.is_point for record in registers.lights[:1])
        lamp = smooth_reach(focal, material.diffuse, is_point)
        half = specular.half_reach(material.specular, material.shininess, 0 if view.orthographic else focal)
        registers.smooth_reach = min(lamp, half)
        registers.smooth_reach_3 = 8 * lamp if lamp < 5 * half // 2 else 20 * half
        registers.half_slope = specular.half_slope(material.specular, material.shininess)
        registers.far_from_highlight = (1 << 20) - 2936013 // material.shininess
        # with several lights most of the work would be repeated for each
        is_simple = len(scene.lights) == 1 and mode & IS_SPOT_LIT == 0 and not specular.is_broad(material)
        if is_simple and not (view.orthographic and is_point):
            mode |= IS_QUADRATIC
        mode |= IS_SMOOTH | IS_LIT | IS_DIFFUSE | (IS_GREY if grey else 0)
    return mode


def scaled(color: int, coefficient: int) -> int:
    """Multiply colour bytes by a coefficient (Q32): lanes of Q16 where 255 is one."""
    k = coefficient >> 16
    return sum(((color >> (8 * i)) & 0xFF) * k // 255 << (56 * i) for i in range(3))


def is_grey(light: int) -> bool:
    """Return whether all lanes are equal."""
    return light == (light & 0xFFFFFFFF) * ONES


def set_reach(view: View, scene: Scene, material: Material, registers: Registers) -> None:
    """Set the square of the distance, in sub-pixels, over which light is nearly linear.

    H turns up to as far as V, divided by |L + V|. Where the square of that may be below 4/3 on the canvas, for a light
    ahead of the camera, it is taken into account.
    """
    focal = view.focal >> 32
    strength = material.shininess * material.specular
    point = any(light.kind == POINT for light in scene.lights)
    if point:
        strength += 2 * material.diffuse
    strength *= len(scene.lights)
    if view.orthographic:
        registers.reach = 0 if point else 1 << 60
    else:
        registers.reach = 1 << 60 if strength == 0 else ((48 * focal * focal << 32) & MASK) // (255 * strength)
        if material.specular:
            registers.reach = registers.reach * turning(scene.canvas.width, scene.canvas.height, registers) >> 24
    if specular.is_broad(material):
        registers.reach = 0


def turning(width: int, height: int, registers: Registers) -> int:
    """Return 3/4 of |L + V|^2 = 2 + 2 L.V where it is least on the canvas, or less, of all directional lights, Q24.

    0 to 1.
    """
    x, y = (size * registers.ray_step // 2 for size in (width, height))
    least = ((1 << 25) + 2) // 3
    for light in registers.lights:
        if not light.is_point:
            # V = -(x, y, 1) or shorter
            beside = (light.x ^ light.x >> 255) * x + (light.y ^ light.y >> 255) * y
            least = min(least, (1 << 24) - (beside >> 24) - light.z)
    return 3 * max(least, 0) >> 1


def smooth_reach(focal: int, coefficient: int, is_point: bool) -> int:
    """Return up to which sum of the squares of two edges, in sub-pixels, directions to a lamp may be interpolated.

    Their error is at most sum w_i w_j e_ij^2 / 2, where e is an edge by the distance of the lamp, or 5/4 of it by that
    of the eye: 5/4 is the square of how much nearer lamps may be. The sum is at most a quarter of that of two edges.
    Four levels of 255 are allowed.
    """
    return (13 * focal * focal << 32) // (255 * coefficient) if is_point and coefficient else 1 << 60
