"""Small programs end with the same status, output and gas in the EVM of the package, in pyrevm and in py-evm."""

from __future__ import annotations

import itertools
import random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from evms import ADDRESS, REGIONS, Ours, pyevm_call, pyrevm_call
from shackled.evm._instance import Answer, Status

GAS = 100_000
ONES = (1 << 256) - 1

ADD, MUL, SUB, DIV, SDIV, MOD, SMOD, ADDMOD, MULMOD, EXP, SIGNEXTEND = range(0x01, 0x0C)
LT, GT, SLT, SGT, EQ, ISZERO, AND, OR, XOR, NOT, BYTE, SHL, SHR, SAR = range(0x10, 0x1E)
KECCAK, CALLDATALOAD, CALLDATASIZE, CALLDATACOPY, CODESIZE, CODECOPY = 0x20, 0x35, 0x36, 0x37, 0x38, 0x39
RETURNDATASIZE, RETURNDATACOPY = 0x3D, 0x3E
POP, MLOAD, MSTORE, MSTORE8, SLOAD, SSTORE, JUMP, JUMPI, PC, MSIZE, GAS_LEFT, JUMPDEST = range(0x50, 0x5C)
TLOAD, TSTORE, MCOPY, PUSH0, PUSH1 = 0x5C, 0x5D, 0x5E, 0x5F, 0x60
DUP1, SWAP1, CALL, RETURN, STATICCALL, REVERT, INVALID = 0x80, 0x90, 0xF1, 0xF3, 0xFA, 0xFD, 0xFE

#: Made with addresses of precompiled contracts, which are left out, these fail as a whole.
CALLS = (0xF1, 0xF2, 0xF4, 0xFA)
#: Instructions without an effect but their result, by the number of their operands.
PURE = {
    1: (ISZERO, NOT, CALLDATALOAD),
    2: (
        *(ADD, MUL, SUB, DIV, SDIV, MOD, SMOD, EXP, SIGNEXTEND),
        *(LT, GT, SLT, SGT, EQ, AND, OR, XOR, BYTE, SHL, SHR, SAR),
    ),
    3: (ADDMOD, MULMOD),
}
#: Numbers at which machine words, signs, shifts and places of bytes end.
EDGES = sorted(
    {
        value % (1 << 256)
        for power in (0, 5, 8, 31, 32, 63, 64, 127, 128, 192, 255)
        for sign in (1, -1)
        for value in (sign * 2**power - 1, sign * 2**power, sign * 2**power + 1)
    }
    | {3, 30, 32, 257, 0x0123456789ABCDEF << 100}
)


def push(value: int) -> bytes:
    """Return the shortest instruction that pushes a number."""
    size = (value.bit_length() + 7) // 8
    return bytes([PUSH0 + size]) + value.to_bytes(size, "big")


def op(code: int, *operands: int) -> bytes:
    """Return an instruction after its operands, the first on top of the stack."""
    return b"".join(push(each) for each in reversed(operands)) + bytes([code])


#: Returns the memory, after the two upper words of the stack.
END = op(MSTORE, 0x100) + op(MSTORE, 0x120) + bytes([MSIZE, PUSH0, RETURN])


@pytest.fixture(scope="module", params=REGIONS)
def ours(request: pytest.FixtureRequest) -> Ours:
    """In the interpreter, compiled in regions of one instruction, and as usual."""
    return Ours(request.param)


@pytest.fixture(scope="module")
def machines() -> list[Ours]:
    """All of them."""
    return [*map(Ours, REGIONS)]


def agree(ours: Ours, code: bytes, data: bytes = b"", gas: int = GAS) -> Answer:
    """Check that a program ends in the same way in all three, and return how."""
    codes = {ADDRESS: code}
    answer = ours.call(codes, ADDRESS, data, gas)
    assert answer == pyrevm_call(codes, ADDRESS, data, gas), code.hex()
    assert answer == pyevm_call(codes, ADDRESS, data, gas), code.hex()
    return answer


def agree_with_pyrevm(ours: Ours, code: bytes, data: bytes = b"", gas: int = GAS) -> Answer:
    """Do the same with pyrevm only. Where an instruction fails for two reasons, they may name either."""
    codes = {ADDRESS: code}
    answer, expected = ours.call(codes, ADDRESS, data, gas), pyrevm_call(codes, ADDRESS, data, gas)
    if answer.status == Status.FAILURE and expected.status == Status.OUT_OF_GAS:
        expected = expected._replace(status=Status.FAILURE)
    elif answer.status == Status.OUT_OF_GAS and expected.status == Status.FAILURE:
        expected = expected._replace(status=Status.OUT_OF_GAS)
    assert answer == expected, code.hex()
    return answer


@pytest.mark.parametrize(("operands", "code"), [(n, code) for n, codes in PURE.items() for code in codes])
def test_results_at_the_edges(ours: Ours, operands: int, code: int) -> None:
    """Each instruction, for numbers around all powers of two that matter, in all pairs: constants."""
    # code of that length is compiled slowly: compiled contracts have the next test, which is the same where regions are
    # of one instruction, whose operands are on the stack
    thin = (1 if operands < 3 else 4) * {None: 1, 1: 12}.get(ours.region, 3)
    cases = list(itertools.product(EDGES[::thin], repeat=operands))
    program = b"".join(op(code, *case) + op(MSTORE, 32 * n) for n, case in enumerate(cases))
    answer = agree(ours, program + op(RETURN, 0, 32 * len(cases)), bytes(range(256)), 100_000_000)
    assert answer.status == Status.SUCCESS
    assert len(answer.output) == 32 * len(cases)


@pytest.mark.parametrize(("operands", "code"), [(n, code) for n, codes in PURE.items() for code in codes])
def test_results_of_data_at_the_edges(ours: Ours, operands: int, code: int) -> None:
    """The same of operands that are known at run time only, the data of the call, in a loop."""
    cases = list(itertools.product(EDGES if operands < 3 else EDGES[::4], repeat=operands))
    # on the stack is the place of a case in the data, which is that of its result in memory too
    load = [bytes([DUP1 + n]) + op(ADD, 32 * (operands - 1 - n)) + bytes([CALLDATALOAD]) for n in range(operands)]
    step = bytes([DUP1 + 1, MSTORE]) + op(ADD, 32 * operands) + bytes([CALLDATASIZE, DUP1 + 1, LT])
    program = (
        bytes([PUSH0, JUMPDEST]) + b"".join(load) + bytes([code]) + step + op(JUMPI, 1) + bytes([MSIZE, PUSH0, RETURN])
    )
    data = b"".join(each.to_bytes(32, "big") for case in cases for each in case)
    answer = agree(ours, program, data, 100_000_000)
    assert answer.status == Status.SUCCESS
    assert len(answer.output) == 32 * (operands * (len(cases) - 1) + 1)


PROGRAMS = {
    "nothing": b"",
    "stop": b"\x00",
    "invalid": bytes([INVALID]),
    "unknown instruction": b"\x0c",
    "instruction of a later fork": b"\x1e",
    "revert": op(REVERT, 0, 0),
    "revert with data": op(MSTORE, 0, ONES) + op(REVERT, 3, 40),
    "underflow of one operand": bytes([POP]),
    "underflow of two operands": push(1) + bytes([ADD]),
    "underflow of DUP16": push(1) * 15 + b"\x8f",
    "underflow of SWAP16": push(1) * 16 + b"\x9f",
    "SWAP16": b"".join(map(push, range(17))) + b"\x9f" + END,
    "underflow of JUMPI": push(1) + bytes([JUMPI]),
    "full stack": push(1) * 1024,
    "load at a fixed place on a full stack": op(MSTORE, 0, 1) + push(1) * 1024 + op(MLOAD, 0),
    "load at a fixed place on the last word": op(MSTORE, 0, 7) + push(1) * 1023 + op(MLOAD, 0),
    "jump on a full stack": push(1) * 1024 + op(JUMP, 2052) + bytes([JUMPDEST]),
    "shift on a full stack": push(1) * 1024 + op(SHL, 1),
    "shift of nothing": op(SHL, 1),
    "store of nothing at a fixed place": op(MSTORE, 0, 1) + op(MSTORE, 0),
    "jump on nothing": op(JUMPI, 3) + bytes([JUMPDEST]),
    "overflow by PUSH": push(1) * 1025,
    "overflow by PUSH0": bytes([PUSH0]) * 1025,
    "overflow by DUP": push(1) * 1024 + bytes([DUP1]),
    "overflow in a loop": bytes([JUMPDEST]) + push(1) + op(JUMP, 0),
    "swap on a full stack": push(1) * 1024 + bytes([SWAP1]),
    "jump to a place of data": op(JUMP, 4) + push(0x5B),
    "jump to what is no JUMPDEST": op(JUMP, 3) + b"\x00",
    "jump to the end": op(JUMP, 3),
    "jump beyond the end": op(JUMP, 100),
    "jump to 2^31": op(JUMP, 1 << 31),
    "jump to 2^32 + 4": op(JUMP, (1 << 32) + 7) + bytes([JUMPDEST]),
    "jump to 2^64 + 4": op(JUMP, (1 << 64) + 10) + bytes([JUMPDEST]),
    "jump to -1": op(JUMP, ONES),
    "jump": op(JUMP, 3) + bytes([JUMPDEST]),
    "jump if": op(JUMPI, 5, 1) + bytes([JUMPDEST]),
    "no jump": op(JUMPI, 5, 0) + bytes([JUMPDEST]),
    "jump to a place of two bytes": op(JUMPI, 300, 1) + bytes(293) + bytes([JUMPDEST]),
    "no jump to a bad place": op(JUMPI, ONES, 0),
    "jump to a bad place": op(JUMPI, ONES, 1 << 255),
    "push beyond the end": b"\x7f\x01\x02",
    "push of nothing at the end": b"\x60",
    "endless loop": bytes([JUMPDEST]) + op(JUMP, 0),
    "load beyond the memory": op(MLOAD, 1) + END,
    "store at the border": op(MSTORE, 0, 1) + op(MSTORE, 1, 2) + op(MSTORE, 32, 3) + bytes([MSIZE]) + END,
    "byte at the border": op(MSTORE8, 31, 0x1FF) + op(MSTORE8, 32, 0x2EE) + bytes([MSIZE]) * 2 + END,
    "load of the last word": op(MSTORE8, 63, 1) + op(MLOAD, 32) + op(MLOAD, 33) + END,
    "load at 2^31": op(MLOAD, 1 << 31),
    "load at 2^32": op(MLOAD, 1 << 32),
    "load at 2^64": op(MLOAD, 1 << 64),
    "load at -32": op(MLOAD, ONES - 31),
    "store at -1": op(MSTORE, ONES, 1),
    "byte at -1": op(MSTORE8, ONES, 1),
    "copy of memory upward": op(MSTORE, 0, EDGES[-3]) + op(MCOPY, 5, 0, 40) + bytes([MSIZE]) * 2 + END,
    "copy of memory downward": op(MSTORE, 32, EDGES[-3]) + op(MCOPY, 3, 20, 44) + bytes([MSIZE]) * 2 + END,
    "copy of memory at the border": op(MSTORE, 32, ONES) + op(MCOPY, 61, 33, 3) + op(MCOPY, 62, 33, 3) + END,
    "copy from the border": op(MSTORE, 32, ONES) + op(MCOPY, 1, 56, 8) + op(MCOPY, 2, 57, 8) + bytes([MSIZE]) + END,
    "copy of nothing": op(MSTORE, 32, ONES) + op(MCOPY, 64, 3, 0) + op(MCOPY, 65, 3, 0) + END,
    "copy of too few words": op(MSTORE, 32, ONES) + push(1) * 2 + bytes([MCOPY]),
    "the call's data": b"".join(op(CALLDATALOAD, place) for place in (0, 7, 8, 38, 39)) + END,
    "copy of nothing from far": op(MCOPY, ONES, ONES, 0) + bytes([MSIZE]) * 2 + END,
    "copy from far": op(MCOPY, 0, 1 << 64, 1),
    "copy of the call's data beyond it": op(CALLDATACOPY, 2, 1, 70) + op(CALLDATACOPY, 90, ONES, 3) + push(1) * 2 + END,
    "copy of code beyond its end": op(CODECOPY, 2, 5, 70) + bytes([CODESIZE, CALLDATASIZE]) + END,
    "copy of returned data beyond its end": op(RETURNDATACOPY, 0, 0, 1),
    "hash": op(MSTORE, 7, ONES) + op(KECCAK, 3, 90) + op(KECCAK, ONES, 0) + END,
    "hash of 2^40 bytes": op(KECCAK, 0, 1 << 40),
    "return of 2^64 bytes": op(RETURN, 0, 1 << 64),
    "where and how much": bytes([PC, GAS_LEFT]) + END,
    "storage": op(SSTORE, 1, 5) + op(SLOAD, 1) + op(TSTORE, 1, 9) + op(TLOAD, 1) + END,
    "identity": op(MSTORE, 0, ONES) + op(STATICCALL, GAS, 4, 3, 50, 60, 50) + bytes([RETURNDATASIZE]) + END,
    "an account without code": op(CALL, GAS, 0x1234, 0, 0, 0, 0, 0) + bytes([RETURNDATASIZE]) + END,
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_ends(ours: Ours, name: str) -> None:
    agree(ours, PROGRAMS[name], bytes(range(1, 40)))


@pytest.mark.parametrize("name", PROGRAMS)
def test_every_limit_of_gas(ours: Ours, name: str) -> None:
    """From none to more than enough: the gas runs out before the same instruction."""
    full = agree_with_pyrevm(ours, PROGRAMS[name], gas=3_000)
    for gas in range(min(full.gas + 2, 400)):
        agree_with_pyrevm(ours, PROGRAMS[name], gas=gas)
    for gas in range(max(0, full.gas - 2), full.gas + 3):
        agree_with_pyrevm(ours, PROGRAMS[name], gas=gas)


def test_calls_within_calls(ours: Ours) -> None:
    """A contract that calls itself with all gas until none is left, or until the stack of calls is full."""
    program = bytes([CALLDATASIZE, PUSH0, PUSH0, CALLDATASIZE, PUSH0, PUSH0, 0x30, GAS_LEFT, CALL, GAS_LEFT]) + END
    for gas in (50_000, 5_000_000, 25_000_000_000):
        agree_with_pyrevm(ours, program, gas=gas)


def test_a_static_call_writes_nothing(ours: Ours) -> None:
    inner = bytes(18) + b"\xbe\xef"
    for program in (op(SSTORE, 1, 1), op(TSTORE, 1, 1), op(0xA0, 0, 0), op(0xF0, 0, 0, 0), op(0xFF, 0)):
        outer = op(STATICCALL, 50_000, 0xBEEF, 0, 0, 0, 0) + bytes([RETURNDATASIZE]) + END
        codes = {ADDRESS: outer, inner: program}
        answer = ours.call(codes, ADDRESS, b"", GAS)
        assert answer == pyrevm_call(codes, ADDRESS, b"", GAS)
        assert answer.output[-1] == 0


def test_other_precompiled_contracts_fail_as_a_whole(ours: Ours) -> None:
    """They are left out; what they would return is not made up."""
    for number in (*range(1, 4), *range(5, 11)):
        ours.put(ADDRESS, op(STATICCALL, GAS, number, 0, 0, 0, 0) + END)
        answer = ours.instance.call(ADDRESS, b"", GAS)
        assert answer.status == Status.FAILURE
        assert b"is not part of this EVM" in answer.output


@pytest.mark.parametrize("size", range(1, 33))
def test_immediates(ours: Ours, size: int) -> None:
    """Of every size, in the first bytes of a code, behind them, and cut off by its end."""
    value = bytes([PUSH0 + size]) + bytes(range(0xFF, 0xFF - size, -1))
    # the interpreter reads whole words of the code; what is compiled reads bytes, wherever they are
    for before in range(0, 34, 1 if ours.region is None else 11):
        program = bytes([JUMPDEST]) * before + value
        answer = agree_with_pyrevm(ours, program + op(MSTORE, 0) + op(RETURN, 0, 32))
        assert answer.output == value[1:].rjust(32, b"\0")
        agree_with_pyrevm(ours, program[:-1])


@pytest.mark.parametrize("size", [*range(70), 300])
def test_copies_of_memory(ours: Ours, size: int) -> None:
    """Upward and downward, with and without overlap, within the memory: each in a kilobyte of its own."""
    data = b"".join((ONES // 255 * (number + 1) ^ EDGES[-1]).to_bytes(32, "big") for number in range(32))
    places = ((3, 0), (0, 3), (40, 9), (9, 40), (500, 20), (20, 500), (1024 - size, 5), (5, 1024 - size))
    program = b"".join(
        op(CALLDATACOPY, start, 0, 1024) + op(MCOPY, start + to, start + origin, size)
        for start, (to, origin) in zip(range(0, 8192, 1024), places, strict=True)
    )
    answer = agree_with_pyrevm(ours, program + op(RETURN, 0, 8192), data)
    assert len(answer.output) == 8192


def test_the_data_of_a_call_from_a_contract(ours: Ours) -> None:
    """They are memory of the caller, which is read where it is."""
    inner = bytes(18) + b"\xbe\xef"
    answer = bytes([JUMPDEST]) + b"".join(op(CALLDATALOAD, place) for place in (0, 9, 63, 64)) + bytes([CALLDATASIZE])
    answer += b"".join(op(MSTORE, 32 * number) for number in range(5)) + op(RETURN, 0, 160)
    fill = b"".join(op(MSTORE, 32 * number, EDGES[-number - 1]) for number in range(5))
    outer = fill + op(STATICCALL, 50_000, 0xBEEF, 17, 95, 0, 160) + op(RETURN, 0, 160)
    codes = {ADDRESS: outer, inner: answer}
    found = ours.call(codes, ADDRESS, b"", GAS)
    assert found == pyrevm_call(codes, ADDRESS, b"", GAS)
    assert int.from_bytes(found.output[:32]) == 95


# ---- random programs ----

numbers = st.one_of(
    st.sampled_from(EDGES),
    st.integers(0, 300),
    st.builds(lambda edge, step: (edge + step) % (1 << 256), st.sampled_from(EDGES), st.integers(-40, 40)),
    st.integers(0, ONES),
)
places = st.one_of(st.integers(0, 200), st.sampled_from([255, 256, 1023, 1 << 20, *EDGES]))
sizes = st.one_of(st.integers(0, 70), st.sampled_from([1 << 16, 1 << 31, ONES]))
pure = [
    st.builds(op, st.sampled_from(codes), *([numbers] * operands))
    for operands, codes in PURE.items()
    for _ in range(operands)
]
pieces = st.one_of(
    *pure,
    # on what is on the stack already
    st.builds(lambda code: bytes([code]), st.sampled_from([*PURE[1], *PURE[2], *PURE[3], POP, MLOAD, MSTORE, MSIZE])),
    st.builds(lambda code: bytes([code]), st.integers(DUP1, SWAP1 + 15)),
    st.builds(push, numbers),
    st.builds(op, st.sampled_from([MLOAD, CALLDATALOAD]), places),
    st.builds(op, st.sampled_from([MSTORE, MSTORE8]), places, numbers),
    st.builds(op, st.sampled_from([MCOPY, CALLDATACOPY, CODECOPY]), places, places, sizes),
    st.builds(op, st.just(KECCAK), places, sizes),
    st.just(bytes([JUMPDEST])),
    # backward, forward, or to what is no place to jump to
    st.builds(op, st.just(JUMP), st.integers(0, 400)),
    st.builds(op, st.just(JUMPI), st.integers(0, 400), st.integers(0, 2)),
    # the identity, nobody, or this program once more
    st.builds(
        op, st.sampled_from([CALL + 3, STATICCALL]), numbers, st.sampled_from([4, 0x1234, 0xC0DE]), *[places] * 4
    ),
    st.builds(lambda code: bytes([code]), st.integers(0, 255).filter(lambda code: code not in CALLS)),
)


@settings(max_examples=800, deadline=None)
@given(st.lists(pieces, max_size=40), st.binary(max_size=70), st.integers(0, 20_000))
@example([op(SDIV, 1 << 255, ONES)], b"", 1000)
def test_random_programs(machines: list[Ours], parts: list[bytes], data: bytes, gas: int) -> None:
    for ours in machines:
        agree_with_pyrevm(ours, b"".join(map(push, range(6))) + b"".join(parts) + END, data, gas)


@pytest.mark.parametrize("seed", range(20))
def test_random_loops(ours: Ours, seed: int) -> None:
    """Many rounds over a few instructions, which work on what the last round left on the stack and in memory."""
    rng = random.Random(seed)
    body = bytearray()
    for number in range(rng.randint(5, 40)):
        operands = rng.choice((1, 2, 2, 2, 3))
        body += bytes([rng.choice((DUP1, DUP1 + 3, DUP1 + 7, SWAP1 + 2))]) * rng.randint(1, 3)
        body += op(AND, 0xFFF) + bytes([MLOAD]) if rng.random() < 0.3 else b""
        body += bytes([rng.choice([each for each in PURE[operands] if each != EXP])])
        body += bytes([DUP1]) + op(AND, 0xFFF) + bytes([MSTORE]) if rng.random() < 0.3 else b""
        if number % 5 == 4:
            body += op(MCOPY, rng.randrange(4096), rng.randrange(4096), rng.choice((0, 3, 8, 33)))
    start = b"".join(push(rng.choice(EDGES)) for _ in range(200))
    program = start + bytes([JUMPDEST]) + body + op(JUMPI, len(start), 1)
    answer = agree_with_pyrevm(ours, program, bytes(range(200)), 300_000)
    assert answer.status in (Status.OUT_OF_GAS, Status.FAILURE)
    # the state before the end, at places that no two programs share
    for gas in rng.sample(range(1000, 60_000), 10):
        agree_with_pyrevm(ours, program, gas=gas)
