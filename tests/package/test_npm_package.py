"""The npm package for contract authors, installed and used as they do."""

from __future__ import annotations

import base64
import io
import json
import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from eth_abi.abi import decode as decode_abi
from PIL import Image as PillowImage
from tools import build_contracts, build_package
from tools.build_contracts import compile_once
from tools.examples import compile_example
from tools.ledger import World, call_data

from compiler import needs_compiler
from shackled import Image, render
from shackled.artifacts import artifact, standard_input
from shackled.cli.app import run as run_shackled
from shackled.deploy import deployments
from shackled.deploy._contract import CONTRACTS
from shackled.ethereum._encoding import to_hex
from shackled.scene import decode

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
MODULES = ROOT / "contracts" / "node_modules"
EXAMPLES = sorted((ROOT / "examples").rglob("*.sol"))
FORGE = MODULES / ".bin" / "forge"
HARDHAT = HERE / "node_modules" / "hardhat"
#: What the pragma of the sources is that compile outside.
OPEN = "pragma solidity ^0.8.25;"
TOKEN, DEGREES = 3, -25

pytestmark = [
    pytest.mark.skipif(not shutil.which("npm"), reason="npm is not installed"),
    needs_compiler,
]


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder where the packed file is installed, and the libraries of the examples."""
    folder = tmp_path_factory.mktemp("package")
    build_package.build(folder / "npm")
    run("npm", "pack", "--silent", "--pack-destination", folder, cwd=folder / "npm")
    project = folder / "project"
    project.mkdir()
    (project / "package.json").write_text('{"private": true}')
    run("npm", "install", "--silent", "--offline", next(folder.glob("*.tgz")), cwd=project)
    modules = project / "node_modules"
    assert [path.name for path in modules.glob("[!.]*")] == ["shackled-contracts"]
    for library, sources in (("erc721a", "contracts"), ("solady", "src/utils")):
        shutil.copytree(MODULES / library / sources, modules / library / sources)
        shutil.copy(MODULES / library / "package.json", modules / library)
    return project


@pytest.fixture
def project(installed: Path, tmp_path: Path) -> Path:
    """The like of it for each test."""
    return shutil.copytree(installed, tmp_path / "project", symlinks=True)


@pytest.fixture(scope="module")
def town() -> Image:
    """The picture of a token of the examples, by Python."""
    return drawn("tokens/SkylineToken.sol", "town(uint256)", ["Studio"], TOKEN)


@pytest.fixture(scope="module")
def tetrahedron() -> Image:
    return drawn("call_from_contract/Tetrahedron.sol", "scene(int256)", ["Renderer", "PngEncoder"], DEGREES)


def drawn(example: str, function: str, contracts: list[str], value: int) -> Image:
    """Render the scene that a contract returns."""
    world = World()
    creation, _ = compile_example(f"examples/{example}")
    arguments = b"".join(world.address(name).rjust(32, b"\0") for name in contracts)
    scene = world.run(world.deploy(creation, arguments), call_data(function, value))
    return render(decode(artifact("Renderer").selectors["render"] + scene))


def run(*command: str | Path, cwd: Path, succeeds: bool = True, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"HARDHAT_DISABLE_TELEMETRY_PROMPT": "true"} | variables
    done = subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True)
    assert succeeds == (done.returncode == 0), done.stdout + done.stderr
    return done


def signatures(abi: list[dict[str, Any]]) -> set[tuple[str, ...]]:
    """Each entry without names of parameters."""

    def types(parameters: list[dict[str, Any]]) -> str:
        parts = (types(p["components"]) + p["type"][5:] if "components" in p else p["type"] for p in parameters)
        return f"({','.join(parts)})"

    return {
        (e["type"], e["name"], types(e["inputs"]), types(e.get("outputs", [])), e.get("stateMutability", ""))
        for e in abi
        if e["type"] != "constructor"
    }


def open_sources() -> dict[str, str]:
    """Return the sources that compile outside, by path."""
    folder = build_contracts.SOURCES
    found = {path.relative_to(folder).as_posix(): path.read_text("utf-8") for path in folder.rglob("*.sol")}
    return {name: text for name, text in found.items() if OPEN in text}


def constants(name: str) -> dict[str, str]:
    text = (build_contracts.SOURCES / name).read_text("utf-8")
    return dict(re.findall(r"^uint256 constant (\w+) = (\w+);", text, re.M))


@pytest.mark.parametrize("optimized", [False, True])
def test_sources_compile_with_default_settings(optimized: bool) -> None:
    """Those of Hardhat 2 have the oldest EVM. The interfaces have all functions, events and errors of the contracts."""
    sources = open_sources()
    # none imports another
    assert build_contracts.follow_imports(sources) == sources
    assert not [name for name in sources if name.startswith(("pipeline/", "uniforms/")) or "Engine" in name]
    numbers = constants("words/Records.sol")
    kept = constants("scene/Extensions.sol") | constants("effects/EffectRecords.sol")
    assert numbers
    assert kept
    assert not numbers.keys() & kept.keys(), "a number of the records stands twice"
    settings = {"evmVersion": "paris", "optimizer": {"enabled": optimized}}
    selection = {name: {"*": ["abi", "evm.bytecode.object"]} for name in sources}
    request = build_contracts.request(sources, settings, selection)
    output = compile_once(request)
    made = {name: each for path in output if path.startswith("interfaces/") for name, each in output[path].items()}
    described = [name for name in CONTRACTS if f"I{name}" in made]
    assert len(described) == 8
    for name in described:
        assert signatures(made[f"I{name}"]["abi"]) == signatures(artifact(name).abi), name


def test_javascript(project: Path) -> None:
    """Addresses and ABIs in JavaScript, their types, artifacts that other tools read, and inputs of the compiler."""
    assert build_package.ADDRESSES.read_text() == build_package.addresses(deployments(CONTRACTS))
    script = """
        const { contracts } = require("shackled-contracts");
        const { bytecode } = require("shackled-contracts/artifacts/Studio.json");
        const { standardInput } = require("shackled-contracts/verify");
        const inputs = process.argv.slice(1).map(standardInput);
        console.log(JSON.stringify([contracts.Studio, Object.keys(contracts), bytecode, inputs]));
    """
    said = run("node", "-e", script, *build_package.PACKED, cwd=project)
    studio, names, bytecode, inputs = json.loads(said.stdout)
    assert studio["abi"] == artifact("Studio").abi
    assert bytecode == to_hex(artifact("Studio").creation)
    assert sorted(names) == sorted(CONTRACTS)
    # the package has all that its bytecode is made of; one small contract is compiled
    assert inputs == [standard_input(artifact(name).group) for name in build_package.PACKED]
    installed = project / "node_modules" / "shackled-contracts"
    command = run("node", installed / "verify.js", "PngEncoder", cwd=project)
    packed = json.loads((installed / "artifacts" / "PngEncoder.json").read_text())
    made = compile_once(json.loads(command.stdout))["encode/PngEncoder.sol"]["PngEncoder"]
    assert "0x" + made["evm"]["bytecode"]["object"] == packed["bytecode"]
    wrong = run("node", installed / "verify.js", "toString", cwd=project, succeeds=False)
    assert (wrong.stdout, wrong.stderr) == ("", "there is no contract toString: give a name such as Studio\n")
    (project / "use.ts").write_text("""
        import { contracts } from "shackled-contracts";
        import { shackled } from "shackled-contracts/hardhat";
        const address: `0x${string}` = contracts.Studio.address;
        const kind: "constructor" = contracts.Renderer.abi[0].type;
        export const placed = async (provider: { request(_: object): Promise<unknown> }) =>
            (await shackled(provider)).Renderer.address satisfies typeof contracts.Renderer.address;
        // @ts-expect-error no such contract
        contracts.Nothing;
        console.log(address, kind);
    """)
    compiler = ROOT / "web" / "node_modules" / "typescript" / "bin" / "tsc"
    if not compiler.is_file():
        pytest.skip("the compiler of TypeScript is not installed: npm ci in web/")
    run("node", compiler, "--noEmit", "--strict", "--module", "nodenext", "--types", "", "use.ts", cwd=project)


@pytest.mark.skipif(not FORGE.exists(), reason="forge is not installed: python tools/prepare.py node")
def test_foundry_project(project: Path, town: Image, tetrahedron: Image) -> None:
    for path in EXAMPLES:
        (project / "src").mkdir(exist_ok=True)
        shutil.copy(path, project / "src")
    (project / "test").mkdir()
    shutil.copy(HERE / "Pictures.t.sol", project / "test")
    house, test = re.findall(r"^```solidity\n(.*?)^```$", build_package.README.read_text("utf-8"), re.M | re.S)
    (project / "src" / "House.sol").write_text(house)
    (project / "test" / "House.t.sol").write_text(test)
    use_compiler(project)
    result = run(FORGE, "test", "-vv", "--offline", cwd=project)
    said = {name: bytes.fromhex(value) for name, value in re.findall(r"^  (\w+): 0x([0-9a-f]+)$", result.stdout, re.M)}
    assert said["bitmap"] == town.bmp
    check_png(said["png"], town, 1)
    uri = re.search(r"^  (data:image/png;base64,.*)$", result.stdout, re.M)
    assert uri
    with PillowImage.open(io.BytesIO(from_uri(uri[1]))) as shown:
        assert shown.size == (512, 512)
    check_png(from_uri(said["uri"].decode()), tetrahedron, 4)


@pytest.mark.skipif(not FORGE.exists(), reason="forge is not installed: python tools/prepare.py node")
def test_the_tutorial(project: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """The contract of the page, in a project of Foundry; its preview command finds nothing wrong with 16 tokens.

    Among them is the dearest of the 256, number 51.
    """
    page = (ROOT / "docs" / "token-tutorial.md").read_text("utf-8")
    files = dict(re.findall(r"^([\w./]+):\n\n```\w*\n(.*?)^```$", page, re.M | re.S))
    assert sorted(files) == ["remappings.txt", "src/Totems.sol"]
    assert len(files["src/Totems.sol"].splitlines()) <= 45
    for name, text in files.items():
        (project / name).parent.mkdir(exist_ok=True)
        (project / name).write_text(text)
    use_compiler(project)
    monkeypatch.setenv("PATH", f"{FORGE.parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.chdir(project)
    command = re.search(r"^shackled (preview .*--check)$", page, re.M)
    assert command
    arguments = [*shlex.split(command[1]), "--first", "40", "--tokens", "16"]
    assert run_shackled(arguments) == 0, capsys.readouterr().err
    assert "Totems.tokenURI: 16 tokens" in capsys.readouterr().out


@pytest.mark.skipif(not HARDHAT.is_dir(), reason="Hardhat is not installed: python tools/prepare.py node")
def test_hardhat_project(project: Path, tetrahedron: Image) -> None:
    (project / "contracts").mkdir()
    for path in EXAMPLES:
        shutil.copy(path, project / "contracts")
    (project / "node_modules" / "hardhat").symlink_to(HARDHAT)
    shutil.copy(HERE / "hardhat.config.js", project)
    (project / "test").mkdir()
    shutil.copy(HERE / "pictures.js", project / "test")
    call = to_hex(call_data("image(int256)", DEGREES))
    result = run("node", HARDHAT / "internal" / "cli" / "bootstrap.js", "test", cwd=project, CALL=call)
    answer = re.search(r"image: 0x([0-9a-f]+)", result.stdout)
    assert answer
    (uri,) = decode_abi(["string"], bytes.fromhex(answer[1]))
    check_png(from_uri(uri), tetrahedron, 4)


def use_compiler(project: Path) -> None:
    """Set the compiler of npm in place of the one that forge downloads; all other settings are the defaults.

    It is called as forge calls a compiler, and reads and writes files only.
    """
    command = project / "solc.sh"
    command.write_text(f"""#!/bin/sh
case " $* " in *" --standard-json "*) set -- --standard-json ;; esac
cat > {project}/solc.in
node {MODULES}/solc/solc.js "$@" < {project}/solc.in > {project}/solc.out || exit $?
sed -n '/^[{{0-9]/,$p' {project}/solc.out
""")
    command.chmod(0o755)
    (project / "foundry.toml").write_text(f'[profile.default]\nsolc = "{command}"\n')


def from_uri(uri: str) -> bytes:
    return base64.b64decode(uri.removeprefix("data:image/png;base64,"), validate=True)


def check_png(png: bytes, image: Image, scale: int) -> None:
    with PillowImage.open(io.BytesIO(png)) as opened:
        assert np.array_equal(np.asarray(opened), image.pixels.repeat(scale, 0).repeat(scale, 1))
