"""Render a mesh of trimesh, and a scene of trimesh with two placed meshes."""

import numpy as np

import shackled

try:
    import trimesh
except ImportError:
    raise SystemExit("this program needs trimesh: pip install trimesh") from None

ball = trimesh.creation.icosphere(subdivisions=2)
shackled.render(ball, size=48, color="gold", smooth=True).save("ball.png")

up = np.eye(4)
up[1, 3] = 1.1
scene = trimesh.Scene()
scene.add_geometry(trimesh.creation.box((2, 0.2, 2)))
scene.add_geometry(ball, transform=up)
image = shackled.render(scene, size=48)
image.save("ball-on-box.png")
print(f"{image.triangles} triangles, {image.gas:,} gas")
