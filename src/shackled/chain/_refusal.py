"""Why a contract refused, in words."""

from __future__ import annotations

from ..artifacts import known_errors
from ..errors import ChainError, OutOfGasError, RenderError
from ..ethereum import decode_error, to_hex


def refusal(data: bytes, gas_limit: int) -> ChainError:
    """Return the error of a call that a contract reverted.

    data: what it reverted with. gas_limit: of the call, for the message of an `OutOfGasError`.
    """
    description = describe(data)
    if description == "OutOfGas()":
        return out_of_gas(gas_limit)
    return RenderError(f"the contract refused: {description}")


def describe(data: bytes) -> str:
    """Write what a contract reverted with, such as "CanvasSize(width=0, height=17)"."""
    if not data:
        return "the data of the call is not a scene as it should be encoded"
    found = decode_error(data, known_errors())
    if found is None:
        return f"error {to_hex(data[:68])}"
    name, values = found
    if name == "Error":
        return str(values["message"])
    if name == "Panic":
        return f"Panic({values['code']:#x})"
    shown = (f"{key}={to_hex(value) if isinstance(value, bytes) else value}" for key, value in values.items())
    return f"{name}({', '.join(shown)})"


def out_of_gas(limit: int) -> OutOfGasError:
    """Return the error of a call that ran out of gas."""
    return OutOfGasError(f"the call ran out of gas: {limit:,} did not suffice")
