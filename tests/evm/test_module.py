"""evm.wasm: of the sources, small, without traces of a machine, and shipped with the licences of what is in it."""

from __future__ import annotations

import gzip
import hashlib
import json
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import wasmtime
from tools import build_evm as tool

from shackled.artifacts import source
from shackled.evm._module import module_bytes

ROOT = Path(__file__).resolve().parents[2]


def test_it_is_that_of_the_sources() -> None:
    record = json.loads(tool.RECORD.read_text("utf-8"))
    assert record["sources"] == tool.digest_of_sources(), "run tools/build_evm.py"
    assert record["module"] == hashlib.sha256(module_bytes()).hexdigest()


def test_it_is_small() -> None:
    assert len(module_bytes()) <= tool.MAX_SIZE
    assert len(gzip.compress(module_bytes(), 9)) <= tool.MAX_COMPRESSED


def test_no_path_or_registry_is_in_it() -> None:
    assert not re.search(rb"/(home|root|Users|usr|work|tmp|build)/|\.cargo|registry|crates\.io|\.rs\b", module_bytes())


def test_it_imports_nothing() -> None:
    module = wasmtime.Module(wasmtime.Engine(), module_bytes())
    assert list(module.imports) == []
    names = {"allocate", "answer", "answer_size", "call", "create", "deploy", "describe", "gas_used", "memory"}
    names |= {"profile", "put", "release", "send", "set_block", "table", "table_size"}
    names |= {"busiest", "calculate", "compile", "copy", "grow", "link", "module"}
    assert {each.name for each in module.exports if not each.name.startswith("__")} == names


#: Crates of Cargo.lock that only other targets need.
ELSEWHERE = {"cpufeatures", "fnv", "libc", "serde_derive", "zerocopy-derive"}


def test_licences_of_all_that_is_compiled_in() -> None:
    """And of what only builds it: of each crate of Cargo.lock."""
    packages = tomllib.loads((ROOT / "evm" / "Cargo.lock").read_text("utf-8"))["package"]
    locked = {(each["name"], each["version"]) for each in packages if "source" in each}
    named = set(re.findall(r"(?:^|, )([a-z0-9_-]+) (\d\S*) \(", tool.LICENSES.read_text("utf-8"), re.MULTILINE))
    assert named <= locked
    assert {name for name, _ in locked - named} <= ELSEWHERE
    assert "Rust's standard library" in tool.LICENSES.read_text("utf-8")


def test_the_wheel_has_it(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (path,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(path) as wheel:
        assert wheel.read("shackled/evm/evm.wasm") == module_bytes()
        assert wheel.read("shackled/evm/LICENSES.txt") == tool.LICENSES.read_bytes()
        # and the sources of the contracts, with which explorers verify them
        for path in json.loads(wheel.read("shackled/artifacts/Studio.json"))["sources"]:
            assert wheel.read(f"shackled/artifacts/sources/{path}").decode() == source(path)
        names = [Path(name).name for name in wheel.namelist()]
    assert {"LICENSE", "THIRD-PARTY-NOTICES", "evm.json"} <= set(names)
