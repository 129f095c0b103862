"""Render a built-in model, save the picture, and print its gas."""

import shackled

image = shackled.render("teapot", size=64, color="tomato")
image.save("teapot.png")
print(image)  # <Image 64x64, 491 triangles, 4.1M gas>
print(f"{image.pixels.shape} pixels, {image.gas:,} gas, {image.made_by}")
