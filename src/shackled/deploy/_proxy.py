"""The deterministic-deployment proxy, which most chains have: github.com/Arachnid/deterministic-deployment-proxy.

On other chains, a published transaction deploys it. Nobody has the key of the account that signed it, which is used for
nothing else; the account must be sent what the transaction costs.
"""

from __future__ import annotations

from ..chain import Connection
from ..errors import ChainError, NoAnswerError, OutOfGasError, TransactionError
from ..ethereum import GWEI, PROXY, checksum_address, keccak256, to_hex
from ._contract import PROXY_CODE
from ._quote import Call, Quote, base_fee
from ._transactor import Receipt, Transactor

#: The account that signed the published transaction, and its cost: 100,000 gas at 100 gwei.
SIGNER = bytes.fromhex("3fab184622dc19b6109349b94811493bf2a45362")
GAS = 100_000
PRICE = 100 * GWEI
COST = GAS * PRICE
#: Gas of a transfer of ether.
TRANSFER_GAS = 21_000
SIGNED = bytes.fromhex(
    "f8a58085174876e800830186a08080b853604580600e600039806000f350fe7fffffffffffffffffffffffffffffffffffffffffffffff"
    "ffffffffffffffffe03601600081602082378035828234f58015156039578182fd5b8082525050506014600cf31ba022222222222222222"
    "22222222222222222222222222222222222222222222222a02222222222222222222222222222222222222222222222222222222222222"
    "222"
)
#: The creation code of the proxy, in the published transaction.
CREATION = bytes.fromhex("604580600e600039806000f350fe") + PROXY_CODE


def is_proxy_deployed(connection: Connection) -> bool:
    """Return whether the chain has the proxy. Raises TransactionError if other code is at its address."""
    code = connection.code(PROXY)
    if code and code != PROXY_CODE:
        raise TransactionError(
            f"chain {connection.chain_id} has other code at the address of the deployment proxy, 0x{PROXY.hex()}: "
            "contracts cannot have their usual addresses there"
        )
    return bool(code)


def missing_funds(connection: Connection) -> int:
    """Return the wei that the signer of the published transaction lacks."""
    return max(0, COST - connection.balance(SIGNER))


def check_gas(connection: Connection) -> None:
    """Raise TransactionError if the node estimates more gas than the published transaction has."""
    try:
        needed = connection.number("eth_estimateGas", {"data": to_hex(CREATION)})
    except NoAnswerError:
        raise
    except ChainError:
        return
    if needed > GAS:
        raise too_little_gas(connection, f"and {needed:,} are needed there")


def too_little_gas(connection: Connection, why: str) -> TransactionError:
    """Return the error for a chain on which the published transaction has too little gas."""
    return TransactionError(
        f"chain {connection.chain_id} has no deployment proxy, and the published transaction that deploys it has "
        f"{GAS:,} gas, {why}: take a chain that has the proxy at {checksum_address(PROXY)}, or, on a development node, "
        "put its code there (anvil_setCode, hardhat_setCode)"
    )


def funding(missing: int) -> Call:
    """Return the transfer of the missing wei to the signer of the published transaction."""
    return Call(SIGNER, b"", TRANSFER_GAS, missing)


def deploy_proxy(transactor: Transactor, quote: Quote | None) -> list[Receipt]:
    """Send the signer of the published transaction the quoted ether, then that transaction."""
    connection = transactor.connection
    price = base_fee(connection) or 0
    if price > PRICE:
        raise TransactionError(
            f"gas costs {price / GWEI:.6g} gwei now, and the published transaction that deploys the proxy offers "
            f"{PRICE // GWEI}: wait until it is cheaper"
        )
    receipts = []
    try:
        if quote is not None:
            # a node that refuses such transactions must be found before anything is paid
            transactor.probe(SIGNED)
            receipts.append(transactor.send(quote))
        receipts.append(transactor.send_signed(SIGNED, to_hex(keccak256(SIGNED)), COST))
    except OutOfGasError:
        raise too_little_gas(connection, "which is too little for the node") from None
    if not transactor.wait(lambda: is_proxy_deployed(connection) or None):
        raise TransactionError(
            "the deployment proxy is not there, though its transaction succeeded: is the node synchronized?"
        )
    return receipts
