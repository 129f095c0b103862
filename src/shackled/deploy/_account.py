"""Accounts that sign transactions. Error messages never show a key or a password."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.untrusted import read_json
from ..errors import InputError, not_installed

if TYPE_CHECKING:
    from eth_account import Account
    from eth_account.signers.local import LocalAccount

#: The most rounds of PBKDF2; more would look like a command that hangs.
MOST_ROUNDS = 10_000_000


def signer_class() -> type[Account]:
    """Return the class that opens accounts. InputError without the extra `chain`."""
    try:
        from eth_account import Account
    except ModuleNotFoundError:
        raise not_installed("an account that signs", "chain") from None
    return Account


def environment_account(name: str) -> LocalAccount:
    """Return the account of the private key, 64 hexadecimal digits, in an environment variable. InputError if none."""
    opener, value = signer_class(), os.environ.get(name, "").strip()
    if not value:
        # an invalid name may be a key or a mnemonic, given by mistake
        if not re.fullmatch("[A-Za-z_][A-Za-z0-9_]{0,39}", name) or re.fullmatch("[0-9a-fA-F]{16,}", name):
            raise InputError(
                "there is no private key in an environment variable of that name: give the name of a variable, not the "
                "key"
            )
        raise InputError(f"the environment variable {name} is not set: it must hold a private key")
    if re.fullmatch("(0x)?[0-9a-fA-F]{64}", value):
        try:
            account: LocalAccount = opener.from_key(value)
            return account
        except Exception:  # its message could show the key
            pass
    raise InputError(f"the environment variable {name} must hold a private key, 64 hexadecimal digits")


def read_keystore(path: Path) -> str:
    """Return the text of a keystore file. InputError if it is none, or would take longer than about ten seconds."""
    try:
        text = path.read_text("utf-8")
    except (OSError, ValueError) as error:
        # the name may be a key or a mnemonic, given by mistake
        if re.search("[0-9A-Za-z]{41,}", path.name) or len(path.name.split()) >= 6:
            raise InputError("there is no keystore file of that name: give the name of a file, not a key") from None
        if isinstance(error, FileNotFoundError):
            raise InputError(f"there is no keystore file {path}") from None
        raise InputError(
            f"the keystore file {path} cannot be read: {getattr(error, 'strerror', 'it is not text')}"
        ) from None
    try:
        keystore = read_json(text)
        found = isinstance(keystore, dict) and bool({"crypto", "Crypto"} & keystore.keys())
    except ValueError:
        found = False
    if not found:
        raise InputError(f"{path} is not a keystore file as geth, foundry or wallets write it (JSON, version 3)")
    rounds = _pbkdf2_rounds(keystore)
    if rounds > MOST_ROUNDS:
        raise InputError(
            f"the keystore file {path} derives its key by {rounds:,} rounds of PBKDF2, more than the {MOST_ROUNDS:,} "
            "that are computed, within about ten seconds: write it again with fewer; wallets use 262,144"
        )
    return text


def _pbkdf2_rounds(keystore: Any) -> int:
    """Return how many rounds of PBKDF2 a keystore asks for; 0 where it names none."""
    # eth-account reads names in any letters
    for name in ("crypto", "kdfparams", "c"):
        found = keystore.items() if isinstance(keystore, dict) else ()
        keystore = next((value for key, value in found if key.lower() == name), None)
    return keystore if isinstance(keystore, int) else 0


def keystore_account(path: Path, password: str) -> LocalAccount:
    """Return the account of a keystore file. Raises InputError if the file or the password is wrong."""
    opener, text = signer_class(), read_keystore(path)
    try:
        key = opener.decrypt(text, password)
    except Exception as error:  # its message could show a part of the file
        what = "the password is wrong" if "MAC" in str(error) else "it is damaged or of an unknown kind"
        raise InputError(f"the keystore file {path} cannot be opened: {what}") from None
    account: LocalAccount = opener.from_key(key)
    return account
