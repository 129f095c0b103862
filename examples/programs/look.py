"""Render the same model with several looks, and compare their gas."""

import shackled

gas = {}
for name, image in {
    "flat": shackled.render("torus-knot", size=48, color="#c8553d"),
    "smooth": shackled.render("torus-knot", size=48, smooth=True, specular=0.8, shininess=60),
    "wireframe": shackled.render("torus-knot", size=48, wireframe=True, unlit=True, background=("black", "navy")),
    "lamp": shackled.render("torus-knot", size=48, lights=shackled.Light.point(position=(2, 3, 4), color="orange")),
    "from above": shackled.render("torus-knot", size=48, elevation=80, orthographic=True, rotate=(0, 45, 0)),
}.items():
    image.save(f"{name}.png")
    gas[name] = image.gas
print(gas)
