"""Bundle the TypeScript package web/ into src/shackled/web, with contracts.json: the contracts that its EVM runs.

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
from pathlib import Path

from shackled.artifacts import RENDERER, artifact
from shackled.chain import EmbeddedChain, open_chain
from shackled.ethereum import SOLIDITY_ERRORS, to_hex

ROOT = Path(__file__).resolve().parent.parent
WEB = ROOT / "web"
BUNDLES = ROOT / "src" / "shackled" / "web"


def build() -> dict[str, bytes]:
    """Return the bytes of every bundle, by name."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["node", "build.mjs", "python", folder], cwd=WEB, check=True)
        bundles = {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}
    return bundles | {"contracts.json": contracts()}


def contracts() -> bytes:
    """Return the code and addresses of the contracts, and what their errors mean, as web/src/evm/contracts.ts says."""
    chain = open_chain()
    assert isinstance(chain, EmbeddedChain)
    names = (*RENDERER, "Studio")
    errors = dict(SOLIDITY_ERRORS)
    for name in names:
        errors |= artifact(name).errors
    document = {
        "contracts": {
            name: {"address": to_hex(chain.address(name)), "code": to_hex(chain.code(name))} for name in names
        },
        "errors": {to_hex(selector): errors[selector] for selector in sorted(errors)},
    }
    return json.dumps(document, separators=(",", ":")).encode() + b"\n"


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
