"""The address book: a file that is whole, or said to be broken."""

from __future__ import annotations

import errno
import json
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest
from tools.children import child

from shackled.chain._address_book import VARIABLE, AddressBook, book_path
from shackled.errors import InputError, OutputError

ONE, TWO = b"\x01" * 20, bytes.fromhex("5aAeb6053F3E94C9b9A09f33669435E7Ef1BeAed")


def test_what_was_written_is_found(tmp_path: Path) -> None:
    book = AddressBook(tmp_path / "new" / "addresses.json")
    assert book.find(1, "Engine") is None
    book.write(1, {"Engine": ONE})
    book.write(10, {"Engine": TWO})
    book.write(1, {"Renderer": TWO})
    assert book.entries(1) == {"Engine": ONE, "Renderer": TWO}
    assert book.find(10, "Engine") == TWO
    assert book.find(5, "Engine") is None
    assert AddressBook(book.path).entries(1) == book.entries(1)
    # nothing else is left in the folder, and what is the same is not written again
    assert [path.name for path in book.path.parent.iterdir()] == ["addresses.json"]
    before = book.path.stat()
    book.write(1, {"Engine": ONE})
    assert book.path.stat() == before


def test_where_it_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "my.json"))
    assert book_path() == tmp_path / "my.json"
    monkeypatch.delenv(VARIABLE)
    assert book_path().parts[-2:] == ("shackled", "addresses.json") or "shackled" in str(book_path())


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "{}",
        '{"chains": []}',
        '{"chains": {"one": {}}}',
        '{"chains": {"1": 5}}',
        '{"chains": {"1": {"A": 5}}}',
        '{"chains": {"' + 5_000 * "9" + '": {}}}',
        '{"chains": {"²": {}}}',
    ],
)
def test_a_broken_book(tmp_path: Path, text: str) -> None:
    path = tmp_path / "addresses.json"
    path.write_text('{"chains": {"1": {"Engine": "0x12"}}}')
    with pytest.raises(InputError, match=r"Engine on chain 1 in .* must be an address"):
        AddressBook(path).find(1, "Engine")
    path.write_text(text)
    with pytest.raises(InputError, match=r"the address book .* is damaged.*: repair or remove it, or name another"):
        AddressBook(path).find(1, "Engine")
    with pytest.raises(InputError, match="is damaged"):
        AddressBook(path).write(1, {"Engine": ONE})
    assert path.read_text() == text


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be read"):
        AddressBook(tmp_path / "file" / "addresses.json").write(1, {"Engine": ONE})
    with pytest.raises(InputError, match="cannot be read"):
        AddressBook(tmp_path).find(1, "Engine")


def test_a_full_disk_is_no_wrong_input(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def full(*arguments: object, **more: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)
    book = AddressBook(tmp_path / "addresses.json")
    message = rf"^the address book {tmp_path}/addresses.json cannot be written: No space left on device; name another"
    for use in (book.check, lambda: book.write(1, {"Engine": ONE})):
        with pytest.raises(OutputError, match=message):
            use()


def test_two_writers_lose_nothing(tmp_path: Path) -> None:
    code = (
        "import sys\nfrom pathlib import Path\nfrom shackled.chain._address_book import AddressBook\n"
        "book = AddressBook(Path(sys.argv[1]))\n"
        "for each in range(50):\n    book.write(int(sys.argv[2]) + each, {'Renderer': bytes(19) + b'\\1'})\n"
    )
    path = tmp_path / "book.json"
    with ExitStack() as stack:
        command = (sys.executable, "-c", code, path)
        writers = [stack.enter_context(child(*command, str(start))) for start in (1000, 2000, 3000)]
        assert [writer.wait(120) for writer in writers] == [0, 0, 0]
    assert len(json.loads(path.read_text())["chains"]) == 150
    assert [each.name for each in tmp_path.iterdir()] == ["book.json"]
