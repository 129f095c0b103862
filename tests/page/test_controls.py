"""Controls: each changes the picture and is reset; looks, lights, objects, undo."""

from __future__ import annotations

import json
from typing import Any

from creator_page import Creator, Visit, scene

#: Objects, lights and effects with which each control has an effect.
ALL = scene(
    {"mesh": {"piece": "cube", "object": 0}, "crease": 85, "material": {"shading": "smooth"}},
    {"mesh": {"piece": "cone", "object": 0}, "position": [2.2, 0, 0], "material": {"shading": "smooth"}, "crease": 85},
    size=[40, 32],
    ground={"color": "#708090", "radius": 6},
    lights=[
        {"kind": "spot", "position": [3, 5, 6], "direction": [-3, -5, -6], "inner_angle": 10, "outer_angle": 30},
        {"kind": "point", "position": [-4, 2, 3], "color": "#4060ff"},
    ],
    hemisphere={"sky": "#88aaff", "ground": "#442200"},
    rim={"color": "#ffcc88", "power": 3},
    fog={"color": "#8892a2", "near": 4, "far": 14},
    tone={"exposure": 1.1, "filmic": True, "gamma": True},
)
GROUPS = {"object", "material", "lights", "ground", "atmosphere", "tone", "camera", "picture"}
#: What the page may draw alike: they change what the file says, or what comes later.
UNSEEN = {"lights_follow", "cull", "two_sided", "antialias", "max_triangles"}

#: Changes a control by its own element, to another value of its range.
CHANGE = """(() => {
    const row = document.querySelector(`[data-name='row-${argument}']`);
    const set = (field, value) => {
        Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set.call(field, value);
        for (const type of ['input', 'change']) field.dispatchEvent(new Event(type, { bubbles: true }));
    };
    const radio = row.querySelector('input[type=radio]:not(:checked)');
    const number = row.querySelector('input[type=number]');
    const color = row.querySelector('input[type=color]');
    const box = row.querySelector('input[type=checkbox]');
    if (number) {
        const [low, high, now, step] = [number.min, number.max, number.value, number.step].map(Number);
        const by = Math.max(step, 0.1 * Math.min(high - low, number.closest('[data-unit=r]') ? 20 : 100));
        set(number, String(Number((now + by <= high ? now + by : now - by).toPrecision(4))));
    } else if (color) set(color, color.value === '#3fa060' ? '#a03f60' : '#3fa060');
    else (radio ?? box).click();
})()"""


def test_each_control_changes_the_picture_and_is_reset(visit: Visit) -> None:
    page = visit(ALL)
    doc, shown = page.doc(), page.pixels()
    page.open_groups()
    rows = page.run(
        """[...document.querySelectorAll('[data-name^=row-]')].map(each => [
            each.dataset.name.slice(4), each.closest('.group').dataset.name.slice(6)
        ])"""
    )
    assert {group for _, group in rows} >= GROUPS
    for path, _ in rows:
        reset = page.page.locator(f"[data-name='reset-{path}']")
        assert not reset.count(), path
        changed = page.after(lambda path=path: page.run(CHANGE, path))  # type: ignore[misc]
        assert changed != shown or path.rpartition(".")[2] in UNSEEN, path
        assert page.after(reset.click) == shown, path
        reset.wait_for(state="detached")
    # a panel, and everything
    for path in ("camera.fov", "tone.exposure"):
        page.after(lambda path=path: page.run(CHANGE, path))  # type: ignore[misc]
    page.after(page.click("reset-tone"))
    assert page.doc()["tone"] == doc["tone"]
    assert page.doc()["camera"] != doc["camera"]
    assert page.after(page.click("reset-all")) == shown


def test_numbers(visit: Visit) -> None:
    page = visit(ALL)
    page.open_groups()
    most = float(page.page.get_attribute("[data-name='slider-material.diffuse']", "max"))
    page.typed("material.diffuse", str(most + 1))
    assert page.doc()["objects"][0]["material"]["diffuse"] == most + 1
    # and what no picture takes becomes the nearest that it takes, which is told
    page.typed("material.shininess", "1000")
    assert page.doc()["objects"][0]["material"]["shininess"] == 128
    assert "128" in page.said()
    # where objects differ, it says so
    cone = {"mesh": {"piece": "cone", "object": 0}, "position": [3, 0, 0], "material": {"diffuse": 0.2}}
    page.show(scene("cube", cone))
    field = page.field("material.diffuse")
    page.wait("document.querySelector(\"[data-name='material.diffuse']\").placeholder === 'Mixed'")
    assert field.input_value() == ""
    page.typed("material.diffuse", "0.5")
    assert [each["material"]["diffuse"] for each in page.doc()["objects"]] == [0.5, 0.5]
    # the same length, in radii, does the same to objects of any size
    pictures = []
    for scale in (1, 50):
        page.show(scene({"mesh": {"piece": "cone", "object": 0}, "scale": scale}))
        page.typed("camera.distance", "4")
        pictures.append(page.typed("camera.target.x", "0.5"))
    assert pictures[0] == pictures[1]


def test_looks(visit: Visit) -> None:
    page = visit(ALL)
    names = page.run("[...document.querySelectorAll('[data-name^=look-]')].map(each => each.dataset.name)")
    assert len(set(names)) >= 10
    shown, doc = {page.pixels()}, page.doc()
    for name in names:
        shown.add(page.after(page.click(name)))
        now = page.doc()
        assert (now["camera"], now["width"], now["ground"]) == (doc["camera"], doc["width"], doc["ground"])
        page.page.locator(f"[data-name={name}][aria-pressed=true]").wait_for()
    assert len(shown) >= len(names)
    # they are shown on these objects
    page.wait("[...document.querySelectorAll('[data-name^=look-] img')].length === argument", len(names))
    before = page.page.get_attribute("[data-name^=look-] img >> nth=0", "src")
    page.after(page.click("piece-icons/heart"))
    page.wait("![...document.querySelectorAll('[data-name^=look-] img')].some(each => each.src === argument)", before)
    # surprises differ, of the same objects
    shown = {page.show(scene("cube", "cone")), page.after(page.click("surprise")), page.after(page.press("s"))}
    assert len(shown) == 3
    assert [each["mesh"]["piece"] for each in page.doc()["objects"]] == ["cube", "cone"]


def test_lights(visit: Visit) -> None:
    page = visit(scene("cube"))
    page.open_groups()
    shown = page.pixels()
    for count in (2, 3, 4):
        page.after(page.click("add-light"))
        assert len(page.doc()["lights"]) == count
    page.page.locator("[data-name=add-light]").wait_for(state="detached")
    for _ in range(3):
        page.after(page.click("remove-light-1"))
    assert page.pixels() == shown
    # fields follow the kind
    page.after(lambda: page.field("lights.0.kind-spot").check(force=True))
    page.field("lights.0.outer_angle").wait_for()


def place_of(page: Creator, number: int) -> tuple[float, float]:
    """Where an object is seen, in parts of the picture, as drawn by the contract."""
    places = [(x / 10, y / 10) for y in range(1, 10) for x in range(1, 10)]
    found = [place for place in places if page.run("app.work.pick(app.doc.value, ...argument)", place) == number]
    return found[len(found) // 2]


def test_objects(visit: Visit) -> None:
    page = visit(scene("cube", {"mesh": {"piece": "cone", "object": 0}, "position": [4, 0, 0]}, size=[96, 64]))
    places = [place_of(page, number) for number in (0, 1)]
    (cube, cone) = page.doc()["objects"]
    ids = [cube["id"], cone["id"]]
    box = page.place.bounding_box()
    # selected

    def click(x: float, y: float, *modifiers: Any) -> None:
        page.place.click(position={"x": x * box["width"], "y": y * box["height"]}, modifiers=list(modifiers))

    def selected(*expected: str) -> None:
        text = json.dumps(sorted(expected), separators=(",", ":"))
        page.wait("JSON.stringify([...app.selected.value].sort()) === argument", text)

    for place, id_ in zip(places, ids, strict=True):
        click(*place)
        selected(id_)
    click(*places[0], "Shift")
    selected(*ids)
    click(0.01, 0.99)
    selected()
    page.page.locator(f"[data-name='object-{ids[1]}']").click()
    selected(ids[1])
    page.press("Escape")()
    selected()
    page.press("Control+a")()
    selected(*ids)
    page.press("Escape")()
    selected()
    # moved, copied, removed, ordered, named
    page.press("m")()
    page.after(lambda: page.drag(40, 0, start=places[0]))
    moved = page.doc()["objects"]
    assert moved[0]["position"] != cube["position"]
    assert moved[1] == cone
    page.press("Escape")()
    page.run("void (app.selected.value = new Set([app.doc.value.objects[0].id]))")
    page.after(page.press("d"))
    assert len({each["id"] for each in page.doc()["objects"]}) == 3
    page.after(page.press("Delete"))
    assert len(page.doc()["objects"]) == 2
    page.page.locator("[data-name=objects] button").first.click()
    page.after(page.click("object-down"))
    assert page.doc()["objects"][1]["id"] == cube["id"]
    page.page.locator("[data-name=objects] button").last.dblclick()
    page.typed("object-name", "My cube")
    assert page.doc()["objects"][1]["name"] == "My cube"
    for _ in range(5):
        page.after(page.press("Control+z"))
    assert page.doc()["objects"] == [cube, cone]


def test_keys_undo_and_redo(visit: Visit) -> None:
    page = visit(scene("cube", "cone"))
    page.press("?")()
    dialog = page.page.locator("#keys")
    dialog.wait_for()
    assert "Wireframe" in dialog.inner_text()
    page.page.keyboard.press("Escape")
    dialog.wait_for(state="detached")
    assert page.page.is_disabled("[data-name=undo]")
    first = page.pixels()
    for key in ("l", "2", "h", "w", "c", "i", "a", "p", "f", "ArrowDown", "Shift+ArrowLeft", "+", "-", "0"):
        page.after(page.press(key))
    page.after(page.click("piece-icons/heart"))
    last = page.after(page.click("look-gold"))
    while page.page.is_enabled("[data-name=undo]"):
        shown = page.after(page.press("Control+z"))
    assert shown == first
    while page.page.is_enabled("[data-name=redo]"):
        shown = page.after(page.click("redo"))
    assert shown == last
    for key, name in (("Enter", "limits"), ("Control+s", "download")):
        page.press(key)()
        page.page.locator(f"#{name}").wait_for()
        page.page.keyboard.press("Escape")
        page.page.locator(f"#{name}").wait_for(state="detached")
    # also after a click on anything
    page.open_groups()
    for name in ("look-clay", "piece-icons/heart", "undo"):
        page.after(page.click(name))
        for key in ("i", "ArrowLeft"):
            page.after(lambda key=key: page.page.keyboard.press(key))  # type: ignore[misc]
    # a slider keeps its arrows
    page.after(page.page.locator("[data-name='slider-camera.fov']").click)
    before = page.doc()["camera"]
    page.after(lambda: page.page.keyboard.press("ArrowRight"))
    now = page.doc()["camera"]
    assert (now["eye"], now["halfHeight"] != before["halfHeight"]) == (before["eye"], True)
    page.after(lambda: page.page.keyboard.press("w"))
    # and who types, types
    doc = page.doc()
    page.page.locator("[data-name=search]").press_sequentially("wig0")
    assert page.page.input_value("[data-name=search]") == "wig0"
    assert page.doc() == doc
