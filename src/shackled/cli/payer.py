"""Who signs and pays, and whether they want to."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ..errors import InputError

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

#: Holds the password of a keystore where nobody can be asked.
PASSWORD = "SHACKLED_PASSWORD"


def open_signer(account: Path | None, variable: str | None) -> LocalAccount:
    """The account of --account or --private-key-env. InputError if there is none; nothing that is said shows a key."""
    from ..deploy import environment_account, keystore_account
    from ..deploy.account import read_keystore

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
        password = typer.prompt(f"password of {account}", hide_input=True, err=True)
    return keystore_account(account, password)


def ask(payer: str) -> None:
    """Asks whether to go on. InputError where nobody can be asked, typer.Abort for no."""
    if not sys.stdin.isatty():
        raise InputError("nothing was sent, since nobody can be asked here: --yes does it without")
    if not typer.confirm(f"Shall {payer} pay for it?", err=True):
        raise typer.Abort
