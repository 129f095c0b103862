"""Compare the pictures and the gas of two EVMs, and edit one with Pillow."""

import numpy as np
from PIL import Image

import shackled

scene = shackled.load("tetrahedron", size=32)
first = shackled.render(scene, on="revm")
try:
    second = shackled.render(scene, on="pyevm")
except shackled.InputError as error:
    raise SystemExit(str(error)) from None
difference = np.abs(np.asarray(first, dtype=int) - np.asarray(second, dtype=int))
print(f"{first.made_by}: {first.gas:,} gas; {second.made_by}: {second.gas:,} gas; {difference.max()} levels apart")

first.save("tetrahedron.png")
with Image.open("tetrahedron.png") as decoded:
    assert np.array_equal(np.asarray(decoded), first.pixels)
    decoded.resize((256, 256), Image.Resampling.NEAREST).save("large.png")
