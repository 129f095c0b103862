"""Render a mesh made of arrays: a height field with a colour for each vertex."""

import numpy as np

import shackled

side = 12
x, z = np.meshgrid(np.linspace(-2, 2, side), np.linspace(-2, 2, side))
y = np.cos(x * x + z * z) * 0.6
vertices = np.column_stack([x.ravel(), y.ravel(), z.ravel()])

corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
upper = np.column_stack([corner, corner + side, corner + 1])
lower = np.column_stack([corner + 1, corner + side, corner + side + 1])
faces = np.concatenate([upper, lower])

height = (y.ravel() + 0.6) / 1.2
colors = np.column_stack([height, np.full_like(height, 0.4), 1 - height])  # floats from 0 to 1

mesh = shackled.Mesh(vertices, faces, colors)
image = shackled.render(mesh, size=64, smooth=True, elevation=35)
image.save("waves.png")
print(f"{mesh.triangles} triangles, {image.covered_pixels} lit pixels")
