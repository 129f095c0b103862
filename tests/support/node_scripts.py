"""Scripts for Node that answer a file of JSON with another, and modules of web/src bundled for them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

WEB = Path(__file__).resolve().parents[2] / "web"
ESBUILD = WEB / "node_modules" / ".bin" / "esbuild"
#: The TypeScript package, as it comes with the Python package.
BUNDLE = Path(str(files("shackled"))) / "web" / "shackled.js"
needs_node = pytest.mark.skipif(not shutil.which("node"), reason="there is no Node")
needs_web = pytest.mark.skipif(not ESBUILD.exists() or not shutil.which("node"), reason="needs Node, and `npm ci`")


def asked(script: Path, folder: Path, content: Any) -> Any:
    """Run a script; return what it writes for this, all in JSON. One in TypeScript may import modules of web/src."""
    question, answer = folder / "asked.json", folder / "answers.json"
    question.write_text(json.dumps(content), "utf-8")
    program = _bundle(folder, script) if script.suffix == ".ts" else script
    subprocess.run(["node", program, question, answer], check=True)
    return json.loads(answer.read_text("utf-8"))


def calls_made(lines: Sequence[dict[str, Any]], folder: Path, bundle: Path = BUNDLE) -> list[Any]:
    """The calls that TypeScript makes, see tests/web/calls.mjs, or what it says instead."""
    script = Path(__file__).parents[1] / "web" / "calls.mjs"
    found = asked(script, folder, {"bundle": str(bundle), "lines": lines})
    return [bytes.fromhex(each["call"]) if "call" in each else each["error"] for each in found]


def bundled(folder: Path, *modules: str) -> Path:
    """Bundle all that modules of web/src export; return the path of the bundle."""
    source = "".join(f'export * from "./src/{name}.js";' for name in modules)
    return _bundle(folder, source=source)


def _bundle(folder: Path, *scripts: Path, source: str | None = None) -> Path:
    path = folder / "bundle.mjs"
    options = ("--bundle", "--format=esm", "--platform=node", f"--outfile={path}", "--log-level=warning")
    environment = {**os.environ, "NODE_PATH": str(WEB / "node_modules")}
    subprocess.run([ESBUILD, *scripts, *options], input=source, text=True, cwd=WEB, env=environment, check=True)
    return path
