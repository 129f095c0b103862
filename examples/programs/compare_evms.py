"""Compare the pictures of an EVM and of the NumPy reference, and edit one with Pillow."""

import numpy as np
from PIL import Image

import shackled

scene = shackled.load("tetrahedron", size=32)
first = shackled.render(scene, on="pyevm")
second = shackled.render(scene, on="reference")
difference = np.abs(np.asarray(first, dtype=int) - np.asarray(second, dtype=int))
print(f"{first.made_by} and {second.made_by}: {difference.max()} levels apart")

first.save("tetrahedron.png")
with Image.open("tetrahedron.png") as decoded:
    assert np.array_equal(np.asarray(decoded), first.pixels)
    decoded.resize((256, 256), Image.Resampling.NEAREST).save("large.png")
