"""Accounts: from keystores and environment variables; whatever is wrong with them, no key is shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from eth_account import Account

from nodes import KEY
from shackled.deploy import environment_account, keystore_account
from shackled.deploy._account import read_keystore
from shackled.errors import InputError

ADDRESS = "0xf39Fd6e51aad88F6F4ce6aB8827279cffFb92266"


@pytest.fixture
def keystore(tmp_path: Path) -> Path:
    path = tmp_path / "keystore"
    path.write_text(json.dumps(Account.encrypt(bytes.fromhex(KEY[2:]), "right", kdf="pbkdf2", iterations=1000)))
    return path


def test_a_keystore(keystore: Path) -> None:
    assert keystore_account(keystore, "right").address == ADDRESS
    with pytest.raises(InputError, match="cannot be opened: the password is wrong") as error:
        keystore_account(keystore, "wrong-password")
    assert "wrong-password" not in str(error.value)
    text = json.loads(keystore.read_text())
    del text["crypto"]["kdfparams"]
    keystore.write_text(json.dumps(text))
    with pytest.raises(InputError, match="cannot be opened: it is damaged"):
        keystore_account(keystore, "right")


@pytest.mark.parametrize("text", ["", "{}", "[1]", KEY, '{"version": 3}', "\x00"])
def test_files_that_are_no_keystores(tmp_path: Path, text: str) -> None:
    path = tmp_path / "file"
    for words in ("there is no keystore file", "is not a keystore file"):
        with pytest.raises(InputError, match=words) as error:
            keystore_account(path, "right")
        assert KEY[2:10] not in str(error.value)
        path.write_text(text)
    with pytest.raises(InputError, match="cannot be read"):
        keystore_account(tmp_path, "")


@pytest.mark.parametrize("name", ["crypto", "Crypto"])
def test_rounds_have_a_bound(keystore: Path, name: str) -> None:
    """At once, before a password is asked."""
    text = json.loads(keystore.read_text())
    text[name] = text.pop("crypto")
    text[name]["kdfparams"]["c"] = 10_000_001
    keystore.write_text(json.dumps(text))
    with pytest.raises(InputError, match="by 10,000,001 rounds of PBKDF2, more than the 10,000,000 that are computed"):
        read_keystore(keystore)


@pytest.mark.parametrize("value", [KEY, KEY[2:], f" {KEY}\n", KEY.upper().replace("0X", "0x")])
def test_a_key_in_the_environment(monkeypatch: pytest.MonkeyPatch, value: str) -> None:
    monkeypatch.setenv("SOME_KEY", value)
    assert environment_account("SOME_KEY").address == ADDRESS


@pytest.mark.parametrize("value", [KEY[:-1], KEY + "0", "secret words", "0x" + 64 * "f", "0x" + 64 * "0"])
def test_keys_that_are_none(monkeypatch: pytest.MonkeyPatch, value: str) -> None:
    with pytest.raises(InputError, match="the environment variable SOME_KEY is not set"):
        environment_account("SOME_KEY")
    monkeypatch.setenv("SOME_KEY", value)
    with pytest.raises(InputError, match="SOME_KEY must hold a private key, 64 hexadecimal digits") as error:
        environment_account("SOME_KEY")
    assert value not in str(error.value)
    assert error.value.__cause__ is None


#: What may stand in the place of a name by mistake: a key, or one with a mistake, and the words of a wallet.
SLIPS = [
    *(KEY, KEY[2:], KEY[:-1], KEY[2:-1], "0X" + KEY[2:], f"{KEY},", f"{KEY} ", f'"{KEY}"', KEY[2:36]),
    "test test test test test test test test test test test junk",
]


@pytest.mark.parametrize("slip", SLIPS)
def test_a_key_in_place_of_a_name(slip: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match="give the name of a variable, not the key") as error:
        environment_account(slip)
    assert slip[4:12] not in str(error.value)
    if len(slip) > 41:
        monkeypatch.chdir(tmp_path)
        with pytest.raises(InputError, match="give the name of a file, not a key") as wrong:
            keystore_account(Path(slip), "")
        assert slip[4:12] not in str(wrong.value)


def test_names_of_keystores_are_reported() -> None:
    """As geth and foundry make them."""
    for name in (
        "UTC--2016-03-22T12-57-55.920751759Z--7ef5a6135f1fd6a02593eedc869c6d41d934aef8",
        "9ba0ef29-9d0e-4ee7-8d8e-3cbcdb5b4e3a",
    ):
        with pytest.raises(InputError, match=f"there is no keystore file {name}"):
            keystore_account(Path(name), "")
