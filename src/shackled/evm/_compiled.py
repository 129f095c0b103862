"""Contracts as machine code: evm.wasm translates their bytecode to WebAssembly, and wasmtime compiles that.

A code is compiled in a thread once it has used `MUCH` gas in the interpreter in this process. The machine code is kept
on disk beside that of evm.wasm, where later processes find it. Whatever fails here leaves the code to the interpreter,
which returns the same. SHACKLED_EVM=interpreter compiles nothing; SHACKLED_EVM=compiled compiles each code before its
first call, which is for tests and benchmarks.
"""

from __future__ import annotations

import hashlib
import os
import threading
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from ..errors import ChainError, InputError
from ._module import Kind, config, folder, read, save, version

if TYPE_CHECKING:
    import wasmtime

#: Instructions of a region of compiled code: more take longer to compile, and are not faster.
REGION = 25
#: The gas of a code in the interpreter from which on it is looked for on disk, and from which on it is compiled: that
#: of a picture, and half a second of a processor.
SOME, MUCH = 10_000_000, 250_000_000
#: At most so many codes are compiled in a process; the translation of one has so many bytes; the cache so many files.
MOST_CODES, MOST_BYTES, MOST_FILES = 24, 4 << 20, 40

#: Returns the translation of a code; empty if it would be too large.
Translate = Callable[[bytes], bytes]

_lock = threading.Lock()
_gas: Counter[bytes] = Counter()
#: What was looked for on disk; what is being compiled, or cannot be; machine code.
_sought: set[str] = set()
_begun: set[str] = set()
_machine_code: dict[str, bytes] = {}


def mode() -> str:
    """Return the value of SHACKLED_EVM, or "". InputError if it is none of those above."""
    value = os.environ.get("SHACKLED_EVM", "")
    if value not in ("", "interpreter", "compiled"):
        raise InputError(f"SHACKLED_EVM must be `interpreter` or `compiled`, not {value!r:.40}")
    return value


def module_of(code: bytes, engine: wasmtime.Engine, kind: Kind, translate: Translate) -> wasmtime.Module | None:
    """Return the module of a code for an engine, and compile it first where that is needed; None if it cannot be."""
    name = _name(code, kind)
    with _lock:
        if (module := _module(name, engine)) is not None or name in _begun:
            return module
        _begun.add(name)
    _compile(name, code, kind, translate)
    return _module(name, engine)


def busy_module_of(
    code: bytes, gas: int, engine: wasmtime.Engine, kind: Kind, translate: Translate
) -> wasmtime.Module | None:
    """Return the same for a code that used gas in the interpreter, or None; start to compile it where that pays."""
    with _lock:
        _gas[code] += gas
        if _gas[code] < SOME:
            return None
        name = _name(code, kind)
        module = _module(name, engine)
        if module is None and _gas[code] >= MUCH and name not in _begun and len(_begun) < MOST_CODES:
            _begun.add(name)
            threading.Thread(target=_compile, args=(name, code, kind, translate), daemon=True).start()
        return module


def _name(code: bytes, kind: Kind) -> str:
    return f"code-{version()}-{hashlib.sha256(code).hexdigest()[:32]}{kind.suffix}.bin"


def _module(name: str, engine: wasmtime.Engine) -> wasmtime.Module | None:
    """Return the module of machine code that is in memory or on disk; None if there is none for this wasmtime."""
    import wasmtime

    if name not in _sought and len(_machine_code) < MOST_CODES and (found := read(folder() / name)) is not None:
        _machine_code.setdefault(name, found)
    _sought.add(name)
    if name in _machine_code:
        try:
            return wasmtime.Module.deserialize(engine, _machine_code[name])
        except (wasmtime.WasmtimeError, MemoryError):
            del _machine_code[name]
    return None


def _compile(name: str, code: bytes, kind: Kind, translate: Translate) -> None:
    """Compile a code, and keep the machine code in memory and on disk; the oldest files are removed."""
    import wasmtime

    with suppress(ChainError, wasmtime.WasmtimeError, MemoryError):
        translated = translate(code)
        if not 0 < len(translated) <= MOST_BYTES:
            return
        settings = config(kind)
        # the other processors draw
        settings.parallel_compilation = False
        module = wasmtime.Module(wasmtime.Engine(settings), translated)
        _machine_code[name] = bytes(module.serialize())
        save(folder() / name, _machine_code[name])
    with suppress(OSError):
        files = sorted(folder().glob("code-*.bin"), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in files[MOST_FILES:]:
            path.unlink()
