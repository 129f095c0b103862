"""Build what would be published into build/release, and use it in fresh environments as a stranger would.

    python -m tools.release_check                     what `make release-check` runs
    python -m tools.release_check --python PATH       with one more Python; --node PATH: with one more Node

Prints a row for each check, and exits with 1 if one failed. The Pythons are those of the classifiers in pyproject.toml,
from the PATH or pyenv, the Nodes that of the PATH and those of nvm. Rows name those that are absent.
"""

from __future__ import annotations

import argparse
import email
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from shackled.deploy import deployments
from tools import build_package
from tools.addresses import ROOT, addresses, project

RELEASE = ROOT / "build" / "release"
PAGE = ROOT / "build" / "page"
PROJECT = project()["project"]
VERSION: str = PROJECT["version"]
EXAMPLES = [ROOT / "examples" / "first_picture.py", *sorted((ROOT / "examples" / "programs").glob("*.py"))]
#: The oldest Node that the npm packages run on.
OLDEST_NODE = (20, 16)

MB = 1_000_000
#: The most bytes of each package, and of an environment with the Python package and what it needs.
MOST = {
    "*.whl": 5 * MB,
    "*.tar.gz": 12 * MB,
    "shackled-contracts-*.tgz": 2 * MB,
    "shackled-[0-9]*.tgz": 1.2 * MB,
    "environment": 300 * MB,
}
#: The variables of the programs that are run: no part of this checkout is in their paths.
VARIABLES = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}

#: Prints the licence of each package of an environment, in JSON.
LICENCES = """
import json
from importlib.metadata import distributions
found = {}
for each in distributions():
    said = each.metadata
    classifiers = [line for line in said.get_all("Classifier", []) if line.startswith("License")]
    found[said["Name"]] = said.get("License-Expression") or ", ".join(classifiers) or said.get("License", "")[:80]
print(json.dumps(found))
"""
#: Prints the address of the Renderer, and fails if a source cannot be imported.
CONTRACTS = """
require.resolve("shackled-contracts/interfaces/IRenderer.sol");
console.log(require("shackled-contracts").contracts.Renderer.address);
"""
#: Libraries whose meshes are drawn, and how they make one.
OTHERS = {
    "meshio": 'meshio.Mesh(v, {"triangle": f})',
    "open3d": "open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(v), open3d.utility.Vector3iVector(f))",
    "pyvista": "pyvista.PolyData.from_regular_faces(v, f)",
}
#: Draws a mesh of such a library, and fails unless the picture is that of arrays of the same numbers.
OTHER = """
import numpy, shackled, %s
v, f = numpy.array([(-1.0, -1, 0), (1, -1, 0), (1, 1, 0)]), numpy.array([(0, 1, 2)])
assert (shackled.render(%s, 16).pixels == shackled.render((v, f), 16).pixels).all()
"""
TRIANGLE = "v 0 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\n"


class Failure(Exception):
    """What is wrong, in one line."""


class Skipped(Exception):
    """Why something cannot be checked, in one line."""


class Table:
    """The rows that are printed. failed: whether one of them is a failure."""

    failed = False

    def row(self, name: str, state: str, details: Iterable[object] = ()) -> None:
        """Print a row."""
        self.failed |= state == "FAILED"
        print(f"{name:<38} {state:<7} {', '.join(map(str, details))}", flush=True)

    @contextmanager
    def check(self, name: str) -> Iterator[list[object]]:
        """Print a row for what is done within, which adds details to the list, or raises Failure or Skipped."""
        details: list[object] = []
        try:
            yield details
        except Skipped as reason:
            self.row(name, "skipped", [reason])
        except Failure as failure:
            self.row(name, "FAILED", [failure])
        except (OSError, LookupError, ValueError, subprocess.SubprocessError) as error:
            self.row(name, "FAILED", [repr(error)])
        else:
            self.row(name, "good", details)


def demand(condition: object, message: str) -> None:
    """Raise Failure unless the condition is true."""
    if not condition:
        raise Failure(message)


def run(*command: str | Path, cwd: Path) -> str:
    """Run a command; return what it prints. Raise Failure with its last line if it fails."""
    done = subprocess.run(command, cwd=cwd, env=VARIABLES, capture_output=True, text=True)
    lines = [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]
    # without the text of a program
    name = " ".join(map(str, command[:4])).splitlines()[0]
    demand(not done.returncode, f"{name} ...: {lines[-1] if lines else done.returncode}")
    return done.stdout


def size_of(path: Path) -> int:
    """Return the bytes of a file, or of all files of a folder."""
    files = path.rglob("*") if path.is_dir() else [path]
    return sum(each.stat().st_size for each in files if each.is_file() and not each.is_symlink())


def bounded(path: Path, bound: str) -> str:
    """Return the size as a text; raise Failure if it is above a bound of `MOST`."""
    size, most = size_of(path), MOST[bound]
    demand(size <= most, f"{path.name} has {size / MB:.2f} MB, more than {most / MB:g}")
    return f"{size / MB:.2f} of at most {most / MB:g} MB"


def released(pattern: str) -> Path:
    """Return the one file of build/release with such a name."""
    found = [*RELEASE.glob(pattern)]
    demand(len(found) == 1, f"build/release has {len(found)} files {pattern}")
    return found[0]


# ---- what is built ----


def check_python_package(table: Table, work: Path) -> None:
    """Build the sdist, and from it the wheel; check their metadata and content."""
    with table.check("sdist, and the wheel made of it") as details:
        demand(PAGE.is_dir(), "there is no page to put in: make page")
        tools = make_environment(Path(sys.executable), work / "tools", "build", "twine")
        run(tools, "-m", "build", "--outdir", RELEASE, ROOT, cwd=work)
        details += [f"{pattern} {bounded(released(pattern), pattern)}" for pattern in ("*.whl", "*.tar.gz")]
        run(tools, "-m", "twine", "check", "--strict", released("*.whl"), released("*.tar.gz"), cwd=work)
        details.append("twine check")
    with table.check("content of the wheel") as details, zipfile.ZipFile(released("*.whl")) as wheel:
        files = {name: wheel.read(name) for name in wheel.namelist()}
        info = f"shackled-{VERSION}.dist-info"
        said = email.message_from_bytes(files[f"{info}/METADATA"])
        demand(said["License-Expression"] == "MIT", "its licence is not MIT")
        wanted = {f"{info}/licenses/{name}" for name in said.get_all("License-File", [])}
        wanted |= {f"shackled/web/page/{each.relative_to(PAGE).as_posix()}" for each in PAGE.rglob("*.*")}
        artifacts = [json.loads(text) for name, text in files.items() if re.match(r"shackled/artifacts/[A-Z]", name)]
        wanted |= {f"shackled/artifacts/sources/{path}" for each in artifacts for path in each["sources"]}
        wanted |= {"shackled/web/creator.html", "shackled/py.typed"}
        demand(wanted <= files.keys(), f"without {', '.join(sorted(wanted - files.keys())[:3])}")
        check_content(files, str(said.get_payload()))
        details += [
            f"{len(files)} files",
            f"{len(artifacts)} contracts",
            f"{len(said.get_all('Project-URL', []))} links",
        ]


def check_content(files: dict[str, bytes], readme: str) -> None:
    """Raise Failure if a file names a folder of this machine, or if the README has links that are not absolute."""
    places = [str(place).encode() for place in (ROOT, Path.home()) if len(place.parts) > 2]
    for name, content in files.items():
        demand(not any(place in content for place in places), f"{name} names a folder of this machine")
    links = re.findall(r"\]\((?!#|https://)([^)]*)\)", re.sub(r"```.*?```", "", readme, flags=re.DOTALL))
    demand(not links, f"links of the README that an index cannot follow: {links[:3]}")


def check_npm_packages(table: Table) -> None:
    """Build and pack both npm packages; check their content."""
    for pattern, build, folder in (
        ("shackled-contracts-*.tgz", build_package.build, build_package.PACKAGE),
        ("shackled-[0-9]*.tgz", build_package.build_web, build_package.WEB_PACKAGE),
    ):
        with table.check(f"npm package of build/{folder.name}") as details:
            build(folder)
            run("npm", "pack", "--silent", "--pack-destination", RELEASE, cwd=folder)
            details.append(bounded(released(pattern), pattern))
            with tarfile.open(released(pattern)) as packed:
                streams = {each.name: packed.extractfile(each) for each in packed.getmembers()}
                files = {name: stream.read() for name, stream in streams.items() if stream}
            manifest = json.loads(files["package/package.json"])
            demand((manifest["version"], manifest["license"]) == (VERSION, "MIT"), "it has another version or licence")
            demand("package/LICENSE" in files, "it has no LICENSE")
            check_content(files, files["package/README.md"].decode())
            details.append(f"{len(files)} files")


def check_texts(table: Table) -> None:
    """Run the tests of versions, addresses, and links between the pages of the repository."""
    with table.check("versions, addresses, links") as details:
        tests = ("tests/test_rules.py", "tests/test_project_addresses.py")
        run(sys.executable, "-m", "pytest", "-q", *tests, cwd=ROOT)
        details += [VERSION, addresses()["repository"] or "no address yet: fill [tool.shackled] in pyproject.toml"]


# ---- where it is used ----


def make_environment(python: Path, folder: Path, *wanted: str | Path) -> Path:
    """Make an environment with some packages; return its Python."""
    run(python, "-m", "venv", folder, cwd=folder.parent)
    inside = folder / ("Scripts" if os.name == "nt" else "bin") / "python"
    run(inside, "-m", "pip", "install", "--quiet", *wanted, cwd=folder.parent)
    return inside


def find_python(version: str) -> Path | None:
    """Return a Python of this version that can make environments."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"), "versions")
    for found in (shutil.which(f"python{version}"), *sorted(pyenv.glob(f"{version}.*/bin/python{version}"))):
        program = "import ensurepip, sys, venv; print('%d.%d' % sys.version_info[:2])"
        if found and subprocess.run([found, "-c", program], capture_output=True, text=True).stdout.strip() == version:
            return Path(found)
    return None


def use_python(table: Table, name: str, python: Path, package: Path, work: Path) -> None:
    """Install a package in a fresh environment: draw, write the page, run the examples, look at the licences."""
    folder = Path(tempfile.mkdtemp(dir=work))
    with table.check(f"{name}: install") as details:
        begin = time.monotonic()
        inside = make_environment(python, folder / "environment", package)
        details += [f"{time.monotonic() - begin:.0f} s", bounded(folder / "environment", "environment")]
        run(inside, "-m", "pip", "check", cwd=folder)
        licences = json.loads(run(inside, "-c", LICENCES, cwd=folder))
        strict = [
            each for each, licence in licences.items() if re.search(r"(?<!L)GPL|(?<!Lesser )General Pub", licence)
        ]
        demand(not strict, f"these packages are under the GPL: {', '.join(strict)}")
        details.append(f"{len(licences)} packages, none under the GPL")
    with table.check(f"{name}: draw") as details:
        # the bytes of the contract; a PNG also depends on the library that packs it
        drawing = ("render", "teapot", "--size", "64", "--json", "-o", "teapot.bmp")
        here = json.loads(run(Path(sys.executable).with_name("shackled"), *drawing, cwd=work))
        begin = time.monotonic()
        there = json.loads(run(inside.with_name("shackled"), *drawing, cwd=folder))
        details += [f"{time.monotonic() - begin:.1f} s", f"{there['gas']:,} gas"]
        demand([there[key] for key in ("gas", "sha256")] == [here[key] for key in ("gas", "sha256")], "not as here")
        run(inside, "-W", "error", "-c", "import shackled; shackled.render('cube', size=8)", cwd=folder)
    with table.check(f"{name}: page, examples") as details:
        run(inside.with_name("shackled"), "creator", "--out", "page", cwd=folder)
        built = size_of(PAGE) + size_of(PAGE.with_name("creator.html"))
        demand(size_of(folder / "page") == built, "`shackled creator --out` writes another page")
        needing = [program.stem for program in EXAMPLES if not runs(inside, program, folder)]
        details.append(f"{len(EXAMPLES) - len(needing)} of {len(EXAMPLES)} examples run")
        if needing:
            details.append(f"these say what else they need: {' '.join(needing)}")


def use_others(table: Table, python: Path, work: Path) -> None:
    """Draw meshes of other libraries, each in an environment of its own."""
    for library, mesh in OTHERS.items():
        with table.check(f"a mesh of {library}") as details:
            inside = make_environment(python, work / library, released("*.whl"))
            try:
                run(inside, "-m", "pip", "install", "--quiet", library, cwd=work)
                run(inside, "-c", f"import {library}", cwd=work)
            except Failure as failure:
                # it has no wheel for this Python, or needs a library of the system
                if re.search("No matching distribution|cannot open shared object file", str(failure)):
                    raise Skipped(failure) from None
                raise
            run(inside, "-c", OTHER % (library, mesh), cwd=work)
            details.append(run(inside, "-m", "pip", "show", library, cwd=work).splitlines()[1])


def runs(python: Path, program: Path, folder: Path) -> bool:
    """Run a program. Return whether it succeeded; raise Failure if it failed with more than a line that says why."""
    done = subprocess.run([python, program], cwd=folder, env=VARIABLES, capture_output=True, text=True)
    lines = done.stderr.strip().splitlines()
    demand(not done.returncode or len(lines) == 1, f"{program.name}: {lines[-1] if lines else done.returncode}")
    return not done.returncode


def find_nodes() -> list[Path]:
    """Return the Nodes of the PATH and of nvm."""
    nvm = Path(os.environ.get("NVM_DIR", Path.home() / ".nvm"), "versions", "node")
    here = shutil.which("node")
    return [*([Path(here)] if here else []), *sorted(nvm.glob("*/bin/node"))]


def use_node(table: Table, node: Path, work: Path) -> None:
    """Install both npm packages in an empty folder, and run the programs of a README and the command there."""
    version = run(node, "--version", cwd=work).strip()
    with table.check(f"Node {version}") as details:
        numbers = tuple(map(int, re.findall(r"\d+", version)[:2]))
        demand(numbers >= OLDEST_NODE, f"the packages need {'.'.join(map(str, OLDEST_NODE))} or newer")
        folder = Path(tempfile.mkdtemp(dir=work))
        (folder / "package.json").write_text('{"private": true}')
        packages = [released(pattern) for pattern in MOST if pattern.endswith(".tgz")]
        run("npm", "install", "--silent", "--no-audit", "--no-fund", *packages, cwd=folder)
        readme = (build_package.WEB / "README.md").read_text("utf-8")
        (folder / "readme.mjs").write_text("".join(re.findall(r"^```js\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)))
        details.append(run(node, "readme.mjs", cwd=folder).strip())
        (folder / "model.obj").write_text(TRIANGLE)
        command = folder / "node_modules" / "shackled" / "dist" / "cli.js"
        run(node, command, "poster", "model.obj", "-o", "poster.png", "--size", "32", cwd=folder)
        demand((folder / "poster.png").read_bytes().startswith(b"\x89PNG"), "poster.png is no picture")
        (renderer,) = (each.address for each in deployments(["Renderer"]) if each.name == "Renderer")
        said = run(node, "-e", CONTRACTS, cwd=folder).strip()
        demand(bytes.fromhex(said[2:]) == renderer, "shackled-contracts has another address of the Renderer")


def main() -> int:
    """Run all checks."""
    parser = argparse.ArgumentParser(description="Build what would be published, and use it in fresh environments.")
    parser.add_argument("--python", type=Path, action="append", default=[], help="a Python more")
    parser.add_argument("--node", type=Path, action="append", default=[], help="a Node more")
    options = parser.parse_args()
    shutil.rmtree(RELEASE, ignore_errors=True)
    RELEASE.mkdir(parents=True)
    table = Table()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        check_texts(table)
        check_python_package(table, work)
        check_npm_packages(table)
        # each of these is needed there
        if len([*RELEASE.iterdir()]) == 4:
            use(table, work, options.python, options.node)
    print(
        "something failed" if table.failed else f"ready in {RELEASE.relative_to(ROOT)}; PUBLISHING.md says what is next"
    )
    return int(table.failed)


def use(table: Table, work: Path, pythons: list[Path], nodes: list[Path]) -> None:
    """Use the packages with every Python and Node at hand, and with these."""
    named = [line.removeprefix("Programming Language :: Python :: ") for line in PROJECT["classifiers"]]
    found = {version: find_python(version) for version in named if re.fullmatch(r"3\.\d+", version)}
    for version, python in [*found.items(), *((str(path), path) for path in pythons)]:
        if python:
            use_python(table, f"Python {version}", python, released("*.whl"), work)
        else:
            table.row(f"Python {version}", "absent")
    if first := next(filter(None, found.values()), None):
        use_python(table, "sdist", first, released("*.tar.gz"), work)
        use_others(table, first, work)
    for node in [*find_nodes(), *nodes]:
        use_node(table, node, work)


if __name__ == "__main__":
    sys.exit(main())
