"""Install what the Makefile needs; runs on a bare Python.

    python3 tools/prepare.py package          .venv with the package in it
    python3 tools/prepare.py dev              and with what tests and documentation need
    python3 tools/prepare.py node [FOLDER]    node_modules of a folder: contracts (compiler, libraries, anvil), web
                                              (bundler, libraries of the page) or tests/package (Hardhat); or of all
    python3 tools/prepare.py browser          browsers for the tests of pages, if they can be had
    python3 tools/prepare.py opengl           an OpenGL without a screen, to compare pictures with, if it can be had
    python3 tools/prepare.py rust             the compiler of evm/, if it can be had

Missing packages of the system are installed by apt-get, if that is there and the user is root, unless the variable
SHACKLED_NO_APT is set. Python packages are those of tools/locked, by version and hash.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from ctypes.util import find_library
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
LOCKED = ROOT / "tools" / "locked"
#: Folders with a package-lock.json.
NODE_FOLDERS = ("contracts", "web", "tests/package")

#: Browsers that the tests of pages use: their commands, and the package with them.
BROWSERS = {"chromium": ("chromium", "chromium-browser"), "firefox-esr": ("firefox-esr", "firefox")}
#: Files that OpenGL without a screen needs: libraries, Mesa, its software renderer (older and newer versions); and the
#: packages with them.
OPENGL_LIBRARIES = ("EGL", "GL", "EGL_mesa")
OPENGL_RENDERERS = ("dri/swrast_dri.so", "libgallium-*.so")
OPENGL_PACKAGES = ("libegl1", "libgl1", "libegl-mesa0", "libgl1-mesa-dri")
#: The programs that compile evm/, as tools/build_evm.py calls them, and the packages with them.
RUST = ("/usr/bin/rustc", "/usr/bin/cargo", "wasm-ld-19")
RUST_PACKAGES = ("rustc-web", "cargo-web", "rust-web-src", "lld-19")

OLDEST_PYTHON = (3, 11)
OLDEST_NODE = 20


def main() -> int:
    """Prepare what the arguments name."""
    targets = {
        "package": prepare_package,
        "dev": prepare_dev,
        "node": prepare_node,
        "browser": prepare_browser,
        "opengl": prepare_opengl,
        "rust": prepare_rust,
    }
    target, *folders = sys.argv[1:] or [""]
    if target not in targets or not {*folders} <= {*(NODE_FOLDERS if target == "node" else ())}:
        print(f"usage: python3 tools/prepare.py {'|'.join(targets)} [FOLDER]", file=sys.stderr)
        return 2
    try:
        targets[target](*folders)
    except subprocess.CalledProcessError as error:
        print(f"failed: {' '.join(map(str, error.cmd))}", file=sys.stderr)
        return 1
    return 0


def prepare_package() -> None:
    """Install the package in .venv, editable."""
    make_venv()
    say("installing the package")
    install("package")


def prepare_dev() -> None:
    """Install the package and the dependency group "dev"."""
    make_venv()
    say("installing the package and the tools of development")
    install("dev")
    (VENV / ".dev").touch()


def prepare_node(*folders: str) -> None:
    """Install node_modules of folders from their package-lock.json; without a folder, of all."""
    if not (shutil.which("node") and shutil.which("npm")):
        apt_install("Node.js and npm", "nodejs", "npm")
    check_node(subprocess.run(["node", "--version"], capture_output=True, text=True).stdout)
    folders = folders or NODE_FOLDERS
    for folder in folders:
        say(f"installing node_modules of {folder}")
        run("npm", "ci", "--no-audit", "--no-fund", "--loglevel=error", cwd=ROOT / folder)
        (ROOT / folder / "node_modules" / ".package-lock.json").touch()
    if "contracts" in folders and not (ROOT / "contracts" / "node_modules" / ".bin" / "anvil").exists():
        say("there is no anvil for this machine; tests of a real node look for one in the PATH")


def check_node(said: str) -> None:
    """Exit if Node is too old. said: the output of `node --version`, as v20.19.2."""
    major = said.strip().removeprefix("v").partition(".")[0]
    if not major.isdecimal() or int(major) < OLDEST_NODE:
        raise SystemExit(
            f"Node {OLDEST_NODE} or newer is needed, this is {said.strip() or 'of an unknown version'}: install one, "
            "for instance from nodejs.org, and put it first on the path"
        )


def prepare_browser() -> None:
    """Install Chromium and Firefox as packages of the system. Only the tests of pages need them."""
    missing = [package for package, commands in BROWSERS.items() if not any(map(shutil.which, commands))]
    if missing:
        apt_install_if_possible("tests of pages are skipped", "browsers for the tests of pages", *missing)


def prepare_opengl() -> None:
    """Install OpenGL by EGL as packages of the system. Only the tests against OpenGL need it."""
    folders = (*Path("/usr").glob("lib*"), *Path("/usr/lib").glob("*-linux-gnu"))
    has_renderer = any(list(folder.glob(name)) for folder in folders for name in OPENGL_RENDERERS)
    if not (has_renderer and all(map(find_library, OPENGL_LIBRARIES))):
        without = "the tests against OpenGL are skipped"
        apt_install_if_possible(without, "OpenGL, to compare pictures with", *OPENGL_PACKAGES)


def prepare_rust() -> None:
    """Install the compiler of evm/ as packages of the system. Only the check that builds evm.wasm again needs it."""
    if not all(map(shutil.which, RUST)):
        apt_install_if_possible("evm.wasm is not built again", "the compiler of evm/", *RUST_PACKAGES)


def make_venv() -> None:
    """Create .venv, if there is none that works."""
    if sys.version_info < OLDEST_PYTHON:
        found, needed = (".".join(map(str, v[:2])) for v in (sys.version_info, OLDEST_PYTHON))
        raise SystemExit(f"Python {needed} or newer is needed, this is {found}: make PYTHON=python{needed} ...")
    if PYTHON.exists() and subprocess.run([PYTHON, "-m", "pip", "--version"], capture_output=True).returncode == 0:
        return
    if not importlib.util.find_spec("ensurepip"):
        apt_install("the venv module of Python", f"python{sys.version_info[0]}-venv")
    say("creating .venv")
    run(sys.executable, "-m", "venv", "--clear", VENV)


def install(listed: str) -> None:
    """Install in .venv what a file of tools/locked lists, whose hashes pip compares, and the package itself."""
    pip = (PYTHON, "-m", "pip", "install", "--quiet", "--disable-pip-version-check")
    run(*pip, "--require-hashes", "--requirement", LOCKED / f"{listed}.txt")
    # what builds it is among what was installed
    run(*pip, "--no-deps", "--no-build-isolation", "--editable", ROOT)
    (VENV / ".package").touch()


def apt_install(what: str, *packages: str) -> None:
    """Install packages of the system."""
    if not shutil.which("apt-get") or os.geteuid() != 0 or os.environ.get("SHACKLED_NO_APT"):
        raise SystemExit(f"missing: {what}; install it, for instance by: sudo apt-get install {' '.join(packages)}")
    say(f"missing: {what}; installing {' '.join(packages)}")
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    run("apt-get", "update", "-qq", env=environment)
    # another program may be installing packages
    options = ("-y", "-qq", "--no-install-recommends", "-o", "DPkg::Lock::Timeout=300")
    run("apt-get", "install", *options, *packages, env=environment)


def apt_install_if_possible(without: str, what: str, *packages: str) -> None:
    """Install packages of the system, or say what happens without them."""
    try:
        apt_install(what, *packages)
    except (SystemExit, subprocess.CalledProcessError) as error:
        say(f"{without}: {error}")


def run(*command: object, cwd: Path = ROOT, env: dict[str, str] | None = None) -> None:
    """Run a command; raise CalledProcessError if it fails."""
    subprocess.run([str(part) for part in command], cwd=cwd, env=env, check=True)


def say(text: str) -> None:
    """Print a message about the progress."""
    print(f"{text} ...", flush=True)


if __name__ == "__main__":
    sys.exit(main())
