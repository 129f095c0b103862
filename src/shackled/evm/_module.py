"""The module evm.wasm, which evm/ is built to, and the machine code that wasmtime compiles it to."""

from __future__ import annotations

import atexit
import hashlib
import os
import platform
import stat
import threading
from contextlib import suppress
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakSet

from platformdirs import user_cache_path

from ..base.whole_file import write_whole
from ..errors import ChainError

if TYPE_CHECKING:
    import wasmtime

#: Address space in bytes below which no instance starts, with what else its process takes, and no small one.
FULL, LEAST = 5 << 30, 512 << 20

_lock = threading.Lock()

#: What wasmtime closes when it is no longer used.
_open: WeakSet[wasmtime.Engine | wasmtime.Module | wasmtime.Store] = WeakSet()


@atexit.register
def _leave_open() -> None:
    # Finalizers that run later, when wasmtime's own modules are gone, would print errors. What a thread still uses, or
    # closes at this moment, must not be closed here; the system frees all of it.
    for each in _open.copy():
        with suppress(ValueError):
            each._consume()


class Kind(NamedTuple):
    """What machine code depends on, besides the machine: see `start`."""

    is_small: bool
    is_stoppable: bool

    @property
    def suffix(self) -> str:
        """Return what tells files of this kind from others."""
        return "-small" * self.is_small + "-stoppable" * self.is_stoppable


def start(is_stoppable: bool = False) -> tuple[Kind, wasmtime.Engine, wasmtime.Store, wasmtime.Instance]:
    """Return a new instance of the module, with its engine and store. ChainError where wasmtime cannot start it.

    is_stoppable: whether an increment of the engine's epoch ends the call that runs in the instance, and all later
    ones. The checks of the epoch take time, so that other instances have none: benchmarks/parallel.md measures both.

    An instance reserves 4 GB of address space, so that no access to its memory needs a check. Where the system refuses
    that (`ulimit -v`), or the file in memory with its first content (`ulimit -f`), the instance is a small one: it
    reserves 64 MB, moves its memory when that does not suffice, and checks accesses.
    """
    limit, failure = address_space(), None
    for is_small, needed in ((False, FULL), (True, LEAST)):
        if limit is not None and limit < needed:
            continue
        engine, module = compiled(Kind(is_small, is_stoppable))
        import wasmtime

        store = wasmtime.Store(engine)
        if is_stoppable:
            store.set_epoch_deadline(1)
        try:
            instance = wasmtime.Instance(store, module, [])
        except (wasmtime.WasmtimeError, MemoryError) as error:
            store.close()
            failure = error
        else:
            _open.add(store)
            return Kind(is_small, is_stoppable), engine, store, instance
    raise _cannot_start(failure) from failure


def address_space() -> int | None:
    """Return the limit of the address space of this process, in bytes; None if there is none."""
    try:
        import resource
    except ImportError:  # Windows has no such limits
        return None
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return None if limit == resource.RLIM_INFINITY else limit


def _cannot_start(error: Exception | None) -> ChainError:
    limit = address_space()
    why = [" ".join(str(error).split()) or "there is too little memory"] if error else []
    if limit is not None:
        why.append(
            f"this process may use {limit >> 20:,} MB of address space, and needs at least {LEAST >> 20:,}: raise the "
            "limit (`ulimit -v`)"
        )
    return ChainError(f"the embedded EVM cannot start: {'; '.join(why)}")


def module_bytes() -> bytes:
    """Return the module in the binary format of WebAssembly."""
    return files(__package__).joinpath("evm.wasm").read_bytes()


def compiled(kind: Kind) -> tuple[wasmtime.Engine, wasmtime.Module]:
    """Return the module as machine code. What can be stopped has its own engine.

    The first call on a machine compiles it, within a second; later ones load it within milliseconds. ChainError where
    there is no build of wasmtime, or too little memory.
    """
    with _lock:
        engine, module = _compiled(kind)
        _open.update((engine, module))
        if kind.is_stoppable:
            import wasmtime

            engine = wasmtime.Engine(config(kind))
            module = wasmtime.Module.deserialize(engine, module.serialize())
            _open.update((engine, module))
        return engine, module


def config(kind: Kind) -> wasmtime.Config:
    """Return the settings of an engine."""
    import wasmtime

    made = wasmtime.Config()
    made.epoch_interruption = kind.is_stoppable
    # products of 64 bits, for compiled contracts
    made.wasm_wide_arithmetic = True
    if kind.is_small:
        made.memory_reservation, made.memory_guard_size = 64 << 20, 64 << 10
        made.memory_reservation_for_growth, made.memory_init_cow = 64 << 20, False
    return made


def folder() -> Path:
    """Return the folder of machine code."""
    return user_cache_path("shackled", appauthor=False)


@cache
def version() -> str:
    """Return what tells this module from those of other versions."""
    return hashlib.sha256(module_bytes()).hexdigest()[:16]


@cache
def _compiled(kind: Kind) -> tuple[wasmtime.Engine, wasmtime.Module]:
    try:
        import wasmtime
    except (ImportError, OSError, RuntimeError) as error:
        # also of the wheel for any platform, which has no library
        raise ChainError(
            f"there is no wasmtime for this machine ({platform.system()}, {platform.machine()}): choose the chain "
            "pyevm, of pip install 'shackled[pyevm]'"
        ) from error
    engine = wasmtime.Engine(config(kind))
    path = folder() / f"evm-{version()}{kind.suffix}.bin"
    module = _load(engine, path)
    if module is None:
        try:
            module = wasmtime.Module(engine, module_bytes())
        except (wasmtime.WasmtimeError, MemoryError) as error:
            raise _cannot_start(error) from error
        save(path, bytes(module.serialize()))
    return engine, module


def _load(engine: wasmtime.Engine, path: Path) -> wasmtime.Module | None:
    """Return the module of a cache file; None if it cannot be read, or wasmtime differs."""
    import wasmtime

    code = read(path)
    with suppress(wasmtime.WasmtimeError):
        return None if code is None else wasmtime.Module.deserialize(engine, code)
    return None


def read(path: Path) -> bytes | None:
    """Return the machine code of a cache file; None if others could have written it, or it is damaged."""
    with suppress(OSError), open(path, "rb", opener=_open_plainly) as file:
        if _is_trusted(os.fstat(file.fileno())):
            digest, code = file.read(32), file.read()
            # wasmtime takes code as it is: what was cut off or changed would crash
            return code if hashlib.sha256(code).digest() == digest else None
    return None


def _open_plainly(path: str, flags: int) -> int:
    """Open a file, but no link, and without waiting for the writer of a pipe."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))


def _is_trusted(status: os.stat_result) -> bool:
    """Return whether nobody but this user and root could have written a file: its content runs as machine code."""
    # Windows has neither users nor modes; there the folder belongs to the user
    is_own = not hasattr(os, "geteuid") or (status.st_uid in (0, os.geteuid()) and not status.st_mode & 0o022)
    return is_own and stat.S_ISREG(status.st_mode)


def save(path: Path, code: bytes) -> None:
    """Write a cache file that only this user can change; where that fails, the next process compiles again."""
    with suppress(OSError):
        path.parent.parent.mkdir(parents=True, exist_ok=True)
        path.parent.mkdir(mode=0o700, exist_ok=True)
        # `write_whole` would follow a link, and wait for the reader of a pipe
        if path.is_symlink() or (path.exists() and not path.is_file()):
            path.unlink()
        write_whole(path, hashlib.sha256(code).digest() + code, mode=0o600)
