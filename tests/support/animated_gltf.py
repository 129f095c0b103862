"""A small glTF file with animations, in text."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "<f4")


def write(path: Path, **more: Any) -> None:
    """Write a red square that goes from x = -6 to 6 in two seconds, and one that turns in four: Slide and Spin."""
    half = float(np.sqrt(0.5))
    data = [
        SQUARE,
        np.array([0, 1, 2, 0, 2, 3], "<u2"),
        np.array([0, 2], "<f4"),
        np.array([[-6, 0, 0], [6, 0, 0]], "<f4"),
        np.array([0, 4], "<f4"),
        np.array([[0, 0, 0, 1], [0, 0, half, half]], "<f4"),
    ]
    kinds = ("VEC3", "SCALAR", "SCALAR", "VEC3", "SCALAR", "VEC4")
    uris = ["data:application/octet-stream;base64," + base64.b64encode(each.tobytes()).decode() for each in data]
    animations = [
        {
            "name": name,
            "samplers": [{"input": at, "output": at + 1}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": what}}],
        }
        for name, at, what in (("Slide", 2, "translation"), ("Spin", 4, "rotation"))
    ]
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": each.nbytes, "uri": uri} for each, uri in zip(data, uris, strict=True)],
        "bufferViews": [{"buffer": n, "byteLength": each.nbytes} for n, each in enumerate(data)],
        "accessors": [
            {
                "bufferView": number,
                "componentType": 5123 if each.dtype == "<u2" else 5126,
                "count": len(each),
                "type": kind,
            }
            for number, (each, kind) in enumerate(zip(data, kinds, strict=True))
        ],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "doubleSided": True}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "animations": animations,
        **more,
    }
    path.write_text(json.dumps(document))
