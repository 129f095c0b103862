from typing import Any

import numpy as np
import pytest

from original_scenes import LIGHT, documents, wrong_documents
from shackled import Camera, Scene
from shackled.errors import InputError
from shackled.scene._arithmetic import rotate
from shackled.scene._files.original import original_scene

TRIANGLE: dict[str, Any] = {"canvasDim": 64, "verts": [[0, 0, 0], [10, 0, 0], [0, 10, 0]], "faces": [[0, 1, 2]]}


def document(**changes: Any) -> dict[str, Any]:
    return {
        **TRIANGLE,
        "cols": [[255, 0, 0], [0, 255, 0], [0, 0, 255]],
        "objPosition": [1, 2, -500],
        "objScale": 3,
        "backgroundColor": [[0, 0, 40], [0, 0, 160]],
        "lightingParams": LIGHT,
        "perspCamera": True,
        "backfaceCulling": False,
        "invert": True,
        "wireframe": True,
        **changes,
    }


def lit(**changes: Any) -> Scene:
    return original_scene(document(lightingParams={**LIGHT, **changes}))


def test_what_carries_over_exactly() -> None:
    scene = original_scene(document())
    thing = scene.objects[0]
    assert (scene.width, scene.height, scene.invert, scene.camera) == (64, 64, True, Camera())
    assert (scene.background.top, scene.background.bottom) == ((0, 0, 40), (0, 0, 160))
    assert thing.mesh.positions.tolist() == [[0, 0, 0], [10, 0, 0], [0, 10, 0]]
    assert thing.mesh.faces.tolist() == [[0, 1, 2]]
    assert thing.mesh.colors.tolist() == [[255, 0, 0], [0, 255, 0], [0, 0, 255]]
    assert (thing.position.tolist(), thing.rotation.tolist()) == ([1, 2, -500], [0, 0, 0, 1])
    assert (thing.scale, thing.cull, thing.wireframe) == (3, False, True)
    inner = document()
    assert original_scene({"canvasDim": inner.pop("canvasDim"), "renderParams": inner, "name": "x"}) == scene


def test_what_is_missing_has_defaults() -> None:
    scene = original_scene(TRIANGLE)
    thing = scene.objects[0]
    assert (thing.scale, thing.cull, thing.wireframe, thing.material.shading) == (1, True, False, "unlit")
    assert scene.background.top == (0, 0, 0)
    assert original_scene(document(faces=[])).objects == ()
    for missing in ("canvasDim", "verts", "faces"):
        with pytest.raises(InputError, match=f"^{missing} is missing$"):
            original_scene({key: value for key, value in TRIANGLE.items() if key != missing})


def test_orthographic_camera_spans_500_units_a_pixel() -> None:
    camera = original_scene(document(perspCamera=False)).camera
    assert (camera.projection, camera.half_height) == ("orthographic", 32000)


def test_light() -> None:
    scene = lit()
    material, light = scene.objects[0].material, scene.lights[0]
    assert (material.shading, material.ambient, material.shininess) == ("flat", 1, 10)
    assert (material.diffuse, material.specular) == pytest.approx((0.8, 1.2))
    assert (light.kind, light.color, light.vector.tolist()) == ("directional", (255, 255, 255), [-50, 0, 0])
    assert scene.ambient_light == (255, 255, 255)
    assert [lit(inverseShininess=n).objects[0].material.shininess for n in (0, 1000)] == [1, 128]
    dark = lit(applyLighting=False, lightPos=[0, 0, 0])
    assert (dark.objects[0].material.shading, dark.lights) == ("unlit", ())


@pytest.mark.parametrize(
    ("changes", "color", "diffuse", "specular"),
    [
        # coefficient times colour is what the original adds
        ({"lightColSpec": [100, 50, 0], "lightColDiff": [100, 50, 0]}, (255, 128, 0),
         pytest.approx(0.8 * 100 / 255, rel=0.01), pytest.approx(1.2 * 100 / 255)),
        # without a highlight, the colour is that of the diffuse light
        ({"lightSpecPower": 0, "lightColDiff": [0, 100, 200]}, (0, 128, 255),
         pytest.approx(0.8 * 200 / 255, rel=0.01), 0),
        # the power may be in the colour
        ({"lightDiffPower": 475000, "lightColDiff": [1, 1, 1], "lightColSpec": [51, 51, 51]}, (255, 255, 255),
         pytest.approx(190 / 255), pytest.approx(1.2 / 5)),
        # what a material does not take
        ({"lightSpecPower": 10**9, "lightDiffPower": -5}, (255, 255, 255), 0, 4),
    ],
)  # fmt: skip
def test_colors_and_powers(changes: dict[str, Any], color: tuple[int, ...], diffuse: Any, specular: Any) -> None:
    scene = lit(**changes)
    material = scene.objects[0].material
    assert scene.lights[0].color == color
    assert (material.diffuse, material.specular) == (diffuse, specular)


def test_rotation_in_degrees_about_x_then_y_then_z() -> None:
    rotation = original_scene(document(rotation=[90, 90, 0])).objects[0].rotation
    np.testing.assert_allclose(rotate(rotation, [0, 1, 0]), [1, 0, 0], atol=1e-12)


def test_negative_scale_mirrors_the_mesh() -> None:
    thing = original_scene(document(objScale=-2)).objects[0]
    assert thing.scale == 2
    assert thing.mesh.positions.tolist() == [[0, 0, 0], [-10, 0, 0], [0, -10, 0]]


def test_more_or_fewer_colors_than_vertices() -> None:
    four = [[0, 0, 0], [10, 0, 0], [0, 10, 0], [9, 9, 9]]
    assert len(original_scene(document(verts=four)).objects[0].mesh.colors) == 4
    assert len(original_scene(document(cols=[[1, 2, 3]] * 9)).objects[0].mesh.colors) == 3


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"canvasDim": 0}, "canvasDim must be a whole number from 1 to 2048, not 0"),
        ({"verts": [[0, 0, 0], [1, 0, float("nan")], [0, 1, 0]]}, "verts[1] must be three numbers, not [1, 0, nan]"),
        ({"faces": [[0, 1, 2.5]]}, "faces[0] must be three whole numbers, not [0, 1, 2.5]"),
        ({"cols": [[1, 2, 3]]}, "cols has 1 colours, but a face uses vertex 2, which needs one"),
        ({"cols": [[0, 0, 0], [0, 300, 0], [0, 0, 0]]},
         "cols[1] must be red, green and blue from 0 to 255, not [0, 300, 0]"),
        ({"perspCamera": 1}, "perspCamera must be true or false, not 1"),
        ({"backgroundColor": [[0, 0, 0]]},
         "backgroundColor must be two colours, the top one and the bottom one, not 1"),
        ({"backgroundColor": [[-10, 0, 0], [0, 0, 0]]},
         "backgroundColor: the background colour must be red, green and blue from 0 to 255, not [-10, 0, 0]"),
        ({"lightingParams": {**LIGHT, "lightPos": [0, 0, 0]}},
         "lightingParams.lightPos must not be the origin: it is the direction toward the light"),
        ({"lightingParams": {**LIGHT, "lightColSpec": [0, 0, -1]}},
         "lightingParams.lightColSpec must not be negative, not [0, 0, -1]"),
    ],
)  # fmt: skip
def test_what_is_wrong_names_its_key(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        original_scene(document(**changes))
    assert str(error.value) == message


def test_scenes_of_the_kinds_that_were_measured() -> None:
    for found in documents().values():
        scene = original_scene(found)
        assert scene.lights or all(thing.material.shading == "unlit" for thing in scene.objects)


@pytest.mark.parametrize("name", wrong_documents())
def test_scenes_that_the_original_does_not_draw_either(name: str) -> None:
    with pytest.raises(InputError):
        original_scene(wrong_documents()[name])
