"""Pictures that are lowered until they fit a request."""

from __future__ import annotations

import pytest
from attrs import evolve

from shackled import InputError, Scene, load, render
from shackled.chain import open_chain
from shackled.chain._chain import CallResult
from shackled.cli.look_options import FIT
from shackled.datasets import teapot
from shackled.errors import InputWarning
from shackled.gas import fit_scene, limits, measure, render_call, suffices
from shackled.gas._fitting import FITS, Fitted
from shackled.gas._limits import fits_of
from shackled.scene._look import resize

LIMITS = {what: next(limit for limit in limits() if limit.place == place) for what, place in FITS.items()}


@pytest.fixture(scope="module")
def default() -> Scene:
    """The teapot in the default look of mesh files, which is too much for a transaction."""
    return load(load("teapot").objects[0].mesh, size=256)


@pytest.fixture
def tries(monkeypatch: pytest.MonkeyPatch) -> list[bytes]:
    """The data of the calls that are made."""
    chain, made = open_chain(), list[bytes]()
    call = chain.call

    def counted(contract: str, data: bytes, gas_limit: int | None = None) -> CallResult:
        made.append(data)
        return call(contract, data, gas_limit)

    monkeypatch.setattr(chain, "call", counted)
    return made


def fits(scene: Scene, what: str) -> bool:
    chain, data = open_chain(), render_call(scene)
    made = chain.call("Renderer", data)
    found = fits_of(made.gas, data, suffices(chain, "Renderer", data))
    return next(each.fits for each in found if each.limit == LIMITS[what])


def gas(scene: Scene) -> int:
    exact = measure(scene)
    return exact.gas + exact.intrinsic_gas


def dear(scene: Scene, gas_of_all: float) -> Scene:
    """Return the scene with so many equal meshes, one behind the other, that it takes nearly this gas."""
    (o,) = scene.objects
    count = max(1, int(gas_of_all / gas(scene)))
    return evolve(scene, objects=[evolve(o, position=(0, 0, -0.01 * n)) for n in range(count)])


def test_what_fits_is_left_as_it_is(tries: list[bytes]) -> None:
    scene = load("cube")
    for count, what in enumerate(FITS, 1):
        found = fit_scene(scene, what)
        assert found.scene == scene
        assert len(tries) == count
        assert found.sentence.startswith("the picture fits ")


def test_antialiasing_goes_first(default: Scene, tries: list[bytes]) -> None:
    plain = resize(evolve(default, antialias=False), 128)
    scene = dear(plain, 0.97 * LIMITS["call"].gas)
    assert fits(scene, "call")
    assert not fits(evolve(scene, antialias=True), "call")
    words = f"to fit a read call of geth, the picture is drawn without antialiasing: {gas(scene):,} of 50,000,000 gas"
    tries.clear()
    assert fit_scene(evolve(scene, antialias=True), "call") == Fitted(scene, words)
    assert len(tries) == 2


def test_the_largest_size_that_fits_comes_next(default: Scene, tries: list[bytes]) -> None:
    scene = resize(evolve(default, antialias=True), (512, 384))
    found = fit_scene(scene, "transaction")
    assert len(tries) <= 8
    assert not found.scene.antialias
    assert found.scene.objects == scene.objects
    assert 128 < found.scene.width < 512
    # the shape stays
    assert found.scene.height == round(found.scene.width * 384 / 512)
    assert fits(found.scene, "transaction")
    larger = found.scene.width + 8
    near = gas(found.scene) > 0.97 * LIMITS["transaction"].gas
    assert near or not fits(resize(found.scene, (larger, round(larger * 384 / 512))), "transaction")
    size = f"{found.scene.width} x {found.scene.height}"
    assert f"without antialiasing and at {size} instead of 512 x 384" in found.sentence


def test_triangles_of_fine_meshes_go_before_the_smallest_sizes(tries: list[bytes]) -> None:
    pytest.importorskip("fast_simplification")
    fine = load(teapot(12), cull=True, antialias=False)
    assert fine.triangles > 5_000
    found = fit_scene(fine, "transaction")
    assert len(tries) <= 9
    assert found.scene.width == found.scene.height == 128
    assert 128**2 // 8 <= found.scene.triangles < fine.triangles
    assert fits(found.scene, "transaction")
    assert f"with {found.scene.triangles:,} of {fine.triangles:,} triangles" in found.sentence


def test_coarse_meshes_keep_their_triangles_until_the_end(default: Scene) -> None:
    pytest.importorskip("fast_simplification")
    small = resize(evolve(default, antialias=False), 64)
    some = dear(small, 0.8 * LIMITS["transaction"].gas)
    found = fit_scene(resize(some, 256), "transaction")
    assert found.scene.objects == some.objects
    assert 64 <= found.scene.width < 256
    many = dear(small, 2.5 * LIMITS["transaction"].gas)
    found = fit_scene(resize(many, 256), "transaction")
    assert found.scene.width == 64
    (mesh,) = {each.mesh for each in found.scene.objects}
    assert 200 <= mesh.triangles < 992
    assert fits(found.scene, "transaction")


def test_too_many_triangles_for_a_request_at_all() -> None:
    pytest.importorskip("fast_simplification")
    scene = load(teapot(20), size=32, shading="flat", cull=True, antialias=False)
    assert len(render_call(scene)) > 128 * 1024
    found = fit_scene(scene, "transaction")
    # the data of a transaction is limited, too
    assert len(render_call(found.scene)) < 128 * 1024
    assert (found.scene.width, found.scene.height) == (32, 32)
    assert fits(found.scene, "transaction")


def test_what_fits_nowhere_is_told(default: Scene) -> None:
    pytest.importorskip("fast_simplification")
    scene = dear(resize(default, 80), 20 * LIMITS["call"].gas)
    with pytest.raises(InputError, match="larger than what one transaction on Ethereum can hold"):
        fit_scene(evolve(scene, objects=2 * scene.objects), "transaction")
    small = r"without antialiasing, at 64 x 64 instead of 80 x 80 pixels and with [\d,]+ of [\d,]+ triangles$"
    with pytest.raises(InputError, match=f"fits a read call of geth, even {small}"):
        fit_scene(scene, "call")
    with pytest.raises(InputError, match=r"`fit` must be one of transaction, call, ethereum, base, .*, not 'block'"):
        fit_scene(scene, "block")


def test_shadows_that_no_size_makes_cheap_are_told() -> None:
    scene = load("icons/crystals", ground="white", shadow=True)
    least, lights = resize(scene, 64), [evolve(each, shadow=False) for each in scene.lights]
    shadows, geometry = (gas(each) - gas(evolve(each, lights=lights)) for each in (least, resize(scene, 1)))
    with pytest.raises(InputError) as caught:
        fit_scene(scene, "transaction")
    head, *others = str(caught.value).split("; ")
    assert head.endswith(
        "fits one transaction on Ethereum, even at 64 x 64 instead of 256 x 256 pixels, "
        f"where shadows take {shadows:,} gas, {geometry:,} of it for geometry at any size"
    )
    # with effects a picture is always antialiased; without them, the whole size fits
    one, both = others
    found = fit_scene(evolve(scene, lights=lights), "transaction").scene
    assert one == (
        f"without shadows, it fits at {found.width} x {found.width} instead of 256 x 256 pixels ({gas(found):,} gas)"
    )
    plain = evolve(scene, lights=lights, ground=None, antialias=False)
    assert both == f"without shadows and the ground, it fits without antialiasing ({gas(plain):,} gas)"


def test_each_chain_has_its_own_limit() -> None:
    scene = load("icons/crystals", ground="white", shadow=True)
    sides = {what: fit_scene(scene, what).scene.width for what in ("monad", "polygon", "call")}
    assert 64 <= sides["monad"] <= sides["polygon"] < sides["call"] < 256
    words = f"to fit one transaction on Polygon, the picture is drawn at {sides['polygon']} x"
    assert fit_scene(scene, "polygon").sentence.startswith(words)
    # help names all of them
    said = FIT.metadata["text"]
    assert {each for each in FITS if each not in said} == {"ethereum"}


def test_without_the_package_that_simplifies(default: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._simplify.find_spec", lambda name: None)
    many = dear(resize(evolve(default, antialias=False), 64), 2.5 * LIMITS["transaction"].gas)
    with pytest.raises(InputError, match=r"at 64 x 64 instead of 256 x 256 pixels; .*fast-simplification"):
        fit_scene(resize(many, 256), "transaction")


def test_render_draws_what_fits(default: Scene) -> None:
    with pytest.warns(
        InputWarning, match="to fit one transaction on Ethereum, the picture is drawn without antialiasing"
    ):
        image = render(default, fit="transaction", antialias=True)
    assert image == render(fit_scene(evolve(default, antialias=True), "transaction").scene)
    assert image.calls == 1
    cube = load("cube")
    assert render(cube, fit="call") == render(cube)
    with pytest.raises(InputError, match="`fit` and `tile` exclude each other"):
        render(cube, fit="call", tile=64)
    with pytest.raises(InputError, match="`fit` and `gas_limit` exclude each other"):
        render(cube, fit="call", gas_limit=10**7)
