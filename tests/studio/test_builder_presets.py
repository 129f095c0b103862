"""The presets of the scene builder are those of Python."""

from __future__ import annotations

import pytest
from attrs import evolve
from eth_abi.abi import encode

from compiler import needs_compiler
from probes import SCENE_STRUCT, Probe
from shackled import load
from shackled.artifacts import artifact
from shackled.scene import PRESETS
from shackled.scene._decode import read_call
from shackled.scene._in_range import in_range
from shackled.scene._look import look_at
from shackled.scene._packed import pack
from shackled.scene._scene import Scene
from shackled.scene._settings import checked_look

#: Of cosines and of coefficients, in Q32, after two roundings.
NEAR = 2**-28


@needs_compiler
@pytest.mark.parametrize(("piece", "toward"), [("icosphere", (1, 1, 3)), ("cube", (-4, 0, 1)), ("cube", (0, 1, 0))])
def test_each_is_that_of_python(piece: str, toward: tuple[int, int, int]) -> None:
    mesh = in_range(load(piece, shading="smooth" if piece == "icosphere" else "flat")).objects[0].mesh
    smooth = mesh.normals is not None
    data = pack(mesh, smooth), smooth, toward
    (scenes,) = Probe("tests/studio/PresetProbe.sol").ask([f"{SCENE_STRUCT}[]"], "all(bytes,bool,int256[3])", *data)
    plain = read_call(_call(scenes[-1]))
    for preset, struct in zip(PRESETS, scenes, strict=True):
        found = read_call(_call(struct))
        wanted = look_at(
            evolve(plain, objects=[evolve(plain.objects[0], mesh=mesh)]), checked_look({"preset": preset.name})
        )
        _assert_alike(found, wanted, smooth)


def _call(struct: tuple[object, ...]) -> bytes:
    return bytes(artifact("Renderer").selectors["render"]) + encode([SCENE_STRUCT], [struct])


def _assert_alike(found: Scene, wanted: Scene, smooth: bool) -> None:
    assert (found.background, found.ambient_light, found.invert) == (
        wanted.background,
        wanted.ambient_light,
        wanted.invert,
    )
    assert [light.shadow for light in found.lights] == [True, False][: len(found.lights)]
    for one, other in zip(found.lights, wanted.lights, strict=True):
        assert one.color == other.color
        assert one.vector == pytest.approx(other.vector, abs=NEAR)
    (thing,), (o,) = found.objects, wanted.objects
    assert thing.wireframe == o.wireframe
    assert (thing.mesh.colors == o.mesh.colors).all()
    own, other_own = thing.material, o.material
    assert own.shading == ("flat" if other_own.shading == "smooth" and not smooth else other_own.shading)
    for name in ("ambient", "diffuse", "specular", "shininess"):
        if own.shading != "unlit":
            assert getattr(own, name) == pytest.approx(getattr(other_own, name), abs=NEAR)
