"""The embedded EVM as a program: threads, bounds of memory, and the cache of its machine code."""

from __future__ import annotations

import os
import shutil
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from tools.children import child

from shackled import ChainError, InputError
from shackled.chain._embedded import RevmChain
from shackled.ethereum._encoding import word
from shackled.evm._instance import Instance, Status

ADDRESS = bytes(18) + b"\xc0\xde"
#: JUMPDEST PUSH0 JUMP: 11 gas a round, until the gas ends.
ENDLESS = bytes.fromhex("5b5f56")
RETURN_42 = bytes.fromhex("602a5f5260205ff3")

needs_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits and cache are those of Linux")


def instance(code: bytes) -> Instance:
    made = Instance()
    made.put(ADDRESS, code)
    return made


def test_other_threads_run_during_a_call() -> None:
    """Calls release the lock of the interpreter."""
    made = instance(ENDLESS)
    for _ in range(5):
        thread = threading.Thread(target=made.call, args=(ADDRESS, b"", 500_000_000))
        started = last = time.perf_counter()
        longest = 0.0
        thread.start()
        while thread.is_alive():
            now = time.perf_counter()
            longest, last = max(longest, now - last), now
        # the longest time without a step here; the whole call if it held the lock
        if longest < (last - started) / 2:
            return
    pytest.fail(f"no other thread ran for {longest:.2f} s of a call of {last - started:.2f} s")


def test_threads_share_a_chain() -> None:
    chain = RevmChain()
    chain.put(ADDRESS, bytes.fromhex("5f355f5260205ff3"))
    data = [number.to_bytes(32, "big") for number in range(1600)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda each: chain.run(ADDRESS, each).output, data)) == data


def test_contracts_that_are_removed() -> None:
    made = instance(RETURN_42)
    assert int.from_bytes(made.call(ADDRESS, b"", 100_000).output, "big") == 42
    made.hold({})
    assert made.call(ADDRESS, b"", 100_000).output == b""
    made.hold({ADDRESS: bytes.fromhex("602b5f5260205ff3")})
    assert int.from_bytes(made.call(ADDRESS, b"", 100_000).output, "big") == 43


@pytest.mark.parametrize("instruction", [0x51, 0x52, 0x53])
@pytest.mark.parametrize(
    "place", [1 << 30, (1 << 31) - 32, 1 << 31, (1 << 32) - 33, (1 << 32) - 32, (1 << 32) - 1, 1 << 32, 1 << 60]
)
def test_memory_is_bounded(place: int, instruction: int) -> None:
    """Whatever the gas, a call cannot take more; and the chain serves others afterwards."""
    chain = RevmChain(1 << 63)
    chain.put(ADDRESS, b"\x60\x01\x7f" + word(place) + bytes([instruction, 0x59, 0x5F, 0x52, 0x60, 0x20, 0x5F, 0xF3]))
    with pytest.raises(ChainError, match=r"needs more than 1,024 MB of memory|is not enough"):
        chain.run(ADDRESS, b"")
    chain.put(bytes(20), b"")
    assert chain.run(bytes(20), b"").output == b""


def test_large_data() -> None:
    """That which is passed counts, too."""
    made = instance(bytes.fromhex("365f5260205ff3"))
    assert int.from_bytes(made.call(ADDRESS, bytes(50 << 20), 100_000).output, "big") == 50 << 20
    with pytest.raises(ChainError, match="needs more than 1,024 MB of memory"):
        made.call(ADDRESS, bytes(1100 << 20), 100_000)


def test_replaced_codes_are_not_kept() -> None:
    made, codes = Instance(), [bytes([number]) * 20_000 for number in range(200)]

    def memory() -> int:
        return int(made._memory.data_len(made._store))

    for code in codes[:20]:
        made.put(ADDRESS, code)
    before = memory()
    for code in codes:
        made.put(ADDRESS, code)
    # 4 MB of codes; at most what one takes, with its table of jumps
    assert memory() - before <= 1 << 17


def test_a_code_of_two_contracts_stays() -> None:
    """Also if one of them gets another, and the code comes back."""
    made, other = instance(RETURN_42), bytes(20)
    made.put(other, bytes([*RETURN_42]))
    made.put(ADDRESS, b"")
    assert made.call(other, b"", 100_000).output[-1:] == b"*"
    made.put(other, ENDLESS)
    made.put(ADDRESS, RETURN_42)
    assert made.call(ADDRESS, b"", 100_000).output[-1:] == b"*"
    made.send(ADDRESS, b"", 100_000)
    made.put(ADDRESS, RETURN_42[:])
    # EXTCODECOPY of the code that is there now
    made.put(other, bytes.fromhex(f"6007 5f 5f 73{ADDRESS.hex()} 3c 60075ff3"))
    assert made.call(other, b"", 100_000).output == RETURN_42[:7]


@pytest.mark.parametrize("size", [0, 19, 21])
def test_addresses_have_20_bytes(size: int) -> None:
    made, place = Instance(), bytes(size)
    for function in ("put", "describe", "call", "send", "profile"):
        gas = [] if function in ("put", "describe") else [99]
        with pytest.raises(InputError, match=rf"^an address must have 20 bytes, not {size}$"):
            getattr(made, function)(place, b"", *gas)


# ---- limits of the process ----

#: A call that uses so many bytes of memory, with a limit of the process, if any.
PROGRAM = """
import sys
limit, value, memory = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
if limit:
    import resource
    resource.setrlimit(getattr(resource, limit), (value, value))
from shackled import ChainError
from shackled.evm._instance import Instance
try:
    made = Instance()
    made.put(bytes(20), bytes.fromhex("6001 63%08x 52 602a 5f 52 6020 5f f3" % memory))
    print(made.call(bytes(20), b"", 1 << 44).output.hex())
except ChainError as error:
    print(error)
"""
ANSWER = bytes(31).hex() + "2a"


def start(
    cache: Path, limit: str = "", value: int = 0, memory: int = 0
) -> AbstractContextManager[subprocess.Popen[str]]:
    """Start a process whose cache is in a folder."""
    environment = os.environ | {"XDG_CACHE_HOME": str(cache)}
    return child(sys.executable, "-c", PROGRAM, limit, str(value), str(memory), env=environment)


def output(process: subprocess.Popen[str]) -> str:
    output, errors = process.communicate(timeout=120)
    assert (process.returncode, errors, output.count("\n")) == (0, "", 1)
    return output.strip()


def said(cache: Path, limit: str = "", value: int = 0, memory: int = 0) -> str:
    with start(cache, limit, value, memory) as process:
        return output(process)


def check(cache: Path, limit: str = "", value: int = 0, memory: int = 0) -> None:
    assert said(cache, limit, value, memory) == ANSWER


@needs_linux
@pytest.mark.parametrize("megabytes", [4096, 2048, 512])
def test_it_starts_with_little_address_space(tmp_path: Path, megabytes: int) -> None:
    """Its memory can grow, too, beyond the 64 MB that are reserved."""
    memory = 80 << 20 if megabytes > 1000 else 32
    check(tmp_path, "RLIMIT_AS", megabytes << 20, memory)


@needs_linux
def test_too_little_address_space(tmp_path: Path) -> None:
    assert said(tmp_path, "RLIMIT_AS", 400 << 20) == (
        "the embedded EVM cannot start: this process may use 400 MB of address space, and needs at least 512: raise "
        "the limit (`ulimit -v`)"
    )
    assert said(tmp_path, "RLIMIT_AS", 1 << 30, 600 << 20) == (
        "the embedded EVM stopped: the call needs more than 1,024 MB of memory, or than this process has left of 1,024 "
        "MB of address space (`ulimit -v`)"
    )


@needs_linux
def test_a_limit_of_the_size_of_files(tmp_path: Path) -> None:
    """Nothing is cached then."""
    check(tmp_path, "RLIMIT_FSIZE", 1000, 32)
    assert cached(tmp_path) == []


# ---- the cache ----


def cached(cache: Path) -> list[Path]:
    return list((cache / "shackled").iterdir())


@needs_linux
def test_two_processes_at_once(tmp_path: Path) -> None:
    with start(tmp_path) as one, start(tmp_path) as other:
        assert [output(one), output(other)] == [ANSWER, ANSWER]
    assert [path.suffix for path in cached(tmp_path)] == [".bin"]


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache that a process has written."""
    folder = tmp_path_factory.mktemp("compiled")
    check(folder)
    return folder


@pytest.fixture
def cache(compiled: Path, tmp_path: Path) -> Path:
    """The only file of such a cache, in a folder of the test."""
    shutil.copytree(compiled, tmp_path, dirs_exist_ok=True)
    (path,) = cached(tmp_path)
    return path


@needs_linux
def test_a_damaged_cache(tmp_path: Path, cache: Path) -> None:
    """It is compiled and written again."""
    whole = cache.read_bytes()
    for damaged in (whole[:-1], whole[:5000] + bytes(50) + whole[5050:]):
        cache.write_bytes(damaged)
        check(tmp_path)
        assert cache.read_bytes() == whole
    # or not written, where a file is in the place of the folder
    shutil.rmtree(tmp_path / "shackled")
    (tmp_path / "shackled").write_text("")
    check(tmp_path)


SPOIL: dict[str, Callable[[Path], object]] = {
    "others": lambda path: path.chmod(0o666),
    "owner": lambda path: os.chown(path, 65534, -1),
    "link": lambda path: path.symlink_to(path.rename(path.with_name("elsewhere"))),
    "pipe": lambda path: os.mkfifo(path.rename(path.with_name("elsewhere")).with_name(path.name)),
}


@needs_linux
@pytest.mark.parametrize("spoil", SPOIL)
def test_a_cache_that_others_could_have_written(tmp_path: Path, cache: Path, spoil: str) -> None:
    """It is not run, and replaced: its content is machine code."""
    if spoil == "owner" and os.geteuid():
        pytest.skip("only root can give files away")
    SPOIL[spoil](cache)
    spoilt = cache.lstat()
    check(tmp_path)
    now = cache.lstat()
    assert now.st_ctime_ns > spoilt.st_ctime_ns
    assert (stat.S_ISREG(now.st_mode), now.st_uid, now.st_mode & 0o777) == (True, os.geteuid(), 0o600)


@needs_linux
def test_only_the_user_writes_the_cache(tmp_path: Path) -> None:
    before = os.umask(0)
    try:
        check(tmp_path)
    finally:
        os.umask(before)
    (path,) = cached(tmp_path)
    assert [each.stat().st_mode & 0o777 for each in (path.parent, path)] == [0o700, 0o600]
    kept = path.stat().st_mtime_ns
    check(tmp_path)
    assert path.stat().st_mtime_ns == kept


BROKEN = """
import sys
class Broken:
    def find_spec(self, name, *_):
        if name == "wasmtime._ffi":
            raise RuntimeError("unsupported platform")
sys.meta_path.insert(0, Broken())
from shackled.cli.app import run
sys.exit(run(["render", "cube", "--size", "4", "-o", sys.argv[1], *sys.argv[2:]]))
"""


def test_where_wasmtime_has_no_library(tmp_path: Path) -> None:
    command = [sys.executable, "-c", BROKEN, str(tmp_path / "a.png")]
    told = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert told.returncode == 1
    assert told.stderr.startswith("shackled: there is no wasmtime for this machine (")
    assert told.stderr.endswith("choose the chain pyevm, of pip install 'shackled[pyevm]'\n")


def test_another_thread_stops_a_call() -> None:
    """The one that runs, and all later ones of this instance; others go on."""
    made, other = Instance(is_stoppable=True), Instance(is_stoppable=True)
    for each in (made, other):
        each.put(ADDRESS, ENDLESS)
    stopping = threading.Timer(0.2, made.stop)
    stopping.start()
    for _ in range(2):
        with pytest.raises(ChainError, match=r"^the call was stopped$"):
            made.call(ADDRESS, b"", 1 << 44)
    stopping.join()
    assert other.call(ADDRESS, b"", 1_000).status == Status.OUT_OF_GAS


#: Threads drop instances while the process ends.
DROP = """
import threading
from shackled.evm._instance import Instance

made = [Instance() for _ in range(24)]
ready = threading.Barrier(25)


def drop(number):
    ready.wait()
    made[number] = None


for number in range(24):
    threading.Thread(target=drop, args=(number,), daemon=True).start()
ready.wait()
"""


def test_a_process_may_end_while_threads_drop_instances() -> None:
    for _ in range(4):
        ended = subprocess.run([sys.executable, "-c", DROP], capture_output=True, text=True, timeout=120)
        assert (ended.returncode, ended.stderr) == (0, "")
