"""What is opened: pieces, seeds, files, links, and what was kept."""

from __future__ import annotations

import hashlib
import io
import json
import random
import zipfile
from pathlib import Path

from examples.showcase import SCENES
from PIL import Image as PillowImage

import shackled
from creator_page import OBJ, Creator, Visit, drawn, link, scene
from shackled.datasets.common import shapes

SEED = hashlib.sha256(b"any").hexdigest()
MTL = b"newmtl m\nKd 1 0 0\n"


def genesis(page: Creator, seed: str, name: str) -> None:
    """The picture is that of the contract's piece."""
    page.wait("app.doc.value.title.includes(argument)", name)
    expected = shackled.load(f"genesis/{seed}", size=page.doc()["width"], antialias=page.doc()["antialias"])
    assert page.settle() == shackled.render(expected).pixels.tobytes()
    assert name in page.page.inner_text("[data-name=title]")


# ---- pieces ----


def test_the_shelf(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.page.locator("[data-name='piece-icons/heart'] img").wait_for()
    page.wait("document.querySelector('[data-name=\"piece-icons/heart\"] img').naturalWidth === 64")
    shown = page.after(page.click("piece-icons/heart"))
    assert shown == shackled.render(shackled.load("icons/heart", size=48, antialias=False)).pixels.tobytes()
    page.click("shelf-common")()
    page.after(page.click("piece-torus"))
    # one more beside it, and another instead
    page.after(lambda: page.run("app.openPiece('tetrahedron', true)"))
    assert len(page.doc()["objects"]) == 2
    page.after(page.click("piece-teapot"))
    assert len(page.doc()["objects"]) == 1
    # in its own shape, so that nothing of it is cut off
    shown = page.after(lambda: page.run("app.openPiece('showcase/wires')"))
    wires = shackled.load(SCENES["wires"](), size=(48, 36), antialias=False)
    assert shown == shackled.render(wires).pixels.tobytes()
    page.after(page.click("piece-teapot"))
    assert (page.doc()["width"], page.doc()["height"]) == (48, 48)
    # every piece is that of the package, number for number
    names = page.run("(await app.assets.pieces()).map(each => each.name)")
    assert {"icons/diamond", "teapot", "showcase/glass"} <= set(names)
    for name in names:
        found = json.loads(page.run("JSON.stringify(await app.assets.piece(argument))", name))
        dataset, _, example = name.partition("/")
        expected = SCENES[example]() if dataset == "showcase" else shackled.load(name)
        assert found == json.loads(expected.encode()), name


def test_search_and_genesis_seeds(visit: Visit) -> None:
    page = visit(scene("cube"), permissions=["clipboard-read", "clipboard-write"])
    field = page.page.locator("[data-name=search]")
    known = {name.lower() for each in page.run("app.pieces.value") for name in (each["name"], each["title"])}
    for text in ("bunny", "Heart", "no such thing"):
        field.fill(text)
        is_known = any(text.lower() in name for name in known)
        assert bool(page.page.locator(".shelf [data-name^=piece-]").count()) == is_known
        assert page.page.locator("[data-name=nothing-found]").count() == (not is_known)
    # what is nearly a seed is told
    for text in ("0x12", "heart", "5000"):
        field.fill(text)
        field.press("Enter")
        assert ("64 hexadecimal digits" in page.page.inner_text(".shelf")) == (text != "heart")
    page.run("navigator.clipboard.writeText(argument)", f"0x{SEED.upper()}")
    page.press("Control+v")()
    genesis(page, SEED, SEED[:8])
    field.fill("3")
    field.press("Enter")
    genesis(page, "3", "Genesis 3")
    page.after(page.press("g"))
    assert page.doc()["title"] != "Genesis 3"
    assert visit(page.kept()).pixels() == page.pixels()


# ---- files ----


def test_files(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"<img src=x onerror=alert(1)>.obj": OBJ.encode()}))
    # the name of a file is text, and not markup
    title = page.page.locator("[data-name=title]")
    assert "img src" in title.inner_text()
    assert ".obj" not in title.inner_text()
    assert title.locator("img").count() == 0
    assert page.run("app.meshes.get(app.doc.value.objects[0].mesh).triangles") == 4
    given = {"name": "shape.obj", "mimeType": "text/plain", "buffer": OBJ.encode()}
    page.after(lambda: page.page.set_input_files("#file", given))
    assert page.doc()["title"] == "shape"
    # two meshes are two objects, with a material beside them
    files = {"a.mtl": MTL, "chair.obj": f"mtllib a.mtl\nusemtl m\n{OBJ}".encode(), "b.obj": OBJ.encode()}
    page.after(lambda: page.drop(**files))
    objects = {each["name"]: each for each in page.doc()["objects"]}
    assert objects.keys() == {"b", "chair"}
    colors = page.run("Array.from(app.meshes.get(argument).mesh.colors).slice(0, 3)", objects["chair"]["mesh"])
    assert colors == [255, 0, 0]
    # of files that are opened one after the other, the last is shown
    for name in ("first", "second", "third"):
        page.drop(**{f"{name}.obj": f"{OBJ}# {name}\n".encode()})
    page.wait("app.doc.value.title === 'third' && !app.busy.value")
    assert not [each for each in page.run("app.toasts.value") if each["kind"] == "error"]


#: Objects on a ground, in a light with shadow.
STILL_LIFE = scene(
    "cube",
    {"mesh": {"piece": "cone", "object": 0}, "position": [2.5, 0, 0]},
    size=[64, 48],
    ground={"color": "#807060"},
    lights=[{"kind": "directional", "direction": [1, 2, 1], "shadow": True}],
    fog={"color": "#8892a2", "near": 4, "far": 20},
)


def files_of(folder: Path) -> dict[str, dict[str, bytes]]:
    """The still life in each form in which it can be dropped."""
    image = drawn(STILL_LIFE, folder)
    assert image.scene is not None
    image.save(folder / "a.png")
    image.scene.save(folder / "a.json")
    toml = b'size = 48\n[[objects]]\nmesh = "part.obj"\n[[objects]]\nmesh = "part.obj"\nposition = [3, 0, 0]\n'
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("inner/scene.toml", toml)
        archive.writestr("inner/part.obj", OBJ)
    return {
        "png": {"a.png": (folder / "a.png").read_bytes()},
        "toml": {"scene.toml": toml, "part.obj": OBJ.encode()},
        "json": {"a.json": (folder / "a.json").read_bytes()},
        "references": {"b.json": json.dumps(STILL_LIFE).encode()},
        "zip": {"all.zip": packed.getvalue()},
    }


def test_scenes(visit: Visit, tmp_path: Path) -> None:
    page = visit(scene("tetrahedron"))
    for kind, files in files_of(tmp_path).items():
        for name, content in files.items():
            (tmp_path / name).write_bytes(content)
        # the ZIP file holds what was given as TOML before
        expected = shackled.render(tmp_path / {"zip": "scene.toml"}.get(kind, next(iter(files))))
        assert page.after(lambda files=files: page.drop(**files)) == expected.pixels.tobytes(), kind  # type: ignore[misc]
        doc = page.doc()
        assert len(doc["objects"]) == 2
        if kind not in ("toml", "zip"):
            # the ground is a ground, and the light keeps its shadow; so they do with another look
            page.after(page.click("look-gold"))
            assert doc["ground"]
            assert page.doc()["ground"] == doc["ground"]
            assert doc["lights"][0]["shadow"]
            assert any(light.get("shadow") for light in page.doc()["lights"])


def test_what_is_told_of_files(visit: Visit) -> None:
    page = visit(scene("cube"))
    before = page.pixels()
    stream = io.BytesIO()
    PillowImage.new("RGB", (4, 4)).save(stream, "png")
    for name, content, words in (
        ("broken.glb", b"glTF" + bytes(100), "broken.glb"),
        ("plain.png", stream.getvalue(), "was not made by Shackled"),
        ("notes.txt", b"Buy milk.", "This is no 3D file: notes.txt. Known are .glb, "),
        ("deep.json", b'{"objects": ' + b"[" * 100_000, "deep.json"),
    ):
        page.run("void (app.toasts.value = [])")
        page.drop(**{name: content})
        said = page.said("error")
        assert words in said
        assert said[0].isupper()
        assert page.settle() == before
    # too many bytes are not read
    page.run("void (app.toasts.value = [])")
    page.run(
        "void app.open([{ name: 'huge.stl', size: 101 * 2 ** 20, arrayBuffer: () => Promise.reject(Error('read')) }])"
    )
    assert "100 MB" in page.said("error")
    # large meshes are simplified
    ball = shapes.icosphere(5)
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in ball.positions.tolist())
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in (ball.faces + 1).tolist())
    page.after(lambda: page.drop(**{"ball.obj": (points + faces).encode()}))
    told = page.said()
    assert told.startswith("ball.obj: ")
    assert "simplified" in told
    notes, gas = (page.page.locator(name).bounding_box() for name in (".toasts", "[data-name=status]"))
    assert notes["y"] + notes["height"] < gas["y"]
    triangles = page.run("app.meshes.get(app.doc.value.objects[0].mesh).triangles")
    assert triangles < ball.triangles or page.doc()["objects"][0]["maxTriangles"] < ball.triangles


# ---- links ----


def test_a_link_that_is_none_is_told_and_something_is_shown(visit: Visit) -> None:
    page = visit("#1AAAA")
    assert page.said("error")
    assert page.doc()["objects"]
    before = page.pixels()
    for address in ("#1" + "x" * 50, "#9abc", link({"objects": 3})):
        page.run("void (app.toasts.value = [], location.hash = argument)", address)
        assert page.said("error")
        assert page.settle() == before


def test_links_of_files(visit: Visit) -> None:
    """A small file is in the link. One that is too large is told, and opened again it restores the picture."""
    chance = random.Random(1)
    points = "".join(f"v {n / 300} {chance.random() / 9} {chance.random() / 9}\n" for n in range(1800))
    large = {"large.obj": (points + "".join(f"f {n} {n + 1} {n + 2}\n" for n in range(1, 1799))).encode()}
    page = visit(scene("cube"))
    shown = page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    address = page.kept()
    assert page.run("app.missing.value") == []
    other = visit(address)
    assert other.pixels() == shown
    page.after(lambda: page.drop(**large))
    page.after(page.press("i", "ArrowLeft"))
    page.wait("app.missing.value.length")
    shown = page.pixels()
    other.run("void (location.hash = argument)", page.kept())
    assert "large" in other.said("error").lower()
    assert other.after(lambda: other.drop(**large)) == shown


# ---- what is kept ----


def test_what_is_kept(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    shown = page.after(page.press("i"))
    page.kept()
    # the plain address remembers
    other = visit("", context=page.page.context)
    assert other.pixels() == shown
    dialog = page.dialog("things")
    page.click("keep")()
    dialog.locator("li").wait_for()
    dialog.get_by_label("Name").fill("My first")
    dialog.get_by_label("Name").press("Enter")
    dialog.get_by_role("button", name="Duplicate: My first").click()
    dialog.locator("li").nth(1).wait_for()
    page.page.keyboard.press("Escape")
    page.after(page.click("piece-icons/heart"))
    # another tab has its own picture, and the same things
    assert other.pixels() == shown
    other.after(other.press("i"))
    dialog = other.dialog("things")
    assert other.after(dialog.get_by_role("button", name="Open: My first").last.click) == shown
    dialog = other.dialog("things")
    for left in (1, 0):
        dialog.get_by_role("button", name="Delete:").first.click()
        dialog.get_by_role("button", name="Delete for good").click()
        other.wait("document.querySelectorAll('#things li').length === argument", left)
