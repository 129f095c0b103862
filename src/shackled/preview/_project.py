"""The project of a contract: its folder, its compiler, and what the compiler makes of one file."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..ethereum import keccak256

#: Files in the folder of a project, the most telling first.
MARKS = ("foundry.toml", "hardhat.config.js", "hardhat.config.ts", "hardhat.config.cjs", "remappings.txt")
#: Folders whose sources are not the author's: directly below the project, and anywhere.
FOREIGN = {"out", "cache", "artifacts", "lib"}
HIDDEN = {"node_modules", ".git"}
#: Seconds that a compiler may take.
PATIENCE = 600
#: Of the compiler of a file without a project.
SETTINGS = {"evmVersion": "cancun", "optimizer": {"enabled": True, "runs": 200}}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
#: A line that begins as those in which compilers say that they failed. The forge of npm ends with 0 all the same.
FAILED = re.compile(r"^(?:\w*Error(?: [^:\n]{1,20})?:|Compiler run failed)", re.MULTILINE)
INSTALL = (
    "no compiler was found: install Foundry (forge), put solc on the PATH, or run `npm install solc` in the project"
)


class CompilerError(InputError):
    """A source does not compile. said: what the compiler says, in lines."""

    def __init__(self, source: Path, said: str) -> None:
        """Take the source and the words of the compiler."""
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
            forge = self._command("forge")
            if forge is None:
                raise InputError(f"{self.root} is a project of Foundry, but there is no forge: install Foundry")
            output = self._forge_output(forge)
            self._run_compiler([str(forge), "build", self._name, "--color", "never"])
            return self._made_by_forge(output)
        if any((self.root / mark).is_file() for mark in MARKS[1:4]):
            hardhat = self._command("hardhat")
            if hardhat is None:
                raise InputError(f"{self.root} is a project of Hardhat, but it is not installed: run npm install there")
            self._run_compiler([str(hardhat), "compile"])
            return self._made_by_hardhat(self.root / "artifacts")
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

    def _command(self, name: str) -> Path | None:
        """Return a command of the project or of the machine."""
        folders = [folder / "node_modules" / ".bin" for folder in (self.root, *self.root.parents)]
        found = shutil.which(name, path=os.pathsep.join(map(str, folders))) or shutil.which(name)
        return Path(found) if found else None

    def _forge_output(self, forge: Path) -> Path:
        """Return the folder where forge writes what it makes."""
        said = self._run([str(forge), "config", "--json"])
        try:
            return self.root / str(json.loads(said.stdout)["out"])
        except (ValueError, KeyError):
            raise InputError(f"foundry.toml cannot be read: {_shown(said)}") from None

    def _run_compiler(self, command: list[str]) -> None:
        """Run a compiler that writes files. CompilerError with what it says if it fails, or says that it failed."""
        said = self._run(command)
        if not said.returncode and not FAILED.search(said.stdout):
            return
        absent = re.search("Failed to install solc.*", said.stdout)
        if absent:
            raise InputError(f"forge has no compiler: {absent[0]}")
        raise CompilerError(self.source, _shown(said))

    def _made_by_forge(self, output: Path) -> list[Compiled]:
        """Return the contracts of the file. Of files of one name, forge puts those of one into a further folder."""

        def found() -> Iterator[Artifact]:
            # what an earlier name of a contract left, and other versions of the compiler, are older
            for path in sorted(output.glob(f"**/{self.source.name}/*.json"), key=lambda each: each.stat().st_mtime_ns):
                built = _json(path)
                metadata = built.get("metadata") or {}
                target = metadata.get("settings", {}).get("compilationTarget", {self._name: path.stem})
                if self._name in target:
                    yield path, target[self._name], built, _hashes(metadata)

        nothing = f"forge wrote no contract of {self._name} to {output}"
        return self._deployable(found(), nothing, "run `forge build --force`, and mend what it reports")

    def _made_by_hardhat(self, output: Path) -> list[Compiled]:
        """Return the contracts of the file."""
        paths = [each for each in sorted((output / self._name).glob("*.json")) if not each.name.endswith(".dbg.json")]
        builds = [(path, _json(path)) for path in paths]
        found = [(path, path.stem, built, self._hashes_of_hardhat(path, built)) for path, built in builds]
        remedy = "leave `paths.artifacts` at its default"
        return self._deployable(found, f"hardhat wrote no contract of {self._name} to {output}: {remedy}", remedy)

    def _hashes_of_hardhat(self, path: Path, built: dict[str, Any]) -> dict[str, str]:
        """Return the hashes of the sources of an artifact, by the files of the compiler that Hardhat keeps."""
        debug = path.with_suffix(".dbg.json")
        if debug.is_file():
            kept = path.parent / str(_json(debug).get("buildInfo"))
        else:
            kept = self.root / "artifacts" / "build-info" / f"{built.get('buildInfoId')}.json"
        name = built.get("inputSourceName", built.get("sourceName"))
        # Hardhat 3 writes the output into a file of its own
        build: dict[str, Any] = {}
        for each in (kept, kept.with_suffix(".output.json")):
            build |= _json(each) if each.is_file() else {}
        metadata = build.get("output", {}).get("contracts", {}).get(name, {}).get(path.stem, {}).get("metadata")
        if metadata:
            return _hashes(json.loads(metadata), "project/")
        content = build.get("input", {}).get("sources", {}).get(name, {}).get("content")
        return {} if content is None else {self._name: "0x" + keccak256(content.encode()).hex()}

    def _deployable(self, artifacts: Iterable[Artifact], otherwise: str, remedy: str) -> list[Compiled]:
        """Return the contracts that are in the source and have code.

        InputError if none is in it, `otherwise`, or if what is there was made of other sources, with the remedy.
        """
        built: dict[str, dict[str, Any]] = {}
        for path, name, each, hashes in artifacts:
            changed = changed_source(self.root, hashes, path, self._name)
            if changed is None:
                built[name] = each
            else:
                otherwise = f"{path} was not made of {changed} as it is now: {remedy}"
        code = COMMENT.sub(" ", _text(self.source))
        known = {name: each for name, each in built.items() if re.search(rf"\b{re.escape(name)}\b", code)}
        if not known and re.search(r"\bcontract\b", code):
            raise InputError(otherwise)
        return _compiled(
            {name: (each["abi"], each.get("bytecode", "")) for name, each in known.items() if "abi" in each}
        )

    def _by_solc(self) -> list[Compiled]:
        """Compile with solc, the program or the package of npm."""
        compiler = shutil.which("solc")
        command = [compiler] if compiler else self._solc_of_npm()
        remappings = self.root / "remappings.txt"
        settings: dict[str, Any] = SETTINGS | {
            "remappings": _text(remappings).split() if remappings.is_file() else [],
            "outputSelection": {self._name: {"*": ["abi", "evm.bytecode.object"]}},
        }
        sources = {self._name: {"content": _text(self.source)}}
        request = {"language": "Solidity", "sources": sources, "settings": settings}
        modules = self.root / "node_modules"
        places = ["--base-path", str(self.root), *(("--include-path", str(modules)) if modules.is_dir() else ())]
        said = self._run([*command, "--standard-json", *places], json.dumps(request))
        try:
            result = json.loads(said.stdout[said.stdout.index("{") :])
        except ValueError:
            raise CompilerError(self.source, _shown(said)) from None
        faults = [each["formattedMessage"] for each in result.get("errors", []) if each["severity"] == "error"]
        if faults or said.returncode:
            raise CompilerError(self.source, "\n".join(faults).strip() or _shown(said))
        made = result.get("contracts", {}).get(self._name, {}).items()
        return _compiled({name: (each["abi"], each["evm"]["bytecode"]) for name, each in made})

    def _solc_of_npm(self) -> list[str]:
        node = shutil.which("node")
        for folder in (self.root, *self.root.parents):
            script = folder / "node_modules" / "solc" / "solc.js"
            if node and script.is_file():
                return [node, str(script)]
        raise InputError(INSTALL)

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


def _hashes(metadata: dict[str, Any], folder: str = "") -> dict[str, str]:
    """Return the hashes of the sources in the metadata of a compiler. folder: what it calls that of the project."""
    return {name.removeprefix(folder): each["keccak256"] for name, each in metadata.get("sources", {}).items()}


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


def changed_source(root: Path, hashes: Mapping[str, str], artifact: Path, source: str) -> str | None:
    """Return the name of a source that an artifact was not made of as it is now; None if there is none.

    root: folder of the project, below which sources are named. hashes: Keccak-256 of each source as it was compiled, by
    its name; they decide. Where that of `source`, the file of the contract, is missing, the times of the files decide.
    Sources that are not below the project are not compared.
    """
    for name, expected in hashes.items():
        path = root / name
        if path.is_file():
            content = path.read_bytes()
            # forge compiles with the ends of lines of Unix
            if expected not in {f"0x{keccak256(each).hex()}" for each in (content, content.replace(b"\r\n", b"\n"))}:
                return name
    is_older = source not in hashes and artifact.stat().st_mtime_ns < (root / source).stat().st_mtime_ns
    return source if is_older else None
