"""Files of strangers in the Creator: they make it ask for nothing, and textures inside of them are drawn."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tools.page_server import Static, static

from creator_page import Visit, scene
from mesh_files import GltfObject

STRIPES = np.array([[[255, 0, 0]] * 8 + [[0, 255, 0]] * 8] * 16, dtype="u1")
KINDS = ("webp", "avif", "png")


@pytest.fixture
def other(tmp_path: Path) -> Iterator[Static]:
    """A server of somebody else, who sees what it is asked for."""
    with static(tmp_path) as served:
        yield served


def gltf(kind: str, uri: str, folder: Path) -> bytes:
    """A triangle with a texture of a kind."""
    file = GltfObject()
    file.material(pbrMetallicRoughness={"baseColorTexture": file.texture(STRIPES)})
    file.document["images"] = [{"uri": uri}]
    if kind != "png":
        file.document["textures"] = [{"extensions": {f"EXT_texture_{kind}": {"source": 0}}}]
    return file.write(folder).read_bytes()


@pytest.mark.parametrize("disk", [False, True])
def test_no_file_makes_the_page_ask(visit: Visit, other: Static, tmp_path: Path, disk: bool) -> None:
    page = visit(scene("cube"), disk=disk)
    for kind in KINDS:
        content = gltf(kind, f"{other.address}track.{kind}", tmp_path)
        page.after(lambda: page.drop(**{f"{kind}.gltf": content}))  # noqa: B023
        assert page.doc()["title"] == kind
        assert f"track.{kind}, which was not given" in page.said()
    assert other.asked == []


@pytest.mark.parametrize("kind", KINDS)
def test_textures_inside(visit: Visit, tmp_path: Path, kind: str) -> None:
    stream = io.BytesIO()
    Image.fromarray(STRIPES).save(stream, kind, **({"lossless": True} if kind == "webp" else {}))
    uri = f"data:image/{kind};base64," + base64.b64encode(stream.getvalue()).decode()
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"a.gltf": gltf(kind, uri, tmp_path)}))
    texture = "app.meshes.get(app.doc.value.objects[0].mesh).texture"
    pixels = np.reshape(page.run(f"Array.from({texture}.pixels)"), STRIPES.shape)
    np.testing.assert_allclose(pixels[:, [0, -1]], STRIPES[:, [0, -1]], atol=12)  # AVIF is lossy


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
def test_what_reads_files_reaches_no_address(visit: Visit, other: Static, tmp_path: Path, disk: bool) -> None:
    """Whatever fault a reader may have."""
    script = FRAMES.replace("FAULT", json.dumps(FAULT.replace("URL", json.dumps(f"{other.address}leak"))))
    page = visit(scene("cube"), disk=disk, script=script, allowed=other.address, nodes=[other.address])
    lines: list[str] = []
    page.page.context.on("console", lambda message: lines.append(message.text))
    page.after(lambda: page.drop(**{"a.gltf": gltf("webp", "data:,", tmp_path)}))
    page.wait("!app.busy.value")
    page.page.wait_for_timeout(300)
    assert "the fault ran" in lines
    assert other.asked == []
