"""What is opened: pieces, seeds, files, links, and what was kept."""

from __future__ import annotations

import hashlib
import io
import json
import random
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from creator_page import OBJ, Creator, Visit, drawn, link, scene
from shackled.scene import encode_scene_file

SEED = hashlib.sha256(b"any").hexdigest()
MTL = b"newmtl m\nKd 1 0 0\n"


def search(page: Creator, text: str) -> None:
    field = page.page.locator("[data-name=search]")
    field.fill(text)
    field.press("Enter")


def genesis(page: Creator, seed: str, name: str) -> None:
    """The picture is that of the contract's piece."""
    width = page.doc()["width"]
    expected = shackled.render(shackled.load(f"genesis/{seed}", size=width, antialias=page.doc()["antialias"]))
    assert page.settle() == expected.pixels.tobytes()
    assert name in page.page.inner_text("[data-name=title]")


# ---- pieces ----


def test_a_piece_from_the_shelf(visit: Visit, tmp_path: Path) -> None:
    page = visit(scene("cube"))
    page.page.locator("[data-name='piece-icons/heart'] img").wait_for()
    page.wait("document.querySelector('[data-name=\"piece-icons/heart\"] img').naturalWidth === 64")
    shown = page.after(page.click("piece-icons/heart"))
    assert shown == shackled.render(shackled.load("icons/heart", size=48, antialias=False)).pixels.tobytes()
    page.click("shelf-common")()
    page.after(page.click("piece-torus"))
    # one more beside it, and another instead
    page.run("app.openPiece('tetrahedron', true)")
    page.wait("app.doc.value.objects.length === 2")
    page.settle()
    page.after(page.click("piece-teapot"))
    assert len(page.doc()["objects"]) == 1


#: The digest of all numbers and words of a value, in the order of their keys.
DIGEST = """(async () => {
    const [numbers, words] = [[], []];
    const walk = value => {
        if (typeof value === 'number') numbers.push(value);
        else if (value === null || typeof value !== 'object') words.push(String(value));
        else if (Array.isArray(value)) value.forEach(walk);
        else for (const key of Object.keys(value).sort()) words.push(key), walk(value[key]);
    };
    const found = {};
    for (const { name } of await app.assets.pieces()) {
        [numbers.length, words.length] = [0, 0];
        walk(await app.assets.piece(name));
        const text = new TextEncoder().encode(words.join());
        const bytes = new Uint8Array([...text, ...new Uint8Array(Float64Array.from(numbers).buffer)]);
        const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
        found[name] = [...digest.slice(0, 8)].map(byte => byte.toString(16).padStart(2, '0')).join('');
    }
    return found;
})()"""


def digest(value: Any) -> str:
    """The same in Python."""
    numbers: list[float] = []
    words: list[str] = []

    def walk(value: Any) -> None:
        if isinstance(value, bool) or value is None or isinstance(value, str):
            words.append(value if isinstance(value, str) else json.dumps(value))
        elif isinstance(value, int | float):
            numbers.append(value)
        elif isinstance(value, list):
            for each in value:
                walk(each)
        else:
            for key in sorted(value):
                words.append(key)
                walk(value[key])

    walk(value)
    return hashlib.sha256(",".join(words).encode() + np.array(numbers, "<f8").tobytes()).hexdigest()[:16]


def test_every_piece_is_that_of_the_package(visit: Visit) -> None:
    """Number for number."""
    found = visit(scene("cube")).run(DIGEST)
    assert {"icons/diamond", "teapot", "showcase/glass"} <= found.keys()
    for name, expected in found.items():
        assert digest(json.loads(encode_scene_file(shackled.load(name)))) == expected, name


def test_search(visit: Visit) -> None:
    page = visit(scene("cube"))
    known = {name.lower() for each in page.run("app.pieces.value") for name in (each["name"], each["title"])}
    for text in ("bunny", "Heart", "no such thing"):
        page.page.fill("[data-name=search]", text)
        found = [name for name in known if text.lower() in name]
        assert bool(page.page.locator(".shelf [data-name^=piece-]").count()) == bool(found)
        assert page.page.locator("[data-name=nothing-found]").count() == (0 if found else 1)


def test_a_genesis_seed(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.run(
        """(() => {
            const clipboardData = new DataTransfer();
            clipboardData.setData('text', argument);
            document.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true }));
        })()""",
        f"0x{SEED.upper()}",
    )
    page.wait("app.doc.value.title.includes(argument)", SEED[:8])
    genesis(page, SEED, SEED[:8])
    page.after(lambda: search(page, "3"))
    genesis(page, "3", "Genesis 3")
    page.after(page.press("g"))
    assert page.doc()["title"] != "Genesis 3"
    assert visit(page.kept()).pixels() == page.pixels()


def test_what_is_nearly_a_seed_is_told(visit: Visit) -> None:
    page = visit(scene("cube"))
    for text in ("0x12", "heart", "5000"):
        search(page, text)
        assert ("64 hexadecimal digits" in page.page.inner_text(".shelf")) == (text != "heart")


# ---- files ----


def test_a_file_is_dropped_and_its_name_is_no_markup(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"<img src=x onerror=alert(1)>.obj": OBJ.encode()}))
    title = page.page.locator("[data-name=title]")
    assert "img src" in title.inner_text()
    assert ".obj" not in title.inner_text()
    assert title.locator("img").count() == 0
    assert page.run("app.meshes.get(app.doc.value.objects[0].mesh).triangles") == 4


def test_a_file_is_chosen(visit: Visit) -> None:
    page = visit(scene("cube"))
    given = {"name": "shape.obj", "mimeType": "text/plain", "buffer": OBJ.encode()}
    page.after(lambda: page.page.set_input_files("#file", given))
    assert page.doc()["title"] == "shape"


def test_two_files_are_two_objects(visit: Visit) -> None:
    page = visit(scene("cube"))
    files = {"a.mtl": MTL, "chair.obj": f"mtllib a.mtl\nusemtl m\n{OBJ}".encode(), "b.obj": OBJ.encode()}
    page.after(lambda: page.drop(**files))
    assert sorted(each["name"] for each in page.doc()["objects"]) == ["b", "chair"]
    chair = next(each for each in page.doc()["objects"] if each["name"] == "chair")
    colors = page.run("Array.from(app.meshes.get(argument).mesh.colors).slice(0, 3)", chair["mesh"])
    assert colors == [255, 0, 0]


def test_files_one_after_the_other(visit: Visit) -> None:
    page = visit(scene("cube"))
    for name in ("first", "second", "third"):
        page.drop(**{f"{name}.obj": f"{OBJ}# {name}\n".encode()})
    page.wait("app.doc.value.title === 'third' && !app.busy.value")
    assert not [each for each in page.run("app.toasts.value") if each["kind"] == "error"]


def still_life() -> dict[str, Any]:
    """Objects on a ground, in a light with shadow."""
    return scene(
        "cube",
        {"mesh": {"piece": "cone", "object": 0}, "position": [2.5, 0, 0]},
        size=[64, 48],
        ground={"color": "#807060"},
        lights=[{"kind": "directional", "direction": [1, 2, 1], "shadow": True}],
        fog={"color": "#8892a2", "near": 4, "far": 20},
    )


def files_of(folder: Path) -> dict[str, dict[str, bytes]]:
    """The still life in each form in which it can be dropped."""
    image = drawn(still_life(), folder)
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
        "json": {"a.json": (folder / "a.json").read_bytes()},
        "references": {"b.json": json.dumps(still_life()).encode()},
        "toml": {"scene.toml": toml, "part.obj": OBJ.encode()},
        "zip": {"all.zip": packed.getvalue()},
    }


@pytest.mark.parametrize("kind", ["png", "json", "references", "toml", "zip"])
def test_a_scene_is_dropped(visit: Visit, tmp_path: Path, kind: str) -> None:
    files = files_of(tmp_path)[kind]
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    if kind == "zip":
        (tmp_path / "part.obj").write_text(OBJ)
        (tmp_path / "scene.toml").write_bytes(files_of(tmp_path)["toml"]["scene.toml"])
    expected = shackled.render(tmp_path / {"zip": "scene.toml"}.get(kind, next(iter(files))))
    page = visit(scene("tetrahedron"))
    assert page.after(lambda: page.drop(**files)) == expected.pixels.tobytes()
    doc = page.doc()
    assert len(doc["objects"]) == 2
    if kind not in ("toml", "zip"):
        # the ground is a ground, and the light keeps its shadow
        assert doc["ground"]
        assert doc["lights"][0]["shadow"]


def test_what_a_look_does_not_touch(visit: Visit, tmp_path: Path) -> None:
    """A scene from a file keeps ground and shadow when a look is chosen, and the ground its colour."""
    page = visit(scene("tetrahedron"))
    page.after(lambda: page.drop(**files_of(tmp_path)["png"]))
    ground = page.doc()["ground"]
    page.after(page.click("look-gold"))
    assert page.doc()["ground"] == ground
    assert any(light.get("shadow") for light in page.doc()["lights"])


def test_what_cannot_be_read_is_told(visit: Visit) -> None:
    page = visit(scene("cube"))
    before = page.pixels()
    stream = io.BytesIO()
    PillowImage.new("RGB", (4, 4)).save(stream, "png")
    for name, content, words in (
        ("broken.glb", b"glTF" + bytes(100), "broken.glb"),
        ("plain.png", stream.getvalue(), "was not made by Shackled"),
        ("empty.obj", b"", "empty.obj"),
        ("notes.txt", b"hello", "notes.txt"),
        ("bomb.zip", b"PK\x03\x04" + bytes(40), "bomb.zip"),
        ("deep.json", b'{"objects": ' + b"[" * 100_000, "deep.json"),
    ):
        page.run("void (app.toasts.value = [])")
        page.drop(**{name: content})
        said = page.said("error")
        assert words in said
        assert said[0].isupper()
        assert page.settle() == before


def test_too_many_bytes_are_refused_at_once(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.run(
        "void app.open([{ name: 'huge.stl', size: 101 * 2 ** 20, arrayBuffer: () => Promise.reject(Error('read')) }])"
    )
    assert "100 MB" in page.said("error")


def test_large_meshes_are_simplified_and_it_is_told(visit: Visit) -> None:
    page = visit(scene("cube"))
    rows = 130
    points = "".join(f"v {x} {y} {(x * x + y * y) % 7 / 9}\n" for x in range(rows) for y in range(rows))
    corners = [(x * rows + y + 1) for x in range(rows - 1) for y in range(rows - 1)]
    faces = "".join(f"f {a} {a + rows} {a + rows + 1}\nf {a} {a + rows + 1} {a + 1}\n" for a in corners)
    page.after(lambda: page.drop(**{"grid.obj": (points + faces).encode()}))
    assert "simplified" in page.said()
    triangles = page.run("app.meshes.get(app.doc.value.objects[0].mesh).triangles")
    assert triangles < 2 * len(corners) or page.doc()["objects"][0]["maxTriangles"] < 2 * len(corners)


# ---- links ----


#: Links of the Creator that had a server, with size, an object, and pixels: means of a 4 x 4 grid.
OLD_LINKS = {
    "plain": (
        "I6wUYmRKZmJuPlC6Vgc9cZhYINKGsVFtLQA",
        [48, 32],
        "3520547474937076943520544c3d78a0e6f56ec2de4a3e75673b80485b8e3d578a673b807f49967e4e987b50987f4996",
    ),
    "posed": (
        "I0Ep9qgxAvrXEDNqDEEhYQwidI1QosdAzwJoFFIcYSQlHaRkYgg0ADmhmAG58IhJNjAxMAal4PyCxOTMkkqQ4eZAw7EmdyOgUhPU5J5okGSQbADy"
        "GVp6NzFAJHdjo9paAA",
        [40, 32],
        "2f3f4f2f3e4e303e4e2f3f4f50607081515279494a525e6d71819176717c69606771819192a2b292a2b292a2b292a2b2",
    ),
    "lit": (
        "jVPLCsMgEPyXnKVoaoP0X0oJYlOhajAN7cV_746ERtMeghdd9jE74-xIDXGeKHMPmUfsX-4oc2DlosWzYFZrpTKKpeMEVKU63bZjy6sWSmlN4rBS"
        "BlHIYL038Zr91ZxFrg3zcw0Bcbqwf7ZhvyaTHKeBGZydxruJmTjgQgWRFK0rI9Wyi9_G8DIUkQnyDnW2NzCHAMwbbh2ho92Cz3PMm1wxY6Y4nCjD"
        "Phz9kqV06J3rvzg2DpZ8NbDkKX0A",
        [40, 40],
        "d7dee6ccc5cfccc5d0d6dde5ba97a9b18993b395a7b88f9db39bacb86d74b76c70b28e9aa9b6c5a8abb9a8abbaa9b6c5",
    ),
    "genesis": (
        "I6wUZrQpUDWSt3G7GqgMLf2YGCCSj4lBbS0A",
        [40, 40],
        "0000000000000e03000000000000001e0c040101010000000101010202022016130101010101010b0401010101010101",
    ),
}


@pytest.mark.parametrize("name", OLD_LINKS)
def test_an_old_link_is_understood(visit: Visit, name: str) -> None:
    text, size, colors = OLD_LINKS[name]
    page = visit(f"?p=1{text}")
    doc = page.doc()
    assert [doc["width"], doc["height"]] == size
    picture = PillowImage.frombytes("RGB", (size[0], size[1]), page.pixels()).resize((4, 4), PillowImage.Resampling.BOX)
    expected = np.frombuffer(bytes.fromhex(colors), np.uint8).astype(int)
    assert np.abs(np.frombuffer(picture.tobytes(), np.uint8) - expected).max() <= 3


@pytest.mark.parametrize("address", ["#1AAAA", "#1" + "x" * 50, "#9abc", link({"objects": 3}), "?p=1AAAA"])
def test_a_link_that_is_none_is_told_and_something_is_shown(visit: Visit, address: str) -> None:
    page = visit(address)
    assert page.said("error")
    assert page.doc()["objects"]


def test_a_small_file_is_in_the_link(visit: Visit) -> None:
    page = visit(scene("cube"))
    shown = page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    address = page.kept()
    assert page.run("app.missing.value") == []
    assert visit(address).pixels() == shown


def test_a_picture_comes_back_with_its_file(visit: Visit) -> None:
    """A file that is too large for a link is told, and opened again it restores the picture."""
    chance = random.Random(1)
    points = "".join(f"v {n / 300} {chance.random() / 9} {chance.random() / 9}\n" for n in range(1800))
    large = {"large.obj": (points + "".join(f"f {n} {n + 1} {n + 2}\n" for n in range(1, 1799))).encode()}
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**large))
    page.after(page.press("i", "ArrowLeft"))
    page.wait("app.missing.value.length")
    shown, address = page.pixels(), page.kept()
    other = visit(address, wait=False)
    assert "large" in other.said("error").lower()
    other.wait("app?.shown.value")
    other.after(lambda: other.drop(**large))
    assert other.pixels() == shown


# ---- what is kept ----


#: Whether the inverted picture is what was last shown.
AUTOSAVED = """new Promise(done => {
    const opening = indexedDB.open('shackled-creator');
    opening.onsuccess = () => {
        const request = opening.result.transaction('things').objectStore('things').get('last');
        request.onsuccess = () => {
            opening.result.close();
            done(request.result?.document.invert);
        };
    };
})"""


def test_the_plain_address_remembers(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    shown = page.after(page.press("i"))
    page.wait(AUTOSAVED)
    again = visit("", context=page.page.context)
    assert again.pixels() == shown


def test_my_things(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.after(lambda: page.drop(**{"mine.obj": OBJ.encode()}))
    shown = page.after(page.press("i"))
    dialog = page.dialog("things")
    page.click("keep")()
    dialog.locator("li").wait_for()
    dialog.get_by_label("Name").fill("My first")
    dialog.get_by_label("Name").press("Enter")
    dialog.get_by_role("button", name="Duplicate: My first").click()
    dialog.locator("li").nth(1).wait_for()
    page.page.keyboard.press("Escape")
    page.after(page.click("piece-icons/heart"))
    # in another tab, too
    other = visit(scene("cube"), context=page.page.context)
    dialog = other.dialog("things")
    assert other.after(dialog.get_by_role("button", name="Open: My first").last.click) == shown
    dialog = other.dialog("things")
    for left in (1, 0):
        dialog.get_by_role("button", name="Delete:").first.click()
        dialog.get_by_role("button", name="Delete for good").click()
        other.wait("document.querySelectorAll('#things li').length === argument", left)


def test_two_tabs_do_not_meet(visit: Visit) -> None:
    first = visit(scene("cube"))
    second = visit(scene("cone"), context=first.page.context)
    before = second.pixels()
    first.after(first.press("i"))
    assert second.pixels() == before
