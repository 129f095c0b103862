"""Files of strangers in the Creator: they make it ask for nothing, and their textures of any kind are drawn."""

from __future__ import annotations

import base64
import io
import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

from creator_page import Visit, scene

TRIANGLE = np.array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1], dtype="<f4").tobytes()


class Counter(ThreadingHTTPServer):
    """A server that keeps what it is asked for."""

    def __init__(self) -> None:
        self.asked: list[str] = []
        asked = self.asked

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                asked.append(self.path)
                self.send_response(200)
                self.send_header("Access-Control-Allow-Origin", "*")
                self.send_header("Content-Length", "0")
                self.end_headers()

            do_OPTIONS = do_POST = do_HEAD = do_GET

            def log_message(self, *_: Any) -> None:
                pass

        super().__init__(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server_port}"


@pytest.fixture
def counter() -> Iterator[Counter]:
    with Counter() as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server
        server.shutdown()
        thread.join()


def gltf(image: dict[str, Any], texture: dict[str, Any]) -> bytes:
    """A triangle with a texture."""
    uri = "data:;base64," + base64.b64encode(TRIANGLE).decode()
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "buffers": [{"byteLength": len(TRIANGLE), "uri": uri}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
            ],
            "images": [image],
            "textures": [texture],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}],
        }
    ).encode()


def extension(kind: str) -> dict[str, Any]:
    return {"extensions": {f"EXT_texture_{kind}": {"source": 0}}} if kind != "png" else {"source": 0}


@pytest.mark.parametrize("disk", [False, True])
def test_no_file_makes_the_page_ask(visit: Visit, counter: Counter, disk: bool) -> None:
    page = visit(scene("cube"), disk=disk)
    for kind in ("webp", "avif", "png"):
        name = f"{kind}.gltf"
        page.after(lambda: page.drop(**{name: gltf({"uri": f"{counter.address}/track.{kind}"}, extension(kind))}))  # noqa: B023
        assert page.doc()["title"] == kind
        assert f"track.{kind}, which was not given" in page.said()
    assert counter.asked == []


@pytest.mark.parametrize("kind", ["webp", "avif", "png"])
def test_textures_inside(visit: Visit, kind: str) -> None:
    """Red to the left, green to the right, whatever the image is packed with."""
    pixels = np.zeros((16, 16, 3), dtype="u1")
    pixels[:, :8, 0] = pixels[:, 8:, 1] = 255
    stream = io.BytesIO()
    PillowImage.fromarray(pixels).save(stream, kind, **({"lossless": True} if kind == "webp" else {}))
    uri = f"data:image/{kind};base64," + base64.b64encode(stream.getvalue()).decode()
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"a.gltf": gltf({"uri": uri}, extension(kind))}))
    table = page.run(
        "(({width, height, pixels}) => [width, height, ...pixels])"
        "(app.meshes.get(app.doc.value.objects[0].mesh).texture)"
    )
    assert table[:2] == [16, 16]
    assert np.abs(np.reshape(table[2:], (16, 16, 3))[:, [0, -1]].astype(int) - pixels[:, [0, -1]]).max() < 12


#: A script that asks for an address in all the ways that workers have.
FAULT = """
const ways = [
    () => fetch(URL), () => fetch(URL, { mode: "no-cors" }), () => importScripts(URL), () => new EventSource(URL),
    () => new WebSocket(URL.replace("http", "ws")),
    () => { const ask = new XMLHttpRequest(); ask.open("GET", URL, false); ask.send(); },
];
for (const way of ways) try { Promise.resolve(way()).catch(() => 0) } catch {}
fetch("data:,").then(() => console.log("the fault ran"));
"""
#: Lets scripts of workers that are made in frames begin with it.
FRAMES = """
if (self !== top) globalThis.Blob = class extends Blob {
    constructor(parts, options) {
        super(options?.type === "text/javascript" ? [FAULT, ...parts] : parts, options);
    }
};
"""


@pytest.mark.parametrize("disk", [False, True])
def test_what_reads_files_reaches_no_address(visit: Visit, counter: Counter, disk: bool) -> None:
    """Whatever fault a reader may have."""
    script = FAULT.replace("URL", json.dumps(f"{counter.address}/leak"))
    script = FRAMES.replace("FAULT", json.dumps(script))
    page = visit(scene("cube"), disk=disk, script=script, allowed=counter.address, nodes=[counter.address])
    lines: list[str] = []
    page.page.context.on("console", lambda message: lines.append(message.text))
    page.after(lambda: page.drop(**{"a.gltf": gltf({"uri": "data:,"}, extension("webp"))}))
    page.page.wait_for_timeout(300)
    assert "the fault ran" in lines
    assert counter.asked == []
