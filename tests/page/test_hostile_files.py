"""Strangers' files in the Creator: they make it ask for nothing, take little, and their textures are drawn."""

from __future__ import annotations

import base64
import io
import json
import os
import threading
import time
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


def memory() -> int:
    """The bytes of the processes that this one has started, and those: shared ones are divided."""
    parents: dict[int, int] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(stat.parent.name)] = int(stat.read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
    own, total = {os.getpid()}, 0
    while found := {number for number, parent in parents.items() if parent in own} - own:
        own |= found
    for number in own - {os.getpid()}:
        try:
            lines = Path(f"/proc/{number}/smaps_rollup").read_text().splitlines()
            total += next(1024 * int(line.split()[1]) for line in lines if line.startswith("Pss:"))
        except OSError:
            continue
    return total


@pytest.mark.skipif(not Path("/proc/self/smaps_rollup").exists(), reason="memory is measured on Linux")
def test_many_large_textures(visit: Visit, tmp_path: Path) -> None:
    """Twelve of 8192 x 8192 pixels, no two alike: those that are too many together are left out."""
    file = GltfObject()
    triangle = file.primitive
    file.document["images"], file.document["textures"], file.document["materials"] = [], [], []
    file.document["meshes"][0]["primitives"] = []
    uvs = file.rows([[0, 0], [1, 0], [0, 1]])
    for number in range(12):
        stream = io.BytesIO()
        Image.new("L", (8192, 8192), 20 * number).save(stream, "png")
        file.document["images"].append({"bufferView": file.view(stream.getvalue()), "mimeType": "image/png"})
        file.document["textures"].append({"source": number})
        file.document["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": {"index": number}}})
        attributes = {**triangle["attributes"], "TEXCOORD_0": uvs}
        primitive = {**triangle, "attributes": attributes, "material": number}
        file.document["meshes"][0]["primitives"].append(primitive)
    content = file.write(tmp_path).read_bytes()
    assert len(content) < 2_000_000
    page = visit(scene("cube"))
    before, most, done = memory(), [0], threading.Event()

    def watch() -> None:
        while not done.wait(0.05):
            most[0] = max(most[0], memory())

    watcher = threading.Thread(target=watch)
    watcher.start()
    start = time.perf_counter()
    try:
        page.drop(**{"a.gltf": content})
        said = page.said()
        page.wait("app.doc.value.title === 'a'")
        page.settle()
    finally:
        done.set()
        watcher.join()
    assert time.perf_counter() - start < 20
    assert most[0] - before < 1_000_000_000
    # the last of the notes are shown
    assert "textures[11] is left out: all textures together may have up to 268,435,456 pixels; reduce them" in said
