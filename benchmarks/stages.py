"""Where the gas goes.

    python -m benchmarks.stages FILE ...     any mesh or scene file

Runs the deployed code in py-evm and charges each instruction's gas to the stage whose source it comes from, by the
compiler's source map. Mathematics and the like, which all stages use, is charged to the stage that was at work. Needs
Node, the packages of contracts/, and py-evm.
"""

from __future__ import annotations

import json
import shutil
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any

from tools import build_contracts

from shackled import Scene, load
from shackled.artifacts import artifact
from shackled.chain.embedded import PyEvmChain

from . import shared
from .floor import floor_of
from .scenes import staged_teapot
from .table import Section, millions, table
from .workload import workload_of

TITLE = "Where the gas goes"

SETUP, ROWS = "triangle set-up", "rows of plain triangles"
SHADING, LIGHTING = "shading set-up", "lighting set-up"
REST = "calls, bands, memory"

#: The stage of each source; of the two that belong to two stages, that of most functions. Others serve all stages.
SOURCES = {
    "scene/Checks.sol": "checks",
    "pipeline/View.sol": "vertex shader",
    "pipeline/VertexShader.sol": "vertex shader",
    "pipeline/PrimitiveAssembly.sol": "primitive assembly",
    "pipeline/Clipper.sol": "primitive assembly",
    "pipeline/Shading.sol": SHADING,
    "pipeline/Lighting.sol": LIGHTING,
    "pipeline/Rasterizer.sol": SETUP,
    "pipeline/Wireframe.sol": ROWS,
    "pipeline/FragmentShader.sol": "fragment shader",
    "pipeline/Compositor.sol": "compositor",
    "encode/Bmp.sol": "encoding",
    "encode/Base64.sol": "encoding",
    "encode/Svg.sol": "encoding",
    "encode/Text.sol": "encoding",
    "pipeline/Pipeline.sol": REST,
    "Engine.sol": REST,
    "Renderer.sol": REST,
}
FUNCTIONS = {
    ("pipeline/Rasterizer.sol", "rows"): ROWS,
    ("pipeline/Lighting.sol", "setFace"): SHADING,
    ("pipeline/Lighting.sol", "setFaceNormal"): SHADING,
    ("pipeline/Lighting.sol", "facePointLight"): SHADING,
}
STAGES = (
    "checks",
    "vertex shader",
    "primitive assembly",
    LIGHTING,
    SHADING,
    SETUP,
    ROWS,
    "fragment shader",
    "compositor",
    "encoding",
    REST,
)

CONTRACTS = ("Engine", "Renderer")


def missing() -> str | None:
    """What this needs and does not find, if anything."""
    if shutil.which("node") is None:
        return "Node"
    if not build_contracts.LIBRARIES.is_dir():
        return "`npm ci` in contracts/"
    return None if find_spec("eth") else "py-evm"


def gas_by_stage(scene: Scene) -> dict[str, int]:
    """Execution gas of a render, by stage; stages that need none are there with 0."""
    chain = _Profiler(stage_maps())
    drawn = chain.draw(scene)
    assert chain.costs.total() == drawn.gas
    return {stage: chain.costs[stage] for stage in STAGES}


@cache
def stage_maps() -> dict[str, dict[int, str]]:
    """For each contract the stage of every instruction, by its place in the code; none where it serves all stages."""
    request = json.loads(build_contracts.ARTIFACTS.joinpath(build_contracts.STANDARD_INPUT).read_text("utf-8"))
    wanted = ["evm.deployedBytecode.object", "evm.deployedBytecode.sourceMap"]
    selection = {f"{name}.sol": {name: wanted} for name in CONTRACTS}
    request["settings"]["outputSelection"] = selection | {"*": {"": ["ast"]}}
    answer = build_contracts.run_compiler(json.dumps(request))
    sources = {source["id"]: (name, _functions(source["ast"])) for name, source in answer["sources"].items()}
    maps = {}
    for name in CONTRACTS:
        output = answer["contracts"][f"{name}.sol"][name]["evm"]["deployedBytecode"]
        if bytes.fromhex(output["object"]) != artifact(name).runtime:
            raise SystemExit(f"{name}.json is not what its sources give: run tools/build_contracts.py")
        maps[name] = _stage_map(bytes.fromhex(output["object"]), output["sourceMap"], sources)
    return maps


@dataclass(frozen=True)
class _Function:
    name: str
    begin: int
    end: int


def _functions(node: Any) -> list[_Function]:
    """The functions in a syntax tree, with their places in the source."""
    if isinstance(node, list):
        return [function for each in node for function in _functions(each)]
    if not isinstance(node, dict):
        return []
    if node.get("nodeType") == "FunctionDefinition":
        begin, length, _ = map(int, node["src"].split(":"))
        return [_Function(node["name"], begin, begin + length)]
    return [function for value in node.values() for function in _functions(value)]


def _stage_map(code: bytes, source_map: str, sources: dict[int, tuple[str, list[_Function]]]) -> dict[int, str]:
    stages = {}
    place = 0
    fields = ["0", "0", "-1"]
    for entry in source_map.split(";"):
        # begin:length:source:..., each as in the entry before if it is empty
        for i, field in enumerate(entry.split(":")[:3]):
            fields[i] = field or fields[i]
        begin, length, source = map(int, fields)
        if source in sources:
            name, functions = sources[source]
            inside = (f.name for f in functions if f.begin <= begin and begin + length <= f.end)
            function = next(inside, None)
            # what has no function of its own is the compiler's, for instance reading the ABI
            stage = None if function is None else FUNCTIONS.get((name, function), SOURCES.get(name))
            if stage is not None:
                stages[place] = stage
        place += 1 + max(0, code[place] - 0x5F if code[place] <= 0x7F else 0)
        if place >= len(code):
            break
    return stages


class _Profiler(PyEvmChain):
    """Charges gas to stages."""

    def __init__(self, maps: dict[str, dict[int, str]]) -> None:
        super().__init__()
        self.costs: Counter[str] = Counter()
        self._stages = {self.address(name): stages for name, stages in maps.items()}

    def _state(self) -> Any:
        state = super()._state()
        self.costs = Counter()
        self._now, self._charged = REST, 0
        base = state.computation_class
        opcodes = {number: self._charging(opcode) for number, opcode in base.opcodes.items()}
        state.computation_class = type("ProfiledComputation", (base,), {"opcodes": opcodes})
        return state

    def _charging(self, opcode: Callable[..., None]) -> Callable[..., None]:
        def charge(computation: Any) -> None:
            meter, charged = computation._gas_meter, self._charged
            place = computation.code.program_counter - 1
            stages = getattr(self, "_stages", {}).get(computation.msg.code_address, {})
            stage = self._now = stages.get(place, self._now)
            before = meter.gas_remaining
            try:
                opcode(computation)
            finally:
                # a call has been charged for already by what it called
                gas = before - meter.gas_remaining - (self._charged - charged)
                self.costs[stage] += gas
                self._charged += gas
                self._now = stage

        return charge


def section() -> Section:
    """The table of some scenes."""
    lack = missing()
    if lack is not None:
        return Section(TITLE, f"skipped: needs {lack}", {})
    return report(_examples())


def report(scenes: dict[str, Scene]) -> Section:
    """The stages of each scene, beside their floor."""
    spent = {name: gas_by_stage(scene) for name, scene in scenes.items()}
    floors = {name: floor_of(scene, workload_of(scene)) for name, scene in scenes.items()}
    totals = [sum(spent[name].values()) for name in scenes]
    lines = [
        [stage, *(f"{millions(spent[name][stage])} / {millions(floors[name].get(stage, 0))}" for name in scenes)]
        for stage in STAGES
    ]
    bottoms = [sum(floors[name].values()) for name in scenes]
    lines.append(["together", *(f"{millions(a)} / {millions(b)}" for a, b in zip(totals, bottoms, strict=True))])
    lines.append(["times the floor", *(f"{a / b:.2f}" for a, b in zip(totals, bottoms, strict=True))])
    data = {name: {"gas": spent[name], "floor": floors[name]} for name in scenes}
    return Section(TITLE, EXPLANATION + table(["gas / floor", *scenes], lines), data)


EXPLANATION = (
    "Every instruction's gas, charged to the stage whose source it comes from, beside the floor: what a count of the\n"
    "least instructions gives, to about 15 %: 250 a vertex, 150 a face, 900 a drawn triangle and 900 more where\n"
    "it is lit by a face normal, 153 a row of a triangle, 74 a tested pixel, 300 (directional lights) or 680 (a point\n"
    "light) a visible pixel that is lit for itself, 2.75 of memory a pixel of a band for depths, no more.\n"
    "Light that is interpolated over a triangle may cost less than that. The fragment shader walks the rows and tests\n"
    "the depths of all triangles that are not plain, so its floor and that of the rows belong together.\n\n"
)


def _examples() -> dict[str, Scene]:
    scenes = {f"teapot {shading}": staged_teapot(shading, 128) for shading in ("flat", "smooth")}
    if shared.is_there():
        table_scenes = shared.table_scenes()
        spot = "obj_spot_cull"
        names = [spot, spot + shared.UNLIT_SUFFIX, spot + shared.SMOOTH_SUFFIX, "genesis_000", shared.CUBE]
        scenes |= {name: table_scenes[name] for name in [*names, shared.QUAD + shared.LAMP_SUFFIX]}
    return scenes


def main() -> int:
    """The command."""
    lack = missing()
    if lack is not None:
        print(f"this needs {lack}", file=sys.stderr)
        return 1
    print(report({name: load(name) for name in sys.argv[1:]}).text if sys.argv[1:] else section().text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
