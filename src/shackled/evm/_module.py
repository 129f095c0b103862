"""The module evm.wasm, which evm/ is built to, and the machine code that wasmtime compiles it to."""

from __future__ import annotations

import atexit
import hashlib
import platform
import threading
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakSet

from platformdirs import user_cache_path

from ..errors import ChainError
from ..whole_file import write_whole

if TYPE_CHECKING:
    import wasmtime

_lock = threading.Lock()

#: What wasmtime has to close.
_open: WeakSet[wasmtime.Engine | wasmtime.Module | wasmtime.Store] = WeakSet()


@atexit.register
def _close() -> None:
    # finalizers that run later, when wasmtime's own modules are gone, would print errors
    for each in list(_open):
        each.close()


def new_store() -> tuple[wasmtime.Store, wasmtime.Module]:
    """Return a store, and the module compiled for it."""
    engine, module = compiled()
    import wasmtime

    store = wasmtime.Store(engine)
    _open.update((store, module, engine))
    return store, module


def module_bytes() -> bytes:
    """Return the module in the binary format of WebAssembly."""
    return files(__package__).joinpath("evm.wasm").read_bytes()


def compiled() -> tuple[wasmtime.Engine, wasmtime.Module]:
    """Return the module as machine code.

    The first call on a machine compiles it, within a second; later ones load it within milliseconds. ChainError where
    there is no build of wasmtime.
    """
    with _lock:
        return _compiled()


@cache
def _compiled() -> tuple[wasmtime.Engine, wasmtime.Module]:
    try:
        import wasmtime
    except (ImportError, OSError, RuntimeError) as error:
        # also of the wheel for any platform, which has no library
        raise ChainError(
            f"there is no wasmtime for this machine ({platform.system()}, {platform.machine()}): choose the chain "
            "pyevm, of pip install 'shackled[pyevm]'"
        ) from error
    engine = wasmtime.Engine()
    source = module_bytes()
    path = _cache_file(source)
    module = _load(engine, path)
    if module is None:
        module = wasmtime.Module(engine, source)
        _save(path, bytes(module.serialize()))
    return engine, module


def _cache_file(source: bytes) -> Path:
    return user_cache_path("shackled", appauthor=False) / f"evm-{hashlib.sha256(source).hexdigest()[:16]}.bin"


def _load(engine: wasmtime.Engine, path: Path) -> wasmtime.Module | None:
    """Return the module of a cache file; None if there is none, it is damaged, or wasmtime or the machine differ."""
    import wasmtime

    try:
        content = path.read_bytes()
        digest, code = content[:32], content[32:]
        # wasmtime takes code as it is: what was cut off or changed would crash
        if hashlib.sha256(code).digest() == digest:
            return wasmtime.Module.deserialize(engine, code)
    except (OSError, wasmtime.WasmtimeError):
        pass
    return None


def _save(path: Path, code: bytes) -> None:
    """Write a cache file; where that fails, the next process compiles again."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, hashlib.sha256(code).digest() + code)
    except OSError:
        pass
