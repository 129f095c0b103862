"""The custom element <shackled-view>, in chromium, on a page opened from disk."""

from __future__ import annotations

import base64
import hashlib
import http.server
import threading
import time
import zlib
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from benchmarks.view import page as html
from tools.anvil import AnvilChain, find_anvil

from nodes import Reply, anvil, needs_anvil, result, serving
from shackled import Image, Scene, load, render
from shackled.artifacts import artifact
from shackled.ethereum import to_hex
from shackled.gas import profile
from shackled.scene import encode, encode_scene_file, render_call
from shackled.studio import store_scene
from shackled.web import asset

PATIENCE = 60
#: All that a page with the element needs; the page of a site needs less, since its scripts are files.
POLICY = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; worker-src blob:; connect-src *"
CORS = {"Access-Control-Allow-Origin": "*", "Access-Control-Allow-Headers": "*"}
STUDIO = bytes.fromhex("57d10" + "0" * 35)


class View:
    """The element of a page."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.stage = page.get_by_role("application")

    def run(self, script: str, argument: Any = None) -> Any:
        """The value of an expression of `view`, the element."""
        return self.page.evaluate(f"argument => {{ const view = this.view; return {script} }}", argument)

    def wait(self, condition: str) -> None:
        # the policy of the page forbids what playwright's own waiting does
        end = time.monotonic() + PATIENCE
        while not self.run(condition):
            assert time.monotonic() < end, f"{condition}: {self.error()!r}"
            time.sleep(0.02)

    def after(self, act: Callable[[], object]) -> dict[str, Any]:
        """The details of the picture at rest that follows what was done."""
        before, errors = self.run("[this.pictures.length, this.errors.length]")
        act()
        self.wait(f"this.pictures.length > {before} || this.errors.length > {errors}")
        assert not self.error()
        found: dict[str, Any] = self.run("this.pictures.at(-1)")
        return found

    def press(self, *keys: str) -> Callable[[], None]:
        def act() -> None:
            self.stage.focus()
            for key in keys:
                self.page.keyboard.press(key)

        return act

    def drag(self, x: float, y: float) -> None:
        box = self.stage.bounding_box()
        middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        self.page.mouse.move(*middle)
        self.page.mouse.down()
        self.page.mouse.move(middle[0] + x, middle[1] + y, steps=6)
        time.sleep(0.1)
        self.page.mouse.up()

    def error(self) -> str:
        return str(self.run("view.shadowRoot.querySelector('.error').textContent"))

    def turn(self) -> dict[str, float]:
        found: dict[str, float] = self.run("view.turn")
        return found

    def shown(self) -> list[int]:
        """Width, height and bytes of the canvas."""
        found: list[int] = self.run(
            """(() => {
                const { width, height } = view.shadowRoot.querySelector('canvas');
                return [width, height, ...view.shadowRoot.querySelector('canvas').getContext('2d')
                    .getImageData(0, 0, width, height).data];
            })()"""
        )
        return found

    def fails(self, act: Callable[[], object]) -> str:
        """What the element says after what was done."""
        before = self.run("this.errors.length")
        act()
        self.wait(f"this.errors.length > {before}")
        return self.error()


@cache
def scene(name: str = "icons/crown") -> Scene:
    return load(name, size=(48, 40))


def call_of(drawn: Scene) -> bytes:
    return encode(artifact("Renderer").selectors["render"], drawn)


def sha256(image: Image) -> str:
    return hashlib.sha256(image.pixels.tobytes()).hexdigest()


Opener = Callable[..., View]


@pytest.fixture
def show(browser: Any, tmp_path: Path) -> Iterator[Opener]:
    """Opens a page with an element. At the end of the test nothing must have gone wrong in it."""
    contexts: list[Any] = []
    faults: list[str] = []

    def open_page(call: bytes | None = None, attributes: str = "", width: int = 400, **options: Any) -> View:
        call = call_of(scene()) if call is None else call
        policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        text = html(call, attributes=attributes).replace("<shackled-view", f"{policy}\n<shackled-view", 1)
        path = tmp_path / "page.html"
        path.write_text(text, "utf-8")
        context = browser.new_context(viewport={"width": width, "height": 500}, **options)
        contexts.append(context)
        context.add_init_script(
            """this.pictures = [];
            this.turns = [];
            this.errors = [];
            addEventListener('picture', ({detail}) => this.pictures.push(detail));
            addEventListener('turn', ({detail}) => this.turns.push(detail));
            addEventListener('DOMContentLoaded', () => {
                this.view = document.querySelector('shackled-view');
                this.view.addEventListener('error', ({message}) => this.errors.push(message));
            });"""
        )
        page = context.new_page()
        page.set_default_timeout(1000 * PATIENCE)
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(path.as_uri())
        view = View(page)
        view.wait("view.picture || view.shadowRoot.querySelector('.error').textContent")
        return view

    yield open_page
    for context in contexts:
        context.close()
    assert not faults


def test_the_picture_is_that_of_python(show: Opener) -> None:
    for name in ("teapot", "icons/crown", "genesis/0"):
        drawn = load(name)
        image = render(drawn)
        view = show(call_of(drawn))
        assert not view.error()
        details = view.run("this.pictures[0]")
        assert details["sha256"] == sha256(image)
        assert (details["gas"], details["width"], details["height"]) == (image.gas, image.width, image.height)
        assert bytes(view.run("Array.from(view.picture.pixels)")) == image.to_pil().convert("RGBA").tobytes()
        assert bytes(view.run("Array.from(view.call)")) == call_of(drawn)
        figures = view.page.locator("[part=figures]").inner_text()
        assert f"{image.width} x {image.height} pixels" in figures
        assert f"{image.gas:,} gas" in figures


def test_drag_and_home(show: Opener) -> None:
    view = show()
    first = view.run("this.pictures[0]")
    turned = view.after(lambda: view.drag(50, 20))
    assert turned["sha256"] != first["sha256"]
    turn = view.turn()
    assert turn["azimuth"] < 0 < turn["elevation"]
    assert view.run("this.turns.at(-1)") == turn
    # all frames of a movement have one size
    back = view.after(view.press("Home"))
    assert view.turn() == {"azimuth": 0, "elevation": 0, "zoom": 1}
    assert back["sha256"] == first["sha256"]


def test_frames_of_a_drag_have_one_size(show: Opener) -> None:
    view = show()
    view.run("(this.sizes = [], view.addEventListener('frame', e => this.sizes.push(e.detail.width)), null)")
    view.after(lambda: view.drag(90, 0))
    sizes = view.run("this.sizes")
    assert len(sizes) > 1
    assert len(set(sizes)) == 1


def test_keys_and_wheel(show: Opener) -> None:
    view = show()
    view.after(view.press("ArrowRight", "ArrowDown", "+"))
    turn = view.turn()
    assert (turn["azimuth"], turn["elevation"], round(turn["zoom"], 6)) == (-10, 10, 1.2)
    view.after(view.press("ArrowLeft", "ArrowLeft", "-", "ArrowUp"))
    turn = view.turn()
    assert (turn["azimuth"], turn["elevation"], round(turn["zoom"], 6)) == (10, 0, 1)
    view.after(view.press("0"))

    def wheel() -> None:
        view.stage.hover()
        view.page.mouse.wheel(0, -300)

    view.after(wheel)
    assert view.turn()["zoom"] > 1
    view.after(lambda: view.page.get_by_role("button", name="Reset").click())
    assert view.turn()["zoom"] == 1


def test_two_fingers_zoom(show: Opener) -> None:
    view = show()
    box = view.stage.bounding_box()
    touches = view.page.context.new_cdp_session(view.page)

    def touch(kind: str, *xs: float) -> None:
        points = [{"x": box["x"] + x, "y": box["y"] + 50, "id": index} for index, x in enumerate(xs)]
        touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def pinch() -> None:
        touch("touchStart", 100)
        touch("touchStart", 100, 150)
        for x in range(160, 210, 10):
            touch("touchMove", 100, x)
        touch("touchEnd")

    view.after(pinch)
    turn = view.turn()
    assert turn["zoom"] == pytest.approx(2)
    assert turn["azimuth"] == 0


def test_elevation_ends_above_the_scene(show: Opener) -> None:
    view = show()
    view.after(lambda: view.run("(view.turn = {elevation: 500}, null)"))
    assert 0 < view.turn()["elevation"] < 180
    view.after(lambda: view.run("(view.turn = {azimuth: 370}, null)"))
    assert view.turn() == {"azimuth": 10, "elevation": 0, "zoom": 1}


@pytest.mark.parametrize("preference", ["reduce", "no-preference"])
def test_inertia_but_where_motion_is_reduced(show: Opener, preference: str) -> None:
    view = show(reduced_motion=preference)
    box = view.stage.bounding_box()
    went_on = False
    # on a busy machine the mouse may rest before it lets go
    for _ in range(3 if preference == "reduce" else 20):
        view.page.mouse.move(box["x"] + 100, box["y"] + 100)
        view.page.mouse.down()
        view.page.mouse.move(box["x"] + 160, box["y"] + 100, steps=4)
        view.page.mouse.up()
        turned = view.turn()
        time.sleep(0.4)
        went_on |= view.turn() != turned
        if went_on:
            break
    assert went_on == (preference == "no-preference")


def test_the_picture_at_rest_does_not_delay_a_drag(show: Opener) -> None:
    view = show(call_of(load("teapot", size=1000)))
    # the larger picture is being drawn; what was given up is no error
    turned = view.after(lambda: view.drag(40, 10))
    assert turned["width"] == 1000
    assert view.run("this.errors") == []
    view.after(view.press("Home"))


def test_exact_pixels(show: Opener) -> None:
    view = show()
    image = render(scene())
    view.wait("view.shadowRoot.querySelector('[part=figures]').textContent.includes('smoothed')")
    # larger, unless the browser is too slow for that
    assert view.shown()[0] >= image.width
    view.after(lambda: view.page.get_by_role("button", name="Exact pixels").click())
    width, height, *data = view.shown()
    assert (width, height) == (image.width, image.height)
    assert bytes(data) == image.to_pil().convert("RGBA").tobytes()
    assert "smoothed" not in view.page.locator("[part=figures]").inner_text()


def test_means_of_four_pixels(show: Opener) -> None:
    import numpy as np

    view = show(width=40)  # the place of the picture is smaller than the picture
    view.wait("view.shadowRoot.querySelector('[aria-busy=false]')")
    width, height, *data = view.shown()
    drawn = render(load("icons/crown", size=(96, 80))).pixels.astype(int)
    means = (drawn.reshape(40, 2, 48, 2, 3).sum(axis=(1, 3)) + 2) >> 2
    assert np.array_equal(np.array(data).reshape(height, width, 4)[..., :3], means)


def test_a_turn_given_with_the_scene(show: Opener) -> None:
    view = show()
    data = base64.b64encode(call_of(scene())).decode()
    script = "(view.call = Uint8Array.from(atob(argument), c => c.charCodeAt(0)), view.turn = {azimuth: 20}, null)"
    turned = view.after(lambda: view.run(script, data))
    assert view.turn()["azimuth"] == 20
    assert turned["sha256"] != sha256(render(scene()))
    # a new scene is shown as it is
    drop(view, call_of(scene()))
    view.wait("this.pictures.at(-1).sha256 === this.pictures[0].sha256")
    assert view.turn()["azimuth"] == 0


def test_what_is_no_turn(show: Opener) -> None:
    from playwright.sync_api import Error

    view = show()
    with pytest.raises(Error, match="turn must consist of numbers"):
        view.run("(view.turn = {azimuth: NaN}, null)")
    view.after(view.press("ArrowLeft"))


def test_scene_files_and_pictures(show: Opener) -> None:
    view = show()
    other = load("icons/diamond", size=32)
    text = encode_scene_file(other).decode()
    assert view.after(lambda: view.run("(view.scene = argument, null)", text))["sha256"] == sha256(render(other))
    png = render(scene()).encode(".png")
    details = view.after(lambda: drop(view, png))
    assert details["sha256"] == sha256(render(scene()))
    assert "carries no scene" in view.fails(lambda: drop(view, png[:33]))
    assert "carries 2 scenes" in view.fails(lambda: drop(view, png[:-12] + png[33:]))


def chunk(kind: bytes, content: bytes) -> bytes:
    return len(content).to_bytes(4, "big") + kind + content + zlib.crc32(kind + content).to_bytes(4, "big")


def drop(view: View, content: bytes) -> None:
    """Drops a file on the element."""
    view.run(
        """(() => {
            const bytes = Uint8Array.from(atob(argument), letter => letter.charCodeAt(0));
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([bytes], 'file'));
            view.dispatchEvent(new DragEvent('drop', {dataTransfer}));
        })()""",
        base64.b64encode(content).decode(),
    )


def test_bombs_are_not_inflated(show: Opener) -> None:
    view = show()
    content = zlib.compress(bytes(100_000_000), 9)
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"zTXt", b"shackled\0\0" + content)
    assert "must have up to" in view.fails(lambda: drop(view, png))


def test_wrong_scenes_are_one_line(show: Opener) -> None:
    broken = bytearray(call_of(scene()))
    # with a length that is too large
    broken[-40:] = b"\xff" * 40
    view = show(bytes(broken))
    assert view.error().endswith(".")
    assert "\n" not in view.error()
    for junk in (b"", b"\0" * 100, b'{"objects": 3}', b"<script>alert(1)</script>", b"0xzz"):
        view.fails(lambda junk=junk: drop(view, junk))  # type: ignore[misc]
    # and a right one after them
    details = view.after(lambda: drop(view, call_of(scene())))
    assert details["sha256"] == sha256(render(scene()))


def test_the_errors_of_contracts(show: Opener) -> None:
    call = bytearray(call_of(scene()))
    call[36 + 16 * 32 + 31] = 7  # the flag `invert`
    assert show(bytes(call)).error() == "The contract refused: NotAFlag(value=7)."


def test_calls_that_take_too_long_end(show: Opener) -> None:
    large = load("teapot", size=2048)
    view = show(call_of(large), attributes='timeout="150"')
    assert view.error() == "The contracts took longer than 0.15 s, and were stopped."
    view.run("view.removeAttribute('timeout')")
    details = view.after(lambda: drop(view, call_of(scene())))
    assert details["sha256"] == sha256(render(scene()))


def checked(view: View, url: str) -> dict[str, str]:
    found: dict[str, str] = view.run("view.check(argument)", url)
    return found


@needs_anvil
def test_check_by_a_node(show: Opener) -> None:
    view = show()
    with anvil("--hardfork", "cancun", "--gas-limit", "1000000000") as node:
        view.page.get_by_role("button", name="Check").click()
        view.page.get_by_role("textbox").fill(node.url)
        view.page.get_by_role("button", name="Ask the node").click()
        view.wait("view.shadowRoot.querySelector('[data-outcome]')")
        said = view.page.locator(".outcome").inner_text()
        assert (
            said == f"Equal: all {len(render(scene()).bmp):,} bytes, computed there by the contract's code, sent along."
        )
        # and turned
        view.after(view.press("ArrowLeft"))
        assert view.page.locator(".outcome").inner_text() == ""
        assert checked(view, node.url)["outcome"] == "equal"


@needs_anvil
def test_check_by_a_deployed_contract(show: Opener) -> None:
    view = show()
    binary = find_anvil()
    assert binary
    with AnvilChain(binary) as chain:
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
        content = "0x" if request["method"] == "eth_getCode" else to_hex(answer)
        return Reply(result(content).body, headers=CORS)

    with serving(node) as url:
        assert checked(view, url) == {
            "outcome": "different",
            "message": "Different: the contract's code, sent along, computed other bytes there.",
        }
    replies = {
        "HTTP status 403": Reply(b"forbidden", 403, CORS),
        "CORS": result("0x"),
        "it says: no such thing": Reply(b'{"error": {"code": 1, "message": "no such\\nthing"}}', headers=CORS),
        "its answer to eth_getCode is none": Reply(b'{"result": 7}', headers=CORS),
    }
    for words, reply in replies.items():
        with serving(lambda _, reply=reply: reply) as url:  # type: ignore[misc]
            found = checked(view, url)
            assert found["outcome"] == "unknown"
            assert words in found["message"]
    assert "http://" in checked(view, "javascript:alert(1)")["message"]


def test_stored_scenes(show: Opener) -> None:
    """The node says what code is where; Studio's own code decides what belongs there."""
    stored = load("teapot", size=(48, 40))
    transactions = store_scene(stored, STUDIO)
    codes = {to_hex(each.pointer): each.code for each in transactions}
    pointer = to_hex(transactions[-1].pointer)

    def node(request: dict[str, Any]) -> Reply:
        assert request["method"] == "eth_getCode"
        return Reply(result(to_hex(codes.get(request["params"][0], b""))).body, headers=CORS)

    def ask(view: View, url: str) -> None:
        view.run("(view.removeAttribute('src'), view.setAttribute('rpc', argument), null)", url)

    attributes = f'studio="{to_hex(STUDIO)}" pointer="{pointer}"'
    with serving(node) as url:
        view = show(attributes=attributes)
        details = view.after(lambda: ask(view, url))
        width, height = details["width"], details["height"]
        assert (width, height) == (48, 40)
        codes[pointer] = codes[pointer][:-1] + bytes([codes[pointer][-1] ^ 1])
        view = show(attributes=attributes)
        assert "do not belong there" in view.fails(lambda: ask(view, url))
        del codes[pointer]
        view = show(attributes=attributes)
        assert "Nothing is stored" in view.fails(lambda: ask(view, url))


def test_labels(show: Opener) -> None:
    view = show(attributes='label="A crown"')
    assert view.stage.get_attribute("aria-label") == "A crown"
    assert view.page.get_by_role("status").first.inner_text()
    assert view.stage.get_attribute("tabindex") == "0"
    view.page.keyboard.press("Tab")
    assert view.run("view.shadowRoot.activeElement.className") == "stage"


@pytest.fixture(params=["blob:", "'none'"])
def site(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[str]:
    """The address of a page whose files lie beside it. request: what workers it allows."""
    for name in ("view.js", "shackled.js", "evm.wasm", "contracts.json", "stages.json"):
        (tmp_path / name).write_bytes(asset(name))
    render(scene()).save(tmp_path / "crown.png")

    elements = '<shackled-view src="crown.png"><img src="crown.png" alt="A crown"></shackled-view>\n'
    (tmp_path / "index.html").write_text(
        f'<!doctype html>\n<script type="module" src="view.js"></script>\n{elements}{"<br>" * 300}{elements}'
    )

    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments, directory=str(tmp_path))

        def end_headers(self) -> None:
            policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; img-src 'self'"
            self.send_header("Content-Security-Policy", f"{policy}; worker-src {request.param}")
            super().end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


def test_a_page_of_files(browser: Any, site: str, request: pytest.FixtureRequest) -> None:
    page = browser.new_page(viewport={"width": 400, "height": 500})
    # the EVM is held back until the poster has been seen
    held: list[Any] = []
    page.route("**/evm.wasm", lambda route: held.append(route))
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    with page.expect_request("**/evm.wasm"):
        page.goto(site)
    view, poster = page.locator("shackled-view").first, page.locator("img").first
    assert poster.is_visible()
    for route in held:
        route.continue_()
    page.unroute("**/evm.wasm")
    if request.node.callspec.params["site"] == "blob:":
        view.get_by_role("button", name="Exact pixels").wait_for(timeout=1000 * PATIENCE)
        assert view.evaluate("view => view.picture.sha256") == sha256(render(scene()))
        assert not poster.is_visible()
        # pictures that nobody sees are not drawn
        assert page.locator("shackled-view").last.evaluate("view => view.picture") is None
        page.locator("shackled-view").last.scroll_into_view_if_needed()
        page.locator("shackled-view").last.get_by_role("button", name="Check").wait_for(timeout=1000 * PATIENCE)
        # the stages of instructions are loaded by what asks for a profile only
        assert f"{site}/stages.json" not in asked
        stages = page.evaluate(
            "async ([module, call]) => (await import(module)).profile(Uint8Array.from(call))",
            [f"{site}/shackled.js", list(render_call(scene()))],
        )
        assert {each["stage"]: each["gas"] for each in stages} == profile(scene()).stages()
        assert f"{site}/stages.json" in asked
    else:
        view.get_by_role("alert").wait_for(timeout=1000 * PATIENCE)
        assert "worker-src blob:" in view.get_by_role("alert").inner_text()
        assert poster.is_visible()
    page.close()
