"""Build the EVM of evm/, Rust for WebAssembly, into src/shackled/evm.

    python tools/build_evm.py            writes evm.wasm, evm.json and LICENSES.txt
    python tools/build_evm.py --check    writes nothing; fails if they are not those of the sources

Building needs the compiler, the library sources and the linker of Debian's packages rustc-web, cargo-web, rust-web-src
and lld-19: Rust itself has no prebuilt library for WebAssembly everywhere. The check builds the module again, and says
so where it can only compare hashes: where that compiler is not installed, or not of the recorded version, or the crates
cannot be downloaded.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from platformdirs import user_cache_path

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "evm"
PACKAGE = ROOT / "src" / "shackled" / "evm"
WASM, RECORD, LICENSES = PACKAGE / "evm.wasm", PACKAGE / "evm.json", PACKAGE / "LICENSES.txt"

RUSTC, CARGO, LINKER = "/usr/bin/rustc", "/usr/bin/cargo", "wasm-ld-19"
TARGET = "wasm32-unknown-unknown"
#: Instructions on 128 bits reverse the bytes of words; without messages of panics the module is a third smaller, and
#: names no files. An instance has at most 1 GiB of memory.
FLAGS = "-C target-feature=+simd128 -Z unstable-options -C panic=immediate-abort -C link-arg=--max-memory=1073741824"
#: Of this crate only: hosts put the functions of compiled contracts into its table of functions.
OWN_FLAGS = ["-C", "link-arg=--export-table", "-C", "link-arg=--growable-table"]

#: Kept, so that a second build takes seconds; the first one takes minutes.
TARGET_FOLDER = user_cache_path("shackled", appauthor=False) / "evm-build"

#: Bytes of the module at most, plain and compressed.
MAX_SIZE, MAX_COMPRESSED = 430_000, 180_000

MIT = """Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
persons to whom the Software is furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
"""


def digest_of_sources() -> str:
    """Return the SHA-256 of what the module is built from: the crate, versions of dependencies, flags."""
    digest = hashlib.sha256(" ".join([FLAGS, *OWN_FLAGS]).encode())
    for path in [SOURCES / "Cargo.toml", SOURCES / "Cargo.lock", *sorted((SOURCES / "src").rglob("*.*"))]:
        digest.update(f"\n{path.name} {hashlib.sha256(path.read_bytes()).hexdigest()}".encode())
    return digest.hexdigest()


def compiler() -> str | None:
    """Return the versions of compiler and linker; None if one of them is not installed."""
    try:
        said = [subprocess.run([name, "--version"], capture_output=True, text=True) for name in (RUSTC, CARGO, LINKER)]
    except FileNotFoundError:
        return None
    library = subprocess.run([RUSTC, "--print", "sysroot"], capture_output=True, text=True).stdout.strip()
    if not Path(library, "lib", "rustlib", "src", "rust", "library", "std").exists():
        return None
    return ", ".join(each.stdout.strip() for each in said)


def build(sources: Path = SOURCES) -> bytes:
    """Return the module. The folder of the build is kept in the user's cache, so that a second build is fast."""
    home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    environment = os.environ | {
        "RUSTC": RUSTC,
        # Debian's compiler is a stable one; building the library needs an unstable option
        "RUSTC_BOOTSTRAP": "1",
        "RUSTFLAGS": f"{FLAGS} --remap-path-prefix={home}=cargo",
        "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER": LINKER,
        "CARGO_TARGET_DIR": str(TARGET_FOLDER),
        # cargo would warn that it cannot use the job server of make
        "MAKEFLAGS": "",
    }
    options = ["--release", "--locked", "--quiet", "-Z", "build-std=std,panic_abort", "--target", TARGET]
    subprocess.run([CARGO, "rustc", *options, "--", *OWN_FLAGS], cwd=sources, env=environment, check=True)
    return (TARGET_FOLDER / TARGET / "release" / "shackled_evm.wasm").read_bytes()


def licences() -> str:
    """Return the licences of all crates that the build needs."""
    command = [CARGO, "metadata", "--format-version", "1", "--locked", "--filter-platform", TARGET]
    asked = subprocess.run(command, cwd=SOURCES, capture_output=True, text=True, check=True)
    packages: list[dict[str, Any]] = json.loads(asked.stdout)["packages"]
    by_text: dict[str, list[str]] = {}
    for package in sorted(packages, key=lambda package: package["name"]):
        if package["source"] is not None:
            title = f"{package['name']} {package['version']} ({package['license']})"
            by_text.setdefault(_licence(package), []).append(title)
    parts = [f"{', '.join(titles)}\n\n{text}" for text, titles in by_text.items()]
    line = f"\n{'-' * 78}\n"
    return (
        "evm.wasm is compiled from evm/ and the crates below, and from Rust's standard library\n"
        f"(MIT OR Apache-2.0, Copyright (c) The Rust Project Contributors).\n{line}{line.join(parts)}"
    )


def _licence(package: dict[str, Any]) -> str:
    """Return the text of a licence that the package allows, MIT before others."""
    folder = Path(package["manifest_path"]).parent
    files = sorted(path for path in folder.iterdir() if path.name.upper().startswith(("LICEN", "COPYING", "UNLICENSE")))
    chosen = [path for path in files if "MIT" in path.name.upper()] or files
    if chosen:
        return "\n".join(line.rstrip() for line in chosen[0].read_text("utf-8").strip().splitlines()) + "\n"
    if "MIT" in package["license"]:
        return f"Copyright (c) {', '.join(package['authors']) or package['name']}\n\n{MIT}"
    return f"{package['license']}: {package['repository']}\n"


def main() -> int:
    """Build or check the module."""
    parser = argparse.ArgumentParser(description="Build the EVM of evm/ into src/shackled/evm.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the module is not up to date")
    options = parser.parse_args()
    found, sources = compiler(), digest_of_sources()
    if options.check:
        record = json.loads(RECORD.read_text("utf-8"))
        kept = WASM.read_bytes()
        if record["sources"] != sources or record["module"] != hashlib.sha256(kept).hexdigest():
            print("src/shackled/evm/evm.wasm is not that of the sources: run tools/build_evm.py", file=sys.stderr)
            return 1
        if found != record["compiler"]:
            here = f"here is {found}" if found else "which is not installed here (python3 tools/prepare.py rust)"
            print(f"evm.wasm is not built again, only hashes are compared: it needs {record['compiler']}; {here}")
            return 0
        if subprocess.run([CARGO, "fetch", "--locked", "--quiet"], cwd=SOURCES).returncode:
            print("evm.wasm is not built again, only hashes are compared: the crates cannot be downloaded")
            return 0
        if build() != kept:
            print("src/shackled/evm/evm.wasm differs from a new build: run tools/build_evm.py", file=sys.stderr)
            return 1
        return 0
    if found is None:
        print("building needs rustc-web, cargo-web, rust-web-src and lld-19", file=sys.stderr)
        return 1
    module = build()
    WASM.write_bytes(module)
    LICENSES.write_text(licences(), "utf-8")
    record = {"compiler": found, "module": hashlib.sha256(module).hexdigest(), "sources": sources}
    RECORD.write_text(json.dumps(record, indent=1) + "\n", "utf-8")
    print(f"evm.wasm: {len(module):,} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
