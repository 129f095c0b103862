"""Measure what effects cost on models.

    python -m benchmarks.effects

draws models with one effect at a time, prints the gas, and writes it into benchmarks/effects.json, of which
`python -m tools.generated` makes the table of docs/light.md. Figures of models that are not there are kept: spot is of
the cost table, the bonsai of a contract beside it.
"""

from __future__ import annotations

from pathlib import Path
from statistics import fmean

from tools.build_contracts import compile_once, follow_imports, request, settings
from tools.ledger import World, call_data
from tools.readme import EFFECTS

from shackled import Scene, load
from shackled.bench._measure import gas
from shackled.datasets import pieces
from shackled.scene._settings import LookOptions

from . import read_figures, run_main, shared, write_figures

SKY: LookOptions = {"hemisphere": ("skyblue", "tan")}
ALL: LookOptions = {"rim": ("white", 4), "fog": "white", "filmic": True, "gamma": True, "exposure": 1.4}
EFFECTS_OF_LOOKS: dict[str, LookOptions] = {
    "without effects": {},
    "hemisphere light": SKY,
    "rim, exponent 4": {"rim": ("white", 4)},
    "emission": {"emission": "#202020"},
    "fog": {"fog": "white"},
    "exposure": {"exposure": 1.4},
    "filmic": {"filmic": True},
    "gamma": {"gamma": True},
    "hemisphere light, rim, fog, filmic, gamma, exposure": {**SKY, **ALL},
}

#: The gas that a call may take on any node: that of one transaction (EIP-7825).
LIMIT = 1 << 24
#: Variants of the tokens of a contract that draws trees: shiny faces of several colours.
BONSAI = shared.SHARED / "review" / "author" / "Effects.sol"
VARIANTS = {"without effects": 0, "hemisphere light": 2, "rim, exponent 3": 3, "fog": 6, "filmic": 7, "gamma": 5}
TREES = 3

#: By model, the gas of each effect; and by effects, the number of icons that LIMIT suffices for.
Figures = dict[str, dict[str, int]]


def scene_of(model: str, look: LookOptions) -> Scene:
    """Return a model with a look: an icon, antialiased at 128 px, or a mesh in the default look at 256 px."""
    if model.startswith("icons/"):
        name, _, kind = model.partition(", ")
        chosen: LookOptions = {"antialias": True, **look}
        if kind:
            chosen |= {"shading": "flat", "specular": 0.0}
        return load(name, 128, **chosen)
    paths: dict[str, str | Path] = {path.stem: path for path in shared.meshes()}
    return load(paths.get(model, model), 256, **look)


def trees() -> dict[str, int]:
    """Return the mean gas of tokens that are trees, by effect."""
    sources = follow_imports([BONSAI.name], BONSAI.parent)
    wanted = {BONSAI.name: {"Effects": ["evm.bytecode.object"]}}
    output = compile_once(request(sources, settings(200, True), wanted))[BONSAI.name]["Effects"]
    world = World()
    token = world.deploy(bytes.fromhex(output["evm"]["bytecode"]["object"]), world.address("Studio").rjust(32, b"\0"))
    found = {}
    for name, variant in VARIANTS.items():
        costs = []
        for number in range(TREES):
            world.run(token, call_data("render(uint256)", 100 * variant + number))
            costs.append(world.gas)
        found[name] = round(fmean(costs))
    return found


def icons_that_fit() -> dict[str, int]:
    """Return the number of icons whose `render`, antialiased at 128 px, takes at most LIMIT, by effects."""
    looks: dict[str, LookOptions] = {"without effects": {}, "hemisphere light, gamma": {**SKY, "gamma": True}}
    names = [piece.name for piece in pieces("icons")]
    return {name: sum(gas(scene_of(icon, look)) <= LIMIT for icon in names) for name, look in looks.items()}


def main() -> int:
    """Measure, print and write the figures."""
    models = ["teapot", "icons/crystals", "icons/crown", "icons/rocket, quick path"]
    if any(path.stem == "spot" for path in shared.meshes()):
        models.insert(0, "spot")
    figures: Figures = read_figures(EFFECTS)
    for model in models:
        figures[model] = {name: gas(scene_of(model, look)) for name, look in EFFECTS_OF_LOOKS.items()}
    if BONSAI.is_file():
        figures["bonsai"] = trees()
    for model, found in figures.items():
        print(model)
        for name, cost in found.items():
            print(f"    {name:54}{cost:>14,}{cost / found['without effects']:8.2f}")
    figures["icons that fit"] = icons_that_fit()
    print("icons that fit", figures["icons that fit"])
    write_figures(EFFECTS, figures)
    return 0


if __name__ == "__main__":
    run_main(main)
