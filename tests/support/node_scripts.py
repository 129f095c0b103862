"""Scripts for Node that answer a file of JSON lines with a file of byte strings, and modules bundled for them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Sequence
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import pytest

WEB = Path(__file__).resolve().parents[2] / "web"
ESBUILD = WEB / "node_modules" / ".bin" / "esbuild"
needs_web = pytest.mark.skipif(not ESBUILD.exists() or not shutil.which("node"), reason="needs Node, and `npm ci`")


def answers(script: Path, bundle: Traversable, lines: Sequence[dict[str, Any]], folder: Path) -> list[bytes]:
    """Run a script with a bundle; return what it writes, each with its length in four bytes before it."""
    asked, written = folder / "lines", folder / "answers"
    asked.write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    subprocess.run(["node", script, str(bundle), asked, written], check=True)
    data, place, found = written.read_bytes(), 0, []
    while place < len(data):
        end = place + 4 + int.from_bytes(data[place : place + 4], "big")
        found.append(data[place + 4 : end])
        place = end
    return found


def bundled(folder: Path, *modules: str) -> Path:
    """Bundle all that modules of web/src export; return the path of the bundle."""
    source = "".join(f'export * from "./src/{name}.js";' for name in modules)
    return _bundle(folder, source=source)


def asked(script: Path, folder: Path, content: Any) -> Any:
    """Run a script in TypeScript, which may import modules of web/src; return what it writes for this, all in JSON."""
    question, answer = folder / "asked.json", folder / "answers.json"
    question.write_text(json.dumps(content), "utf-8")
    subprocess.run(["node", _bundle(folder, script), question, answer], check=True)
    return json.loads(answer.read_text("utf-8"))


def _bundle(folder: Path, *scripts: Path, source: str | None = None) -> Path:
    path = folder / "bundle.mjs"
    options = ("--bundle", "--format=esm", "--platform=node", f"--outfile={path}", "--log-level=warning")
    environment = {**os.environ, "NODE_PATH": str(WEB / "node_modules")}
    subprocess.run([ESBUILD, *scripts, *options], input=source, text=True, cwd=WEB, env=environment, check=True)
    return path
