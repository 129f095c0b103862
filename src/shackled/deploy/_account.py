"""Accounts that sign transactions. What is said of a key or a password never shows it."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError
from ..untrusted import read_json

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount


def environment_account(name: str) -> LocalAccount:
    """Return the account whose private key, 64 hexadecimal digits, an environment variable has.

    Raises InputError if it has none.
    """
    from eth_account import Account

    value = os.environ.get(name, "").strip()
    if not value:
        # what is no name may be a key, or a mnemonic, typed wrong
        if not re.fullmatch("[A-Za-z_][A-Za-z0-9_]{0,39}", name) or re.fullmatch("[0-9a-fA-F]{16,}", name):
            raise InputError(
                "there is no private key in an environment variable of that name: the name of a variable is wanted, "
                "not the key"
            )
        raise InputError(f"there is no private key in the environment variable {name}: set it to one")
    if re.fullmatch("(0x)?[0-9a-fA-F]{64}", value):
        try:
            account: LocalAccount = Account.from_key(value)
            return account
        except Exception:  # whatever it says could show the key
            pass
    raise InputError(f"the environment variable {name} must hold a private key, 64 hexadecimal digits; it holds none")


def read_keystore(path: Path) -> str:
    """Return the text of a keystore file. InputError if it is none."""
    try:
        text = path.read_text("utf-8")
    except (OSError, ValueError) as error:
        # a key, or a mnemonic, may stand where the name of a file should
        if re.search("[0-9A-Za-z]{41,}", path.name) or len(path.name.split()) >= 6:
            raise InputError(
                "there is no keystore file of that name: the name of a file is wanted, not a key"
            ) from None
        if isinstance(error, FileNotFoundError):
            raise InputError(f"there is no keystore file {path}") from None
        raise InputError(f"the keystore file {path} cannot be read: {getattr(error, 'strerror', 'no text')}") from None
    try:
        keystore = read_json(text)
        found = isinstance(keystore, dict) and bool({"crypto", "Crypto"} & keystore.keys())
    except ValueError:
        found = False
    if not found:
        raise InputError(f"{path} is no keystore file, as geth, foundry or a wallet writes it (JSON, version 3)")
    return text


def keystore_account(path: Path, password: str) -> LocalAccount:
    """Return the account of a keystore file. InputError if it is none, or the password is wrong."""
    from eth_account import Account

    text = read_keystore(path)
    try:
        key = Account.decrypt(text, password)
    except Exception as error:  # whatever it says could show a part of the file
        what = "the password is wrong" if "MAC" in str(error) else "it is damaged, or of an unknown kind"
        raise InputError(f"the keystore file {path} cannot be opened: {what}") from None
    account: LocalAccount = Account.from_key(key)
    return account
