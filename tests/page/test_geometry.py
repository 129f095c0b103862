"""The geometry of the page is that of Python: normals, creases, winding and closedness, number by number."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from node_scripts import bundled, needs_web
from shackled.datasets import pieces
from shackled.errors import InputWarning
from shackled.scene import Mesh, Object, is_closed, weld
from shackled.scene._crease import creased
from shackled.scene._staging import signed_volume
from shackled.scene._winding import wound

FUNCTIONS = ("creased", "wound", "closed", "simplified")

Array = NDArray[np.float64]

pytestmark = needs_web


@pytest.fixture(scope="session")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The modules of the page that are tested here."""
    names = (f"scene/{name}" for name in ("normals", "weld", "winding", "simplify", "checked"))
    return bundled(tmp_path_factory.mktemp("geometry"), *names)


class Answers:
    """What the page answers for meshes, as numbers in the order of the questions: meshes begin with their sizes."""

    def __init__(self) -> None:
        self.asked: list[Any] = []
        self.numbers: Array = np.zeros(0)

    def ask(self, name: str, meshes: Sequence[Mesh], argument: float = 0) -> None:
        self.asked.append([FUNCTIONS.index(name), argument, len(meshes)])
        for mesh in meshes:
            tables = [mesh.positions, mesh.faces, mesh.rgba, mesh.normals, mesh.uvs]
            self.asked.append([len(mesh.positions), len(mesh.faces), *(each is not None for each in tables[3:])])
            self.asked += [np.asarray(each).ravel() for each in tables if each is not None]

    def run(self, bundle: Path, folder: Path) -> None:
        np.concatenate(self.asked).astype("<f8").tofile(folder / "asked")
        script = Path(__file__).with_name("geometry.mjs")
        subprocess.run(["node", script, bundle, folder / "asked", folder / "answers"], check=True)
        self.numbers = np.fromfile(folder / "answers", "<f8")

    def take(self, rows: int, width: int = 1) -> Array:
        found, self.numbers = np.split(self.numbers, [rows * width])
        return found.reshape(rows, width)

    def one(self) -> int:
        return int(self.take(1)[0, 0])

    def mesh(self) -> Mesh:
        vertices, faces, has_normals, has_uvs = (self.one() for _ in range(4))
        positions, corners, rgba = self.take(vertices, 3), self.take(faces, 3), self.take(vertices, 4)
        normals = self.take(vertices, 3) if has_normals else None
        return Mesh(positions, corners, rgba.astype(np.uint8), normals, self.take(vertices, 2) if has_uvs else None)


def random_mesh(rng: np.random.Generator) -> Mesh:
    """A mesh of any kind: open, closed, inside out, of several parts, with slivers and doubled vertices."""
    parts = []
    for _ in range(int(rng.integers(1, 5))):
        kind = int(rng.integers(4))
        if kind == 0:
            n = int(rng.integers(3, 12))
            positions, faces = rng.normal(size=(n, 3)).round(1), rng.integers(0, n, (int(rng.integers(1, 20)), 3))
            # not two on one another: the mean of their normals is what rounding left
            faces = faces[np.unique(np.sort(faces, axis=1), axis=0, return_index=True)[1]]
        else:
            positions, faces = ball(int(rng.integers(3, 8)), int(rng.integers(3, 9)))
            positions = positions * rng.uniform(0.2, 2, 3) + rng.integers(-2, 3, 3) * (kind > 1)
            if rng.random() < 0.4:
                faces = faces[rng.random(len(faces)) < 0.8]
            if rng.random() < 0.4:
                faces = faces[:, ::-1]
            if kind == 3:
                faces = np.where(rng.random(len(faces))[:, None] < 0.2, faces[:, ::-1], faces)
        parts.append(Mesh(positions, faces if len(faces) else [[0, 1, 2]]))
    positions = np.concatenate([part.positions for part in parts]) * 10.0 ** rng.uniform(-3, 3)
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    faces = np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)])
    colors = rng.integers(0, 3, (len(positions), 4)) * 127 if rng.random() < 0.5 else rng.integers(0, 255, 3)
    normals = rng.normal(size=positions.shape) if rng.random() < 0.4 else None
    uvs = rng.random((len(positions), 2)) if rng.random() < 0.3 else None
    return Mesh(positions, faces, colors.astype(np.uint8), normals, uvs)


def ball(rings: int, sides: int) -> tuple[Array, NDArray[np.int64]]:
    """A closed surface of revolution, whose vertices at the poles are one for each side."""
    up, around = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, sides, endpoint=False))
    positions = np.stack([np.sin(up) * np.cos(around), np.cos(up), np.sin(up) * np.sin(around)], axis=2).reshape(-1, 3)
    positions[np.abs(positions) < 1e-12] = 0
    a = (np.arange(sides)[:, None] * (rings + 1) + np.arange(rings)).ravel()
    b = (a + rings + 1) % (sides * (rings + 1))
    return positions, np.concatenate([np.stack([a, b, a + 1], axis=1), np.stack([b, b + 1, a + 1], axis=1)])


@pytest.mark.parametrize("kind", ["pieces", "random"])
def test_creases(bundle: Path, tmp_path: Path, kind: str) -> None:
    """Meshes get the normals that Python gives them."""
    rng, answers = np.random.default_rng(1), Answers()
    asked: list[tuple[Mesh, float | None]]
    if kind == "random":
        asked = [(random_mesh(rng), None if number % 2 else float(rng.integers(181))) for number in range(400)]
    else:
        chosen = [piece for piece in pieces() if piece.ready() and piece.dataset != "genesis"]
        chosen += [piece for piece in pieces() if piece.dataset == "genesis"][::50]
        meshes = [each.mesh for piece in chosen for each in piece.make().objects]
        asked = [(mesh, degrees) for mesh in meshes for degrees in (None, 30)]
    for mesh, degrees in asked:
        answers.ask("creased", [mesh], np.nan if degrees is None else degrees)
        answers.ask("closed", [mesh])
    answers.run(bundle, tmp_path)
    for mesh, degrees in asked:
        assert answers.mesh() == creased(mesh, degrees)
        # not by rounding only, as Python takes slivers and doubled sheets
        assert answers.one() == (is_closed(mesh) and signed_volume(mesh) > 1e-9 * np.ptp(mesh.positions) ** 3)


def test_winding(bundle: Path, tmp_path: Path) -> None:
    rng, answers, models = np.random.default_rng(2), Answers(), []
    for number in range(300):
        model = [random_mesh(rng) for _ in range(int(rng.integers(1, 4)))]
        if number % 10 == 0:
            # a hollow, and a closed part far from it, inside out
            (positions, faces), far = ball(8, 8), np.array([9, 0, 0])
            wall, other = Mesh(positions / 2, faces[:, ::-1]), Mesh(positions + far, faces[:, ::-1])
            model += [Mesh(positions, faces), wall, other]
        models.append(model)
        answers.ask("wound", model, number % 2)
    answers.run(bundle, tmp_path)
    turned = 0
    for number, model in enumerate(models):
        turned += (count := answers.one())
        with pytest.warns(InputWarning, match=f"{count} closed part") if count else nullcontext():
            expected = wound([Object(mesh) for mesh in model], "it", bool(number % 2))
        assert answers.one() == len(expected)
        for each in expected:
            assert answers.one() == each.cull
            assert answers.mesh() == each.mesh
    assert turned > 50


def test_fewer_triangles(bundle: Path, tmp_path: Path) -> None:
    """Meshes keep their shape and their colours, and stay closed."""
    (positions, faces), answers = ball(30, 40), Answers()
    halves = np.where(positions[faces[:, :1], 1:2] > 0.01, (255, 0, 0), (0, 0, 255))
    plain = Mesh(positions, faces, "tan")
    meshes = [plain, weld(positions, faces, np.repeat(halves, 3, axis=1)), creased(plain)]
    meshes.append(Mesh(positions, faces, "white", uvs=np.abs(positions[:, :2])))
    asked = [(mesh, count) for mesh in meshes for count in (900, 200, 60, 10_000)]
    for mesh, count in asked:
        answers.ask("simplified", [mesh], count)
    answers.run(bundle, tmp_path)
    for mesh, count in asked:
        found = answers.mesh()
        assert 0.8 * min(count, mesh.triangles) <= found.triangles <= count
        assert (found == mesh) == (count == 10_000)
        assert is_closed(found)
        assert signed_volume(found) > (0.9 if count > 60 else 0.75) * signed_volume(mesh)
        assert {*map(tuple, found.colors.tolist())} <= {*map(tuple, mesh.colors.tolist())}
        assert (found.uvs is None) == (mesh.uvs is None)
