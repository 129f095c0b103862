"""The address book: a JSON file, written by `shackled deploy`, with the addresses of contracts on each chain."""

from __future__ import annotations

import errno
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path

from ..base.whole_file import locked, write_whole
from ..errors import InputError, OutputError
from ..ethereum._encoding import checksum_address, parse_address

#: The environment variable with the path of the file.
VARIABLE = "SHACKLED_ADDRESS_BOOK"


def book_path() -> Path:
    """Return the path in the variable SHACKLED_ADDRESS_BOOK, or the default in the user's data folder."""
    chosen = os.environ.get(VARIABLE)
    if chosen:
        return Path(chosen)
    from platformdirs import user_data_path

    return user_data_path("shackled") / "addresses.json"


class AddressBook:
    """Addresses by chain id and contract name. The file is read for each query."""

    def __init__(self, path: Path | None = None) -> None:
        """Take the path of the file; None uses `book_path`."""
        self.path = book_path() if path is None else path

    def find(self, chain_id: int, contract: str) -> bytes | None:
        """Return the address of a contract; None if it is unknown. Raises InputError if the file cannot be read."""
        return self.entries(chain_id).get(contract)

    def entries(self, chain_id: int) -> dict[str, bytes]:
        """Return the addresses of a chain, by contract. Raises InputError if the file cannot be read."""
        chain = self._read().get(str(chain_id), {})
        return {name: parse_address(text, f"{name} on chain {chain_id} in {self.path}") for name, text in chain.items()}

    def check(self) -> None:
        """Check that the file can be written. Raises InputError if its content is damaged, OutputError if it cannot."""
        self._read()
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise self._unwritable(error) from None
        if not os.access(self.path.parent, os.W_OK):
            raise self._unwritable(PermissionError(errno.EACCES, "its folder is not writable"))

    def write(self, chain_id: int, addresses: Mapping[str, bytes]) -> None:
        """Add or replace addresses of a chain. Raises InputError or OutputError; then the file has not changed."""
        self._read()  # before a folder is made
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with locked(self.path.parent):  # from reading to writing, so that two writers lose nothing
                chains = self._read()
                known = chains.get(str(chain_id), {})
                chain = known | {name: checksum_address(address) for name, address in addresses.items()}
                if chain != known:
                    chains = dict(sorted((chains | {str(chain_id): chain}).items(), key=lambda item: int(item[0])))
                    write_whole(self.path, (json.dumps({"chains": chains}, indent=2) + "\n").encode())
        except OSError as error:
            raise self._unwritable(error) from None

    def _unwritable(self, error: OSError) -> OutputError:
        why = f"{error.strerror}; name another file in {VARIABLE}"
        return OutputError(error.errno, why, f"the address book {self.path}")

    def _read(self) -> dict[str, dict[str, str]]:
        try:
            chains = json.loads(self.path.read_text("utf-8"))["chains"]
            if all(re.fullmatch("[0-9]{1,78}", key) for key in chains) and all(
                isinstance(text, str) for chain in chains.values() for text in chain.values()
            ):
                return dict(chains)
        except FileNotFoundError:
            return {}
        except OSError as error:
            raise InputError(f"the address book {self.path} cannot be read: {error.strerror}") from None
        except (ValueError, LookupError, TypeError, AttributeError):
            pass
        hint = f"repair or remove it, or name another file in {VARIABLE}"
        raise InputError(f"the address book {self.path} is damaged, it does not map chain ids to addresses: {hint}")
