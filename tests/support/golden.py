"""What the contracts return for 300 small scenes of every kind: digests of pixels and files, and gas.

    python tests/support/golden.py            tells what differs from golden.json
    python tests/support/golden.py --write    and writes it there

A change of pixels shows in the diff of golden.json as a change of gas does; a refactoring leaves the file alone. The
name of a scene is all that it is made from: its words are changes of a random scene, whose seed is the whole name.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from itertools import count, product
from pathlib import Path
from typing import Any, get_args
from zlib import crc32

import numpy as np
from attrs import evolve

from original_scenes import call_data, document, genesis_document, object_keys
from pictures import chain, soup
from random_scenes import Kind, Rng, is_anything_seen, plain, random_case
from shackled import Light, Material, Object, Scene, Texture, Tone
from shackled.artifacts import artifact
from shackled.chain import EmbeddedChain
from shackled.datasets import require
from shackled.datasets.genesis import seed_of
from shackled.errors import ChainError
from shackled.image import encode_bmp
from shackled.scene import LIGHT_KINDS, Background, Fog, Ground, Hemisphere, Rectangle, Rim, encode, resize
from shackled.scene._arithmetic import from_axis_angle, multiply
from shackled.scene._object import Shading
from shackled.scene._texture import FILTERS, WRAPS
from shackled.studio import ANIMATE, store_scene

FILE = Path(__file__).with_name("golden.json")

#: By name: 16 hexadecimal digits of the SHA-256 of what is returned, and the execution gas.
Golden = dict[str, tuple[str, int]]
Change = Callable[[Scene, Rng], Scene]

#: Most triangles of a random scene, sides of the canvas in pixels, and the gas of a call.
TRIANGLES, SIDES, GAS = 60, (16, 49), 1 << 28
#: Coordinates of the corners of slivers.
SLIVER = 30_000
#: Where the Studio of the stored scenes is: their pointers follow from it, and are to stay when contracts change.
STUDIO = bytes(range(1, 21))
NO_CHANGES = (0, (0, 0, 0, 0), 0, (0, 0), 0, (0, 0))


@dataclass(frozen=True)
class Call:
    """A call of the code at an address. codes: what is stored for it, by address."""

    address: bytes
    data: bytes
    codes: Mapping[bytes, bytes]

    def run(self) -> tuple[str, int]:
        """The digest and the gas; the name of the error of a call that fails, and no gas."""
        for address, code in self.codes.items():
            evm().put(address, code)
        try:
            result = evm().run(self.address, self.data, GAS)
        except ChainError as error:
            return type(error).__name__, 0
        return sha256(result.output).hexdigest()[:16], result.gas


def evm() -> EmbeddedChain:
    found = chain()
    assert isinstance(found, EmbeddedChain)
    return found


# ---- random scenes, changed by words ----


def made(name: str, *words: str, kind: Kind = "tame", objects: int = 1) -> Scene:
    """The first random scene from the seed of the name on that still shows something when these words have changed it.

    objects: the least number.
    """
    for seed in count(crc32(name.encode())):
        rng = np.random.default_rng(seed)
        scene = plain(random_case(seed, (kind,)).scene)
        if len(scene.objects) < objects or scene.triangles > TRIANGLES or not all(map(_size, scene.objects)):
            continue
        width, height = rng.integers(*SIDES, 2).tolist()
        top = scene.background.top
        scene = evolve(scene, width=width, height=height, background=Background(top), invert=False)
        if kind == "tame":
            scene = lit(LIGHT_KINDS[rng.integers(3)])(before(scene), rng)
        for word in words:
            scene = CHANGES[word](scene, rng)
        if is_anything_seen(scene):
            return scene
    raise AssertionError("seeds never end")


def fields(**values: Any) -> Change:
    """Changes fields of a scene."""
    return lambda scene, _: evolve(scene, **values)


def each(change: Callable[[Object, Rng], Object]) -> Change:
    """Changes each object."""
    return lambda scene, rng: evolve(scene, objects=[change(o, rng) for o in scene.objects])


def shaded(shading: Shading) -> Change:
    """Makes all objects solid, seen from their front alone, and bright."""

    def change(o: Object, rng: Rng) -> Object:
        ambient, diffuse, specular = rng.uniform([0.1, 0.4, 0], [0.4, 1, 0.8]).tolist()
        material = Material(shading, ambient, diffuse, specular, int(rng.integers(1, 129)))
        return evolve(o, material=material, **SOLID)

    return each(change)


#: Of an object that is drawn in the plainest way.
SOLID: dict[str, Any] = {"cull": True, "wireframe": False, "opacity": 1.0}


def before(scene: Scene) -> Scene:
    """Points the camera at the first object, which then fills most of the canvas."""
    camera, seen = scene.camera, scene.objects[0]
    distance = 1.0 if camera.projection == "orthographic" else _distance(scene)
    across = max(0.9 * _size(seen) / distance, 2.0**-10)
    return evolve(scene, camera=evolve(camera, target=seen.position, half_height=across, near=None))


def orthographic(scene: Scene, _: Rng) -> Scene:
    camera = scene.camera
    distance = _distance(scene) if camera.projection == "perspective" else 1.0
    half_height = camera.half_height * distance
    return evolve(scene, camera=evolve(camera, projection="orthographic", half_height=half_height, near=None))


def lit(*kinds: str, shadow: bool = False) -> Change:
    """Replaces the lights by lights of these kinds, on the side of the eye."""

    def light(kind: str, scene: Scene, rng: Rng) -> Light:
        seen = scene.objects[0]
        toward = np.asarray(scene.camera.eye) - seen.position
        away = _size(seen) * (1.5 * toward / np.linalg.norm(toward) + 0.7 * rng.normal(size=3))
        color = tuple(rng.integers(100, 256, 3).tolist())
        if kind == "directional":
            return Light(kind, away, color, shadow=shadow)
        cone = {"direction": -away, "inner_angle": 8.0, "outer_angle": 40.0} if kind == "spot" else {}
        return Light(kind, seen.position + away, color, shadow=shadow, **cone)  # type: ignore[arg-type]

    return lambda scene, rng: evolve(scene, lights=[light(kind, scene, rng) for kind in kinds])


def fog(scene: Scene, rng: Rng) -> Scene:
    distance = _distance(scene)
    return evolve(scene, fog=Fog(_color(rng), 0.7 * distance, 1.4 * distance))


def all_effects(scene: Scene, rng: Rng) -> Scene:
    tone = Tone(float(rng.uniform(0.5, 2)), True, True)
    return evolve(fog(scene, rng), hemisphere=Hemisphere(_color(rng), _color(rng)), rim=Rim(_color(rng)), tone=tone)


def textured(filter: str, wrap: str, colors: int) -> Change:
    def change(o: Object, rng: Rng) -> Object:
        pixels = rng.integers(0, 256, (colors, 3), dtype=np.uint8)[rng.integers(0, colors, (20, 20))]
        uvs = rng.uniform(-1.5, 1.5, (_count(o), 2))
        texture = Texture(pixels, filter, wrap)
        return evolve(o, mesh=evolve(o.mesh, uvs=uvs), material=evolve(o.material, texture=texture))

    return each(change)


def slivers(o: Object, rng: Rng) -> Object:
    """Replaces the mesh by triangles that are long, and from a few pixels down to far less than one thin."""
    middle, along, across = rng.normal(size=(3, 24, 3))
    thin = across * 2.0 ** -rng.uniform(3, 12, (24, 1))
    corners = np.stack([middle - along, middle + along, middle + along + thin], axis=1)
    mesh = soup(np.rint(np.clip(corners / 3, -1, 1) * SLIVER), rng.integers(0, 256, (24, 3)))
    return evolve(o, mesh=mesh, scale=_size(o) / SLIVER)


def contacts(scene: Scene, rng: Rng) -> Scene:
    """Adds to the first object its copy, turned within it, and another that has the same faces."""
    first = scene.objects[0]
    turned = multiply(first.rotation, from_axis_angle(rng.normal(size=3), 40.0))
    colors = rng.integers(0, 256, (_count(first), 3))
    again = evolve(first, mesh=evolve(first.mesh, colors=colors))
    return evolve(scene, objects=[*scene.objects, evolve(again, rotation=turned), again])


def _count(o: Object) -> int:
    return len(o.mesh.positions)


def _distance(scene: Scene) -> float:
    return float(np.linalg.norm(np.asarray(scene.camera.eye) - scene.camera.target))


def _size(o: Object) -> float:
    return o.scale * float(np.abs(o.mesh.positions).max())


def _color(rng: Rng) -> tuple[int, int, int]:
    red, green, blue = rng.integers(0, 256, 3).tolist()
    return red, green, blue


def with_alpha(cutoff: int) -> Callable[[Object, Rng], Object]:
    """Gives a texture an alpha."""

    def change(o: Object, rng: Rng) -> Object:
        assert o.material.texture is not None
        alpha = rng.integers(0, 256, o.material.texture.pixels.shape[:2])
        return evolve(o, material=evolve(o.material, texture=evolve(o.material.texture, alpha=alpha, cutoff=cutoff)))

    return change


SHADINGS = (*get_args(Shading), "wireframe")
SAMPLING, PROJECTION = ("", "antialiased"), ("", "orthographic")
LIT, LIGHTS = ("flat", "smooth"), ("no light", *(f"{kind} light" for kind in LIGHT_KINDS), "four lights")
#: With one of these alone, light is quadratic.
LAMPS = ("directional light", "point light")
VARIANTS = ("both sides", "contacts", "gradient", "inverted", "slivers")
EFFECTS = ("hemisphere", "rim", "fog", "exposure", "filmic", "gamma", "all effects")
EMISSIONS = ("", "all effects")
SHADOWS = tuple(f"shadow of a {kind} light" for kind in LIGHT_KINDS)
#: Of the texels: a palette of four bits each, one of eight, and 24 bits each.
TEXELS = {"few colours": 9, "palette": 100, "RGB": 400}
TEXTURES = {" ".join(words): words for words in product(FILTERS, WRAPS, TEXELS)}
TEXTURED = next(iter(TEXTURES))

CHANGES: dict[str, Change] = {
    "": fields(),
    **{shading: shaded(shading) for shading in get_args(Shading)},
    "wireframe": each(lambda o, _: evolve(o, **{**SOLID, "wireframe": True})),
    "mixed": fields(),
    "antialiased": fields(antialias=True),
    "orthographic": orthographic,
    "both sides": each(lambda o, _: evolve(o, cull=False)),
    "two-sided": each(lambda o, _: evolve(o, cull=False, two_sided=True)),
    "no light": fields(lights=()),
    **{f"{kind} light": lit(kind) for kind in LIGHT_KINDS},
    "four lights": lit(*LIGHT_KINDS, "point"),
    **{name: lit(kind, shadow=True) for name, kind in zip(SHADOWS, LIGHT_KINDS, strict=True)},
    "ground": lambda scene, rng: evolve(scene, ground=Ground(_color(rng))),
    "translucent": each(lambda o, rng: evolve(o, opacity=float(rng.uniform(0.2, 0.9)))),
    "vertex opacities": each(lambda o, rng: evolve(o, mesh=evolve(o.mesh, opacities=rng.random(_count(o))))),
    "hemisphere": lambda scene, rng: evolve(scene, hemisphere=Hemisphere(_color(rng), _color(rng))),
    "rim": lambda scene, rng: evolve(scene, rim=Rim(_color(rng), int(rng.integers(1, 17)))),
    "fog": fog,
    "emission": each(lambda o, rng: evolve(o, material=evolve(o.material, emission=_color(rng)))),
    "exposure": lambda scene, rng: evolve(scene, tone=Tone(float(rng.uniform(0.3, 3)))),
    "filmic": fields(tone=Tone(1.5, filmic=True)),
    "gamma": fields(tone=Tone(gamma=True)),
    "all effects": all_effects,
    **{name: textured(filter, wrap, TEXELS[texels]) for name, (filter, wrap, texels) in TEXTURES.items()},
    "blended": each(with_alpha(0)),
    "masked": each(with_alpha(128)),
    "gradient": lambda scene, rng: evolve(scene, background=Background(_color(rng), _color(rng))),
    "inverted": fields(invert=True),
    "slivers": each(slivers),
    "contacts": contacts,
}

#: Products of words; a kind of random scene, and the least number of its objects.
KINDS: tuple[tuple[Kind, int, tuple[Iterable[str], ...]], ...] = (
    ("tame", 1, (LIT, SAMPLING, LIGHTS, PROJECTION)),
    ("tame", 1, (("unlit", "wireframe"), SAMPLING, PROJECTION, ("", "both sides"))),
    ("tame", 1, (SHADINGS, SAMPLING, ("translucent", "vertex opacities"))),
    ("tame", 1, (SHADINGS, SAMPLING, ("slivers",))),
    ("tame", 1, (SHADINGS, SAMPLING, ("contacts",))),
    ("tame", 1, (LIT, EFFECTS, PROJECTION)),
    ("tame", 1, (LIT, ("gradient", "inverted", "both sides"))),
    ("tame", 1, (("unlit", "wireframe"), ("all effects",))),
    ("tame", 1, (("flat", "smooth"), TEXTURES)),
    ("tame", 1, (LIT, SHADOWS, ("", "ground"))),
    ("tame", 2, (("mixed",), SAMPLING, PROJECTION, ("", "four lights"))),
    ("tame", 2, (("mixed",), ("all effects", "shadow of a point light", TEXTURED))),
    ("tame", 1, (LIT, ("contacts",), ("translucent", *SHADOWS))),
    ("tame", 1, (LIT, ("slivers",), ("translucent", "all effects"))),
    ("tame", 1, (("smooth",), ("antialiased",), ("slivers",), ("point light", "spot light"))),
    ("tame", 1, (("smooth",), ("antialiased",), LAMPS, VARIANTS)),
    ("tame", 1, (("smooth",), ("antialiased",), LAMPS[:1], ("orthographic",), VARIANTS)),
    ("tame", 2, (("mixed",), ("antialiased",), LAMPS)),
    ("tame", 1, (SHADINGS, ("emission",), EMISSIONS)),
    ("tame", 1, (LIT, ("two-sided",), SAMPLING, ("", "translucent", "all effects"))),
    ("close", 1, (LIT, ("two-sided",), SAMPLING)),
    ("tame", 1, (LIT, (TEXTURED, "bilinear clamp RGB"), ("blended", "masked"))),
    ("close", 1, (SHADINGS, SAMPLING, PROJECTION)),
    ("wild", 1, (SHADINGS, SAMPLING, PROJECTION)),
    ("close", 1, (("smooth",), ("antialiased",), LAMPS)),
    ("wild", 1, (("smooth",), ("antialiased",), LAMPS)),
)
PIECES = (
    *("teapot", "cornell-box", "cylinder", "dodecahedron", "icons/ethereum", "icons/diamond", "icons/crown"),
    *(f"genesis/{number}" for number in range(4)),
)
#: Words for the kinds.
ADJECTIVES = {"tame": "", "close": "clipped", "wild": "huge or tiny"}


@cache
def scenes() -> dict[str, Scene]:
    """Random scenes, then built-in pieces, by name."""
    found = {}
    for kind, objects, lists in KINDS:
        for words in product(*lists):
            name = " ".join(filter(None, [*words, ADJECTIVES[kind]]))
            found[name] = made(name, *words, kind=kind, objects=objects)
    for piece in PIECES:
        found[f"piece {piece}"] = resize(require(piece).make(), (32, 24))
    for size in ((1, 1), (1, 40), (40, 1)):
        found[f"piece cube {size[0]} x {size[1]}"] = resize(require("cube").make(), size)
    return found


# ---- calls ----


def calls() -> dict[str, Call]:
    """What is called, by name."""
    found = {name: call_of("Renderer", "render", scene) for name, scene in scenes().items()}
    return found | dict(functions()) | dict(files()) | dict(stored()) | dict(of_genesis()) | dict(of_the_original())


def call_of(contract: str, function: str, scene: Scene, tile: Rectangle | None = None, *words: int) -> Call:
    return called(contract, encode(artifact(contract).selectors[function], scene, tile, *words))


def called(contract: str, data: bytes) -> Call:
    return Call(evm().address(contract), data, {})


def functions() -> Iterator[tuple[str, Call]]:
    """The other functions of the Renderer."""
    for function, shading, sampling in product(
        ("renderTile", "renderCounted", "renderTileCounted", "renderDataURI", "renderSVG"), ("flat", "smooth"), SAMPLING
    ):
        name = " ".join(filter(None, [function, shading, sampling]))
        scene = made(name, shading, sampling)
        tile = Rectangle(5, 3, scene.width - 7, scene.height - 8) if "Tile" in function else None
        yield name, call_of("Renderer", function, scene, tile)


def files() -> Iterator[tuple[str, Call]]:
    """Files that contracts make: PNG, animated PNG, GLB."""
    random = np.random.default_rng(1)
    areas = np.add.outer(np.arange(21) // 5, np.arange(30) // 7)[..., None] * [20, 10, 5]
    noise = random.integers(0, 256, (21, 30, 3))
    for (name, pixels), scale in product({"areas": areas, "noise": noise}.items(), (1, 3)):
        pictures = [encode_bmp(each.astype(np.uint8)) for each in (pixels // 2, pixels // 2 + 100)]
        for title, signature, given in (
            ("", "encode(bytes,uint256)", pictures[:1]),
            (" transparent", "encodeTransparent(bytes,bytes,uint256)", pictures),
        ):
            data = artifact("PngEncoder").interface.encode(signature, *given, scale)
            yield f"PNG{title} {name} x {scale}", called("PngEncoder", data)
    for words in (("flat",), ("smooth", "antialiased"), ("wireframe",), ("smooth", "all effects")):
        name = f"animated PNG {' '.join(words)}"
        scene = resize(made(name, *words), (20, 16))
        yield name, call_of("Turntable", "animate", scene, None, 3, 80, 2, 0, 1 << 32, 0, 1)
    for words in (
        *((shading,) for shading in SHADINGS),
        ("flat", "translucent"),
        ("smooth", "vertex opacities"),
        ("flat", TEXTURED),
        ("smooth", "shadow of a spot light", "ground"),
    ):
        name = f"GLB {' '.join(words)}"
        yield name, call_of("GlbEncoder", "encode", made(name, *words))


def stored() -> Iterator[tuple[str, Call]]:
    """What the Studio makes of scenes that it stores."""
    interface = artifact("Studio").interface
    functions: dict[str, tuple[Any, ...]] = {
        "render(address)": (),
        "renderPNG(address,uint256)": (2,),
        "renderTransparentPNG(address,uint256)": (1,),
        "renderSVG(address,uint256)": (1,),
        "glb(address)": (),
        ANIMATE: ((2, 80, 1, (0, 1 << 32, 0), True), NO_CHANGES),
    }
    for words, (signature, given) in product((("flat",), ("smooth", "antialiased")), functions.items()):
        name = f"stored {' '.join(words)} {signature.partition('(')[0]}"
        transactions = store_scene(made(name, *words), STUDIO, chain=chain())
        pointer = "0x" + transactions[-1].pointer.hex()
        codes = {STUDIO: evm().code("Studio")} | {each.pointer: each.code for each in transactions}
        yield name, Call(STUDIO, interface.encode(signature, pointer, *given), codes)


def of_genesis() -> Iterator[tuple[str, Call]]:
    """The collection Genesis from seeds, and what its tokens say."""
    for number, function in (*product(range(3), ("generate", "render")), (3, "renderSVG"), (4, "renderDataURI")):
        data = artifact("Genesis").interface.encode(function, seed_of(number))
        yield f"Genesis {number} {function}", called("Genesis", data)
    for number in range(2):
        data = artifact("GenesisMetadata").interface.encode("tokenURI", number, seed_of(number))
        yield f"Genesis {number} tokenURI", called("GenesisMetadata", data)


def of_the_original() -> Iterator[tuple[str, Call]]:
    """The interface of the original contracts."""
    solid, light = object_keys("dodecahedron"), {"lightPos": [-20, 20, 30]}
    orthographic = {"perspCamera": False, "objScale": 20, "objPosition": [0, 0, -90000]}
    for name, given in {
        "unlit": document(32, **solid),
        "lit": document(32, light, **solid),
        "lit orthographic": document(24, light, **solid, **orthographic),
        "wireframe": document(24, **solid, wireframe=True, backfaceCulling=False),
        "inverted": document(24, light, **solid, invert=True),
        "genesis": genesis_document(2, 32),
    }.items():
        for svg in (False, True)[: 1 + (name == "lit")]:
            yield f"Original {name}{' SVG' * svg}", called("Original", call_data(given, svg))


# ---- the file ----


def take() -> Golden:
    """Makes all calls."""
    return {name: each.run() for name, each in calls().items()}


def recorded() -> Golden:
    """What golden.json says."""
    return {name: (digest, gas) for name, (digest, gas) in json.loads(FILE.read_text("utf-8")).items()}


def write(golden: Golden) -> None:
    """Writes golden.json, a line for each name, sorted."""
    lines = [f"{json.dumps(name)}: {json.dumps(golden[name])}" for name in sorted(golden)]
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", "utf-8", newline="\n")


def differences(old: Golden, new: Golden) -> list[str]:
    """What changed, a line for each name; pixels first."""
    pixels: list[str] = []
    gas: list[str] = []
    for name in sorted(old.keys() | new.keys()):
        if name not in old or name not in new:
            pixels.append(f"{name}: {'is not recorded yet' if name in new else 'is not made any more'}")
            continue
        (was, gas_was), (now, gas_now) = old[name], new[name]
        parts = [f"pixels {was} -> {now}"] if was != now else []
        if gas_was != gas_now:
            change = f", {(gas_now - gas_was) / gas_was:+.2%}" if gas_was else ""
            parts.append(f"gas {gas_was:,} -> {gas_now:,} ({gas_now - gas_was:+,}{change})")
        if parts:
            (pixels if was != now else gas).append(f"{name}: {', '.join(parts)}")
    return pixels + gas


def main() -> int:
    """Runs the command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--write", action="store_true", help="write golden.json")
    is_written = parser.parse_args().write
    new = take()
    changed = differences(recorded() if FILE.exists() else {}, new)
    print("\n".join(changed) or f"none of {len(new)} scenes has changed")
    if is_written:
        write(new)
    return int(bool(changed) and not is_written)


if __name__ == "__main__":
    sys.exit(main())
