"""The accounts of development nodes, whose keys are published and known to everyone: worth nothing anywhere else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..chain import Connection
from ..deploy import Transactor
from ..errors import InputError
from ..ethereum import ETHER, ether

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

CHAIN_ID = 31337
#: As the documentation of anvil has it.
PHRASE = "test test test test test test test test test test test junk"
ACCOUNTS = 10
#: Each account of a fresh anvil has 10,000 ether; of one that is not quite fresh a little less.
FUNDS = 9_000 * ETHER


def development_accounts(count: int = ACCOUNTS) -> list[LocalAccount]:
    """Return the first accounts, 1 to 10."""
    from eth_account import Account

    Account.enable_unaudited_hdwallet_features()
    return [Account.from_mnemonic(PHRASE, account_path=f"m/44'/60'/0'/0/{number}") for number in range(count)]


def development_transactors(connection: Connection, max_fee: int | None = None) -> list[Transactor]:
    """Return transactors of the accounts of a development node. InputError if the node is anything else.

    max_fee: see `current_fees`.
    """
    if connection.chain_id != CHAIN_ID:
        raise InputError(
            f"the demo is for a fresh anvil, whose chain is {CHAIN_ID}; the {connection.name} belongs to chain "
            f"{connection.chain_id}, where the keys that everyone knows must not be used"
        )
    version = str(connection.request("web3_clientVersion"))
    if not version.lower().startswith("anvil"):
        raise InputError(f"the demo is for a fresh anvil, and the {connection.name} is {version[:60]!r}")
    transactors = [Transactor(connection, account, max_fee=max_fee) for account in development_accounts()]
    for transactor in transactors:
        if transactor.balance() < FUNDS:
            raise InputError(
                f"the demo is for a fresh anvil: {transactor.name} has {ether(transactor.balance())} on the "
                f"{connection.name}, not about 10,000; start anvil anew, with no options that change its accounts"
            )
    return transactors
