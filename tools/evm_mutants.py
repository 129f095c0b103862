"""Make faulty versions of the translator of contracts (evm/src/compile), and find out which tests detect them.

    python -m tools.evm_mutants            all of them; each takes a minute or two
    python -m tools.evm_mutants carry      those whose names contain a word

Each is built as tools/build_evm.py builds the EVM, beside the sources. Prints a table in Markdown, and fails if one was
not detected.
"""

from __future__ import annotations

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
    "price of growth": ("compiled.rs", "    (gas - cost) as i64\n", "    gas as i64\n"),
    "price of copies": ("compiled.rs", "let cost = 3 * (count as u64)", "let cost = 2 * (count as u64)"),
    "jump to no JUMPDEST": ("compile/paths.rs", ".i32_const(1).i32_and().i32_eqz()", ".i32_const(0).i32_and()"),
    "calls that run again": ("calls.rs", "if runner.gave_up {", "if runner.gave_up && gas == 0 {"),
}

#: What detects them, in order: tests of compiled contracts.
DETECTORS = {
    "random programs": ["tests/evm/test_compiled.py", "-k", "random_programs"],
    "numbers at the edges": ["tests/evm/test_bytecode.py", "-k", "data_at_the_edges"],
    "jumps to places known at run time": ["tests/evm/test_compiled.py", "-k", "jumps_to_places"],
    "check of stores": ["tests/evm/test_compiled.py", "-k", "every_store"],
}
#: Runs tests with the module whose path is given.
JUDGE = """
import sys
from pathlib import Path
import pytest
from shackled.evm import _module
_module.module_bytes = lambda: Path(sys.argv[1]).read_bytes()
sys.exit(pytest.main(["-q", "-x", *sys.argv[2:]]))
"""


def detector(name: str) -> str:
    """Return the first of the detectors that detects a mutant; "" if none does."""
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
        environment = os.environ | {"XDG_CACHE_HOME": folder}
        for found, tests in DETECTORS.items():
            command = [sys.executable, "-c", JUDGE, str(module), *tests]
            ended = subprocess.run(command, cwd=build_evm.ROOT, env=environment, capture_output=True, timeout=1800)
            if ended.returncode:
                return found
    return ""


def main() -> int:
    """Print the table."""
    missed = 0
    print("| fault | detected by |\n|---|---|")
    for name in MUTANTS:
        if all(word in name for word in sys.argv[1:]):
            found = detector(name)
            missed += not found
            print(f"| {name} | {found} |", flush=True)
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
