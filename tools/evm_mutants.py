"""Make faulty versions of the translator of contracts (evm/src/compile), and find out which tests detect them.

    python -m tools.evm_mutants            all of them; each takes a minute or two
    python -m tools.evm_mutants carry      those whose names contain a word

Each is built as tools/build_evm.py builds the EVM, beside the sources. Prints a table in Markdown, and fails if one was
not detected, by random programs or by the check of what a translation writes.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from tools import build_evm

#: By name: a file of evm/src, what is replaced there, and by what.
MUTANTS = {
    "carry of ADD": (
        "compile/words.rs",
        "carry = f.op(Op::Or, over, more);\n            }\n            sum",
        "}\n            sum",
    ),
    "borrow of SUB": ("compile/words.rs", "borrow = f.op(Op::Or, over, more);", "borrow = more;"),
    "SAR like SHR": ("compile/words.rs", "if is_signed { Op::ShrS } else { Op::ShrU }", "Op::ShrU"),
    "SLT like LT": ("compile/words.rs", "if i == 3 && is_signed {", "if i == 4 && is_signed {"),
    "sign of SIGNEXTEND": (
        "compile/words.rs",
        "let bits = 8 * byte.as_limbs()[0] + 7;",
        "let bits = 8 * byte.as_limbs()[0] + 6;",
    ),
    "limb of BYTE": ("compile/helpers.rs", "select(word[0], word[1], 24)", "select(word[0], word[1], 25)"),
    "sign of a product": ("compile/helpers.rs", "f.op(Op::Sub, high, more)", "f.op(Op::Add, high, NOUGHT)"),
    "row of a product": ("compile/helpers.rs", "for j in 0..4 - i {", "for j in 0..3 - i {"),
    "division by -1": (
        "compile/helpers.rs",
        ".i64_const(1).i64_add().i64_const(2)",
        ".i64_const(0).i64_add().i64_const(1)",
    ),
    "gas of a path": (
        "compile/region.rs",
        "i64_const(gas as i64).i64_sub().local_get(STATE)",
        "i64_const(gas as i64 - 1).i64_sub().local_get(STATE)",
    ),
    "gas of the dearest path": ("compile/region.rs", "self.dearest = self.dearest.max(gas);", "_ = gas;"),
    "gas of a round": (
        "compile/region.rs",
        "i64_const(gas as i64).i64_sub().local_set(GAS)",
        "i64_const(0).i64_sub().local_set(GAS)",
    ),
    "words that a round changes": ("compile/region.rs", "all.push((j, Word::Slot(slot)));", "_ = j;"),
    "need of the stack": ("compile/region.rs", "self.need = self.need.max(self.path.taken);", "_ = self.need;"),
    "room of the stack": ("compile/region.rs", "self.height = self.height.max(", "_ = self.height.max("),
    "limbs of a load swapped": (
        "compile/memory.rs",
        "limbs[2 * (1 - half) + lane as usize]",
        "limbs[2 * half + lane as usize]",
    ),
    "growth of memory": ("compile/memory.rs", "self.grow(|sink| _ = sink.local_get(end));", ""),
    "end of a byte": ("compile/memory.rs", "self.place(place, 1)", "self.place(place, 0)"),
    "memory that moved": (
        "compile/memory.rs",
        "i32_load(at(offset_of!(State, memory))).local_set(MEMORY)",
        "i32_load(at(offset_of!(State, memory))).drop()",
    ),
    "price of growth": ("compiled.rs", "(gas - cost) as i64\n    }", "gas as i64\n    }"),
    "price of copies": ("compiled.rs", "let cost = 3 * (count as u64)", "let cost = 2 * (count as u64)"),
    "jump to no JUMPDEST": ("compile/paths.rs", ".i32_const(1).i32_and().i32_eqz()", ".i32_const(0).i32_and()"),
    "calls that run again": ("calls.rs", "if runner.gave_up {", "if runner.gave_up && gas == 0 {"),
}

#: Prints what detects the module whose path is given.
JUDGE = """
import json, random, sys
sys.path.insert(0, "tests/support")
from pathlib import Path
from shackled.evm import _module, _compiled
_module.module_bytes = lambda: Path(sys.argv[1]).read_bytes()
import programs, stores, wasmtime
from evms import Ours

def fails(check):
    try:
        return bool(check())
    except (AssertionError, wasmtime.WasmtimeError, wasmtime.Trap, Exception):
        return True

def stores_fail():
    evm, rng = Ours().instance, random.Random(5)
    for _ in range(200):
        stores.check(evm.translate(programs.program(rng), _compiled.REGION))

print(json.dumps([fails(lambda: programs.differences(random.Random(1), 500, 2)), fails(stores_fail)]))
"""


def detectors(name: str) -> list[bool]:
    """Return whether random programs, and whether the check of stores detect a mutant."""
    file, old, new = MUTANTS[name]
    with tempfile.TemporaryDirectory() as folder:
        sources = Path(folder, "evm")
        shutil.copytree(build_evm.SOURCES, sources, ignore=shutil.ignore_patterns("target"))
        path = sources / "src" / file
        text = path.read_text("utf-8")
        assert text.count(old) == 1, f"{name}: {file} has changed"
        path.write_text(text.replace(old, new), "utf-8")
        module = Path(folder, "evm.wasm")
        module.write_bytes(build_evm.build(sources))
        command = [sys.executable, "-c", JUDGE, str(module)]
        environment = os.environ | {"XDG_CACHE_HOME": folder}
        ended = subprocess.run(
            command, cwd=build_evm.ROOT, env=environment, capture_output=True, text=True, timeout=1800
        )
    if ended.returncode:
        # it ended the process
        return [True, False]
    found: list[bool] = json.loads(ended.stdout)
    return found


def main() -> int:
    """Print the table."""
    missed = 0
    print("| fault | random programs | check of stores |\n|---|---|---|")
    for name in MUTANTS:
        if all(word in name for word in sys.argv[1:]):
            found = detectors(name)
            missed += not any(found)
            print(f"| {name} | {' | '.join('found' if each else '' for each in found)} |", flush=True)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
