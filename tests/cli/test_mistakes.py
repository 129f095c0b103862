"""Wrong usage and bad input: exit code 2, one line that says what is wrong, and nothing is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from commands import Shackled

LONG = "n" * 300
NOBODY = "http://127.0.0.1:1"

MISTAKES = {
    "--bogus": "--bogus",
    "draw shape.obj": "draw",
    # inputs
    "render": "INPUT",
    "render missing.obj": "missing.obj does not exist",
    "render folder.obj": "folder.obj",
    "render empty.obj": "empty.obj",
    "render binary.obj": "binary.obj",
    "render shape.xyz": "shape.xyz",
    "render more/none": "the folder more/none has no mesh files in it, .obj .ply .stl .glb .gltf .off",
    "render - -": "-, standard input, is one file: give it once",
    "gas missing.obj": "missing.obj does not exist",
    # outputs
    "render shape.obj -o a.tiff": "must end in one of .png .bmp .svg .gif",
    "render shape.obj -o missing/a.png": "the folder missing",
    f"render shape.obj --turntable 2 -o {LONG}.gif": "cannot be written: File name too long",
    f"export shape.obj -o {LONG}.html": "cannot be written: File name too long",
    f"stages shape.obj --size 8 -o {LONG}": "cannot be written: File name too long",
    f"bench deploy -o {LONG}": "cannot be written: File name too long",
    "render shape.obj --turntable 3 -o a.svg": "must end in .gif .png .webp or .mp4, or be a folder",
    "render shape.obj --turntable 3 -o missing/a.gif": "the folder missing of the animation a.gif does not exist",
    "render shape.obj --turntable 3 -o file": "file is a file, not a folder to write to",
    "render shape.obj -o a.bmp --scene": "--scene needs a .png file, not a.bmp",
    # several inputs
    "render shape.obj more/shape.obj": "the picture of more/shape.obj would overwrite that of shape.obj: shape.png",
    "render shape.obj shape.obj -o out/": "would overwrite that of shape.obj: out/shape.png",
    "render shape.obj cube -o one.png": "2 inputs need more than one file: give -o a folder, such as",
    "render shape.obj cube -o frames/ --turntable 2": "give -o a pattern, such as out/{stem}",
    "render shape.obj cube -o {stem}.tiff": "must end in one of .png",
    "render shape.obj cube -o -": "standard output takes one picture, not 2",
    "render shape.obj kept.png -o {stem}.png": "would overwrite the input kept.png",
    "render shape.obj cube -o shape.obj/{stem}.png": "shape.obj",
    # the look: what the library refuses is told with the names of options
    "render shape.obj --size 0": "from 1 to 2048 pixels a side",
    "render shape.obj --size 100x0": "from 1 to 2048 pixels a side",
    "render shape.obj --size 3000": "from 1 to 2048 pixels a side",
    "render shape.obj --size big": "WIDTHxHEIGHT",
    "render shape.obj --size -5": "--size",
    "render shape.obj --rotate 1,2": "--rotate must be three numbers",
    "render shape.obj --eye a,b,c": "--eye must be three numbers",
    "render shape.obj --fov 180": "--fov must be a finite number from 0.2 to 179.8",
    "render shape.obj --fov wide": "--fov",
    "gas shape.obj --fov 40 --half-height 1": "--fov and --half-height exclude each other: give one of them",
    "render shape.obj --ambient-light dim": "--ambient-light must be red, green and blue",
    "gas shape.obj --light lamp:1,2,3": "--light must be directional:x,y,z",
    "render shape.obj --light point:1,2,3:reddish": "#rrggbb",
    "render shape.obj --light spot:1,2,3": "spot:position:direction:angle",
    "render shape.obj --light spot:1,2,3:0,0,1:wide": "--light spot needs its outer angle in degrees",
    "render shape.obj --light spot:1,2,3:0,0,1:1,2,3": "--light spot needs its outer angle in degrees",
    "render shape.obj --light spot:1,2,3:0,0,1:200": "from 0 to 180",
    "render shape.obj --ambient -1": "ambient",
    "render shape.obj --background red,red,red": "--background must be one colour or two, #rrggbb,#rrggbb, not",
    "render shape.obj --hemisphere red,red,red": "--hemisphere must be one colour or two, #rrggbb,#rrggbb, not",
    "render shape.obj --fog red,1": "--fog must be a colour, or #rrggbb,near,far, not 'red,1'",
    "render shape.obj --fog red,1,x": "--fog must be a colour, or #rrggbb,near,far, not 'red,1,x'",
    # animations
    "render shape.obj --turntable 3 --duration 5": "the duration of a frame in milliseconds must be",
    "render shape.obj --duration 50": "--duration needs --turntable",
    "render shape.obj --frames 3 --turntable 3": "--turntable and --frames exclude each other: give one of them",
    "render shape.obj --frames 3 --fit call": "--fit and --frames exclude each other: give one of them",
    "render shape.obj --frames 3 -o a.bmp": "the animation a.bmp must end in .gif .png .webp or .mp4, or be a folder",
    "render shape.obj --transparent -o a.bmp": " file: .bmp has no alpha channel",
    "render shape.obj --transparent --turntable 3": " file: .gif has no alpha channel",
    "render shape.obj --transparent --turntable 3 --one-call -o a.png": "--transparent and --one-call exclude each",
    "render shape.obj --frames 3 --one-call": "--one-call needs --turntable",
    "render shape.obj --turntable 5 --one-call --tile 8": "has no tiles: leave out --tile or --one-call",
    "render shape.obj --turntable 5 --one-call --jobs 2": "an EVM that runs the contracts, or a node; not several",
    "render shape.obj --turntable 5 --one-call --scene -o a.png": "--scene and --one-call exclude each other",
    # where, and in which parts
    "render shape.obj --fit call --tile 64": "--fit and --tile exclude each other: give one of them",
    "render shape.obj --fit call --gas-limit 100": "--fit and --gas-limit exclude each other: give one of them",
    "render shape.obj --fit call --turntable 4": "--fit and --turntable exclude each other: give one of them",
    "render shape.obj --tile 0": "the sides of a --tile must be whole numbers from 1",
    "render shape.obj --tile 4x": "--tile must be a side such as 128 or WIDTHxHEIGHT",
    "render shape.obj --evm moon": "--evm must be one of revm, pyrevm, pyevm, not 'moon'",
    f"render shape.obj --evm {NOBODY}": f"--evm is the name of an EVM: give --rpc for the node '{NOBODY}'",
    f"render shape.obj --rpc {NOBODY} --evm revm": "--rpc and --evm exclude each other",
    f"render shape.obj --rpc {NOBODY} --cluster local": "--rpc and --cluster exclude each other",
    "render shape.obj --rpc-timeout 5": "--rpc-timeout needs --rpc",
    "render shape.obj --verify all": "--verify needs --rpc or --cluster",
    # gas
    f"gas shape.obj --address 0x{'5' * 40}": "--address needs --rpc",
    "gas shape.obj --rpc-timeout 5": "--rpc-timeout needs --rpc",
    "gas shape.obj --profile flame.png": "an .svg file",
    "gas shape.obj --profile nowhere/flame.svg": "does not exist",
    "gas shape.obj --profile folder.svg": "is a folder",
    "gas shape.obj --profile flame.svg --no-stages": "--no-stages and --profile exclude",
    "gas shape.obj --opcodes --no-stages": "--no-stages and --opcodes exclude",
    "gas shape.obj --gas-price -1": "--gas-price",
    "gas shape.obj --eth-price nan": "--eth-price",
    # others
    "genesis": "Missing argument 'SEED...'",
    "genesis 1024": "a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to 1023, not '1024'",
    "genesis 3 4 -o a.png": "--output needs exactly one SEED, not 2",
    "genesis 3 -o a.txt": "the picture a.txt must end in one of .png .bmp",
    "datasets list icon": "the dataset must be one of common, icons, genesis, not 'icon'",
    "datasets gallery -o g.gif": "the gallery g.gif must end in .html or .png",
    "datasets gallery -o missing/g.png": "the folder missing of the gallery g.png does not exist",
    "datasets fetch bal": "there is no model 'bal' to fetch; there are bunny, dragon,",
    "datasets fetch bunny cow --from x.obj": "--from needs exactly one NAME",
    "bench canvass -o x": "an experiment must be one of canvas, triangles, genesis, culling, deploy, linear, not",
    "bench canvas": "the experiments need an output folder: -o DIR",
    "bench canvas -o file": "file is a file, not a folder to write to",
    "info gone.ply": "gone.ply does not exist",
}


@pytest.fixture(scope="module")
def crowded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with files of all kinds: as nothing is written there, all mistakes can be made in it."""
    folder = tmp_path_factory.mktemp("crowded")
    for name in ("folder.obj", "folder.svg", "more/none"):
        (folder / name).mkdir(parents=True)
    mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    texts = {"shape.obj": mesh, "more/shape.obj": mesh, "empty.obj": "", "shape.xyz": "1 2 3", "file": ""}
    for name, text in texts.items():
        (folder / name).write_text(text)
    (folder / "binary.obj").write_bytes(bytes(range(256)) * 20)
    (folder / "kept.png").write_bytes(b"kept")
    return folder


@pytest.mark.parametrize(("words", "message"), MISTAKES.items(), ids=[words[:80] for words in MISTAKES])
def test_mistakes(words: str, message: str, crowded: Path, shackled: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(crowded)
    before = {path: path.stat().st_mtime_ns for path in crowded.rglob("*")}
    said = shackled(words, expect=2)
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert said.err.startswith("shackled: ")
    assert message in said.err
    assert {path: path.stat().st_mtime_ns for path in crowded.rglob("*")} == before


def test_characters_that_steer_a_terminal_are_not_sent_to_it(shackled: Shackled) -> None:
    assert shackled("render", "a\x1b[31m.obj", expect=2).err == "shackled: a?[31m.obj does not exist\n"
