"""The scenes of the original, made anew, and the measurement of a contract with its interface."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from benchmarks import shared
from benchmarks.original import __main__ as harness
from benchmarks.original import recipe
from benchmarks.original.documents import call_data, document

from shackled import InputError
from shackled.bench._measure import call, cost
from shackled.bench._original import original
from shackled.chain._embedded import RevmChain
from shackled.ethereum._encoding import to_hex
from shackled.scene._files.original import original_scene

#: The interface of the original: a token that leaves the work to a library.
STAND_IN = """
pragma solidity >=0.8.9;
struct Lighting { bool on; int256 ambient; int256 diffuse; int256 specular; uint256 shininess;
    int256[3] position; int256[3] a; int256[3] b; int256[3] c; }
struct RenderParams { uint256[3][] faces; int256[3][] verts; int256[3][] cols; int256[3] objPosition; int256 objScale;
    int256[3][2] background; Lighting lighting; bool persp; bool cull; bool invert; bool wireframe; }
library Pixels {
    function made(int256 side) external pure returns (string memory) {
        uint256[] memory used = new uint256[](uint256(side * side));
        return used.length == 0 ? "" : "data:image/bmp;base64,";
    }
}
contract Shackled {
    function render(RenderParams memory given, int256 side, bool) external pure returns (string memory) {
        require(given.faces.length != 3, "three");
        return Pixels.made(side);
    }
}
"""
SOLC = pytest.mark.skipif(not harness.SOLC.is_dir(), reason="the compiler is not installed: npm ci in contracts/")
#: Every rounding of a background of one colour is the same.
SKY = [0, 0, 40]
FULL = shared.SHARED / "meshes" / "full"


# ---- the scenes ----


def test_scenes_are_those_that_were_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recipe, "SOURCES", {})
    found = {name: recipe.digest(scene) for name, scene in recipe.documents()}
    assert len(found) == 103
    assert found.items() <= recipe.digests().items()
    assert recipe.digests().keys() <= original().keys()


@pytest.mark.skipif(not FULL.is_dir(), reason=shared.MESHES_SKIPPED)
def test_models_are_those_that_were_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    there = {name: each for name, each in recipe.SOURCES.items() if (FULL / each.address.rpartition("/")[2]).is_file()}
    monkeypatch.setattr(recipe, "SOURCES", {name: there[name] for name in ("cow", "horse", "suzanne")})
    found = {name: recipe.digest(scene) for name, scene in recipe.documents(FULL)}
    assert found.items() <= recipe.digests().items()
    assert len(found) == 103 + 10


def test_the_digests_are_of_the_scenes_here() -> None:
    for name in recipe.digests() if shared.is_there() else ():
        path = shared.FOLDER / f"{name}.json"
        if path.exists():
            scene = json.loads(path.read_text("utf-8"))
            assert recipe.digest({key: scene[key] for key in document()}) == recipe.digests()[name]


def test_normals_are_weighted_by_angles() -> None:
    """A corner of a cube has the same normal however its sides are cut."""
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1], [1, 0, 1]], float)
    faces = np.array([[0, 2, 1], [0, 3, 2], [0, 4, 5], [0, 5, 3], [0, 1, 4], [4, 1, 6]])
    assert recipe.vertex_normals(positions, faces)[0] == pytest.approx(np.full(3, -(3**-0.5)))


def test_a_file_must_be_the_right_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file_of = recipe.file_of
    source = recipe.SOURCES["cow"]
    with pytest.raises(InputError, match="does not exist; it is https://"):
        recipe.file_of("cow", source, tmp_path)
    (tmp_path / "cow.obj").write_text("v 0 0 0\n")
    with pytest.raises(InputError, match="its checksum is git-blob:"):
        recipe.file_of("cow", source, tmp_path)
    # a port at which nobody listens, and a file that is there
    gone = replace(source, address="http://127.0.0.1:9/cow.obj")
    (tmp_path / "here.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n")
    monkeypatch.setattr(
        recipe, "file_of", lambda name, *_: file_of(name, gone, None) if name == "cow" else tmp_path / "here.obj"
    )
    monkeypatch.setattr(recipe, "SOURCES", {"cow": gone, "horse": source})
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr("sys.argv", ["recipe", str(tmp_path)])
    wrong = r"^the scenes of 1 of 2 models are left out: cow: http.*obj cannot be downloaded.*have: --from FOLDER$"
    with pytest.raises(InputError, match=wrong):
        recipe.main()
    assert (tmp_path / "scenes" / "obj_horse_cull.json").is_file()


# ---- the measurement ----


@pytest.fixture
def scenes(tmp_path: Path) -> Path:
    folder = tmp_path / "scenes"
    folder.mkdir()
    made = {
        "onetri_32": document(32, {}),
        "other": document(16, backgroundColor=[SKY, SKY]),
        "three": document(16, faces=[[0, 1, 2]] * 3),
    }
    for name, scene in made.items():
        (folder / f"{name}.json").write_text(json.dumps(scene))
    return folder


def rows(path: Path) -> dict[str, dict[str, str]]:
    lines = [line for line in path.read_text("utf-8").splitlines() if not line.startswith("#")]
    return {each["scene"]: each for each in csv.DictReader(lines)}


@SOLC
@pytest.mark.parametrize("kind", ["folder", "standard JSON", "of a block explorer"])
def test_sources_are_compiled_and_linked(
    kind: str, tmp_path: Path, scenes: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sources = tmp_path / "sources"
    sources.mkdir()
    (sources / "Token.sol").write_text(STAND_IN)
    if kind != "folder":
        text = json.dumps(harness.standard_input(sources))
        sources = tmp_path / "input.json"
        sources.write_text(text if kind == "standard JSON" else f"{{{text}}}")
    output = tmp_path / "original.csv"
    assert harness.main([str(sources), str(scenes), "onetri_32", "-o", str(output)]) == 0
    found = rows(output)
    assert found.keys() == original().keys()
    changed = found.pop("onetri_32")
    assert all(int(each["gas"]) == original()[name].gas for name, each in found.items())
    # what the other columns say is known; a word of memory for each pixel
    assert int(changed["lit_pixels"]) == original()["onetri_32"].lit_pixels
    assert 3 * 32 * 32 < int(changed["gas"]) < 100_000
    assert f"onetri_32: {int(changed['gas']):,} (recorded {original()['onetri_32'].gas:,})" in capsys.readouterr().out
    assert output.read_text("utf-8").startswith("# What the original")


@SOLC
def test_a_scene_that_fails_is_left_out(tmp_path: Path, scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "Token.sol").write_text(STAND_IN)
    output = tmp_path / "original.csv"
    assert harness.main([str(tmp_path), str(scenes), "three", "-o", str(output)]) == 1
    assert "three: the call ended with REVERT" in capsys.readouterr().err
    assert rows(output).keys() == original().keys()


def test_deployed_code_is_measured(tmp_path: Path, scenes: Path) -> None:
    """By this project's contract with the same interface, in the place of the original."""
    chain = RevmChain()
    address = chain.address("Original")
    codes = tmp_path / "codes.json"
    codes.write_text(json.dumps({to_hex(each): "0x" + code.hex() for each, code in chain.codes().items()}))
    output = tmp_path / "original.csv"
    arguments = [str(codes), str(scenes.parent), "other", "--at", to_hex(address), "-o", str(output)]
    assert harness.main(arguments) == 0
    scene, found = document(16, backgroundColor=[SKY, SKY]), rows(output)["other"]
    known = cost(original_scene(scene))
    assert int(found["gas"]) == call("Original", call_data(scene)).gas
    assert (int(found["drawn"]), int(found["lit_pixels"])) == (known.triangles, known.lit_pixels)


def test_culled_triangles_are_counted() -> None:
    assert harness.drawn(document()) == 1
    assert harness.drawn(document(faces=[[0, 2, 1], [0, 1, 2], [0, 0, 1]])) == 1
    assert harness.drawn(document(faces=[[0, 2, 1]], backfaceCulling=False)) == 1
    if shared.is_there():
        for name in ("obj_cow_cull", "genesis_007", "cornell_cull"):
            scene = json.loads((shared.FOLDER / f"{name}.json").read_text("utf-8"))
            assert harness.drawn(scene) == original()[name].drawn


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.json", "{}", "is no standard JSON input"),
        ("folder", "", "has no .sol files"),
        ("b.json", "{", "Expecting property name"),
    ],
)
def test_what_is_no_source_is_refused(name: str, text: str, message: str, tmp_path: Path, scenes: Path) -> None:
    path = tmp_path / name
    path.write_text(text) if text else path.mkdir()
    with pytest.raises(SystemExit, match=message):
        harness.main([str(path), str(scenes)])
