"""Make web/src/document/settings.ts: what the page takes from the package, which are settings, looks, limits of gas,
chains, and bounds of what transactions cost.
"""

from __future__ import annotations

import json
from math import isfinite
from pathlib import Path
from typing import Any

from shackled.base.checks import Color
from shackled.deploy import _quote
from shackled.gas import known_chains, limits
from shackled.scene import PRESETS
from shackled.scene._presets import Preset
from shackled.scene._settings import SETTINGS
from shackled.tokens._contract import USUAL_GAS
from shackled.tokens._reveal import FIRST_GAS, REVEAL_GAS

FILE = Path(__file__).resolve().parent.parent / "web" / "src" / "document" / "settings.ts"
HEAD = """// Written by tools/page_settings.py from the tables of the Python package.

/** What can be set: src/shackled/scene/_settings.py. `low` and `high` are null where there is none. */
export type Setting = Readonly<
    Record<"name" | "kind" | "group" | "text" | "unit" | "default", string> &
        Record<"low" | "high", number | null> & { part: string | null; choices: readonly string[] }
>;

/** A look: src/shackled/scene/presets.toml. Lamps are directional; their azimuths are relative to the camera. */
export type Preset = Readonly<
    Record<"name" | "title" | "help" | "ambientLight", string> &
        Record<"wireframe" | "invert", boolean> & {
            material: Readonly<Record<string, number | string>>;
            color: string | null;
            lamps: readonly Readonly<{ azimuth: number; elevation: number; color: string }>[];
            background: Readonly<{ top: string; bottom: string }>;
        }
>;

/** How much gas a request may use, the smallest first: src/shackled/gas/limits.toml, chains.toml. */
export type Limit = Readonly<
    Record<"name" | "place" | "source" | "date" | "remark", string> & { gas: number; kind: "transaction" | "call" }
>;

/** A chain, its currency by symbol; node: one that a wallet can use, or "": src/shackled/gas/chains.toml. */
export type KnownChain = Readonly<Record<"name" | "currency" | "explorer" | "node", string> & { number: number }>;
"""
#: The tables, and the types of their rows.
TYPES = {"SETTINGS": "Setting", "PRESETS": "Preset", "LIMITS": "Limit", "CHAINS": "KnownChain"}


def settings() -> list[dict[str, Any]]:
    """Return the settings as JSON objects."""
    names = ("name", "kind", "part", "group", "text", "unit", "choices", "default")
    return [
        {name: getattr(each, name) for name in names}
        | {key: limit if isfinite(limit) else None for key, limit in zip(("low", "high"), each.limits, strict=True)}
        for each in SETTINGS
    ]


def look(preset: Preset) -> dict[str, Any]:
    """Return a preset as a JSON object."""
    return {
        **{name: getattr(preset, name) for name in ("name", "title", "help", "wireframe", "invert")},
        "material": {name: value for name, value in preset.settings.items() if hasattr(preset.material, name)},
        "color": _hex(preset.color) if preset.color else None,
        "lamps": [{"azimuth": e.azimuth, "elevation": e.elevation, "color": _hex(e.color)} for e in preset.lamps],
        "background": {side: _hex(getattr(preset.background, side)) for side in ("top", "bottom")},
        "ambientLight": _hex(preset.ambient_light),
    }


def files() -> dict[Path, str]:
    """Return the text of the file, by its path."""
    names = ("name", "gas", "kind", "place", "source", "date", "remark")
    known = [{name: getattr(each, name) for name in names} for each in limits()]
    of_chains = ("number", "name", "currency", "explorer", "node")
    chains = [{name: getattr(each, name) for name in of_chains} for each in known_chains()]
    made = [HEAD]
    for table, rows in zip(TYPES, (settings(), [look(each) for each in PRESETS], known, chains), strict=True):
        lines = "".join(f"    {json.dumps(row, ensure_ascii=False, default=str)},\n" for row in rows)
        made.append(f"\n// prettier-ignore\nexport const {table}: readonly {TYPES[table]}[] = [\n{lines}];\n")
    return {FILE: "".join([*made, bounds()])}


def bounds() -> str:
    """Return the bounds of what transactions cost, and the gas of those whose gas is not measured here."""
    tips = f"tip: {_quote.TIP}n, mostTip: {_quote.MOST_TIP}n"
    margin = ", ".join(f"{number}n" for number in _quote.MARGIN)
    gas = f"mint: {USUAL_GAS['mint']}, reveal: {FIRST_GAS}, round: {REVEAL_GAS}"
    return f"""
/** The bounds of quotes, in wei per gas, and the margin of gas limits, as a fraction: src/shackled/deploy/_quote.py. */
export const BOUNDS = {{ {tips}, mostTimes: {_quote.MOST_TIMES}n, margin: [{margin}] }} as const;

/** Gas: of minting a token, besides that of its data; of a transaction that reveals, and of each round in it. */
export const USUAL_GAS = {{ {gas} }} as const;
"""


def _hex(color: Color) -> str:
    return "#" + bytes(color).hex()
