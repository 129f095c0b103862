"""OBJ files with the habits and the faults of real exporters: what is loaded of each, and what is told."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal
from unittest.mock import Mock

import numpy as np
import pytest
from PIL import Image

from shackled.errors import InputWarning
from shackled.scene._files.beside import OUTSIDE
from shackled.scene._files.mesh_file import read_model
from shackled.scene._mesh import DEFAULT_COLOR
from shackled.scene._texture import Texture

RED, BLUE, GREY, WHITE = (255, 0, 0), (0, 0, 255), DEFAULT_COLOR, (255, 255, 255)
CORNERS = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
PLACES = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
#: Two triangles of a square, each of a material.
PAIR = f"mtllib m.mtl\n{CORNERS}usemtl {{}}\nf 1 2 3\nusemtl {{}}\nf 1 3 4\n"
#: A material, and a square, with a texture.
WOODEN = "newmtl a\nmap_Kd wood.png\n"
BOARD = f"mtllib m.mtl\n{CORNERS}{PLACES}usemtl a\nf 1/1 2/2 3/3 4/4\n"


@dataclass(frozen=True)
class Case:
    """The texts of an OBJ file and its materials, names of images, which are WOOD, and what is right.

    colors: of the first corner of each triangle that has an area, in the order of the parts; WHITE for a texture.
    uvs, wrap: of the texture; those of the first corner of the first triangle, and of its third. opacities, emissions:
    of the parts. notes: what follows the path.
    """

    obj: str
    mtl: str = ""
    images: tuple[str, ...] = ()
    mtl_name: str = "m.mtl"
    colors: tuple[tuple[int, int, int], ...] = (RED, BLUE)
    uvs: tuple[tuple[float, float], tuple[float, float]] = ((0, 1), (1, 0))
    wrap: Literal["repeat", "clamp"] = "repeat"
    opacities: tuple[float, ...] = (1.0,)
    emissions: tuple[tuple[int, int, int], ...] | None = None
    notes: tuple[str, ...] = ()


def pair(one: str, other: str, mtl_one: str = "", mtl_other: str = "") -> Case:
    """Two materials, red and blue, by their names in both files."""
    mtl = f"newmtl {mtl_one or one}\nKd 1 0 0\nnewmtl {mtl_other or other}\nKd 0 0 1\n"
    return Case(PAIR.format(one, other), mtl)


def red_and_blue(one: str, other: str, before: str = "", **more: Any) -> Case:
    """Two materials with other statements behind their colours."""
    return Case(PAIR.format("a", "b"), f"{before}newmtl a\nKd 1 0 0\n{one}\nnewmtl b\nKd 0 0 1\n{other}\n", **more)


def board(statements: str, image: str = "wood.png", **more: Any) -> Case:
    return Case(BOARD, f"newmtl a\n{statements}\n", (image,), colors=(WHITE, WHITE), **more)


def grey(obj: str, *notes: str) -> Case:
    return Case(obj, colors=(GREY, GREY), notes=notes)


NO_TEXTURE = "corners with texture coordinates (vt) that do not exist or are not finite, first in line"
COMPUTED = "that do not exist or are not finite, first in line"
CASES = {
    # names
    "number signs in names": pair("Mat #1", "Mat #2"),
    "a comment behind a name": pair("warm # the first", "cold #", "warm", "cold"),
    "quotes in one of the files": pair('"warm one"', "cold", "warm one", '"cold"'),
    "backslashes in names": pair("A\\B\\red", "b\\"),
    "a comment ends with a backslash": Case("# made of C:\\a\\\n" + PAIR.format("a", "b"), pair("a", "b").mtl),
    "words of the Windows code page": pair("Stra\u00dfe", "Stra\u00fce"),
    "a name with quotes of a material file": Case(
        PAIR.format("a", "b").replace("m.mtl", '"my lib.mtl"'), pair("a", "b").mtl, mtl_name="my lib.mtl"
    ),
    "a material file in a folder": Case(
        BOARD.replace("m.mtl", "sub\\M.mtl"), WOODEN, ("Sub/wood.png",), "Sub/m.mtl", colors=(WHITE, WHITE)
    ),
    "two files of the folder of the author": Case(
        PAIR.format("a", "b").replace("m.mtl", "/some place/lost.mtl '/some place/My One.mtl'"),
        pair("a", "b").mtl,
        mtl_name="my one.mtl",
        notes=(f"its materials are left out: '/some place/lost.mtl' {OUTSIDE}",),
    ),
    "a material that is in no file": Case(
        PAIR.format("a", "lost"), "newmtl a\nKd 1 0 0\n", colors=(RED, GREY),
        notes=("1 material that no material file has, drawn in light grey: 'lost'",),
    ),
    # images
    "an image with quotes": board('map_Kd "my wood.png"', "my wood.png"),
    "an absolute path of Windows": board("map_Kd D:\\work\\Wood.png"),
    "a tab in a path": board("map_Kd tex\\t.png", "tex/t.png"),
    "the folder of the OBJ": Case(
        BOARD.replace("m.mtl", "sub/m.mtl"), WOODEN, ("wood.png",), "sub/m.mtl", colors=(WHITE, WHITE)
    ),
    "ambient only": board("map_Ka wood.png"),
    "diffuse before ambient": board("map_Ka other.png\nmap_Kd wood.png\nmap_Ka other.png"),
    # options: v of files is upward, so that 1 - (0.25 + 3 v)
    "scale and offset": board("map_Kd -s 2 3 1 -o 0.5 .25 0 wood.png", uvs=((0.5, 0.75), (2.5, -2.25))),
    "scale of one number": board("map_Kd -s 2 wood.png", uvs=((0, 1), (2, 0))),
    "options behind the name": board("map_Kd my wood.png -s 2 2 1 -clamp on", "my wood.png", wrap="clamp",
                                     uvs=((0, 1), (2, -1))),
    "options before a name with spaces": board("map_Kd -blendu on -blendv off -cc off -clamp ON -bm 0.5 -mm 0 1"
        " -boost 2 -imfchan r -texres 512 -type sphere -o 0 0 0 2 my wood.png", "2 my wood.png", wrap="clamp"),
    "options that are not drawn": board(
        "map_Kd -mm 0.5 2 -t 0 0 0 wood.png", notes=("1 -mm statement of its materials left out",)
    ),
    "a name like an option": board("map_Kd my -s.png", "my -s.png"),
    "other images": board(
        "map_Kd wood.png\nmap_Bump -bm 1 wood.png\nnorm wood.png\nKe 1 1 1\nmap_Ke wood.png",
        notes=tuple(
            f"1 {each} statement of its materials left out" for each in ("map_Bump", "map_Ke", "norm")
        ),
    ),
    "without coordinates": Case(
        PAIR.format("a", "b"), "newmtl a\nKd 1 0 0\nmap_Kd wood.png\nnewmtl b\nKd 0 0 1\n", ("wood.png",),
        notes=("1 triangle without usable texture coordinates drawn without texture",),
    ),
    "coordinates far outside": Case(
        BOARD.replace("vt 1 0\n", "vt 1e5 0\n") + "v 2 0 0\nvt 1e300 0\nf 1/1 5/5 3/3\nf 2/1 5/1 3/3\n",
        "newmtl a\nKd 1 0 0\nmap_Kd wood.png\n",
        ("wood.png",),
        colors=(RED, RED, WHITE, WHITE),
        uvs=((0, 1), (0, 0)),
        opacities=(1.0, 1.0),
        notes=("2 triangles without usable texture coordinates drawn without texture",),
    ),
    "a texture before colours of vertices": Case(
        BOARD.replace("v 0 0 0", "v 0 0 0 1 0 0"), WOODEN + "Kd 0 0 1", ("wood.png",), colors=(WHITE, WHITE),
        notes=("2 triangles drawn in the colours of a texture, not in their own",),
    ),
    "a texture on white vertices": Case(
        BOARD.replace(CORNERS, CORNERS.replace(" 0\n", " 0 1 1 1\n")), WOODEN, ("wood.png",), colors=(WHITE, WHITE)
    ),
    "no material file": grey(
        PAIR.format("a", "b").replace("mtllib m.mtl\n", ""),
        "2 materials left out, for no line mtllib names their file: 'a', 'b'",
    ),
    # opacity and emission
    "both say opaque": red_and_blue("d 1.0\nTr 1.0", "Tr 1\nd 1"),
    "opacities": red_and_blue("Tr 0.75", "d -halo 0.5", opacities=(0.25, 0.5)),
    "MeshLab writes an opacity as Tr": red_and_blue(
        "Tr 1.0", "Tr 0.25", "# Converted by Meshlab Group\n\n", opacities=(1.0, 0.25)
    ),
    "not to be seen": red_and_blue(
        "d 1", "d 0", opacities=(1.0, 0.0), notes=("1 material with an opacity of 0, of which nothing is visible",)
    ),
    "a lamp": red_and_blue("Ke 0 0 0", "Ke 2 0.5 0", opacities=(1.0, 1.0), emissions=((0, 0, 0), (255, 128, 0))),
    "numbers that are none": red_and_blue(
        "d x\nKe nan 0 0", "Tr 1.#IND\nd 1",
        notes=tuple(f"1 {each} statement of its materials left out" for each in ("Ke", "d", "Tr")),
    ),
    "colours far outside": red_and_blue("Kd 1e308 -1e308 -7", "Kd 0 0 1 1"),
    "one number for grey": red_and_blue("Kd 0.2", "", colors=((51,) * 3, BLUE)),
    # bad numbers
    "normals that are none": grey(
        CORNERS + "vn -1.#IND -1.#QNAN0 1.#INF # none\nvn nan -nan(ind) inf\nf 1//1 2//2 3//1\nf 1 3 4\n",
        f"3 corners with normals (vn) {COMPUTED} 7; the face has computed ones",
    ),
    "normals out of range": grey(
        CORNERS + "vn 0 0 1\nf 1//1 2//2 3//-7 4//0\n",
        f"3 corners with normals (vn) {COMPUTED} 6; the face has computed ones",
    ),
    "coordinates out of range": Case(
        BOARD.replace("vt 1 0\n", "vt nan 0\n").replace("4/4", "4/5"), "newmtl a\nKd 1 0 0\nmap_Kd wood.png\n",
        ("wood.png",),
        colors=(RED, RED),
        notes=(
            f"2 {NO_TEXTURE} 11; the face has no texture",
            "2 triangles without usable texture coordinates drawn without texture",
        ),
    ),
    "faces of vertices that are none": grey(
        CORNERS + "v nan 0 0\nv 1.#INF 0 0\nf 1 2 5\nf 1 2 3\nf 4 5 6\nf 1 3 4\n",
        "2 faces left out, with coordinates that are not finite numbers",
    ),
    "a vertex that is none, and of no face": grey(CORNERS + "v nan 0 0\nf 1 2 3 4\n"),
    "colours that are none": Case(
        "v 0 0 0 1 nan 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\nf 4 1 3\n",
        colors=(GREY, BLUE),
        notes=("1 colour of vertices left out, not finite numbers",),
    ),
    # other statements
    "polypaint": Case(CORNERS + "#MRGB ffff0000ffff0000\n#MRGB 00ff0000ff0000ff\nf 1 2 3\nf 4 1 3\n"),
    "comments like polypaint": grey(CORNERS + "#MRGB is what others write\nf 1 2 3 4\n"),
    "points, lines and the rest": grey(
        CORNERS + "p 1 2\nf 1 2 3\nl 1 2 3\nl 1 3\nf 1 3\ncurv 0 1 1 2\ncurv 0 1 2 3\nf 1 3 4\nvp 0.5\n",
        "2 points, 2 lines, 1 incomplete face, 2 curves left out; only faces are drawn",
        "statement 'vp' (1) left out; only faces are drawn",
    ),
    "some faces without an area": grey(CORNERS + "v 0.5 0 0\nf 1 2 3\nf 1 5 2\nf 1 5 2 1\nf 1 3 4\n"),
    "a corner along an edge": grey(CORNERS + "v 0.5 0 0\nf 1 5 2 3 4\n"),
}  # fmt: skip

#: Of wood: all four texels differ, and no two rows nor columns are alike.
WOOD = np.array([[[200, 10, 20], [30, 40, 50]], [[60, 70, 80], [90, 100, 110]]], dtype=np.uint8)


def build(folder: Path, case: Case) -> Path:
    encoding = "cp1252" if "\u00df" in case.obj else "utf-8"
    for image in case.images:
        (folder / image).parent.mkdir(exist_ok=True)
        Image.fromarray(WOOD).save(folder / image)
    if case.mtl:
        (folder / case.mtl_name).parent.mkdir(exist_ok=True)
        (folder / case.mtl_name).write_text(case.mtl, encoding=encoding)
    (folder / "a.obj").write_text(case.obj, encoding=encoding)
    return folder / "a.obj"


@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("always")
def test_what_is_loaded_and_told(name: str, tmp_path: Path, recwarn: pytest.WarningsRecorder) -> None:
    case = CASES[name]
    path = build(tmp_path, case)
    parts = read_model(path)
    assert [str(each.message) for each in recwarn] == [f"{path}: {note}" for note in case.notes]
    triangles = [triangle for part in parts for triangle in part.mesh.colors[part.mesh.faces].tolist()]
    points = [triangle for part in parts for triangle in part.mesh.positions[part.mesh.faces].tolist()]
    areas = [np.cross(np.subtract(b, a), np.subtract(c, a)).any() for a, b, c in points]
    seen = [tuple(triangle[0]) for triangle, has_area in zip(triangles, areas, strict=True) if has_area]
    assert seen == list(case.colors)
    assert tuple(part.opacity for part in parts) == case.opacities
    emissions = tuple(part.material.get("emission", (0, 0, 0)) for part in parts)
    assert emissions == (case.emissions or ((0, 0, 0),) * len(parts))
    textures = [part.material.get("texture") for part in parts]
    wood = Texture(WOOD, wrap=case.wrap)
    assert textures == [wood if (part.mesh.colors == 255).all() else None for part in parts]
    mesh = parts[-1].mesh
    if textures[-1] is None:
        return
    assert mesh.uvs is not None
    np.testing.assert_allclose(mesh.uvs[mesh.faces][0, [0, 2]], case.uvs, atol=1e-12)


GRADED, BINARY = [[10, 200], [90, 255]], [[0, 255], [255, 255]]


@pytest.mark.parametrize(("levels", "cutoff"), [(GRADED, 0), (BINARY, 128)])
@pytest.mark.parametrize("mode", ["L", "RGBA"])
@pytest.mark.parametrize("image", ["map_Kd wood.png\n", ""])
def test_the_alpha_of_map_d(tmp_path: Path, levels: list[list[int]], cutoff: int, mode: str, image: str) -> None:
    """Of a grey image, or the alpha of one that has it; with an image or without."""
    grey = Image.fromarray(np.array(levels, dtype=np.uint8))
    whole = grey
    if mode == "RGBA":
        whole = Image.new("RGBA", (2, 2), "navy")
        whole.putalpha(grey)
    whole.save(tmp_path / "mask.png")
    path = build(tmp_path, Case(BOARD, f"newmtl a\nKd 1 0 0\n{image}map_d mask.png\n", ("wood.png",)))
    (part,) = read_model(path)
    texture = part.material["texture"]
    assert texture.alpha.tolist() == levels
    assert texture.cutoff == cutoff
    visible = texture.alpha > 0
    assert (texture.pixels[visible] == (WOOD[visible] if image else 255)).all()
    assert part.mesh.colors.tolist() == [[255] * 3 if image else list(RED)] * 4


def test_the_normals_of_corners_that_have_none_are_computed(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(CORNERS + "vn 0.6 0 0.8\nf 1//1 2//9 3//1 4//1\n")
    with pytest.warns(InputWarning, match="1 corner with normals"):
        (part,) = read_model(path)
    normals = {tuple(p): tuple(n) for p, n in zip(part.mesh.positions.tolist(), part.mesh.normals, strict=True)}  # type: ignore[arg-type]
    given = (0.6, 0.0, 0.8)
    assert normals == {(0, 0, 0): given, (1, 0, 0): (0, 0, 1), (1, 1, 0): given, (0, 1, 0): given}


def test_one_image_of_several_materials_is_read_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    materials = "newmtl a\nmap_Kd -s 2 2 1 wood.png\nnewmtl b\nmap_Kd wood.png\n"
    path = build(tmp_path, Case(BOARD + "usemtl b\nf 1/1 2/2 3/3\n", materials, ("wood.png",)))
    with monkeypatch.context() as patch:
        patch.setattr(Image, "open", watched := Mock(wraps=Image.open))
        (part,) = read_model(path)
    assert part.mesh.triangles == 3
    watched.assert_called_once_with(tmp_path / "wood.png")


# ---- images ----


def levels_of(levels: Sequence[float], mode: str) -> Callable[[], Image.Image]:
    kind = {"I;16": "<u2", "I;16L": "<u2", "I;16B": ">u2", "I": "<i4", "F": "<f4"}[mode]
    return lambda: Image.frombytes(mode, (len(levels), 1), np.array(levels, dtype=kind).tobytes())


#: By hand: CMYK is (255 - C) (255 - K) / 255; half of the lightness L of LAB is level 119 of sRGB; 16 bits
#: are divided by 256; a float up to 1 is a fraction, up to 255 a level, and beyond one of 65,535.
MODES: dict[str, tuple[Callable[[], Image.Image], list[tuple[int, int, int]]]] = {
    "LA": (lambda: Image.new("LA", (1, 1), (77, 10)), [(77, 77, 77)]),
    "RGBa": (lambda: Image.new("RGBa", (1, 1), (64, 32, 0, 128)), [(127, 63, 0)]),
    "CMYK": (lambda: Image.new("CMYK", (1, 1), (51, 102, 0, 51)), [(163, 122, 204)]),
    "LAB": (lambda: Image.new("LAB", (1, 1), (128, 128, 128)), [(119, 119, 119)]),
    **{
        mode: (levels_of([0, 255, 8192, 49152, 65535], mode), [(v,) * 3 for v in (0, 0, 32, 192, 255)])
        for mode in ("I;16", "I;16L", "I;16B")
    },
    "I": (levels_of([-5, 255, 8192, 49152, 65535, 99999], "I"), [(v,) * 3 for v in (0, 0, 32, 192, 255, 255)]),
    "F, fractions": (levels_of([0, 0.5, 1, float("nan")], "F"), [(v,) * 3 for v in (0, 127, 255, 0)]),
    "F, levels": (levels_of([-3, 0, 77, 255], "F"), [(v,) * 3 for v in (0, 0, 77, 255)]),
    "F, 16 bits": (levels_of([0, 8192, 65535], "F"), [(v,) * 3 for v in (0, 32, 255)]),
}  # fmt: skip


@pytest.mark.parametrize("mode", MODES)
def test_images_of_every_mode(mode: str) -> None:
    make, wanted = MODES[mode]
    image = make()
    assert image.mode == mode.partition(",")[0]
    found = Texture.open(image).pixels[0].astype(int)
    assert np.abs(found - wanted).max() <= (1 if mode in ("CMYK", "RGBa", "LAB") else 0), found.tolist()
