"""Who signs and pays, how much at most, and whether they want to."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..checks import number
from ..errors import InputError
from ..ethereum import at_most, ether, roughly
from ..untrusted import plain
from .option import option

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

    from ..deploy import Quote

#: Holds the password of a keystore where nobody can be asked.
PASSWORD = "SHACKLED_PASSWORD"

MaxFee = Annotated[
    float | None,
    option(
        "--max-fee",
        "The most that a gas may cost, in gwei. Without it: twice the base fee and a tip of at most 3; a node that "
        "wants a higher tip, tells no base fee, or estimates 10 times the usual gas is refused.",
        "GWEI",
    ),
]


def parse_max_fee(gwei: float | None) -> int | None:
    """The wei of --max-fee. InputError if it is no price."""
    return None if gwei is None else max(1, round(number(gwei, "--max-fee", 1e-9, 1e9) * 10**9))


def price(quotes: Sequence[Quote]) -> str:
    """What transactions cost, for people: value, gas by the node and as counted here, and the most in all."""
    value = sum(each.call.value for each in quotes)
    likely = sum(each.likely for each in quotes) - value
    gas, ours = sum(each.expected for each in quotes), sum(each.call.ours for each in quotes)
    return (
        (f"{ether(value)} and " if value else "")
        + f"about {roughly(likely)} for {gas:,} gas by the node, {ours:,} as counted here; "
        + f"at most {at_most(sum(each.ceiling for each in quotes))} ether in all"
    )


def open_signer(account: Path | None, variable: str | None) -> LocalAccount:
    """The account of --account or --private-key-env. InputError if there is none; nothing that is said shows a key."""
    from ..deploy import environment_account, keystore_account, read_keystore

    if account is not None and variable is not None:
        raise InputError("--account and --private-key-env both say who pays: give one of them")
    if variable is not None:
        return environment_account(variable)
    if account is None:
        raise InputError("nothing was sent; say whose account it is: --account FILE or --private-key-env NAME")
    read_keystore(account)
    password = os.environ.get(PASSWORD)
    if password is None:
        if not sys.stdin.isatty():
            raise InputError(f"the password of {account} cannot be asked here: put it into {PASSWORD}")
        password = typer.prompt(plain(f"password of {account}"), hide_input=True, err=True)
    return keystore_account(account, password)


def ask(payer: str) -> None:
    """Asks whether to go on. InputError where nobody can be asked, typer.Abort for no."""
    if not sys.stdin.isatty():
        raise InputError("nothing was sent, since nobody can be asked here: --yes does it without")
    if not typer.confirm(plain(f"Shall {payer} pay for it?"), err=True):
        raise typer.Abort
