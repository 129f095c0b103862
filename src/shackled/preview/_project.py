"""The project of a contract: its folder, its compiler, and what the compiler makes of one file."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..ethereum._encoding import keccak256

#: Files in the folder of a project, the most telling first.
MARKS = ("foundry.toml", "hardhat.config.js", "hardhat.config.ts", "hardhat.config.cjs", "remappings.txt")
#: Folders whose sources are not the author's: directly below the project, and anywhere.
FOREIGN = {"out", "cache", "artifacts", "lib"}
HIDDEN = {"node_modules", ".git"}
#: Seconds that a compiler may take.
PATIENCE = 600
#: Of the compiler of a file without a project.
SETTINGS = {"evmVersion": "cancun", "optimizer": {"enabled": True, "runs": 200}}
#: A line that begins as those in which compilers say that they failed. The forge of npm ends with 0 all the same.
FAILED = re.compile(r"^(?:\w*Error(?: [^:\n]{1,20})?:|Compiler run failed)", re.MULTILINE)
INSTALL = (
    "no compiler was found: install Foundry (forge), put solc on the PATH, or run `npm install solc` in the project"
)


class CompilerError(InputError):
    """A source does not compile. said: what the compiler says, in lines."""

    def __init__(self, source: Path, said: str) -> None:
        super().__init__(f"{source.name} does not compile")
        self.said = said


@dataclass(frozen=True)
class Compiled:
    """A contract. abi: its entries. creation: its creation code, without arguments."""

    name: str
    abi: list[dict[str, Any]]
    creation: bytes


#: What a tool wrote: its file, the contract, the document, and the hashes of its sources.
Artifact = tuple[Path, str, dict[str, Any], dict[str, str]]


class Project:
    """A source file, and the project around it."""

    def __init__(self, source: Path) -> None:
        """Take the file of the contract. InputError if it cannot be read."""
        if source.suffix != ".sol":
            raise InputError(f"the contract must be a Solidity file such as Token.sol, not {source}")
        if not source.is_file():
            raise InputError(f"there is no file {source}")
        self.source = source.resolve()
        parents = self.source.parents
        marked = [folder for folder in parents if any((folder / mark).is_file() for mark in MARKS)]
        installed = [folder for folder in parents if (folder / "node_modules").is_dir()]
        self.root = (marked + installed + [self.source.parent])[0]

    def compile(self) -> list[Compiled]:
        """Return the contracts of the file, without abstract ones. CompilerError if it does not compile."""
        if (self.root / "foundry.toml").is_file():
            return self._by_forge()
        if any((self.root / mark).is_file() for mark in MARKS[1:4]):
            return self._by_hardhat()
        return self._by_solc()

    def stamps(self) -> dict[Path, int]:
        """Return when each source of the project was changed last, to notice changes."""
        found = {}
        for path in [self.source, *_sources(self.root)]:
            try:
                found[path] = path.stat().st_mtime_ns
            except OSError:
                continue
        return found

    @property
    def _name(self) -> str:
        """The file as the project names it."""
        return self.source.relative_to(self.root).as_posix()

    def _command(self, otherwise: str, *names: str) -> str:
        """Return the first of some commands that the project or the machine has. InputError, `otherwise`, if none."""
        folders = [folder / "node_modules" / ".bin" for folder in (self.root, *self.root.parents)]
        for name in names:
            found = shutil.which(name, path=os.pathsep.join(map(str, folders))) or shutil.which(name)
            if found:
                return found
        raise InputError(otherwise)

    def _run_compiler(self, command: list[str]) -> None:
        """Run a compiler that writes files. CompilerError with what it says if it fails, or says that it failed."""
        said = self._run(command)
        if said.returncode or FAILED.search(said.stdout):
            raise CompilerError(self.source, _shown(said))

    def _by_forge(self) -> list[Compiled]:
        """Compile with Foundry. Of files of one name, it puts those of one into a further folder."""
        forge = self._command(f"{self.root} is a project of Foundry, but there is no forge: install Foundry", "forge")
        said = self._run([forge, "config", "--json"])
        try:
            output = self.root / str(json.loads(said.stdout)["out"])
        except (ValueError, KeyError):
            raise InputError(f"foundry.toml cannot be read: {_shown(said)}") from None
        self._run_compiler([forge, "build", self._name, "--color", "never"])
        found: list[Artifact] = []
        # the newest last: what other versions of the compiler left is older
        for path in sorted(output.glob(f"**/{self.source.name}/*.json"), key=lambda each: each.stat().st_mtime_ns):
            built = _json(path)
            metadata = built.get("metadata") or {}
            target = metadata.get("settings", {}).get("compilationTarget", {self._name: path.stem})
            if self._name in target:
                hashes = {name: each["keccak256"] for name, each in metadata.get("sources", {}).items()}
                found.append((path, target[self._name], built, hashes))
        return self._current(found, "forge", output, "run `forge build --force`, and mend what it reports")

    def _by_hardhat(self) -> list[Compiled]:
        absent = f"{self.root} is a project of Hardhat, but it is not installed: run npm install there"
        self._run_compiler([self._command(absent, "hardhat"), "compile"])
        output = self.root / "artifacts"
        paths = [each for each in sorted((output / self._name).glob("*.json")) if not each.name.endswith(".dbg.json")]
        builds = [(path, _json(path)) for path in paths]
        found = [(path, path.stem, built, self._given_by_hardhat(path, built)) for path, built in builds]
        return self._current(found, "hardhat", output, "leave `paths.artifacts` at its default")

    def _given_by_hardhat(self, path: Path, built: dict[str, Any]) -> dict[str, str]:
        """Return the hash of the source that Hardhat gave to the compiler for an artifact; none if it kept nothing."""
        build = self.root / "artifacts" / "build-info" / f"{built.get('buildInfoId')}.json"
        # Hardhat 2 names it in a further file
        debug = path.with_suffix(".dbg.json")
        build = path.parent / str(_json(debug).get("buildInfo")) if debug.is_file() else build
        sources = _json(build).get("input", {}).get("sources", {}) if build.is_file() else {}
        source = sources.get(built.get("inputSourceName", built.get("sourceName")))
        return {self._name: _hash(source["content"].encode())} if source else {}

    def _current(self, artifacts: list[Artifact], tool: str, output: Path, remedy: str) -> list[Compiled]:
        """Return the contracts with code. InputError, with the remedy, if none was made of the sources as they are."""
        built = {}
        otherwise = f"{tool} wrote no contract of {self._name} to {output}"
        for path, name, each, hashes in artifacts:
            changed = self._changed(hashes)
            if changed is None:
                built[name] = each.get("abi", []), each.get("bytecode", "")
            else:
                otherwise = f"{path} was not made of {changed} as it is now"
        if not built:
            raise InputError(f"{otherwise}: {remedy}")
        return _compiled(built)

    def _changed(self, hashes: Mapping[str, str]) -> str | None:
        """Return a source below the project that has not this hash, by its name; None if there is none."""
        for name, expected in hashes.items():
            path = self.root / name
            if path.is_file():
                content = path.read_bytes()
                # forge compiles with the ends of lines of Unix
                if expected not in (_hash(content), _hash(content.replace(b"\r\n", b"\n"))):
                    return name
        return None

    def _by_solc(self) -> list[Compiled]:
        """Compile with solc, the program or the package of npm."""
        compiler = self._command(INSTALL, "solc", "solcjs")
        remappings = self.root / "remappings.txt"
        settings: dict[str, Any] = SETTINGS | {
            "remappings": _text(remappings).split() if remappings.is_file() else [],
            "outputSelection": {self._name: {"*": ["abi", "evm.bytecode.object"]}},
        }
        sources = {self._name: {"content": _text(self.source)}}
        request = {"language": "Solidity", "sources": sources, "settings": settings}
        modules = self.root / "node_modules"
        places = ["--base-path", str(self.root), *(("--include-path", str(modules)) if modules.is_dir() else ())]
        said = self._run([compiler, "--standard-json", *places], json.dumps(request))
        try:
            result = json.loads(said.stdout[said.stdout.index("{") :])
        except ValueError:
            raise CompilerError(self.source, _shown(said)) from None
        faults = [each["formattedMessage"] for each in result.get("errors", []) if each["severity"] == "error"]
        if faults or said.returncode:
            raise CompilerError(self.source, "\n".join(faults).strip() or _shown(said))
        made = result.get("contracts", {}).get(self._name, {}).items()
        return _compiled({name: (each["abi"], each["evm"]["bytecode"]) for name, each in made})

    def _run(self, command: list[str], given: str = "") -> subprocess.CompletedProcess[str]:
        """Run a command. Input and output are files, since solc of npm cuts off what it writes to a pipe."""
        with tempfile.TemporaryFile("w+") as stdin, tempfile.TemporaryFile("w+", errors="replace") as stdout:
            stdin.write(given)
            stdin.seek(0)
            environment = os.environ | {"NO_COLOR": "1", "HARDHAT_DISABLE_TELEMETRY_PROMPT": "true"}
            try:
                code = subprocess.run(
                    command,
                    stdin=stdin,
                    stdout=stdout,
                    stderr=subprocess.STDOUT,
                    cwd=self.root,
                    timeout=PATIENCE,
                    env=environment,
                ).returncode
            except subprocess.TimeoutExpired:
                raise InputError(f"{Path(command[0]).name} took more than {PATIENCE} seconds, and was ended") from None
            except OSError as error:
                raise InputError(f"{command[0]} cannot be run: {error.strerror}") from None
            stdout.seek(0)
            return subprocess.CompletedProcess(command, code, stdout.read(), "")


def _sources(folder: Path) -> Iterator[Path]:
    """Yield the sources below a folder that the author may change."""
    for here, folders, files in os.walk(folder):
        left_out = HIDDEN | FOREIGN if Path(here) == folder else HIDDEN
        folders[:] = [name for name in folders if name not in left_out]
        yield from (Path(here, name) for name in files if name.endswith(".sol") or name in MARKS)


def _text(path: Path) -> str:
    """Return the text of a file. InputError if it cannot be read."""
    try:
        content = path.read_bytes()
        return content.decode()
    except OSError as error:
        raise InputError(f"{path.name} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InputError(f"{path.name} cannot be read: not UTF-8 at line {line}") from None


def _json(path: Path) -> dict[str, Any]:
    """Return the object in a file that a compiler wrote. InputError if it is damaged."""
    try:
        found = json.loads(_text(path))
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        found = None
    if not isinstance(found, dict):
        raise InputError(f"{path} is not what a compiler writes: delete it")
    return found


def _hash(content: bytes) -> str:
    return f"0x{keccak256(content).hex()}"


def _compiled(built: Mapping[str, tuple[list[dict[str, Any]], Any]]) -> list[Compiled]:
    """Return the contracts with code, given ABI and bytecode of each, which tools write as text or in an object."""
    found = []
    for name, (abi, bytecode) in built.items():
        digits = str(bytecode.get("object", "") if isinstance(bytecode, dict) else bytecode).removeprefix("0x")
        if not re.fullmatch("[0-9a-fA-F]*", digits):
            raise InputError(f"{name} needs external libraries, which the preview does not link: make them internal")
        if digits:
            found.append(Compiled(name, abi, bytes.fromhex(digits)))
    return found


def _shown(said: subprocess.CompletedProcess[str]) -> str:
    """Return what a compiler says, without the places in its own program, or that it says nothing."""
    text = "\n".join(line for line in said.stdout.splitlines() if not line.startswith("    at ")).strip()
    return text or f"{Path(said.args[0]).name} failed, and says nothing (exit code {said.returncode})"
