"""Render a built-in model, save the picture, and print what it cost."""

import shackled

image = shackled.render("teapot", size=64, color="tomato")
image.save("teapot.png")
print(f"{image.width} x {image.height} pixels, {image.triangles} triangles, {image.gas:,} gas on {image.chain}")
