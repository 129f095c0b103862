"""Bundle the TypeScript package web/ into src/shackled/web, with the contracts that its EVM runs, and their stages.

    python tools/build_web.py            writes the bundles
    python tools/build_web.py --check    writes nothing; fails, and says which are not up to date

Needs Node and `npm ci` in web/. The bundler is esbuild, of the version in web/package-lock.json: the same bytes on
every machine.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from itertools import groupby
from pathlib import Path
from typing import Any

from shackled.artifacts import RENDERER, artifact
from shackled.chain import open_chain
from shackled.chain._embedded import EmbeddedChain
from shackled.ethereum._abi import SOLIDITY_ERRORS
from shackled.ethereum._encoding import to_hex
from shackled.gas._source_map import source_map
from shackled.gas._stages import STAGES
from shackled.gas._trace import places

ROOT = Path(__file__).resolve().parent.parent
WEB = ROOT / "web"
BUNDLES = ROOT / "src" / "shackled" / "web"

JUMP, JUMPI, JUMPDEST = 0x56, 0x57, 0x5B


def build() -> dict[str, bytes]:
    """Return the bytes of every bundle, by name."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["node", "build.mjs", "python", folder], cwd=WEB, check=True)
        bundles = {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}
    return bundles | {"contracts.json": contracts(), "stages.json": stages()}


def contracts() -> bytes:
    """Return the code and addresses of the contracts, and what their errors mean, as web/src/evm/contracts.ts says."""
    names = (*RENDERER, "Studio")
    errors = dict(SOLIDITY_ERRORS)
    for name in names:
        errors |= artifact(name).errors
    document = {
        "contracts": {name: code_of(name) for name in names},
        "errors": {to_hex(selector): errors[selector] for selector in sorted(errors)},
    }
    return json.dumps(document, separators=(",", ":")).encode() + b"\n"


def code_of(name: str) -> dict[str, str]:
    """Return the address and the code of a contract."""
    chain = open_chain()
    assert isinstance(chain, EmbeddedChain)
    return {"address": to_hex(chain.address(name)), "code": to_hex(chain.code(name))}


def stages() -> bytes:
    """Return the stage of each instruction of the contracts that draw, as web/src/evm/stages.ts says."""
    chain = open_chain()
    assert isinstance(chain, EmbeddedChain)
    maps = {name: {"address": to_hex(chain.address(name))} | stage_map(name) for name in RENDERER}
    document = {"stages": STAGES, "contracts": maps}
    return json.dumps(document, separators=(",", ":")).encode() + b"\n"


def stage_map(contract: str) -> dict[str, Any]:
    """Return the stages, jumps and functions of a contract; of the places of a function, those that are jumped to."""
    code, found = artifact(contract).runtime, places(contract)
    instructions = list(source_map(contract).places)
    targets = found[[at for at in instructions if code[at] == JUMPDEST]]
    jumps = found["jump"][[at for at in instructions if code[at] in (JUMP, JUMPI)]]
    runs = [(len(list(run)), stage) for stage, run in groupby(found["stage"][instructions].tolist())]
    return {
        "runs": [number for run in runs for number in run],
        "jumps": "".join("-io"[jump] for jump in jumps),
        "functions": targets["function"].tolist(),
        "entries": targets["entry"].tolist(),
    }


def main() -> int:
    """Build or check the bundles."""
    parser = argparse.ArgumentParser(description="Bundle the TypeScript package web/ into src/shackled/web.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the bundles are not up to date")
    options = parser.parse_args()
    bundles = build()
    kept = {path.name: path.read_bytes() for path in BUNDLES.iterdir() if path.suffix in (".js", ".json")}
    if options.check:
        wrong = sorted(name for name in bundles.keys() | kept.keys() if bundles.get(name) != kept.get(name))
        for name in wrong:
            print(f"src/shackled/web/{name} is not that of the sources: run tools/build_web.py", file=sys.stderr)
        return 1 if wrong else 0
    for name in kept.keys() - bundles.keys():
        (BUNDLES / name).unlink()
    for name, content in bundles.items():
        (BUNDLES / name).write_bytes(content)
        print(f"{name}: {len(content):,} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
