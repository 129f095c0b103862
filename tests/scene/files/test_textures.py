"""Textures of mesh and scene files: what loads, how it is reduced, and files that are wrong."""

from __future__ import annotations

import base64
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from attrs import evolve
from numpy.typing import NDArray
from PIL import Image

import shackled
from mesh_files import Gltf, png, sheet
from shackled import InputError, Material, Mesh, Object, Scene, Texture, load
from shackled.errors import InputWarning
from shackled.scene import read_mesh
from shackled.scene._codec import render_call
from shackled.scene._files.beside import OUTSIDE
from shackled.scene._files.mesh_file import read_model
from shackled.scene._files.model import TEXTURED
from shackled.scene._packed import unpack_texture
from shackled.scene._simplify import simplify
from shackled.scene._texture import sample

Pixels = NDArray[np.uint8]
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
UVS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], dtype=np.float32)
FACES = np.array([0, 1, 2, 0, 2, 3], dtype=np.uint16)


def pixels_of(width: int, height: int, seed: int = 1) -> Pixels:
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), dtype=np.uint8)


def glb(path: Path, images: list[bytes | str], samplers: list[dict[str, int]] | None = None, **more: Any) -> Path:
    """A GLB with a square for each image: its bytes, or a URI. more: uvs, colors, factor, index."""
    file = Gltf()
    attributes = {
        "POSITION": file.accessor(SQUARE),
        "TEXCOORD_0": file.accessor(np.asarray(more.get("uvs", UVS), dtype=np.float32)),
    }
    if "colors" in more:
        attributes["COLOR_0"] = file.accessor(np.asarray(more["colors"], dtype=np.float32))
    primitive = {"attributes": attributes, "indices": file.accessor(FACES)}
    numbers = range(len(images))
    infos = [{"baseColorTexture": {"index": more.get("index", number)}} for number in numbers]
    file.document |= {
        "images": [{"uri": each} if isinstance(each, str) else {"bufferView": file.view(each)} for each in images],
        "samplers": samplers or [{}],
        "textures": [{"source": number, "sampler": number if samplers else 0} for number in numbers],
        "materials": [{"pbrMetallicRoughness": info | more.get("factor", {})} for info in infos],
        "meshes": [{"primitives": [{**primitive, "material": number}]} for number in numbers],
        "nodes": [{"mesh": number, "translation": [2 * number, 0, 0]} for number in numbers],
        "scenes": [{"nodes": list(numbers)}],
    }
    return file.glb(path)


def texture_of(scene: Scene, number: int = 0) -> Texture:
    found = scene.objects[number].material.texture
    assert found is not None
    return found


def messages(told: Any) -> list[str]:
    return [str(warning.message) for warning in told]


# ---- glTF ----


def test_a_textured_glb(tmp_path: Path) -> None:
    pixels = pixels_of(8, 4)
    scene = load(glb(tmp_path / "a.glb", [png(pixels)]))
    (thing,) = scene.objects
    assert texture_of(scene) == Texture(pixels, "bilinear", "repeat")
    assert thing.mesh.uvs is not None
    corners = np.hstack([thing.mesh.positions, thing.mesh.uvs])[thing.mesh.faces].reshape(-1, 5)
    np.testing.assert_allclose(corners, np.hstack([SQUARE, UVS])[FACES], atol=1e-6)
    assert (thing.mesh.colors == 255).all()


def test_samplers(tmp_path: Path) -> None:
    samplers = [{"magFilter": 9728, "wrapS": 33071, "wrapT": 33071}, {"magFilter": 9729, "wrapS": 10497}]
    scene = load(glb(tmp_path / "a.glb", [png(pixels_of(4, 4, 1)), png(pixels_of(4, 4, 2))], samplers))
    assert [(texture_of(scene, i).filter, texture_of(scene, i).wrap) for i in range(2)] == [
        ("nearest", "clamp"),
        ("bilinear", "repeat"),
    ]


def test_each_texture_is_an_object_and_all_stand_together(tmp_path: Path) -> None:
    images: list[bytes | str] = [png(pixels_of(4, 4, 1)), png(pixels_of(4, 4, 2)), png(np.full((2, 2, 3), 9, np.uint8))]
    scene = load(glb(tmp_path / "a.glb", images), size=64)
    # an image of one colour is that of the vertices
    assert [o.material.texture is not None for o in scene.objects] == [True, True, False]
    assert (scene.objects[2].mesh.colors == 9).all()
    assert len({(tuple(o.position), o.scale, o.cull) for o in scene.objects}) == 1
    low, high = scene.bounds
    assert np.linalg.norm(high - low) == pytest.approx(2, rel=0.01)


def test_factor_and_vertex_colors_are_linear(tmp_path: Path) -> None:
    path = glb(
        tmp_path / "a.glb",
        [png(pixels_of(4, 4))],
        colors=[[1, 0.5, 0]] * 4,
        factor={"baseColorFactor": [0.5, 0.5, 1, 1]},
    )
    # 1.055 * 0.5^(1 / 2.4) - 0.055 = 0.735, and 0.537 of a quarter
    assert load(path).objects[0].mesh.colors.tolist() == [[188, 137, 0]] * 4


def test_a_mirrored_image_is_doubled(tmp_path: Path) -> None:
    pixels = pixels_of(3, 2)
    scene = load(glb(tmp_path / "a.glb", [png(pixels)], [{"wrapS": 33648, "wrapT": 33648}], uvs=UVS * 2))
    across = np.concatenate([pixels, pixels[:, ::-1]], axis=1)
    assert (texture_of(scene).pixels == np.concatenate([across, across[::-1]])).all()
    uvs = scene.objects[0].mesh.uvs
    assert uvs is not None
    assert uvs.max() == 1
    # within 0..1 it is not seen
    scene = load(glb(tmp_path / "a.glb", [png(pixels)], [{"wrapS": 33648, "wrapT": 33648}]))
    assert (texture_of(scene).pixels == pixels).all()
    assert texture_of(scene).wrap == "clamp"


def test_an_image_of_which_each_triangle_shows_one_color_becomes_colors(tmp_path: Path) -> None:
    palette = np.repeat(np.repeat(pixels_of(2, 2), 8, axis=0), 8, axis=1)
    around = [[0.7, 0.2], [0.8, 0.2], [0.8, 0.4], [0.7, 0.4]]
    (thing,) = load(glb(tmp_path / "a.glb", [png(palette)], uvs=around)).objects
    assert thing.material.texture is None
    assert (thing.mesh.colors == palette[0, 15]).all()
    for move in ([-0.19, 0], [0, 0.1], [0.2, 0]):
        (thing,) = load(glb(tmp_path / "a.glb", [png(palette)], uvs=np.add(around, move))).objects
        assert thing.material.texture is not None


def test_a_large_image_is_reduced_with_a_note(tmp_path: Path) -> None:
    path = glb(tmp_path / "a.glb", [png(np.tile(pixels_of(8, 8), (64, 128, 1)))])
    with pytest.warns(InputWarning) as told:
        scene = load(path)
    assert messages(told) == [f"{path}: textures[0] is reduced from 1024 x 512 to 256 x 128 texels"]
    assert (texture_of(scene).width, texture_of(scene).height) == (256, 128)


def test_many_textures_are_smaller(tmp_path: Path) -> None:
    path = glb(tmp_path / "a.glb", [png(pixels_of(300, 300, seed)) for seed in range(5)])
    with pytest.warns(InputWarning):
        scene = load(path)
    assert {texture_of(scene, number).width for number in range(5)} == {128}


def test_far_coordinates_of_an_image_that_repeats_are_moved(tmp_path: Path) -> None:
    scene = load(glb(tmp_path / "a.glb", [png(pixels_of(4, 4))], uvs=UVS + 5000))
    uvs = scene.objects[0].mesh.uvs
    assert uvs is not None
    assert (uvs.min(), uvs.max()) == (0, 1)
    render_call(scene)
    scene = load(glb(tmp_path / "a.glb", [png(pixels_of(4, 4))], [{"wrapS": 33071, "wrapT": 33071}], uvs=UVS + 5000))
    with pytest.raises(
        InputError, match=r"objects\[0\]: the texture coordinates of vertex 0 must be from -128 to below"
    ):
        render_call(scene)


# ---- files that are wrong ----


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_coordinates_that_are_no_numbers(tmp_path: Path, value: float) -> None:
    uvs = UVS.copy()
    uvs[2, 1] = value
    path = glb(tmp_path / "a.glb", [png(pixels_of(4, 4))], uvs=uvs)
    with pytest.warns(InputWarning) as told:
        render_call(load(path))
    assert messages(told) == [
        f"{path}: textures[0] has texture coordinates that are not finite numbers; they are replaced by 0"
    ]


def test_an_image_inside_of_the_document(tmp_path: Path) -> None:
    pixels = pixels_of(4, 4)
    uri = "data:image/png;base64," + base64.b64encode(png(pixels)).decode()
    assert (texture_of(load(glb(tmp_path / "a.glb", [uri]))).pixels == pixels).all()


#: A PNG file that says it is huge.
SMALL = png(np.zeros((1, 1, 3), np.uint8))
HEADER = b"IHDR" + struct.pack(">II", 60_000, 60_000) + SMALL[24:29]
HUGE = SMALL[:12] + HEADER + struct.pack(">I", zlib.crc32(HEADER)) + SMALL[33:]


@pytest.mark.parametrize(
    ("image", "message"),
    [
        ("lost.png", ".uri: {folder}/lost.png does not exist"),
        ("data:image/png;base64,####", " is not an image that can be read"),
        ("data:,no image", " is not an image that can be read"),
        (
            "http://x/a.png",
            f".uri: 'http://x/a.png' {OUTSIDE}",
        ),
        (HUGE, " is not an image that can be read"),
    ],
    ids=lambda value: str(value)[:20],
)
def test_an_image_that_cannot_be_had_leaves_white(tmp_path: Path, image: bytes | str, message: str) -> None:
    path = glb(tmp_path / "a.glb", [image])
    with pytest.warns(InputWarning) as told:
        scene = load(path)
    assert messages(told) == [f"{path}: a texture is left out: images[0]{message.format(folder=tmp_path)}"]
    assert scene.objects[0].material.texture is None
    assert (scene.objects[0].mesh.colors == 255).all()


def test_a_texture_that_is_not_there(tmp_path: Path) -> None:
    path = glb(tmp_path / "a.glb", [png(pixels_of(4, 4))], index=7)
    with pytest.raises(InputError, match="index is 7, but there are 1 textures, numbered from 0"):
        load(path)


# ---- other ways ----


def test_an_obj_with_two_textures_and_a_color(tmp_path: Path) -> None:
    for name in ("wood", "bark"):
        Image.fromarray(pixels_of(4, 4, ord(name[0]))).save(tmp_path / f"{name}.png")
    (tmp_path / "m.mtl").write_text(
        "newmtl a\nmap_Kd wood.png\nnewmtl b\nmap_Kd -clamp on bark.png\nnewmtl c\nKd 1 0 0\n"
    )
    (tmp_path / "a.obj").write_text(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "usemtl a\nf 1/1 2/2 3/3\nf 1/2 3/3 4/4\nusemtl b\nf 1/1 2/2 4/4\nusemtl c\nf 2 3 4\n"
    )
    plain, wood, bark = read_model(tmp_path / "a.obj")
    assert [part.mesh.triangles for part in (plain, wood, bark)] == [1, 2, 1]
    assert (plain.material, wood.material["texture"].wrap, bark.material["texture"].wrap) == ({}, "repeat", "clamp")
    # corners have their own coordinates, of which v is upward in the file
    assert np.asarray(wood.mesh.uvs)[wood.mesh.faces].tolist() == [[[0, 1], [1, 1], [1, 0]], [[1, 1], [1, 0], [0, 0]]]
    assert (len(wood.mesh.positions), (wood.mesh.colors == 255).all()) == (5, True)
    with pytest.warns(InputWarning, match=TEXTURED):
        assert read_mesh(tmp_path / "a.obj").triangles == 4


def textured() -> Object:
    mesh = Mesh(SQUARE, FACES.reshape(-1, 3), "white", uvs=UVS)
    return Object(mesh, material=Material(texture=Texture(pixels_of(6, 5), "nearest")))


def test_a_texture_by_its_path_in_a_scene_file(tmp_path: Path) -> None:
    pixels = pixels_of(3, 3)
    Image.fromarray(pixels).save(tmp_path / "wood.png")
    mesh = f"{{ positions = {SQUARE.tolist()}, faces = {FACES.reshape(-1, 3).tolist()}, uvs = {UVS.tolist()} }}"

    def loaded(texture: str) -> Texture:
        (tmp_path / "scene.toml").write_text(f"[[objects]]\nmesh = {mesh}\nmaterial = {{ texture = {texture} }}\n")
        return texture_of(load(tmp_path / "scene.toml"))

    assert loaded('"wood.png"') == Texture(pixels)
    keys = '{ image = "wood.png", filter = "nearest", wrap = "clamp" }'
    assert loaded(keys) == Texture(pixels, "nearest", "clamp")
    with pytest.raises(InputError, match=r"objects\[0\]\.material\.texture: .*lost\.png does not exist"):
        loaded('"lost.png"')
    with pytest.raises(InputError, match="1 x 1 pixels need 3 bytes, not 2"):
        loaded('{ width = 1, height = 1, pixels = "AAA=" }')


def test_a_texture_of_trimesh(tmp_path: Path) -> None:
    pixels = pixels_of(8, 8)
    path = glb(tmp_path / "a.glb", [png(pixels)])
    mesh: Any = trimesh.load(path, force="mesh")
    ours, theirs = load(path), load(mesh)
    assert texture_of(theirs) == texture_of(ours)
    assert shackled.render(theirs, 48).pixels.tolist() == shackled.render(ours, 48).pixels.tolist()


def test_one_color_for_all_is_without_texture() -> None:
    scene = load([textured()], color="tomato")
    assert scene.objects[0].material.texture is None


def test_simplified_meshes_keep_seams() -> None:
    """A tube of which the texture goes around: no triangle may span the image from its end back to its beginning."""
    column, row, faces = sheet(32, 16)
    turns = 2 * np.pi * (column % 32) / 32
    positions = np.stack([np.cos(turns), row / 8, np.sin(turns)], axis=1)
    mesh = simplify(Mesh(positions, faces, uvs=np.stack([column / 32, row / 16], axis=1)), 200)
    assert mesh.triangles <= 200
    assert mesh.uvs is not None
    corners = mesh.uvs[mesh.faces]
    assert np.ptp(corners[:, :, 0], axis=1).max() < 0.5
    # and they are where they were
    u = np.arctan2(mesh.positions[:, 2], mesh.positions[:, 0]) / (2 * np.pi) % 1
    off = np.abs(u - mesh.uvs[:, 0])
    assert np.minimum(off, 1 - off).max() < 0.05


@pytest.mark.parametrize(
    ("pixels", "message"),
    [
        (np.zeros((3, 3)), "must be of shape"),
        (np.zeros((3, 3, 4)), "must be of shape"),
        (np.zeros((257, 3, 3)), "from 1 to 256 texels along each side, not 3 x 257"),
        (np.zeros((0, 3, 3)), "from 1 to 256 texels"),
        (np.full((3, 3, 3), 0.5), "whole numbers from 0 to 255"),
        (np.full((3, 3, 3), 256), "whole numbers from 0 to 255"),
    ],
)
def test_pixels_that_are_none(pixels: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Texture(pixels)


def test_what_a_texture_needs() -> None:
    with pytest.raises(InputError, match="needs a mesh with uvs"):
        Object(Mesh(SQUARE, FACES.reshape(-1, 3)), material=Material(texture=Texture(pixels_of(2, 2))))
    with pytest.raises(InputError, match="finite texture coordinates for each of its 4 vertices, not 3"):
        Mesh(SQUARE, FACES.reshape(-1, 3), uvs=UVS[:3])
    with pytest.raises(InputError, match="finite texture coordinates"):
        Mesh(SQUARE, FACES.reshape(-1, 3), uvs=UVS * np.nan)
    with pytest.raises(InputError, match=r"must be a shackled\.Texture"):
        Material(texture=5)  # type: ignore[arg-type]
    out = evolve(textured(), mesh=evolve(textured().mesh, uvs=UVS * 128))
    with pytest.raises(InputError, match=r"must be from -128 to below 128, not \(0, 128\)"):
        render_call(Scene([out]))


@pytest.mark.parametrize("place", range(8))
def test_packed_bytes_that_are_wrong(place: int) -> None:
    data = bytearray(100)
    data[place] = 255
    with pytest.raises(InputError, match="a packed texture"):
        unpack_texture(bytes(data), 4)


# ---- samples ----

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


def checker() -> Image.Image:
    """Red and green above, blue and white below."""
    image = Image.new("RGB", (2, 2))
    for place, color in zip([(0, 0), (1, 0), (0, 1), (1, 1)], [RED, GREEN, BLUE, WHITE], strict=True):
        image.putpixel(place, color)
    return image


@pytest.mark.parametrize(
    ("coordinates", "expected"),
    [
        ([[0, 1], [1, 1], [0, 0], [1, 0]], [RED, GREEN, BLUE, WHITE]),
        # between texels, and beyond the borders, where the image repeats
        ([[0.5, 1], [0.5, 0.5]], [(128, 128, 0), (128, 128, 128)]),
        ([[1.75, 1.75], [-1, 3]], [GREEN, BLUE]),
        ([[float("nan"), float("inf")]], [BLUE]),
    ],
)
def test_samples(coordinates: list[list[float]], expected: list[tuple[int, ...]]) -> None:
    assert sample(checker(), coordinates).tolist() == [list(color) for color in expected]
