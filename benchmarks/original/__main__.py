"""Measure your own copy of the original contracts, and rewrite original.csv.

    python -m benchmarks.original SOURCES SCENES [NAME ...] [--solc DIR] [--contract NAME | --at ADDRESS] [-o FILE]

SOURCES is what you have fetched yourself, as none of it is part of this project: the standard JSON input that a block
explorer shows with the verified sources, a folder of these sources, or, with --at, a JSON file of the runtime code of
the token and of its libraries by address, as `eth_getCode` returns it. SCENES is the folder that
`python -m benchmarks.original.recipe` writes; all its scenes are measured unless some are named. Sources are compiled
with the optimizer for 200 runs, unless the standard JSON says otherwise, by the npm package solc in DIR;
`npm install solc@0.8.9` gives the version that original.csv was measured with.

Rows of other scenes stay as they are. Of a new row, lit_pixels are the pixels that differ from the background.
The embedded EVM has 1 GB of memory; scenes that need more are measured if pyrevm is installed, and left out otherwise.
"""

from __future__ import annotations

import argparse
import base64
import csv
import io
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tools.pages import ROOT

from shackled import InputError
from shackled.artifacts import artifact
from shackled.bench._original import original
from shackled.errors import ChainError
from shackled.ethereum._encoding import intrinsic_gas, keccak256, parse_address, to_hex
from shackled.evm._instance import MOST_GAS, Instance, Status

from .. import run_main
from .documents import Document, call_data

CSV = ROOT / "src" / "shackled" / "bench" / "original.csv"
SOLC = ROOT / "contracts" / "node_modules" / "solc"
TOKEN = "Shackled"
#: Whom pyrevm lets call.
CALLER = bytes(19) + b"\1"
SETTINGS = {"optimizer": {"enabled": True, "runs": 200}}
WANTED = {"*": {"*": ["evm.deployedBytecode.object", "evm.deployedBytecode.linkReferences"]}}
COMPILE = 'const solc = require(process.argv[1]); console.log(solc.compile(require("fs").readFileSync(0, "utf8")))'

Codes = dict[bytes, bytes]


# ---- the contracts ----


def standard_input(sources: Path) -> dict[str, Any]:
    """Return the standard JSON input of a folder of sources, or of a file that is one."""
    if sources.is_dir():
        files = {path.relative_to(sources).as_posix(): path for path in sorted(sources.rglob("*.sol"))}
        if not files:
            raise InputError(f"{sources} has no .sol files")
        texts = {name: {"content": path.read_text("utf-8")} for name, path in files.items()}
        found: dict[str, Any] = {"language": "Solidity", "sources": texts, "settings": SETTINGS}
    else:
        text = sources.read_text("utf-8").strip()
        # a block explorer may put it into braces once more
        found = json.loads(text[1:-1] if text.startswith("{{") else text)
        if "sources" not in found:
            raise InputError(f"{sources} is no standard JSON input: it has no sources")
    found["settings"] = {**found.get("settings", {}), "outputSelection": WANTED}
    return found


def compiled(request: dict[str, Any], solc: Path) -> dict[str, Any]:
    """Return the contracts of a standard JSON input by name, compiled."""
    # files, since Node truncates what it writes to a pipe
    with tempfile.TemporaryFile("w+") as given, tempfile.TemporaryFile("w+") as written:
        json.dump(request, given)
        given.seek(0)
        subprocess.run(["node", "-e", COMPILE, str(solc.resolve())], stdin=given, stdout=written, check=True)
        written.seek(0)
        answer = json.load(written)
    faults = [each["formattedMessage"] for each in answer.get("errors", []) if each["severity"] == "error"]
    if faults:
        raise InputError("\n".join(faults))
    return {name: each for file in answer["contracts"].values() for name, each in file.items()}


def linked(contracts: Mapping[str, Any], name: str) -> tuple[bytes, Codes]:
    """Return the address of a contract, and the codes of it and of the libraries that it needs.

    The addresses are made of the names. Constructors do not run: `render` reads nothing that they write.
    """
    if name not in contracts:
        raise InputError(f"there is no contract {name!r}; there are {', '.join(sorted(contracts))}")
    built, codes = contracts[name]["evm"]["deployedBytecode"], Codes()
    text = built["object"]
    for libraries in built["linkReferences"].values():
        for library, places in libraries.items():
            address, others = linked(contracts, library)
            codes |= others
            for place in places:
                start = 2 * place["start"]
                text = text[:start] + address.hex() + text[start + 40 :]
    address = keccak256(name.encode())[-20:]
    return address, codes | {address: bytes.fromhex(text)}


def deployed(path: Path) -> Codes:
    """Return the codes of a JSON file, by address."""
    codes: dict[str, str] = json.loads(path.read_text("utf-8"))
    return {bytes.fromhex(each[2:]): bytes.fromhex(code[2:]) for each, code in codes.items()}


# ---- the measurement ----


def call(codes: Codes, address: bytes, data: bytes) -> tuple[int, bytes]:
    """Return execution gas and output of a call. ChainError if it fails, or needs too much memory."""
    evm = Instance()
    evm.hold(codes)
    try:
        answer = evm.call(address, data, MOST_GAS)
    except ChainError:
        return _in_pyrevm(codes, address, data)
    if answer.status != Status.SUCCESS:
        raise ChainError(f"the call ended with {answer.status.name}")
    return answer.gas, answer.output


def _in_pyrevm(codes: Codes, address: bytes, data: bytes) -> tuple[int, bytes]:
    try:
        import pyrevm
    except ModuleNotFoundError:
        raise ChainError("the call needs more memory than the embedded EVM has, and pyrevm is not installed") from None
    evm = pyrevm.EVM(spec_id="Cancun")
    for each, code in codes.items():
        evm.insert_account_info(to_hex(each), pyrevm.AccountInfo(code=code))
    try:
        output = bytes(evm.message_call(to_hex(CALLER), to_hex(address), data, None, MOST_GAS))
    except RuntimeError as error:
        raise ChainError(f"the call failed: {error}") from None
    assert evm.result is not None
    return evm.result.gas_used - intrinsic_gas(data), output


def row(name: str, scene: Document, codes: Codes, address: bytes) -> dict[str, str | int]:
    """Measure a scene; return its row."""
    gas, output = call(codes, address, call_data(scene))
    uri = artifact("Original").interface.decode("render", output)
    known = original().get(name)
    return {
        "scene": name,
        "triangles": len(scene["faces"]),
        "drawn": known.drawn if known else drawn(scene),
        "canvas": scene["canvasDim"],
        "lit_pixels": known.lit_pixels if known else lit_pixels(uri, scene),
        "gas": gas,
    }


def drawn(scene: Document) -> int:
    """Count the triangles that the original's culling leaves: it takes the eye to be at the origin."""
    if not scene["faces"] or not scene["backfaceCulling"]:
        return len(scene["faces"])
    points = np.array(scene["verts"], object) * scene["objScale"] + np.array(scene["objPosition"], object)
    a, b, c = points[np.array(scene["faces"])].transpose(1, 0, 2)
    p, q = a - b, b - c
    normals = np.stack([p[:, i - 2] * q[:, i - 1] - p[:, i - 1] * q[:, i - 2] for i in range(3)], axis=1)
    return int(((a * normals).sum(axis=1) < 0).sum())


def lit_pixels(uri: str, scene: Document) -> int:
    """Count the pixels of a BMP data URI that differ from the background."""
    side = scene["canvasDim"]
    bmp = base64.b64decode(uri.partition("base64,")[2])
    pixels = np.frombuffer(bmp, np.uint8, 3 * side * side, 54).reshape(side, side, 3)[:, :, ::-1]
    return int((pixels != background(scene)).any(axis=2).sum())


def background(scene: Document) -> NDArray[np.int64]:
    """Return the background from below, (side, 1, 3)."""
    side = scene["canvasDim"]
    top, bottom = np.array(scene["backgroundColor"])
    rows = np.arange(side)[:, None, None]
    colors = (top * rows + bottom * (side - rows)) // side
    return np.asarray(255 - colors if scene["invert"] else colors)


def written(text: str, rows: Iterable[Mapping[str, str | int]]) -> str:
    """Return the text of original.csv with these rows in it."""
    lines = text.splitlines(keepends=True)
    comments = [line for line in lines if line.startswith("#")]
    old = {each["scene"]: each for each in csv.DictReader(line for line in lines if not line.startswith("#"))}
    stream = io.StringIO()
    new = {**old, **{str(each["scene"]): each for each in rows}}
    writer = csv.DictWriter(stream, ["scene", "triangles", "drawn", "canvas", "lit_pixels", "gas"], lineterminator="\n")
    writer.writeheader()
    writer.writerows(new[name] for name in sorted(new))
    return "".join(comments) + stream.getvalue()


def main(arguments: list[str] | None = None) -> int:
    """Measure, and write the file; return 1 if scenes were left out."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", type=Path)
    parser.add_argument("scenes", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--solc", type=Path, default=SOLC, help="folder of the npm package solc")
    parser.add_argument("--contract", default=TOKEN, help="the contract whose render is called")
    parser.add_argument("--at", help="its address, if SOURCES has runtime code")
    parser.add_argument("-o", "--output", type=Path, default=CSV)
    given = parser.parse_args(arguments)
    folder = given.scenes / "scenes" if (given.scenes / "scenes").is_dir() else given.scenes
    names = given.names or sorted(path.stem for path in folder.glob("*.json"))
    rows, left_out = [], 0
    try:
        if not names:
            raise InputError(f"{folder} has no scenes")
        if given.at:
            address, codes = parse_address(given.at, "--at"), deployed(given.sources)
        else:
            address, codes = linked(compiled(standard_input(given.sources), given.solc), given.contract)
        for name in names:
            scene = json.loads((folder / f"{name}.json").read_text("utf-8"))
            try:
                found = row(name, scene, codes, address)
            except ChainError as error:
                print(f"{name}: {error}", file=sys.stderr)
                left_out += 1
                continue
            rows.append(found)
            known = original().get(name)
            note = "new" if known is None else "as recorded" if known.gas == found["gas"] else f"recorded {known.gas:,}"
            print(f"{name}: {found['gas']:,} ({note})", flush=True)
    except (OSError, ValueError) as error:
        raise SystemExit(str(error)) from None
    given.output.write_text(written(CSV.read_text("utf-8"), rows), "utf-8")
    return bool(left_out)


if __name__ == "__main__":
    run_main(main, has_options=True)
