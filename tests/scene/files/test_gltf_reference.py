"""glTF files of random contents, read by the package and by a reader written from the specification."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import gltf_reader
from mesh_files import CODES, TYPES, Gltf
from shackled.errors import InputWarning
from shackled.scene import read_mesh
from shackled.scene._mesh import DEFAULT_COLOR

Values = NDArray[Any]


class Writer(Gltf):
    """A document of two scenes, each of some trees of nodes; meshes are shown once, several times, or not at all."""

    def __init__(self, seed: int) -> None:
        super().__init__(materials=[{}, {"pbrMetallicRoughness": {"baseColorFactor": [0.25, 1.0, 0.5, 1.0]}}])
        self.random = np.random.default_rng(seed)
        self.with_normals = bool(self.chance(0.5))
        self.document["meshes"] = [
            {"primitives": [self.primitive() for _ in range(self.random.integers(1, 4))]} for _ in range(3)
        ]
        # at least one with triangles
        self.document["meshes"][0]["primitives"][0]["mode"] = 5
        self.nodes()
        self.document["extensionsUsed"] = self.document["extensionsRequired"] = ["KHR_mesh_quantization"]

    def chance(self, share: float) -> bool:
        return bool(self.random.random() < share)

    def nodes(self) -> None:
        count = 8
        nodes: list[dict[str, Any]] = [self.node() for _ in range(count)]
        roots: list[int] = []
        for number in range(count):
            if number < 2 or self.chance(0.3):
                roots.append(number)
            else:
                nodes[self.random.integers(number)].setdefault("children", []).append(number)
        nodes[0]["mesh"] = nodes[1]["mesh"] = 0
        self.document["nodes"] = nodes
        self.document["scenes"] = [{"nodes": roots[:1]}, {"nodes": roots[1:]}]
        self.document["scene"] = int(self.random.integers(2))

    def node(self) -> dict[str, Any]:
        """Scales differ by axis and may be negative: with turns above them they shear and mirror."""
        node: dict[str, Any] = {"mesh": int(self.random.integers(3))} if self.chance(0.7) else {}
        quaternion = self.random.normal(size=4)
        scale = self.random.uniform(0.5, 2, 3) * self.random.choice([-1, 1], 3)
        if self.chance(0.3):
            matrix = np.eye(4)
            matrix[:3, :3] = np.eye(3) + self.random.uniform(-0.3, 0.3, (3, 3))
            matrix[:3, 3] = self.random.normal(size=3)
            node["matrix"] = matrix.T.reshape(-1).tolist()
        else:
            node["rotation"] = (quaternion / np.linalg.norm(quaternion)).tolist()
            node["scale"] = scale.tolist()
            node["translation"] = self.random.normal(size=3).tolist()
        return node

    def primitive(self) -> dict[str, Any]:
        count = 3 * int(self.random.integers(2, 6))
        attributes = {"POSITION": self.positions(count)}
        if self.chance(0.6):
            attributes["COLOR_0"] = self.colors(count)
        if self.with_normals:
            attributes["NORMAL"] = self.directions(count)
        primitive: dict[str, Any] = {"attributes": attributes}
        if self.chance(0.7):
            primitive["mode"] = int(self.random.choice([4, 4, 5, 6, 0, 1, 3]))
        if self.chance(0.6):
            kind = str(self.random.choice(["u1", "u2", "u4"]))
            order = self.random.integers(0, count, 3 * int(self.random.integers(1, 6))).astype(kind)
            primitive["indices"] = self.rows(order[:, None])
        if self.chance(0.5):
            primitive["material"] = int(self.random.integers(2))
        return primitive

    def positions(self, count: int) -> int:
        kind = self.random.choice(["f4", "i1", "u1", "i2", "u2"])
        if kind == "f4":
            return self.rows(self.random.normal(size=(count, 3)).astype(kind), sparse=self.chance(0.4))
        limits = np.iinfo(kind)
        values = self.random.integers(limits.min, limits.max, (count, 3), dtype=kind, endpoint=True)
        return self.rows(values, normalized=self.chance(0.7), sparse=self.chance(0.3))

    def colors(self, count: int) -> int:
        width = int(self.random.integers(3, 5))
        kind = self.random.choice(["f4", "u1", "u2"])
        if kind == "f4":
            return self.rows(self.random.random((count, width)).astype(kind))
        return self.rows(
            self.random.integers(0, np.iinfo(kind).max, (count, width), dtype=kind, endpoint=True), normalized=True
        )

    def directions(self, count: int) -> int:
        values = self.random.normal(size=(count, 3))
        values /= np.linalg.norm(values, axis=1, keepdims=True)
        if self.chance(0.5):
            return self.rows(values.astype("f4"))
        kind = self.random.choice(["i1", "i2"])
        return self.rows(np.rint(values * np.iinfo(kind).max).astype(kind), normalized=True)

    def rows(self, values: Values, normalized: bool = False, sparse: bool = False) -> int:
        count, width = values.shape
        accessor: dict[str, Any] = {"componentType": self.code(values), "count": count, "type": TYPES[width]}
        if normalized:
            accessor["normalized"] = True
        if sparse:
            places = np.sort(self.random.choice(count, count // 2, replace=False)).astype(
                self.random.choice(["u1", "u2"])
            )
            accessor["sparse"] = {
                "count": len(places),
                "indices": {**self.place(places[:, None], False), "componentType": self.code(places)},
                "values": self.place(values[places], False),
            }
        if not sparse or self.chance(0.5):
            accessor |= self.place(values, width > 1)
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def code(self, values: Values) -> int:
        return CODES[values.dtype.str[1:]]

    def place(self, values: Values, may_have_gaps: bool) -> dict[str, int]:
        """The bytes, at some place in a view of their own; with gaps between the rows, if they may."""
        rows = [row.tobytes() for row in values]
        stride: dict[str, int] = {}
        if may_have_gaps and self.chance(0.4):
            stride["byteStride"] = size = (len(rows[0]) + 3) // 4 * 4 + 4
            rows = [row.ljust(size, b"\xee") for row in rows]
        start = 4 * int(self.random.integers(3))
        number = self.view(b"\xdd" * start + b"".join(rows))
        self.document["bufferViews"][number] |= stride
        return {"bufferView": number, "byteOffset": start}

    def write(self, folder: Path) -> Path:
        return self.gltf(folder / "model.gltf") if self.chance(0.5) else self.glb(folder / "model.glb")


def srgb(color: gltf_reader.Vector) -> list[float]:
    """Linear colours 0..1 as sRGB 0..255."""
    return [255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055) for c in color]


@pytest.mark.parametrize("seed", range(60))
def test_both_readers_see_the_same(tmp_path: Path, seed: int) -> None:
    writer = Writer(seed)
    path = writer.write(tmp_path)
    wanted = gltf_reader.read(path.read_bytes())
    with pytest.warns(InputWarning) as told:
        mesh = read_mesh(path)
    other, *points = [str(each.message) for each in told]
    assert other == f"{path}: left out: 1 other scene"
    assert all(re.fullmatch(r".*: left out: \d primitives? of points or lines", each) for each in points)
    assert len(points) <= 1
    faces = mesh.faces
    positions = np.array([triangle[0] for triangle in wanted])
    colors = np.array(
        [[DEFAULT_COLOR if color is None else srgb(color) for color in triangle[1]] for triangle in wanted]
    )
    found = mesh.positions[faces]
    assert found.shape == positions.shape
    scale = np.abs(positions).max()
    np.testing.assert_allclose(found / scale, positions / scale, atol=1e-6)
    assert np.abs(mesh.colors[faces] - colors).max() <= 0.51
    assert (mesh.normals is not None) == writer.with_normals
    if mesh.normals is not None:
        np.testing.assert_allclose(
            mesh.normals[faces], np.array([triangle[2] for triangle in wanted], dtype=float), atol=1e-6
        )


def test_the_random_files_have_all_that_is_compared() -> None:
    text = "".join(json.dumps(Writer(seed).document) for seed in range(60))
    for part in ('"sparse"', '"normalized"', '"byteStride"', '"children"', '"matrix"', '"NORMAL"', '"COLOR_0"'):
        assert text.count(part) > 10
    for mode in (4, 5, 6, 0):
        assert text.count(f'"mode": {mode}') > 10
    for kind in CODES.values():
        assert text.count(f'"componentType": {kind}') > 10
