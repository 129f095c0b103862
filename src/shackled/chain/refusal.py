"""Why a contract refused, in words."""

from __future__ import annotations

from ..artifacts import artifact, contracts
from ..errors import OutOfGasError, RenderError

_PANIC = bytes.fromhex("4e487b71")
_ERROR = bytes.fromhex("08c379a0")


def refusal(output: bytes, gas_limit: int) -> RenderError:
    """Says what a contract reverted with, such as "the contract refused: CanvasSize(width=0, height=0)"."""
    description = _describe(output)
    if description == "OutOfGas()":
        return out_of_gas(gas_limit)
    return RenderError(f"the contract refused: {description}")


def _describe(output: bytes) -> str:
    selector, words = output[:4], [output[at : at + 32] for at in range(4, len(output), 32)]
    if not output:
        return "the data of the call is not a scene as it should be encoded"
    if selector == _PANIC:
        return f"Panic({int.from_bytes(output[4:], 'big'):#x})"
    if selector == _ERROR and len(words) >= 2:
        return words[2][: int.from_bytes(words[1], "big")].decode(errors="replace") if len(words) > 2 else "Error"
    # a contract passes on the errors of those that it calls
    known = {key: error for contract in contracts() for key, error in artifact(contract).errors.items()}
    if selector not in known:
        return f"error 0x{output[:68].hex()}"
    name, parameters = known[selector]
    values = [f"{label or kind}={_value(kind, word)}" for (label, kind), word in zip(parameters, words, strict=False)]
    return f"{name}({', '.join(values)})"


def _value(kind: str, word: bytes) -> str:
    if kind == "address":
        return f"0x{word[-20:].hex()}"
    return str(int.from_bytes(word, "big", signed=kind.startswith("int")))


def out_of_gas(limit: int) -> OutOfGasError:
    """The error of a call that ran out of gas."""
    return OutOfGasError(f"the call ran out of gas: {limit:,} did not suffice")
