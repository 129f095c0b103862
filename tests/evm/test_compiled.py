"""Compiled contracts return what the interpreter returns, for the same gas; and keep to their limits."""

from __future__ import annotations

import os
import random
import sys
import time
from collections import Counter
from contextlib import ExitStack
from pathlib import Path

import pytest
import wasmtime
from tools.children import child

import stores
from evms import ADDRESS, Ours
from pictures import call_data
from programs import differences, program, push
from random_scenes import broken_call, random_case
from shackled import InputError, load
from shackled.artifacts import artifact
from shackled.chain._embedded import RevmChain
from shackled.evm import _compiled
from shackled.evm._instance import Answer, Instance, Status
from shackled.scene import encode

IS_LONG = os.environ.get("HYPOTHESIS_PROFILE") == "new"
#: The long profile takes an hour.
pytestmark = [pytest.mark.timeout(4 * 3600)] if IS_LONG else []
REGIONS = (1, _compiled.REGION)
GAS = 10_000_000
OTHER = bytes(18) + b"\xbe\xef"
JUMPDEST, END = b"\x5b", push(0x400) + b"\x5f\xf3"


def test_random_programs() -> None:
    """Four calls of each: 2,000 runs, and 100,000 in `make fuzz`."""
    assert differences(random.Random(1), 25_000 if IS_LONG else 500) == []


# ---- the Renderer ----


@pytest.fixture(scope="module")
def renderers() -> tuple[Ours, Ours, dict[bytes, bytes], bytes]:
    """In the interpreter and compiled; the codes, and the address of the Renderer."""
    chain = RevmChain()
    address = chain.address("Renderer")
    return Ours(), Ours(_compiled.REGION), chain.codes(), address


def test_changed_calls_of_the_renderer(renderers: tuple[Ours, Ours, dict[bytes, bytes], bytes]) -> None:
    own, compiled, codes, to = renderers
    ends: Counter[Status] = Counter()
    whole = [call_data("render", random_case(seed).scene) for seed in range(100)]
    for seed in range(2_000):
        data = broken_call(seed, whole[seed % len(whole)])
        answer = own.call(codes, to, data, GAS)
        assert compiled.call(codes, to, data, GAS) == answer, seed
        ends[answer.status] += 1
    assert min(ends[Status.SUCCESS], ends[Status.REVERT]) > 100


def test_limits_of_gas_of_the_renderer(renderers: tuple[Ours, Ours, dict[bytes, bytes], bytes]) -> None:
    own, compiled, codes, to = renderers
    data = encode(artifact("Renderer").selectors["render"], load("cube", 16, antialias=True))
    used = own.call(codes, to, data, GAS).gas
    rng = random.Random(7)
    for gas in (rng.randrange(used + used // 20) for _ in range(2_000)):
        assert compiled.call(codes, to, data, gas) == own.call(codes, to, data, gas), gas


# ---- programs of one kind each ----


def same(codes: dict[bytes, bytes], data: bytes = b"", gas: int = GAS, send: int = 0) -> Answer:
    """Check that calls, and before them transactions, end in the same way everywhere; return how. send: how many."""
    answers = []
    for region in (None, *REGIONS):
        ours = Ours(region)
        for each, code in codes.items():
            ours.put(each, code)
        sent = [ours.instance.send(ADDRESS, data, gas, value=number) for number in range(send)]
        answers.append([*sent, ours.instance.call(ADDRESS, data, gas)])
    assert answers[1:] == answers[:1] * len(REGIONS)
    return answers[0][-1]


@pytest.mark.parametrize("words", [0, 1, 15, 16, 1007, 1008, 1009, 1023, 1024])
def test_bounds_of_the_stack(words: int) -> None:
    """At each height, as much as one instruction may take or leave, and one more."""
    fill = push(3) * words
    if words > 100:
        # in a loop, whose translation is short: it counts down, on four words more
        fill = push(words - 4) + JUMPDEST + push(3) + b"\x90\x60\1\x90\x03\x80\x60\3\x57\x50" + push(3) * 4
    for end in (b"\x50", b"\x01", b"\x08", b"\x8f", b"\x9f", b"\x80", push(1), push(1) * 16, b"\x50" * 17, b"\x5e"):
        for jump in (b"", JUMPDEST):
            same({ADDRESS: fill + jump + end + jump + END})


def test_places_near_2_to_the_32() -> None:
    for power in (16, 24, 30, 31, 32, 33, 63, 64, 255):
        for place in ((1 << power) - 32, (1 << power) - 1, 1 << power):
            for code in (b"\x51", push(7) + b"\x90\x52", push(7) + b"\x90\x53", push(3) + push(0) + b"\x91\x5e"):
                known, unknown = push(place), push(0) + b"\x35"
                for start in (known, unknown):
                    for gas in (100_000, 1 << 36):
                        if power <= 24 or gas == 100_000:
                            same({ADDRESS: start + code + END}, place.to_bytes(32, "big"), gas)


@pytest.mark.parametrize("to", [0, 1, 4, 5, 6, 7, 8, 9, 12, 200, (1 << 32) + 8, (1 << 64) + 8, (1 << 256) - 1])
def test_jumps_to_places_known_at_run_time(to: int) -> None:
    """To a JUMPDEST, to one in the data of a PUSH, behind an instruction that is not translated, beyond the end."""
    code = push(0) + b"\x35\x56" + b"\x30" + b"\x61\x5b\x5b" + JUMPDEST + b"\x30\x30\x30" + JUMPDEST + END
    answer = same({ADDRESS: code}, to.to_bytes(32, "big"))
    assert (answer.status == Status.SUCCESS) == (code[to : to + 1] == JUMPDEST and to in (7, 11))
    # also under a call, whose failure the caller sees
    caller = (
        push(0) + b"\x35\x5f\x52" + b"\x5f\x5f" + push(32) + b"\x5f" + push(0xBEEF) + push(50_000) + b"\xfa\x5f\x52"
    )
    same({ADDRESS: caller + END, OTHER: code}, to.to_bytes(32, "big"))


#: Adds 1 to slot 0 of the storage, writes a log, keeps the sum and the wei that came along in memory.
COUNT = (
    b"\x5f\x54" + push(1) + b"\x01\x80\x5f\x55" + b"\x5f\x52" + push(9) + push(32) + b"\x5f\xa1" + b"\x34" + push(32)
)
COUNT += b"\x52"


def test_transactions_keep_storage() -> None:
    answer = same({ADDRESS: JUMPDEST + COUNT + b"\x47" + push(64) + b"\x52" + END}, send=3)
    assert [int.from_bytes(answer.output[32 * i : 32 * i + 32]) for i in range(3)] == [4, 0, 3]


def test_a_transaction_that_is_run_again_keeps_its_changes_once() -> None:
    """Behind the change is a jump, for which compiled code gives up."""
    bad = push(0) + b"\x35\x56"
    inner = {OTHER: bad}
    caller = COUNT + b"\x5f\x5f\x5f\x5f" + push(0xBEEF) + push(50_000) + b"\xfa" + push(96) + b"\x52" + END
    assert same({ADDRESS: caller, **inner}, (1 << 40).to_bytes(32, "big"), send=2).output[31] == 3


def test_reentrant_calls() -> None:
    """The contract calls itself, with less data each time, and adds what it gets."""
    call = b"\x5f\x5f" + push(1) + b"\x36\x03\x5f\x30\x5a\xfa"
    program = (
        b"\x36\x15\x61\0\0\x57" + push(32) + b"\x5f" + call[2:] + b"\x3d" + b"\x01" + push(64) + b"\x52" + JUMPDEST
    )
    at = program.index(b"\x61\0\0")
    program = program[: at + 1] + (len(program) - 1).to_bytes(2, "big") + program[at + 3 :]
    program += b"\x36" + push(96) + b"\x52" + END
    for size in (0, 1, 7, 40):
        same({ADDRESS: program}, bytes(size))


def test_code_made_at_run_time() -> None:
    """A contract creates one, with a code of its own data, and calls it twice."""
    inner = push(3) + b"\x5f\x35\x02\x5f\x52" + push(32) + b"\x5f\xf3"
    store = b"".join(push(byte) + push(n) + b"\x53" for n, byte in enumerate(inner))
    creation = store + push(len(inner)) + b"\x5f\xf3"
    fill = b"".join(push(byte) + push(n) + b"\x53" for n, byte in enumerate(creation))
    call = push(32) + push(0x300) + push(32) + push(0x200) + b"\x84\x5a\xfa\x50"
    made = fill + push(len(creation)) + b"\x5f\x5f\xf0" + push(5) + push(0x200) + b"\x52" + call + call
    answer = same({ADDRESS: made + END, OTHER: inner})
    assert answer.output[0x300:0x320] == (15).to_bytes(32, "big")


# ---- what a translation may write, and its limits ----


def test_every_store_is_checked() -> None:
    """Of the contracts that are shipped, and of random programs: read by a decoder of our own."""
    evm = Ours().instance
    chain = RevmChain()
    chain.address("Studio")
    chain.address("Renderer")
    for code in chain.codes().values():
        assert stores.check(evm.translate(code, _compiled.REGION)) > 1_000
    rng = random.Random(5)
    for _ in range(100):
        for region in (*REGIONS, 80):
            stores.check(evm.translate(program(rng), region))


#: Code that makes much of little: each byte a JUMPDEST, a line without an end, forks of forks, and nothing of sense.
HOSTILE = {
    "jumpdests": JUMPDEST * 24_576,
    "line": push(1) + b"\x80\x02" * 60_000,
    "memory": b"\x36\x51" * 12_000,
    "forks": b"".join(JUMPDEST + b"\x36\x61" + (6 * n % 24_000).to_bytes(2, "big") + b"\x57" for n in range(4_000)),
    "random": random.Random(3).randbytes(24_576),
    "products": (JUMPDEST + b"\x36\x36\x02\x36\x51\x02\x36\x04") * 3_000,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_code(name: str) -> None:
    """Its translation ends soon, is valid, and bounded; or there is none."""
    evm = Instance()
    begin = time.process_time()
    translated = evm.translate(HOSTILE[name], _compiled.REGION)
    assert time.process_time() - begin < 5
    assert len(translated) < 8 << 20
    if translated:
        wasmtime.Module.validate(evm._engine, translated)
        stores.check(translated)
    assert evm.translate(bytes(1 << 18), _compiled.REGION) == b""


# ---- which contracts are compiled, and when ----

#: Multiplies as often as the data of the call says.
BUSY = push(0) + b"\x35\x5b" + push(1) + b"\x90\x03\x80\x80\x02\x50\x80" + push(2) + b"\x57" + push(0) + b"\x52" + END
ROUNDS = (200_000).to_bytes(32, "big")

PROGRAM = f"""
import sys, threading
from shackled.evm import _compiled
from shackled.evm._instance import Instance
_compiled.SOME, _compiled.MUCH = 1, 2
made = Instance()
made.put(bytes(20), bytes.fromhex("{BUSY.hex()}"))
answers = {{made.call(bytes(20), bytes.fromhex("{ROUNDS.hex()}"), 1 << 40) for _ in range(2)}}
for thread in threading.enumerate():
    if thread is not threading.main_thread():
        thread.join()
answers |= {{made.call(bytes(20), bytes.fromhex("{ROUNDS.hex()}"), 1 << 40) for _ in range(2)}}
print(len(answers), len(_compiled._machine_code))
"""


def said(cache: Path, count: int = 1, **variables: str) -> str:
    """Return what processes print that compile a contract at the same time, with their cache in a folder."""
    environment = os.environ | {"XDG_CACHE_HOME": str(cache), "SHACKLED_EVM": ""} | variables
    with ExitStack() as stack:
        started = [stack.enter_context(child(sys.executable, "-c", PROGRAM, env=environment)) for _ in range(count)]
        ended = [(*process.communicate(timeout=120), process.returncode) for process in started]
    assert all(end == (ended[0][0], "", 0) for end in ended), ended
    return ended[0][0].strip()


def files(cache: Path) -> list[Path]:
    return sorted((cache / "shackled").glob("code-*.bin"))


needs_linux = pytest.mark.skipif(sys.platform != "linux", reason="sets the cache folder by XDG_CACHE_HOME")


@needs_linux
def test_machine_code_is_kept_for_later_processes(tmp_path: Path) -> None:
    """Also where several compile at once; what is damaged, or could be another's, is compiled again."""
    assert said(tmp_path, 2) == "1 1"
    (path,) = files(tmp_path)
    whole, kept = path.read_bytes(), path.stat().st_mtime_ns
    assert said(tmp_path) == "1 1"
    assert path.stat().st_mtime_ns == kept
    path.write_bytes(whole[:-1])
    assert said(tmp_path) == "1 1"
    assert path.stat().st_size > len(whole) - 1
    path.chmod(0o666)
    assert said(tmp_path) == "1 1"
    assert path.stat().st_mode & 0o777 == 0o600


@needs_linux
def test_where_nothing_can_be_kept(tmp_path: Path) -> None:
    """A folder that is a file, and a device that is full."""
    (tmp_path / "shackled").write_text("")
    assert said(tmp_path) == "1 1"
    assert said(Path("/dev/full")) == "1 1"


@needs_linux
def test_the_cache_is_bounded(tmp_path: Path) -> None:
    (tmp_path / "shackled").mkdir()
    for number in range(60):
        path = tmp_path / "shackled" / f"code-{number}.bin"
        path.write_text("")
        os.utime(path, (number, number))
    assert said(tmp_path) == "1 1"
    assert len(files(tmp_path)) == _compiled.MOST_FILES
    assert not (tmp_path / "shackled" / "code-20.bin").exists()


def test_the_variable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert said(tmp_path, SHACKLED_EVM="interpreter") == "1 0"
    assert said(tmp_path, SHACKLED_EVM="compiled") == "1 1"
    monkeypatch.setenv("SHACKLED_EVM", "jit")
    with pytest.raises(InputError, match=r"^SHACKLED_EVM must be `interpreter` or `compiled`, not 'jit'$"):
        Instance()


def test_what_cannot_be_compiled_stays_interpreted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SHACKLED_EVM", "compiled")
    evm = Instance()
    evm.put(ADDRESS, bytes(1 << 18))
    assert evm.call(ADDRESS, b"", GAS).status == Status.SUCCESS
    assert not evm.compile(ADDRESS)
