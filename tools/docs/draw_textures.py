"""Draw docs/images/textures.png: a jar without and with its texture, and a close-up of its texels.

python -m tools.docs.draw_textures
"""

from __future__ import annotations

import numpy as np
from attrs import evolve
from examples.showcase import vase
from PIL import Image

from shackled import Camera, Object, Scene, Texture, render
from tools.pages import IMAGES

IMAGE = IMAGES / "textures.png"
SIDE = 300
#: What stands on the floor of the scene.
JAR = 1


def with_texture(scene: Scene, texture: Texture | None) -> Scene:
    """Return the scene with another texture on the jar."""
    objects: list[Object] = list(scene.objects)
    jar = objects[JAR]
    objects[JAR] = evolve(jar, material=evolve(jar.material, texture=texture))
    return evolve(scene, objects=objects)


def main() -> None:
    """Draw the picture."""
    scene = evolve(vase(), width=SIDE, height=SIDE)
    texture = scene.objects[JAR].material.texture
    assert texture is not None
    small = texture.pixels[::4, ::4]
    near = evolve(scene, camera=Camera.perspective((0.4, 1.9, 2.9), (0.1, 1.5, 0), fov=20))
    scenes = [
        with_texture(scene, None),
        scene,
        with_texture(near, Texture(small, "nearest")),
        with_texture(near, Texture(small, "bilinear")),
    ]
    strip = np.concatenate([render(each).pixels for each in scenes], axis=1)
    Image.fromarray(strip).save(IMAGE, optimize=True)
    print(f"written: {IMAGE}")


if __name__ == "__main__":
    main()
