"""The custom element <shackled-view>, in chromium, on a page opened from disk."""

from __future__ import annotations

import base64
import time
from collections.abc import Callable, Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from benchmarks.view import page as html
from tools.anvil import AnvilChain
from tools.page_server import static

from creator_page import PATIENCE, Tab
from nodes import ANVIL, Reply, anvil, needs_anvil, result, serving
from shackled import Scene, load, render
from shackled.ethereum._encoding import to_hex
from shackled.gas import profile
from shackled.scene._codec import render_call
from shackled.studio import store_scene
from shackled.web._page import asset

#: All that a page with the element needs; the page of a site needs less, since its scripts are files.
POLICY = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; worker-src blob:; connect-src *"
CORS = {"Access-Control-Allow-Origin": "*", "Access-Control-Allow-Headers": "*"}
STUDIO = bytes.fromhex("57d10" + "0" * 35)
START = {"azimuth": 0, "elevation": 0, "zoom": 1}
#: Notes what the element tells.
LISTEN = """[this.pictures, this.turns, this.errors, this.frames] = [[], [], [], []];
addEventListener('picture', ({detail}) => this.pictures.push(detail));
addEventListener('turn', ({detail}) => this.turns.push(detail));
addEventListener('DOMContentLoaded', () => {
    this.view = document.querySelector('shackled-view');
    this.view.addEventListener('error', ({message}) => this.errors.push(message));
    this.view.addEventListener('frame', ({detail}) => this.frames.push([detail.width, detail.milliseconds]));
});"""


class View(Tab):
    """The element of a page."""

    TARGET = "view"

    def __init__(self, page: Any) -> None:
        super().__init__(page, page.get_by_role("application"), "view.shadowRoot.querySelector('.error').textContent")

    def after(self, act: Callable[[], object]) -> Any:
        """The details of the picture at rest that follows what was done."""
        before, errors = self.run("[this.pictures.length, this.errors.length]")
        act()
        self.wait(f"this.pictures.length > {before} || this.errors.length > {errors}")
        assert not self.error()
        return self.run("this.pictures.at(-1)")

    def set(self, script: str, argument: Any = None) -> Callable[[], object]:
        return lambda: self.run(f"void ({script})", argument)

    def dropped(self, content: bytes) -> Callable[[], object]:
        return lambda: self.drop(file=content)

    def error(self) -> str:
        return str(self.run(self.told))

    def fails(self, act: Callable[[], object]) -> str:
        """What the element says after what was done."""
        before = self.run("this.errors.length")
        act()
        self.wait(f"this.errors.length > {before}")
        return self.error()

    def turn(self) -> Any:
        return self.run("view.turn")

    def button(self, name: str) -> Callable[[], object]:
        return lambda: self.page.get_by_role("button", name=name).click()

    def shown(self) -> Any:
        """The canvas: (H, W, 3)."""
        width, height, *data = self.run(
            """(() => {
                const canvas = view.shadowRoot.querySelector('canvas'), { width, height } = canvas;
                return [width, height, ...canvas.getContext('2d').getImageData(0, 0, width, height).data];
            })()"""
        )
        return np.array(data).reshape(height, width, 4)[..., :3]


@cache
def scene(size: Any = (48, 40)) -> Scene:
    return load("icons/crown", size=size)


Opener = Callable[..., View]


@pytest.fixture
def show(browser: Any, tmp_path: Path) -> Iterator[Opener]:
    """Opens a page with an element. At the end of the test nothing must have gone wrong in it."""
    contexts: list[Any] = []
    faults: list[str] = []

    def open_page(call: bytes | None = None, attributes: str = "", width: int = 400, **options: Any) -> View:
        policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        text = html(call or render_call(scene()), attributes=attributes)
        path = tmp_path / "page.html"
        path.write_text(text.replace("<shackled-view", f"{policy}\n<shackled-view", 1), "utf-8")
        context = browser.new_context(viewport={"width": width, "height": 500}, **options)
        contexts.append(context)
        context.add_init_script(LISTEN)
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE)
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(path.as_uri())
        view = View(page)
        view.wait(f"view.picture || {view.told}")
        return view

    yield open_page
    for context in contexts:
        context.close()
    assert not faults


def test_the_picture_is_that_of_python(show: Opener) -> None:
    view = show()
    for name in ("teapot", "icons/crown", "genesis/0"):
        drawn = load(name, size=80)
        image = render(drawn)
        details = view.after(view.dropped(render_call(drawn)))
        assert details["sha256"] == image.sha256
        assert (details["gas"], details["width"], details["height"]) == (image.gas, image.width, image.height)
        assert bytes(view.run("Array.from(view.picture.pixels)")) == image.to_pil().convert("RGBA").tobytes()
        assert bytes(view.run("Array.from(view.call)")) == render_call(drawn)
        figures = view.page.locator("[part=figures]").inner_text()
        assert f"{image.width} x {image.height} pixels" in figures
        assert f"{image.gas:,} gas" in figures


def test_what_turns_the_scene(show: Opener) -> None:
    view = show(attributes='label="A crown"')
    first = view.run("this.pictures[0].sha256")
    assert first == render(scene()).sha256
    assert view.page.get_by_role("status").first.inner_text()
    assert (view.place.get_attribute("aria-label"), view.place.get_attribute("tabindex")) == ("A crown", "0")
    view.page.keyboard.press("Tab")
    assert view.run("view.shadowRoot.activeElement.className") == "stage"

    def drag() -> None:
        view.drag(90, 20, hold=True)
        time.sleep(0.1)
        view.page.mouse.up()

    assert view.after(drag)["sha256"] != first
    turn = view.turn()
    assert turn["azimuth"] < 0 < turn["elevation"]
    assert view.run("this.turns.at(-1)") == turn
    # all frames of a movement have one size, except after one that took far too long
    frames = view.run("this.frames")
    assert len(frames) > 1
    assert all(size == before or took > 120 for (before, took), (size, _) in pairwise(frames))
    assert view.after(view.press("Home"))["sha256"] == first
    assert view.turn() == START

    acts: tuple[tuple[Callable[[], object], tuple[float, float, float]], ...] = (
        (view.press("ArrowRight", "ArrowDown", "+"), (-10, 10, 1.2)),
        (view.press("ArrowLeft", "ArrowLeft", "-", "ArrowUp"), (10, 0, 1)),
        (view.press("0"), (0, 0, 1)),
        (view.touch((-100,), (-100, -50), *((-100, x) for x in range(-40, 10, 10))), (0, 0, 2)),
        (view.button("Reset"), (0, 0, 1)),
        (view.set("view.turn = {azimuth: 370}"), (10, 0, 1)),
    )
    for act, expected in acts:
        view.after(act)
        assert tuple(view.turn().values()) == pytest.approx(expected)
    view.after(view.wheel)
    assert view.turn()["zoom"] > 1
    # not to below the scene, or above it, where it would be seen from behind
    view.after(view.set("view.turn = {elevation: 500}"))
    assert 0 < view.turn()["elevation"] < 180
    assert "turn must consist of numbers" in view.run(
        "(() => { try { view.turn = {azimuth: NaN} } catch (error) { return error.message } })()"
    )
    # one that is given with a scene is taken; a scene without one is shown as it is
    data = base64.b64encode(render_call(scene())).decode()
    given = "view.call = Uint8Array.from(atob(argument), c => c.charCodeAt(0)), view.turn = {azimuth: 20}"
    assert view.after(view.set(given, data))["sha256"] != first
    assert view.turn()["azimuth"] == 20
    view.dropped(render_call(scene()))()
    view.wait("this.pictures.at(-1).sha256 === this.pictures[0].sha256")
    assert view.turn() == START


@pytest.mark.parametrize("preference", ["reduce", "no-preference"])
def test_inertia_but_where_motion_is_reduced(show: Opener, preference: str) -> None:
    view = show(reduced_motion=preference)
    went_on = False
    # on a busy machine the mouse may rest before it lets go
    for _ in range(3 if preference == "reduce" else 20):
        view.drag(60, 0)
        turned = view.turn()
        time.sleep(0.4)
        went_on = view.turn() != turned
        if went_on:
            break
    assert went_on == (preference == "no-preference")


def test_the_picture_at_rest_does_not_delay_a_drag(show: Opener) -> None:
    view = show(render_call(load("teapot", size=1000)))
    # the larger picture is being drawn; what was given up is no error
    assert view.after(lambda: view.drag(40, 10))["width"] == 1000
    assert view.run("this.errors") == []
    view.after(view.press("Home"))


def test_exact_pixels(show: Opener) -> None:
    view = show()
    view.wait("view.shadowRoot.querySelector('[part=figures]').textContent.includes('smoothed')")
    # larger, unless the browser is too slow for that
    assert view.shown().shape[1] >= 48
    view.after(view.button("Exact pixels"))
    assert np.array_equal(view.shown(), render(scene()).pixels)
    assert "smoothed" not in view.page.locator("[part=figures]").inner_text()


def test_what_is_finer_than_a_frame_of_the_movement_is_shown_at_once(show: Opener) -> None:
    """On a screen of many pixels, the smooth picture takes seconds."""
    view = show(render_call(load("teapot", size=512, antialias=True)), width=800, device_scale_factor=3)
    view.wait("view.shadowRoot.querySelector('[aria-busy=false]')")
    view.run(
        """void (this.widths = [], view.addEventListener('picture', ({ detail }) =>
            this.widths.push(view.shadowRoot.querySelector('canvas').width >= detail.width)))"""
    )
    view.after(lambda: view.drag(90, 20))
    assert max(size for size, _ in view.run("this.frames")) < 512
    assert view.run("this.widths") == [True]


def test_means_of_four_pixels(show: Opener) -> None:
    view = show(width=40)  # the place of the picture is smaller than the picture
    view.wait("view.shadowRoot.querySelector('[aria-busy=false]')")
    drawn = render(scene((96, 80))).pixels.astype(int)
    means = (drawn.reshape(40, 2, 48, 2, 3).sum(axis=(1, 3)) + 2) >> 2
    assert np.array_equal(view.shown(), means)


def test_what_is_shown_and_what_is_told(show: Opener) -> None:
    """web/tests/view.test.ts has files of all kinds, and what is wrong with others."""
    refused = bytearray(render_call(scene()))
    refused[36 + 16 * 32 + 31] = 7  # the flag `invert`
    view = show(bytes(refused))
    assert view.error() == "The contract refused: NotAFlag(value=7)."
    too_long = render_call(scene())[:-40] + b"\xff" * 40
    for junk in (b"", b"\0" * 100, b'{"objects": 3}', b"<script>alert(1)</script>", b"0xzz", too_long):
        said = view.fails(view.dropped(junk))
        assert said.endswith(".")
        assert "\n" not in said
    image, other = render(scene()), load("icons/diamond", size=32)
    assert view.after(view.dropped(image.encode(".png")))["sha256"] == image.sha256
    text = other.encode().decode()
    assert view.after(view.set("view.scene = argument", text))["sha256"] == render(other).sha256
    # what takes too long is stopped; the next is drawn
    view.run("view.setAttribute('timeout', '150')")
    large = view.dropped(render_call(load("teapot", size=2048)))
    assert view.fails(large) == "The contracts took longer than 0.15 s, and were stopped."
    view.run("view.removeAttribute('timeout')")
    assert view.after(view.dropped(render_call(scene())))["sha256"] == image.sha256


def allowed(value: Any) -> Reply:
    """A node's answer, which pages may read."""
    return Reply(result(value).body, headers=CORS)


def checked(view: View, url: str) -> Any:
    return view.run("view.check(argument)", url)


@needs_anvil
def test_check_by_a_node(show: Opener) -> None:
    view = show()
    with anvil("--hardfork", "cancun", "--gas-limit", "1000000000") as node:
        view.button("Check")()
        view.page.get_by_role("textbox").fill(node.url)
        view.button("Ask the node")()
        view.wait("view.shadowRoot.querySelector('[data-outcome]')")
        outcome = view.page.locator(".outcome")
        size = f"{len(render(scene()).bmp):,}"
        assert outcome.inner_text() == f"Equal: all {size} bytes, computed there by the contract's code, sent along."
        # and turned
        view.after(view.press("ArrowLeft"))
        assert outcome.inner_text() == ""
        assert checked(view, node.url)["outcome"] == "equal"
    with AnvilChain(str(ANVIL)) as chain:
        chain.address("Renderer")
        found = checked(view, chain.node.url)
    assert found["outcome"] == "equal"
    assert "the contract deployed on its chain" in found["message"]


def test_nodes_that_answer_otherwise(show: Opener) -> None:
    view = show()
    bmp = bytearray(render(scene()).bmp)
    bmp[-1] ^= 1
    answer = (32).to_bytes(32, "big") + len(bmp).to_bytes(32, "big") + bytes(bmp)

    def node(request: dict[str, Any]) -> Reply:
        return allowed("0x" if request["method"] == "eth_getCode" else to_hex(answer))

    with serving(node) as url:
        found = checked(view, url)
    said = "Different: the contract's code, sent along, computed other bytes there."
    assert found == {"outcome": "different", "message": said}
    replies = {
        "HTTP status 403": Reply(b"forbidden", 403, CORS),
        "CORS": result("0x"),
        "it says: no such thing": Reply(b'{"error": {"code": 1, "message": "no such\\nthing"}}', headers=CORS),
        "its answer to eth_getCode is none": allowed(7),
    }
    for words, reply in replies.items():
        with serving(lambda _, reply=reply: reply) as url:  # type: ignore[misc]
            found = checked(view, url)
            assert found["outcome"] == "unknown"
            assert words in found["message"]
    assert "http://" in checked(view, "javascript:alert(1)")["message"]


def test_stored_scenes(show: Opener) -> None:
    """The node says what code is where; Studio's own code decides what belongs there."""
    transactions = store_scene(load("teapot", size=(48, 40)), STUDIO)
    codes = {to_hex(each.pointer): each.code for each in transactions}
    pointer = to_hex(transactions[-1].pointer)

    def node(request: dict[str, Any]) -> Reply:
        assert request["method"] == "eth_getCode"
        return allowed(to_hex(codes.get(request["params"][0], b"")))

    with serving(node) as url:
        view = show(attributes=f'exact studio="{to_hex(STUDIO)}" pointer="{pointer}"')

        def ask() -> None:
            view.run("['src', 'rpc'].forEach(name => view.removeAttribute(name))")
            view.run("view.setAttribute('rpc', argument)", url)

        details = view.after(ask)
        assert (details["width"], details["height"]) == (48, 40)
        # the worker, which is idle and goes on, asks for all parts again
        view.after(view.set("view.turn = { azimuth: 20 }"))
        codes[pointer] = codes[pointer][:-1] + bytes([codes[pointer][-1] ^ 1])
        assert "do not belong there" in view.fails(ask)
        del codes[pointer]
        assert "Nothing is stored" in view.fails(ask)


@pytest.mark.parametrize("workers", ["blob:", "'none'"])
def test_a_page_of_files(browser: Any, tmp_path: Path, workers: str) -> None:
    """The files lie beside the page, which allows such workers."""
    for name in ("view.js", "shackled.js", "evm.wasm", "contracts.json", "stages.json"):
        (tmp_path / name).write_bytes(asset(name))
    render(scene()).save(tmp_path / "crown.png")
    policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src 'self'"
    element = '<shackled-view src="crown.png"><img src="crown.png" alt="A crown"></shackled-view>\n'
    (tmp_path / "index.html").write_text(
        f'<!doctype html>\n<meta http-equiv="Content-Security-Policy" content="{policy}; worker-src {workers}">\n'
        f'<script type="module" src="view.js"></script>\n{element}{"<br>" * 300}{element}'
    )
    with static(tmp_path) as served, browser.new_page(viewport={"width": 400, "height": 500}) as page:
        page.set_default_timeout(1000 * PATIENCE)
        # the EVM is held back until the poster has been seen
        held: list[Any] = []
        page.add_init_script("Worker = class extends Worker { started = (globalThis.started ??= []).push(this) }")
        page.route("**/evm.wasm", lambda route: held.append(route))
        with page.expect_request("**/evm.wasm"):
            page.goto(served.address)
        view, last = (page.locator("shackled-view").nth(number) for number in (0, 1))
        poster = page.locator("img").first
        assert poster.is_visible()
        # what is shown in place of another before the EVM is there starts no second worker
        for _ in range(2):
            view.evaluate("(view, text) => { view.scene = text }", scene().encode().decode())
        for route in held:
            route.continue_()
        page.unroute("**/evm.wasm")
        if workers == "'none'":
            alert = view.get_by_role("alert")
            alert.wait_for()
            assert "worker-src blob:" in alert.inner_text()
            assert poster.is_visible()
            return
        view.get_by_role("button", name="Exact pixels").wait_for()
        assert view.evaluate("view => view.picture.sha256") == render(scene()).sha256
        assert not poster.is_visible()
        assert page.evaluate("started.length") == 1
        # pictures that nobody sees are not drawn
        assert last.evaluate("view => view.picture") is None
        last.scroll_into_view_if_needed()
        last.get_by_role("button", name="Check").wait_for()
        # the stages of instructions are loaded by what asks for a profile only
        assert "/stages.json" not in served.asked
        stages = page.evaluate(
            "async ([module, call]) => (await import(module)).profile(Uint8Array.from(call))",
            [f"{served.address}shackled.js", list(render_call(scene()))],
        )
        assert {each["stage"]: each["gas"] for each in stages} == profile(scene()).stages()
        assert "/stages.json" in served.asked
