"""Pictures by OpenGL: its clipping, rasterisation, depth test and interpolation, and the light of docs/look.md in GLSL.

EGL makes a context without a screen; Mesa's llvmpipe will do. Clip coordinates are computed in float64 and handed over
as they are; everything else that a fragment needs is relative to the eye or to a light, so that float32 holds it.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from .world import ALL_THROUGH, Array, Solid, World

#: What a vertex consists of: name and count of numbers.
VERTEX = {
    "clip": 4,
    # beyond the near plane
    "inside": 1,
    # for an orthographic camera, 0..1
    "nearness": 1,
    "color": 3,
    "to_eye": 3,
    "to_light_0": 3,
    "to_light_1": 3,
    "to_light_2": 3,
    "to_light_3": 3,
    "normal": 3,
    "facing": 3,
    "number": 1,
}

VERTEX_SHADER = """
in vec4 clip;
in float inside, nearness, number;
in vec3 color, to_eye, to_light_0, to_light_1, to_light_2, to_light_3, normal, facing;
THROUGH out float f_nearness;
THROUGH out vec3 f_color, f_to_eye, f_to_light[4], f_normal;
flat out vec3 f_facing;
flat out float f_number;
uniform bool perspective;
uniform float near;

void main() {
    gl_Position = clip;
#ifdef MULTISAMPLED
    // each sample has a depth of its own, as the fixed functions compute it
    gl_Position.z = perspective ? 2.0 * near - clip.w : 2.0 * nearness - 1.0;
#endif
    gl_ClipDistance[0] = inside;
    f_nearness = nearness;
    f_color = color;
    f_to_eye = to_eye;
    f_to_light = vec3[4](to_light_0, to_light_1, to_light_2, to_light_3);
    f_normal = normal;
    f_facing = facing;
    f_number = number;
}
"""

FRAGMENT_SHADER = """
THROUGH in float f_nearness;
THROUGH in vec3 f_color, f_to_eye, f_to_light[4], f_normal;
flat in vec3 f_facing;
flat in float f_number;
out vec4 result;
uniform bool perspective, lit, smooth_normals, two_sided;
uniform float near, ambient, diffuse, specular, threshold;
uniform int lights, shininess;
uniform vec3 ambient_light, light[4], axis[4];
uniform vec2 cosines[4];

vec3 unit(vec3 v) {
    float square = dot(v, v);
    return square > 0.0 ? v / sqrt(square) : vec3(0.0);
}

float power(float base, int exponent) {
    float product = 1.0;
    for (int i = 0; i < exponent; ++i) product *= base;
    return product;
}

void main() {
#ifndef MULTISAMPLED
    gl_FragDepth = perspective ? gl_FragCoord.w * near : f_nearness;
#endif
    vec3 color = f_color;
    // the lights that give highlights, a bit each
    int shining = 0;
    if (lit) {
        vec3 normal = unit(smooth_normals ? f_normal : f_facing);
        if (two_sided && !gl_FrontFacing) normal = -normal;
        vec3 view = perspective ? unit(f_to_eye) : vec3(0.0, 0.0, 1.0);
        vec3 surface = ambient * ambient_light, highlight = vec3(0.0);
        for (int i = 0; i < lights; ++i) {
            vec3 to_light = unit(f_to_light[i]);
            float lambert = dot(normal, to_light);
            if (lambert > threshold) {
                // a spot light: from 1 at the inner angle to 0 at the outer one, squared, as in glTF
                float along = dot(-axis[i], to_light) - cosines[i].y;
                float through = clamp(along / max(cosines[i].x - cosines[i].y, 1.0 / 1024.0), 0.0, 1.0);
                through *= through;
                surface += diffuse * max(0.0, lambert) * through * light[i];
                if (specular * through > 0.0) shining |= 1 << i;
                float gloss = power(max(0.0, dot(normal, unit(to_light + view))), shininess);
                highlight += specular * through * gloss * light[i];
            }
        }
        color = color * surface + 255.0 * highlight;
    }
    float code = 16.0 * (f_number + 1.0) + float(shining);
#ifdef MULTISAMPLED
    // always 1, though the compiler does not know: it keeps the uniforms
    code = min(code, 1.0);
#endif
    result = vec4(clamp(color, 0.0, 255.0), code);
}
"""

#: What comes before both shaders. With several samples in a pixel, light is that of the middle of the covered ones.
ONE_SAMPLE = "#version 330\n#define THROUGH\n"
MULTISAMPLED = "#version 330\n#define MULTISAMPLED\n#define THROUGH centroid\n"

GL_CLIP_DISTANCE0 = 0x3000
GL_RENDERBUFFER = 0x8D41
GL_DEPTH_COMPONENT32F = 0x8CAC


class Unavailable(Exception):
    """There is no OpenGL here; the message says why."""


@dataclass(frozen=True)
class Drawing:
    """triangle: (H, W) the number of the triangle that is seen, -1 for none. color: (H, W, 3) its light, 0..255.
    shining: (H, W) the lights that reach it, where they give highlights: a bit each.
    """

    triangle: NDArray[np.int64]
    color: Array
    shining: NDArray[np.int64]


@cache
def context() -> moderngl.Context:
    """The context of this process."""
    try:
        # the stubs of moderngl take this for all of the settings
        made = moderngl.create_standalone_context(require=330, backend="egl")  # type: ignore[arg-type]
    except Exception as error:
        # whatever the loader of the library raises
        raise Unavailable(f"no OpenGL by EGL (`python3 tools/prepare.py opengl` installs Mesa's): {error}") from error
    made.enable_direct(GL_CLIP_DISTANCE0)
    return made


@cache
def _program(head: str) -> moderngl.Program:
    return context().program(head + VERTEX_SHADER, head + FRAGMENT_SHADER)


@cache
def _canvas(width: int, height: int) -> moderngl.Framebuffer:
    """RGBA32F, and a depth buffer of 32-bit floats, for which moderngl has no call of its own."""
    depth = context().depth_renderbuffer((width, height))
    library = ctypes.CDLL("libEGL.so.1")
    library.eglGetProcAddress.restype = ctypes.c_void_p
    bind, store = (
        ctypes.CFUNCTYPE(None, *[ctypes.c_uint] * count)(library.eglGetProcAddress(name))
        for name, count in ((b"glBindRenderbuffer", 2), (b"glRenderbufferStorage", 4))
    )
    bind(GL_RENDERBUFFER, depth.glo)
    store(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height)
    return context().framebuffer(context().renderbuffer((width, height), 4, dtype="f4"), depth)


def draw(world: World, threshold: float = 0.0, place: tuple[float, float] = (0.0, 0.0)) -> Drawing:
    """The picture of a world. threshold: N.L above which a light reaches a surface. place: the column and the row from
    the centre of each pixel at which it is sampled, in pixels.
    """
    canvas = _canvas(world.width, world.height)
    _render(world, canvas, _program(ONE_SAMPLE), threshold, place)
    pixels = _read(canvas)
    code = pixels[..., 3].astype(np.int64)
    return Drawing(code // 16 - 1, pixels[..., :3], code % 16)


def multisample(world: World, samples: int = 4) -> tuple[Array, Array]:
    """The picture of a world by OpenGL's own multisampling: (H, W, 3) the sum of the light of its samples, 0..255 each,
    over their number, and (H, W, 1) the part of them that shows anything.
    """
    gl, size = context(), (world.width, world.height)
    canvas = gl.framebuffer(
        gl.renderbuffer(size, 4, samples=samples, dtype="f4"), gl.depth_renderbuffer(size, samples=samples)
    )
    resolved = gl.framebuffer(gl.renderbuffer(size, 4, dtype="f4"))
    _render(world, canvas, _program(MULTISAMPLED))
    gl.copy_framebuffer(resolved, canvas)
    pixels = _read(resolved)
    for each in (*canvas.color_attachments, canvas.depth_attachment, canvas, *resolved.color_attachments, resolved):
        each.release()
    return pixels[..., :3], pixels[..., 3:]


def _render(
    world: World,
    canvas: moderngl.Framebuffer,
    program: moderngl.Program,
    threshold: float = 0.0,
    place: tuple[float, float] = (0.0, 0.0),
) -> None:
    gl = context()
    program["threshold"] = threshold
    canvas.use()
    canvas.clear(0.0, 0.0, 0.0, 0.0, depth=0.0)
    gl.enable_only(moderngl.DEPTH_TEST)
    gl.depth_func = ">"
    for solid, vertices in zip(world.solids, _vertices(world, place), strict=True):
        gl.enable_only(moderngl.DEPTH_TEST | (moderngl.CULL_FACE if solid.cull else 0))
        _set_uniforms(program, world, solid)
        buffer = gl.buffer(vertices.tobytes())
        array = gl.vertex_array(program, buffer, *VERTEX)
        array.render(moderngl.TRIANGLES)
        array.release()
        buffer.release()


def _read(canvas: moderngl.Framebuffer) -> Array:
    """(H, W, 4)."""
    values = np.frombuffer(canvas.read(components=4, dtype="f4"), np.float32).astype(np.float64)
    # the first row is the lowest
    return values.reshape(canvas.height, canvas.width, 4)[::-1]


def _vertices(world: World, place: tuple[float, float]) -> list[NDArray[np.float32]]:
    """For each solid three rows for each triangle."""
    distances = -world.corners[..., 2]
    low, span = (distances.min(), np.ptp(distances) or 1.0) if distances.size else (0.0, 1.0)
    across = np.array([world.width / world.height, 1.0]) * world.half_height
    shift = np.array([-2 * place[0] / world.width, 2 * place[1] / world.height])
    found = []
    for solid in world.solids:
        points = solid.corners.reshape(-1, 3)
        distance = -points[:, 2:]
        w = distance if world.perspective else np.ones_like(distance)
        lights = [lamp.vector - points * lamp.is_point for lamp in world.lamps]
        unused = [np.zeros_like(points)] * (4 - len(lights))
        columns = [
            np.hstack([points[:, :2] / across + shift * w, 0 * w, w]),
            distance - world.near if np.isfinite(world.near) else np.ones_like(w),
            0.25 + 0.5 * (low + span - distance) / span,
            solid.colors.reshape(-1, 3),
            -points,
            *lights,
            *unused,
            solid.normals.reshape(-1, 3),
            np.repeat(solid.facing, 3, axis=0),
            np.repeat(solid.first + np.arange(len(solid.corners)), 3)[:, None],
        ]
        found.append(np.hstack(columns).astype(np.float32))
    return found


def _set_uniforms(program: moderngl.Program, world: World, solid: Solid) -> None:
    material = solid.material
    hues = [tuple(lamp.color / 255) for lamp in world.lamps]
    values = {
        "perspective": world.perspective,
        "lit": material.shading != "unlit",
        "smooth_normals": material.shading == "smooth",
        "two_sided": solid.two_sided,
        "near": world.near if np.isfinite(world.near) else 0.0,
        "ambient": material.ambient,
        "diffuse": material.diffuse,
        "specular": material.specular,
        "lights": len(hues),
        "shininess": material.shininess,
        "ambient_light": tuple(world.ambient / 255),
        "axis": [*(tuple(lamp.axis) for lamp in world.lamps), *[(0.0, 0.0, 0.0)] * (4 - len(hues))],
        "cosines": [*(lamp.cosines for lamp in world.lamps), *[ALL_THROUGH] * (4 - len(hues))],
        "light": hues + [(0.0, 0.0, 0.0)] * (4 - len(hues)),
    }
    for name, value in values.items():
        program[name] = value
