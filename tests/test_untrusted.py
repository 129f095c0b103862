from __future__ import annotations

import subprocess
import sys
import time

import pytest

from shackled.base.untrusted import MAX_NESTING, read_json, read_toml


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("[]", []),
        ('{"a": [1, {"b": "]]]"}]}', {"a": [1, {"b": "]]]"}]}),
        ('"' + "[" * 1000 + '"', "[" * 1000),
        ('["\\"' + "[" * 1000 + '\\\\", 2]', ['"' + "[" * 1000 + "\\", 2]),
        ("[" + "[], " * 1000 + "[]]", [[]] * 1001),
    ],
)
def test_what_is_json_is_read(text: str, value: object) -> None:
    assert read_json(text) == value


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, '["\\"[",' * 100_000, "[" * (MAX_NESTING + 1)])
def test_nesting_has_a_limit(text: str) -> None:
    read_json("[" * MAX_NESTING + "]" * MAX_NESTING)
    with pytest.raises(ValueError, match="nested more than 200 deep"):
        read_json(text)


@pytest.mark.parametrize("text", ["", "[", '"', '"\\', '["a', "]", "]" * 1000 + "[" * 1000])
def test_what_is_cut_off_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        read_json(text)


def test_no_text_ends_the_process() -> None:
    """Where a package has raised the limit of recursion, as one for elliptic curves does."""
    code = (
        "import sys; sys.setrecursionlimit(10**6)\n"
        "from shackled.base.untrusted import read_json\n"
        "for text in ('[' * 10**6, '{\"a\":' * 10**6):\n"
        "    try:\n        read_json(text)\n    except ValueError:\n        print('refused')"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stdout.split()) == (0, ["refused"] * 2)


#: Brackets in strings and comments of TOML, which nest nothing.
MANY = "[" * 300
DOTTED = ".".join(["a"] * 300)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        (f'a = "{MANY}"', {"a": MANY}),
        (f"a = '{MANY}' # {MANY}", {"a": MANY}),
        (f'a = """{MANY}\n"{MANY}"" \\""" """', {"a": f'{MANY}\n"{MANY}"" """ '}),
        (f"a = '''it's {MANY}'''", {"a": f"it's {MANY}"}),
        ("a = [1, [2, {b = 3}]]", {"a": [1, [2, {"b": 3}]]}),
        ("[[t]]\n" * 300, {"t": [{}] * 300}),
        (f"a.b.c = [{'0.5, ' * 300}]", {"a": {"b": {"c": [0.5] * 300}}}),
        (f'a = "{DOTTED}" # {DOTTED}', {"a": DOTTED}),
        (f"""'{DOTTED}' . "{DOTTED}".c = '{DOTTED}'""", {DOTTED: {DOTTED: {"c": DOTTED}}}),
    ],
)
def test_what_is_toml_is_read(text: str, value: object) -> None:
    assert read_toml(text) == value


@pytest.mark.parametrize(
    "text",
    [
        f"a = {MANY}",
        "a = " + "{b = " * 300,
        # a quote or two more may stand before those that end a string
        f'a = ["""b"""", {MANY}',
        f"a = ['''b''''', {MANY}",
        f'a = ["b\\"", {MANY}',
    ],
)
def test_toml_nesting_has_a_limit(text: str) -> None:
    with pytest.raises(ValueError, match="nested more than 200 deep"):
        read_toml(text)


@pytest.mark.parametrize("part", ["a", "'a.b'", '"\\"."'])
@pytest.mark.parametrize("text", ["{} = 1", "[{}]", "[[ {} ]]", "b = [{{c = 1, {} = 2}}]"])
def test_keys_have_so_many_parts(part: str, text: str) -> None:
    """tomllib alone takes seven seconds for 16,000, and four times as long for twice as many."""
    key = " . ".join(f"{part[:-1]}{number}{part[-1]}" if len(part) > 1 else f"a{number}" for number in range(100_000))
    started = time.monotonic()
    with pytest.raises(ValueError, match="one of its keys has more than 200 parts"):
        read_toml(text.format(key))
    assert time.monotonic() - started < 3
    read_toml(text.format(" . ".join([part] * (MAX_NESTING - 4))))
