"""Build a scene of several objects and lights, save it as a scene file, and load it again."""

import shackled
from shackled import Camera, Light, Material, Mesh, Object, Scene

corners = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]
square = Mesh(corners, [(0, 1, 2), (0, 2, 3)], "#705040")
sides = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
pyramid = Mesh([*corners, (0, 1.5, 0)], sides, "goldenrod")
scene = Scene(
    objects=[
        Object(square, scale=4),
        Object(pyramid, position=(-1.2, 0, 0), rotation=(0, 30, 0)),
        Object(pyramid, position=(1.4, 0, 0.6), scale=0.7, material=Material("flat", specular=0.9)),
    ],
    camera=Camera.perspective(eye=(2, 4, 7), target=(0, 0.5, 0), fov=40),
    lights=[Light.directional(toward=(-1, 2, 1)), Light.point(position=(3, 2, 3), color="lightblue")],
    background=("steelblue", "white"),
    width=96,
    height=64,
)
scene.save("pyramids.json")
assert shackled.load("pyramids.json") == scene
shackled.render(scene).save("pyramids.png")
