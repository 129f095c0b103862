"""The same picture, however it is cut and wherever it is rendered."""

from __future__ import annotations

import importlib.util
import threading
import time
from collections.abc import Callable
from dataclasses import replace

import pytest
from attrs import evolve

import shackled
from shackled import Camera, ChainError, Cluster, Ground, Image, InputError, Nodes, Processes, Scene, load
from shackled.chain import open_chain
from shackled.chain._opening import CHAINS
from shackled.parallel import Listener
from shackled.parallel._backends import ChainBackend
from shackled.parallel._estimate import estimate
from shackled.parallel._job import COMPARED_GAS, choose_verifier, plan, render_frames
from shackled.parallel._scheduler import Outline
from shackled.parallel.places import RenderOptions
from shackled.scene._codec import Rectangle

SCENE = evolve(load("teapot"), width=96, height=70)


@pytest.fixture(scope="module")
def whole() -> Image:
    return shackled.render(SCENE)


@pytest.mark.parametrize(
    "where",
    [
        RenderOptions(tile=(96, 10)),
        RenderOptions(tile=(17, 13)),
        RenderOptions(tile=(1000, 1000)),
        RenderOptions(gas_limit=4_000_000),
        RenderOptions(Processes(2, "revm")),
        RenderOptions(Processes(2), gas_limit=5_000_000),
    ],
    ids=str,
)
def test_tiles_are_the_whole(whole: Image, where: RenderOptions) -> None:
    (image,) = render_frames([SCENE], where)
    assert image.bmp == whole.bmp
    assert (image.pixels == whole.pixels).all()
    assert image.gas >= whole.gas  # type: ignore[operator]
    if image.calls == 1:
        assert (image.gas, image.intrinsic_gas) == (whole.gas, whole.intrinsic_gas)


def test_parts_fit_their_gas() -> None:
    limit = 4_000_000
    chain = open_chain()
    (image,) = render_frames([SCENE], RenderOptions(gas_limit=limit))
    tiles = plan(SCENE, 1, [ChainBackend(chain, gas=limit)], estimate(SCENE), None)
    assert 1 < len(tiles) <= image.calls
    fitting = [chain.draw(SCENE, tile).gas for tile in tiles]
    assert sum(gas is not None and gas <= limit for gas in fitting) > len(tiles) // 2
    for on in (None, Processes(2)):
        with pytest.raises(ChainError, match=r"even for a tile of .*; raise `gas_limit` or use `max_triangles`$"):
            render_frames([SCENE], RenderOptions(on, gas_limit=500_000))


def test_a_ground_covers_pixels() -> None:
    """It is a part of what is drawn, not of the background: here of the lower half."""
    camera, ground = Camera((0, 1, 9), (0, 1, 0)), Ground("white", 0, 100)
    scene = evolve(load("cube"), camera=camera, ground=ground, background="black")
    assert 1.7 < estimate(scene).density < 2.3


def test_the_cost_is_told_about_right() -> None:
    chain = open_chain()
    for name, side in (("teapot", 512), ("cube", 300), ("genesis/3", 400)):
        scene = evolve(load(name), width=side, height=side)
        gas = chain.draw(scene).gas
        assert gas is not None
        assert abs(estimate(scene).gas() / gas - 1) < 0.25
        listener = Told()
        (image,) = render_frames([scene], RenderOptions(gas_limit=16_777_216, listener=listener))
        assert abs(listener.gas / (image.gas or 0) - 1) < 0.35


class Told(Listener):
    def planned(self, outline: Outline) -> None:
        self.gas = outline.gas


@pytest.mark.parametrize(
    ("scene", "how"),
    [
        (Scene([], width=50, height=40), RenderOptions(tile=(50, 7))),
        (evolve(load("cube"), width=2048, height=48), RenderOptions(gas_limit=6_000_000)),
    ],
    ids=["empty", "wide"],
)
def test_other_scenes(scene: Scene, how: RenderOptions) -> None:
    assert render_frames([scene], how)[0].bmp == shackled.render(scene).bmp


def test_calls_end_with_their_backend() -> None:
    """At once, in all threads, and no other begins; calls elsewhere go on."""
    (place,), (other,) = (Processes(2).open(Listener()) for _ in range(2))
    long, errors = evolve(SCENE, width=2048, height=2048), list[str]()

    def draw() -> None:
        try:
            place.render(long, Rectangle(0, 0, 2048, 2048))
        except ChainError as error:
            errors.append(str(error))

    threads = [threading.Thread(target=draw) for _ in range(2)]
    for thread in threads:
        thread.start()
    time.sleep(0.2)
    place.close()
    started = time.process_time()
    for thread in threads:
        thread.join()
    # of a second and more each
    assert time.process_time() - started < 0.5
    with pytest.raises(ChainError, match="stopped"):
        place.render(SCENE, Rectangle(0, 0, 96, 20))
    assert errors == ["the call was stopped"] * 2
    assert other.render(SCENE, Rectangle(0, 0, 96, 70)) == open_chain().draw(SCENE)


@pytest.mark.parametrize("evm", ["pyrevm", "pyevm"])
def test_what_holds_the_lock_says_so(evm: str) -> None:
    if importlib.util.find_spec(CHAINS[evm]) is None:
        pytest.skip("it is not installed")
    with pytest.warns(RuntimeWarning, match=rf"^{evm} holds the lock of the Python interpreter: its calls run one"):
        (place,) = Processes(2, evm).open(Listener())
    assert (place.slots, place.name) == (1, open_chain(evm).name)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"gas_limit": 0}, "`gas_limit` must be a whole number of gas from 1 to 30,000,000,000, not 0"),
        ({"gas_limit": 10**30}, "`gas_limit` must be a whole number of gas from 1 to 30,000,000,000"),
        ({"tile": 0}, "sides of a `tile` must be whole numbers from 1"),
        ({"tile": "big"}, r"`tile` must be one number or \(width, height\)"),
        ({"on": "moon"}, "`on` must be one of revm, pyrevm, pyevm, not 'moon'"),
        ({"on": 5}, "`on` must be one of revm, pyrevm, pyevm, Processes, Nodes or Cluster, not 5"),
    ],
)
def test_what_makes_no_sense(options: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        shackled.render("cube", 16, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Processes(0), "`jobs` must be a whole number from 1 to 256, not 0"),
        (lambda: Processes(1.5), "`jobs` must be a whole number from 1 to 256, not 1.5"),  # type: ignore[arg-type]
        (lambda: Processes(evm="moon"), "`evm` must be one of revm, "),
        (lambda: Processes(2, open_chain()), "`evm` must be one of revm, "),  # type: ignore[arg-type]
        (lambda: Nodes(), "`urls` must be addresses of nodes, such as http://127.0.0.1:8545, not ()"),
        (lambda: Nodes(["http://127.0.0.1:1"]), "`urls` must be addresses of nodes, such as "),  # type: ignore[arg-type]
        (lambda: Nodes("foo"), "`urls` must be the address of a node, such as http://127.0.0.1:8545, not 'foo'"),
        (lambda: Nodes("http://127.0.0.1:1", "ws://127.0.0.1"), "`urls` must be the address of a node, "),
        (lambda: Nodes("http://127.0.0.1:1", jobs=257), "`jobs` must be a whole number from 1 to 256, not 257"),
        (lambda: Nodes("http://127.0.0.1:1", verify="most"), "`verify` must be one of all, some, none, not 'most'"),
        (lambda: Nodes("http://127.0.0.1:1", timeout=0), "`timeout` must be more than 0 seconds and at most 86,400"),
        (lambda: Nodes("http://127.0.0.1:1", address="0x12"), "`address` must be an address, 0x and 40 hexadecimal"),
        (lambda: Cluster("teapot"), "a cluster needs the address of its scheduler, such as tcp://host:8786, not 'tea"),
        (lambda: Cluster("tcp://host:8786", verify="yes"), "`verify` must be one of all, some, none, not 'yes'"),
    ],
)
def test_places_are_checked_when_they_are_made(make: Callable[[], object], message: str) -> None:
    with pytest.raises(InputError) as error:
        make()
    assert str(error.value).startswith(message)


def test_how_much_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of what takes little gas, in any number of tiles; of the rest what is asked for."""
    chain = open_chain()
    node, cheap = ChainBackend(chain, untrusted=True), estimate(SCENE)
    dear = replace(cheap, fixed=float(COMPARED_GAS))
    cases = (
        (cheap, None, "all"),
        (dear, None, "some"),
        (dear, "all", "all"),
        (cheap, "some", "some"),
        (cheap, "none", "none"),
    )
    monkeypatch.setattr("shackled.parallel._backends.SAMPLE", 10**9)
    for expected, verify, much in cases:
        judge, compared = choose_verifier([node], expected, verify)
        assert compared is (much == "all")
        assert (judge is None) is (much == "none")
        if judge is not None:
            assert judge.selects(first=True)
            assert judge.selects(first=False) is compared
    # what is drawn on this machine is right
    assert choose_verifier([ChainBackend(chain)], dear, None) == (None, True)
