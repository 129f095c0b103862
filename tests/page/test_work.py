"""The workers of the page make the files and figures that Python makes."""

from __future__ import annotations

import base64
import gzip
import html
import io
import json
import re
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from examples import showcase
from PIL import Image as PillowImage

import shackled
from node_scripts import asked, needs_web
from pictures import chain, frames_of, local, pixels_of
from shackled import Ground, InputError, Light, Material, Mesh, Object, Scene, Texture
from shackled.artifacts import artifact
from shackled.ethereum._encoding import to_hex
from shackled.evm._instance import Instance
from shackled.scene._codec import render_call
from shackled.scene._turning import full_turn
from shackled.stages import draw_stages
from shackled.studio import make_apng, make_glb, store_scene
from shackled.studio._storage import STUDIO
from shackled.tokens._collection import EDITIONS
from shackled.tokens._editions import MAX_SCALE, EditionTerms, add_gas
from shackled.web._page import asset, make_page, page_template

SCRIPT = Path(__file__).with_name("work.ts")
TERMS = {"name": "Tea", "price": "1000", "supply": None, "royalty": 500, "copies": 1, "model": False}
GAS = 30_000_000_000
#: What the page runs besides the contracts that draw.
MORE = ("PngEncoder", "Turntable", "GlbEncoder", "Genesis", "Editions")

pytestmark = needs_web


def textured() -> Scene:
    """Two triangles with a texture and opacities, a vertex that no face uses, and a ground with a shadow."""
    mesh = Mesh(
        np.array([[9, 9, 9], [-1, -1, 0], [1, -1, 0], [1, 1, 0.2], [-1, 1, 0]]),
        [[1, 3, 4], [1, 2, 3]],
        [[255, 255, 255]] * 5,
        uvs=[[0, 0], [0, 1], [1, 1], [1, 0], [0, 0]],
        opacities=np.array([1, 1, 0.6, 1, 0.2]),
    )
    texture = Texture(np.arange(48, dtype=np.uint8).reshape(4, 4, 3) * 5)
    scene = shackled.load("tetrahedron", (40, 32))
    part = Object(mesh, material=Material(texture=texture), cull=False)
    lights = [Light.directional(toward=[1, 2, 2], shadow=True), Light.point([0, 3, 1], (80, 90, 255))]
    return evolve(scene, objects=[part, *scene.objects], lights=lights, ground=Ground("#807060"))


SCENES = {
    "teapot": evolve(shackled.load("teapot", (48, 40)), antialias=True),
    "edges": evolve(shackled.load("icons/crystals", 32), invert=True),
    "textured": textured(),
    "large": shackled.load(showcase.plaster(), 24),
}
#: Those of which pictures are made.
DRAWN = ("teapot", "edges", "textured")


class Answers:
    """What the workers' code answers."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in ("evm.wasm", "contracts.json"):
            (folder / name).write_bytes(asset(name))
        codes = {each: {"address": to_hex(local().address(each)), "code": to_hex(local().code(each))} for each in MORE}
        errors = {to_hex(key): error for each in (*MORE, STUDIO) for key, error in artifact(each).errors.items()}
        (folder / "more.json").write_text(json.dumps({"contracts": codes, "errors": errors}))
        texts = {name: scene.encode().decode() for name, scene in SCENES.items()}
        cases = [
            {"name": name, "does": does, "text": texts.get(scene), "options": options}
            for name, (does, scene, options) in CASES.items()
        ]
        content = {"data": str(folder), "template": page_template(), "cases": cases}
        self.found: dict[str, Any] = dict(zip(CASES, asked(SCRIPT, folder, content), strict=True))

    def value(self, name: str) -> Any:
        found = self.found[name]
        assert "error" not in found, found
        return found["answer"]

    def file(self, name: str, kind: str) -> bytes:
        self.value(name)
        return (self.folder / f"{name}.{kind}").read_bytes()


QUOTED: dict[str, dict[str, Any]] = {
    "teapot": {},
    "edges": {"model": True, "copies": 0, "supply": 10},
    "edges, copies": {"copies": 7},
    "textured": {},
    "large": {"price": "0"},
}


FILM = {"frames": 5, "duration": 90, "scale": 2}
#: What is asked, by name: what the script does, with which scene, and options.
CASES: dict[str, tuple[str, str, dict[str, Any]]] = {
    "selectors": ("selectors", "", {}),
    **{f"{scene}-png": ("file", scene, {"format": "png", "scale": 2}) for scene in DRAWN},
    **{f"{scene}-transparent": ("file", scene, {"format": "transparent", "scale": 1}) for scene in DRAWN},
    **{f"{scene}-stages": ("stages", scene, {}) for scene in DRAWN},
    "glb": ("file", "textured", {"format": "glb"}),
    "apng": ("file", "edges", {"format": "apng", **FILM}),
    "gif": ("gif", "edges", FILM),
    "many": ("gif", "teapot", {"frames": 3, "duration": 50, "scale": 1}),
    "page": ("page", "teapot", {"title": '<Tea> & "pot"', "notice": "By A & B"}),
    "genesis": ("genesis", "", {"seed": "7"}),
    **{f"{name}-quote": ("quote", name.partition(",")[0], TERMS | terms) for name, terms in QUOTED.items()},
    "nameless": ("quote", "edges", TERMS | {"name": ""}),
    **{f"fits-{limit}": ("fits", "edges", {"limit": limit}) for limit in ("transaction", "call", "edition")},
    "fits-not": ("fits", "large", {"limit": "transaction"}),
    "too-large": ("file", "large", {"format": "png", "scale": 1000}),
}


@pytest.fixture(scope="session")
def answers(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    return Answers(tmp_path_factory.mktemp("work"))


def test_selectors(answers: Answers) -> None:
    for contract, functions in answers.value("selectors").items():
        document = json.loads((files("shackled.artifacts") / f"{contract}.json").read_text("utf-8"))
        known = {(name.partition("(")[0], int(key, 16)) for name, key in document["methodIdentifiers"].items()}
        assert set(functions.items()) <= known, contract


@pytest.mark.parametrize("name", DRAWN)
def test_pictures_and_stages(answers: Answers, name: str) -> None:
    scene = SCENES[name]
    image = shackled.render(scene, on=chain())
    found = answers.file(f"{name}-png", "png")
    assert (pixels_of(found) == image.pixels.repeat(2, axis=0).repeat(2, axis=1)).all()
    # it has the scene, too
    path = answers.folder / f"{name}.again.png"
    path.write_bytes(found)
    assert render_call(shackled.load(path)) == render_call(scene)
    glass = shackled.render(scene, on=chain(), transparent=True)
    with PillowImage.open(io.BytesIO(answers.file(f"{name}-transparent", "transparent"))) as picture:
        assert (np.array(picture) == glass.channels).all()
    stages = draw_stages(scene, chain())
    assert answers.value(f"{name}-stages") == [[each.title, each.detail] for each in stages]
    for number, stage in enumerate(stages):
        drawn = np.frombuffer(answers.file(f"{name}-stages", str(number)), np.uint8)
        assert (drawn.reshape(*stage.pixels.shape[:2], 4)[:, :, :3] == stage.pixels).all(), stage.title


def test_films_and_files_of_contracts(answers: Answers) -> None:
    assert answers.file("glb", "glb") == make_glb(SCENES["textured"]).content
    assert answers.file("apng", "apng") == make_apng(SCENES["edges"], 5, 90, 2).content
    scene = chain().call("Genesis", artifact("Genesis").interface.encode("scene", (7).to_bytes(32, "big"))).output
    assert answers.file("genesis", "call") == artifact("Renderer").selectors["render"] + scene
    frames = frames_of(answers.file("gif", "gif"))
    with PillowImage.open(io.BytesIO(answers.file("gif", "gif"))) as film:
        assert (film.info["duration"], film.info["loop"], film.size, len(frames)) == (90, 0, (64, 64), 5)
    for found, each in zip(frames, full_turn(SCENES["edges"], 5), strict=True):
        difference = np.abs(found[::2, ::2].astype(int) - shackled.render(each, on=chain()).pixels)
        assert (found == found[::2, ::2].repeat(2, axis=0).repeat(2, axis=1)).all()
        assert np.mean(difference > 24) < 0.02
    picture = shackled.render(SCENES["teapot"], on=chain()).pixels.astype(int)
    assert np.abs(pixels_of(answers.file("many", "gif")) - picture).max() < 40


def test_a_page(answers: Answers) -> None:
    expected = make_page(shackled.render(SCENES["teapot"], on=chain()), '<Tea> & "pot"', "By A & B").decode()
    found = answers.file("page", "html").decode()
    assert "{{" not in re.sub(r"<script.*?</script>", "", found, flags=re.DOTALL)

    def parts(page: str) -> tuple[str, list[bytes]]:
        data = re.findall(r'<script type="text/plain" id="\w+">(.*?)</script>', page)
        plain = re.sub(r'(<script type="text/plain" id="\w+">).*?</script>|base64,[^"]*', r"\1", page)
        return html.unescape(plain), [gzip.decompress(base64.b64decode(each)) for each in data]

    assert parts(found) == parts(expected)


@pytest.mark.parametrize("name", QUOTED)
def test_a_quote(answers: Answers, name: str) -> None:
    found, scene = answers.value(f"{name}-quote"), SCENES[name.partition(",")[0]]
    studio, collection = (local().address(each) for each in (STUDIO, EDITIONS.contract))
    storing = store_scene(scene, studio)
    assert [(each["pointer"], each["data"], each["code"]) for each in found["storing"]] == [
        (to_hex(each.pointer), each.data.hex(), each.code.hex()) for each in storing
    ]
    for each, expected in zip(found["storing"], storing, strict=True):
        # where parts are joined, Python estimates
        assert abs(each["gas"] - expected.gas) <= (0.02 * expected.gas if "joined" in expected.what else 0)
    assert found["stored"] == sum(each.size for each in storing)
    given = TERMS | QUOTED[name]
    scale = max(1, min(MAX_SCALE, 512 // max(scene.width, scene.height)))
    terms = EditionTerms(
        str(given["name"]), to_hex(storing[-1].pointer), int(str(given["price"])), given["supply"] or 2**32 - 1,
        given["royalty"], given["copies"], scale, given["model"],
    )  # fmt: skip
    interface = artifact(EDITIONS.contract).interface
    data = interface.encode("add", *terms.arguments)
    assert (found["scale"], found["add"]["data"], found["collection"]) == (scale, data.hex(), to_hex(collection))
    codes = {each.pointer: each.code for each in storing}
    if not found["fits"]:
        with pytest.raises(InputError):
            add_gas(terms, codes)
        assert found["reason"]
        assert found["add"]["limit"] == 1 << 24
        return
    upper = add_gas(terms, codes)
    assert upper - 70_000 - 20_000 <= found["add"]["gas"] <= upper
    assert found["add"]["gas"] < found["add"]["limit"] <= 1 << 24

    instance = Instance()
    local().address("Renderer")
    instance.hold({**local().codes(), **codes})
    intrinsic = 21_000 + sum(16 if byte else 4 for byte in data)
    added = instance.send(collection, data, found["add"]["limit"] - intrinsic)
    assert (added.status, added.gas) == (0, found["add"]["gas"] - intrinsic)
    if not terms.copies:
        instance.send(collection, interface.encode("mint", 0, 1), GAS, terms.price)
    token = instance.call(collection, interface.encode("tokenURI", 0), GAS)
    assert (token.gas, int.from_bytes(token.output[32:64])) == (found["tokenUri"]["gas"], found["tokenUri"]["bytes"])


def test_what_does_not_fit(answers: Answers) -> None:
    assert [answers.value(f"fits-{limit}") for limit in ("transaction", "call", "edition")] == [True] * 3
    assert answers.value("fits-not") is False
    assert answers.value("large-quote")["fits"] is False
    assert "needs a name" in answers.found["nameless"]["error"]
    assert "smaller scale" in answers.found["too-large"]["error"]
