"""Options of the commands that use a node: which node, which account pays, and how much at most."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..base.checks import number
from ..base.untrusted import plain
from ..base.values import plural
from ..base.whole_file import check_output_file, write_output
from ..chain._connection import PATIENCE, Connection
from ..deploy._account import environment_account, keystore_account, read_keystore, signer_class
from ..deploy._deployer import Plan
from ..deploy._quote import Call, Quote
from ..deploy._transactor import Receipt, Transactor
from ..errors import InputError
from ..ethereum._amounts import GWEI, at_most, ether, roughly
from ..ethereum._encoding import checksum_address, parse_address
from ..tokens._collection import Collection
from ..tokens._contract import plan
from .option import exclude, option
from .output import print_json, print_note

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

#: The environment variable with the password of a keystore file.
PASSWORD = "SHACKLED_PASSWORD"


def parse_max_fee(gwei: float, name: str) -> int:
    """Return the wei of --max-fee. InputError if it is out of range."""
    return max(1, round(number(gwei, name, 1e-9, 1e9) * GWEI))


def parse_checksum_address(text: str, name: str) -> str:
    """Return an address with its checksum. InputError, which names `name`, if it is invalid."""
    return checksum_address(parse_address(text, name))


def address(name: str, text: str) -> Any:
    """Declare an option whose value is an address."""
    return option(name, text, "ADDRESS", parse=parse_checksum_address)


MAX_FEE = option(
    "--max-fee",
    "Maximum fee per gas, in gwei. Default: twice the base fee plus a tip of at most 3 gwei; the command then "
    "stops if the node suggests a higher tip, reports no base fee, or estimates more than 10 times the usual gas.",
    "GWEI",
    type=float,
    parse=parse_max_fee,
)
JSON = option("--json", "Print JSON instead of text.")
CALLDATA = option(
    "--calldata",
    "Write the transactions to a JSON file for a wallet, and send nothing.",
    "FILE",
    type=Path,
    # before the work for it begins
    parse=lambda path, _: check_output_file(path, "list of transactions"),
)


@dataclass(frozen=True)
class NodeOptions:
    """The node that a command uses."""

    rpc: str | None = option("--rpc", "URL of a node of the chain.", "URL", envvar="SHACKLED_RPC")
    chain_id: int | None = option("--chain-id", "Stop unless the node belongs to this chain.", "N")

    def check(self) -> str:
        """Return the URL of the node. InputError without --rpc."""
        if self.rpc is None or not self.rpc.strip():
            raise InputError("--rpc is missing: the URL of a node of the chain, such as http://127.0.0.1:8545")
        return self.rpc.split()[0]

    def connect(self, timeout: float = PATIENCE) -> Connection:
        """Return a connection to the node. timeout: seconds for an answer. InputError without --rpc.

        WrongChainError if the node belongs to another chain than --chain-id.
        """
        connection = Connection(self.check(), timeout, attempts=4)
        connection.expect_chain(self.chain_id)
        return connection


@dataclass(frozen=True)
class SignerOptions:
    """The account that signs."""

    account: Path | None = option(
        "--account", f"Keystore file of the account. The password is prompted for, or read from {PASSWORD}.", "FILE"
    )
    private_key_env: str | None = option(
        "--private-key-env", "Environment variable with the private key of the account.", "NAME"
    )

    @property
    def is_given(self) -> bool:
        """Whether an account was named."""
        return self.account is not None or self.private_key_env is not None

    @property
    def address(self) -> str:
        """The address of the account."""
        return str(self.signer.address)

    def check(self) -> None:
        """Raise InputError if two accounts were named, or if none can sign here."""
        exclude("--account", self.account, {"--private-key-env": self.private_key_env})
        if self.is_given:
            signer_class()

    @cached_property
    def signer(self) -> LocalAccount:
        """The account, opened once. InputError if none was named or it cannot be opened; messages never show a key."""
        self.check()
        if self.private_key_env is not None:
            return environment_account(self.private_key_env)
        if self.account is None:
            raise InputError("nothing was sent: name an account with --account FILE or --private-key-env NAME")
        read_keystore(self.account)
        password = os.environ.get(PASSWORD)
        if password is None:
            if not sys.stdin.isatty():
                raise InputError(f"there is no terminal to ask for the password of {self.account}: set {PASSWORD}")
            password = click.prompt(plain(f"password of {self.account}"), hide_input=True, err=True)
        return keystore_account(self.account, password)


@dataclass(frozen=True)
class PayerOptions(SignerOptions):
    """The account that signs and pays, the maximum price of gas, and whether to ask before sending."""

    max_fee: int | None = MAX_FEE
    yes: bool = option("--yes -y", "Send without asking.")

    def transactor(self, connection: Connection) -> Transactor:
        """Return a transactor of the account."""
        return Transactor(connection, self.signer, max_fee=self.max_fee)

    def send(self, collection: Collection, title: str, call: Call) -> Receipt:
        """Print the price of a transaction to a collection, ask for consent, and send it. title: what it does."""
        transactor = self.transactor(collection.connection)
        quote = plan(transactor, call)
        print_note(f"{collection.name} on chain {collection.connection.chain_id}: {title}")
        self.confirm(transactor, [quote])
        receipt = transactor.send(quote)
        # printed even if what follows fails
        print_note(f"done: transaction {receipt.hash}")
        return receipt

    def confirm(self, transactor: Transactor, quotes: Sequence[Quote] = ()) -> None:
        """Print the price of transactions, and ask for consent unless --yes was given.

        InputError if there is no terminal to ask at, click.Abort for no.
        """
        if quotes:
            print_price(quotes)
        if self.yes:
            return
        if not sys.stdin.isatty():
            raise InputError("nothing was sent: there is no terminal to ask for consent; --yes sends without asking")
        if not click.confirm(plain(f"Send from {checksum_address(transactor.address)}?"), err=True):
            raise click.Abort


def print_price(quotes: Sequence[Quote]) -> None:
    """Print the value, the estimated gas and the maximum cost of transactions."""
    value = sum(each.call.value for each in quotes)
    likely = sum(each.likely for each in quotes) - value
    gas, counted = sum(each.expected for each in quotes), sum(each.call.gas for each in quotes)
    print_note(
        "price: "
        + (f"{ether(value)}, plus " if value else "")
        + f"about {roughly(likely)} for gas ({gas:,} estimated by the node, {counted:,} counted locally); "
        + f"at most {at_most(sum(each.ceiling for each in quotes))} ether in total"
    )
    print_rollup_fee(quotes)


def print_rollup_fee(quotes: Sequence[Quote]) -> None:
    """Print what a rollup takes besides gas, if these transactions are for one."""
    if any(each.rollup_fee is None for each in quotes):
        print_note(
            "the chain takes a fee for data on L1 as well, and tells no bound of it: the maximum does not include it"
        )
    elif fee := sum(each.rollup_fee or 0 for each in quotes):
        print_note(f"the maximum includes {at_most(fee)} ether for data on L1, twice what the chain tells now")


def write_calls(path: Path, chain_id: int, quotes: Mapping[str, Quote], as_json: bool, **more: str) -> None:
    """Write transactions as JSON, so that a wallet can send them: the chain, and calls as in EIP-5792.

    quotes: by the purpose of each transaction, in the order of sending. as_json: also print the JSON, with `more`.
    """
    calls = []
    for name, each in quotes.items():
        call, to = each.call, each.call.to
        fields = {"value": hex(call.value), "data": f"0x{call.data.hex()}", "gas": hex(each.gas)}
        calls.append({"name": name, "to": to and checksum_address(to), **fields})
    document = {"chainId": hex(chain_id), "calls": calls}
    write_output(path, (json.dumps(document, indent=1) + "\n").encode())
    if as_json:
        print_json({**more, **document})
    gas = sum(each.gas for each in quotes.values())
    them = "it" if len(calls) == 1 else "them, in this order"
    print_note(
        f"nothing was sent: {path} has {plural(len(calls), 'transaction')}, {gas:,} gas in total; any account can send "
        f"{them}"
    )


def wallet_calls(plan: Plan) -> dict[str, Quote]:
    """Return the transactions by which a wallet deploys what is missing, in order, by their purpose."""
    return {f"deploy {step.name}": step.quote for step in plan.steps if step.quote is not None}


def print_step(name: str, address: bytes, receipt: Receipt) -> None:
    """Print what was deployed or stored, and the gas that it used."""
    print_note(f"{name}: at {checksum_address(address)}, {receipt.gas:,} gas, transaction {receipt.hash}")
