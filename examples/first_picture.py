"""Build a scene of two objects in Python, and render it with the contracts in this process.

    python examples/first_picture.py

writes first_picture.png and prints its gas.
"""

from __future__ import annotations

from shackled import Camera, Light, Material, Mesh, Object, Scene, render, replace
from shackled.datasets import teapot

pot = Object(
    replace(teapot(6), colors="#3f8fb5"),
    position=(0, -1.5, 0),
    material=Material("smooth", ambient=0.3, diffuse=0.8, specular=0.6, shininess=40),
    cull=False,
)
tile = Object(
    Mesh(
        positions=[(-4, 0, -4), (-4, 0, 4), (4, 0, 4), (4, 0, -4)],
        faces=[(0, 1, 2), (0, 2, 3)],
        colors=[(70, 90, 150), (220, 140, 100), (250, 215, 160), (150, 110, 150)],
    ),
    position=(0, -1.5, 0),
)
scene = Scene(
    objects=[pot, tile],
    camera=Camera(eye=(3, 4.5, 9), target=(0.2, -0.4, 0.5)),
    lights=[Light.point(position=(-4, 6, 6), color="#fff6e8")],
    background=("#1d2433", "#8794ad"),
)

image = render(scene, size=(192, 144))
image.save("first_picture.png")
print(f"{image.width} x {image.height} pixels, {image.triangles:,} triangles: {image.gas:,} gas on {image.made_by}")
