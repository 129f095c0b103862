"""The deterministic-deployment proxy, which most chains have: github.com/Arachnid/deterministic-deployment-proxy.

Where it is missing, a transaction that was published for everyone deploys it. Nobody has the key of the account that
signed it, which is used for this only; it has to be given what the transaction costs.
"""

from __future__ import annotations

from ..chain.addresses import PROXY, keccak256
from ..chain.connection import Connection
from ..errors import TransactionError
from .contract import PROXY_CODE
from .transactor import GWEI, Fees, Receipt, Transactor

#: The account that signed, and what it must have: 100,000 gas at 100 gwei.
SIGNER = bytes.fromhex("3fab184622dc19b6109349b94811493bf2a45362")
GAS = 100_000
PRICE = 100 * GWEI
COST = GAS * PRICE
#: A transfer of ether.
TRANSFER_GAS = 21_000
SIGNED = bytes.fromhex(
    "f8a58085174876e800830186a08080b853604580600e600039806000f350fe7fffffffffffffffffffffffffffffffffffffffffffffff"
    "ffffffffffffffffe03601600081602082378035828234f58015156039578182fd5b8082525050506014600cf31ba022222222222222222"
    "22222222222222222222222222222222222222222222222a02222222222222222222222222222222222222222222222222222222222222"
    "222"
)


def proxy_stands(connection: Connection) -> bool:
    """Whether the proxy is on the chain. TransactionError if something else is at its address."""
    code = connection.data("eth_getCode", "0x" + PROXY.hex(), "latest")
    if code and code != PROXY_CODE:
        raise TransactionError(
            f"chain {connection.chain_id} has something else where the deployment proxy belongs, at 0x{PROXY.hex()}: "
            "contracts cannot have their usual addresses there"
        )
    return bool(code)


def missing_funds(connection: Connection) -> int:
    """The wei that the account that signed must be given."""
    return max(0, COST - connection.number("eth_getBalance", "0x" + SIGNER.hex(), "latest"))


def deploy_proxy(transactor: Transactor, agreed: Fees | None = None) -> list[Receipt]:
    """Gives the account that signed what it needs, and sends the published transaction."""
    price = transactor.fees().likely
    if price > PRICE:
        raise TransactionError(
            f"gas costs {price / GWEI:.6g} gwei now, and the published transaction that deploys the proxy offers "
            f"{PRICE // GWEI}: wait until it is cheaper"
        )
    receipts = []
    missing = missing_funds(transactor.connection)
    if missing:
        # a node that takes no such transaction shall say so before anything is paid
        transactor.offer(SIGNED)
        receipts.append(transactor.send(SIGNER, value=missing, agreed=agreed))
    receipts.append(transactor.send_signed(SIGNED, "0x" + keccak256(SIGNED).hex(), COST))
    if not transactor.wait(lambda: proxy_stands(transactor.connection) or None):
        raise TransactionError(
            "the deployment proxy is not there, though its transaction succeeded: is the node in step?"
        )
    return receipts
