"""The preview of a token contract: compiler, deployment, tokens, and the page that follows the sources."""

from __future__ import annotations

import base64
import io
import json
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image as PillowImage

from preview.small_contracts import SVG, Made, answering, contract, function, output
from shackled.base.local_server import Answer
from shackled.cli.app import run
from shackled.errors import InputError
from shackled.preview._arguments import parse_call, parse_value
from shackled.preview._document import judge, judge_picture
from shackled.preview._preview import Preview, Request
from shackled.preview._project import Compiled, CompilerError, Project
from shackled.preview._server import Live
from shackled.preview._world import MAX_GAS, World

HERE = Path(__file__).resolve().parent
MODULES = HERE.parents[1] / "contracts" / "node_modules"
SETUP = ("mint{value: 6 gwei}(2)", "mint{value:3000000000}(1)")

needs_solc = pytest.mark.skipif(
    not (MODULES / "solc").is_dir() or not shutil.which("node"),
    reason="the compiler is not installed: npm ci in contracts/",
)


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file without a project, beside the packages of npm."""
    folder = tmp_path_factory.mktemp("odd")
    (folder / "node_modules").symlink_to(MODULES)
    return Path(shutil.copy(HERE / "Odd.sol", folder))


@pytest.fixture(scope="module")
def odd(source: Path) -> Compiled:
    (found,) = Project(source).compile()
    return found


@pytest.fixture
def project(source: Path, odd: Compiled) -> Project:
    return Made(source, odd)


def request(**changes: Any) -> Request:
    return Request(arguments=("3_000_000_000",), setup=SETUP, count=4, **changes)


@needs_solc
def test_tokens_that_are_right_and_wrong(project: Project) -> None:
    made = Preview(project, request())
    tokens = list(made.tokens())
    assert [token.number for token in tokens] == [0, 1, 2, 3]
    assert tokens[0].problems == []
    assert tokens[0].document.image
    assert tokens[0].document.image.media_type == "image/svg+xml"
    assert ["is not a complete image/png" in problem for problem in tokens[1].problems] == [True]
    assert tokens[2].gas
    assert tokens[2].gas > 20_000_000
    assert tokens[2].problems == [f"tokenURI(2) takes {tokens[2].gas:,} gas, more than {MAX_GAS:,} allow"]
    # an error of the contract, with its values
    assert tokens[3].gas is None
    assert tokens[3].problems == ["tokenURI(3) fails: Absent(id=3, why=not minted)"]
    # the limit is exact: with the gas that a token takes its call succeeds, with less by one it does not
    gas = tokens[0].gas
    assert gas is not None
    for limit, right in ((gas, True), (gas - 1, False)):
        made.request = request(max_gas=limit)
        assert (made.token(0).problems == []) == right


@needs_solc
def test_a_function_that_returns_a_picture(project: Project) -> None:
    """The Studio is at the address that the constructor was given."""
    (token,) = Preview(project, request(function="picture")).tokens()
    assert token.document.image
    assert token.document.image.media_type == "image/svg+xml"
    assert not token.problems


@needs_solc
def test_calls_that_fail_and_values_that_do_not_fit(odd: Compiled) -> None:
    for arguments, setup, message in (
        ([], [], "needs price_ \\(uint256\\): give it with `arg`"),
        (["1", "2"], [], "takes 1 values, not 2"),
        (["one"], [], "price_ of the constructor must be of the type uint256, not 'one'"),
        (["1"], ["mint(1)"], "the call mint\\(1\\) failed: the price"),
        (["0"], ["mint(1) x 2", "minted() x 2", "tokenURI(2)"], "tokenURI\\(2\\) failed: Absent\\(id=2"),
        (["0"], ["mint()"], "no function mint of 0 values: it takes 1"),
        (["0"], ["burn(1)"], "its functions are mint, minted, picture, price, studio, tokenURI"),
        (["0"], ["mint 1"], "a call must be like mint"),
    ):
        with pytest.raises(InputError, match=message):
            World(odd, arguments, [parse_call(text, odd) for text in setup])


@needs_solc
def test_files_that_cannot_be_previewed(
    source: Path, project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = source.with_name("Broken.sol")
    broken.write_text("pragma solidity ^0.8.0;\ncontract Broken { uint x = ; }\n")
    with pytest.raises(CompilerError, match=r"Broken\.sol does not compile") as raised:
        Project(broken).compile()
    assert "--> Broken.sol:2:28" in raised.value.said
    for name in ("None.sol", "Odd.txt"):
        with pytest.raises(InputError, match=name):
            Project(tmp_path / name)
    with pytest.raises(InputError, match="no contract 'Even' in the file, but Odd"):
        Preview(project, request(contract="Even"))
    with pytest.raises(InputError, match="no contract of the file has a function draw"):
        Preview(project, request(function="draw"))
    broken.write_bytes(b"pragma solidity ^0.8.0;\n// \xe9\ncontract Latin {}")
    with pytest.raises(InputError, match=r"Broken\.sol cannot be read: not UTF-8 at line 2"):
        Project(broken).compile()
    # no compiler
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "A.sol").write_text("contract A {}")
    with pytest.raises(InputError, match="install Foundry"):
        Project(tmp_path / "A.sol").compile()
    (tmp_path / "foundry.toml").write_text("")
    with pytest.raises(InputError, match="a project of Foundry, but there is no forge"):
        Project(tmp_path / "A.sol").compile()


def test_watched_sources(tmp_path: Path) -> None:
    """Of the folders of libraries, only those directly below the project are left out."""
    watched = {"foundry.toml", "src/Token.sol", "src/lib/Own.sol", "src/out/Own.sol"}
    for name in (*watched, "lib/a/A.sol", "out/B.sol", "src/node_modules/C.sol"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    stamps = Project(tmp_path / "src" / "Token.sol").stamps()
    assert {path.relative_to(tmp_path).as_posix() for path in stamps} == watched


PAIRS = {"type": "tuple[]", "components": [{"type": "uint8"}, {"type": "string"}]}


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("0x10", "uint256", 16),
        ("-1_000", "int16", -1000),
        ("true", "bool", True),
        ("0x00ff", "bytes", b"\0\xff"),
        ("a, b", "string", "a, b"),
        ('"a"', "string", "a"),
        ("[[1, 2], [3, 4]]", "uint8[2][]", [[1, 2], [3, 4]]),
        ('[[1, "a"]]', PAIRS, [(1, "a")]),
        ("[true]", "bool[]", [True]),
        ("255", "uint8", 255),
        ("-32768", "int16", -32768),
    ],
)
def test_values_of_all_types(text: str, kind: Any, value: Any) -> None:
    assert parse_value(text, {"type": kind} if isinstance(kind, str) else kind, "it") == value


@pytest.mark.parametrize(
    ("text", "kind", "message"),
    [
        ("300", "uint8", "it must be of the type uint8, not 300"),
        ("-1", "uint8", "it must be of the type uint8, not -1"),
        ("99999", "int16", "it must be of the type int16, not 99999"),
        (str(1 << 255), "int256", "it must be of the type int256, not 5789"),
        ("9" * 5000, "uint256", "it must be of the type uint256, not '999"),
        ("yes", "bool", "it must be of the type bool, not 'yes'"),
        ("0x1", "bytes", "it must be of the type bytes, in hexadecimal, not '0x1'"),
        ("0x12", "address", "it must be an address"),
        ("0x" + "00" * 33, "bytes32", "it must be of the type bytes32, in hexadecimal, not 33 bytes"),
        ("1", "uint8[]", "it must be a JSON list of the type uint8[], not 1"),
        ("[[1]]", "uint8[]", "it must be a value of the type uint8, not [1]"),
        ("[1]", "uint8[2]", "it must be a JSON list of the type uint8[2], not [1]"),
        ("[[300]]", "uint8[][]", "it must be of the type uint8, not 300"),
        ("[null]", "string[]", "it must be a value of the type string, not null"),
        ("\udce9", "string", "it must be of the type string"),
    ],
)
def test_values_that_do_not_fit(text: str, kind: str, message: str) -> None:
    with pytest.raises(InputError) as raised:
        parse_value(text, {"type": kind}, "it")
    assert str(raised.value).startswith(message)
    assert len(str(raised.value)) < 150


SMALL = contract(
    b"",
    function("mint", "uint256", stateMutability="payable"),
    function("set", "uint8", stateMutability="nonpayable"),
    function("set", "address", stateMutability="nonpayable"),
)


@pytest.mark.parametrize(
    ("amount", "wei"),
    [("0.07 ether", 7 * 10**16), ("0.000_000_001gwei", 1), ("1_000", 1000), ("3 wei", 3), ("0.5 wei", None)]
    + [(amount, None) for amount in ("1.2.3 ether", ". ether", "9" * 80, "", "1 eth", "0.0000000001 gwei", "-1")],
)
def test_amounts_of_ether_are_exact(amount: str, wei: int | None) -> None:
    text = f"mint{{value: {amount}}}(1)"
    if wei is not None:
        assert parse_call(text, SMALL).value == wei
        return
    with pytest.raises(InputError, match=r"the value of mint must be whole in wei, such as 0\.07 ether"):
        parse_call(text, SMALL)


def test_calls_of_overloaded_functions() -> None:
    address = "0x" + "11" * 20
    assert parse_call("set(5)", SMALL).data[4:] == bytes(31) + b"\5"
    assert parse_call(f"set({address})", SMALL).data[4:] == bytes(12) + b"\x11" * 20
    for text, message in (
        ("set(300)", "must be of the type uint8, not 300; or set: value0 must be an address"),
        ("set{value: 1}(5)", "set is not payable: leave out its value"),
        ("set(5) x 0", "a call must be like mint"),
    ):
        with pytest.raises(InputError, match=message):
            parse_call(text, SMALL)


def uri(document: Any) -> str:
    text = document if isinstance(document, str) else json.dumps(document)
    return "data:application/json;base64," + base64.b64encode(text.encode()).decode()


def film(kind: str = "png", frames: int = 1, side: int = 4) -> bytes:
    """Return a picture, which moves if it has several frames."""
    stream = io.BytesIO()
    # greys, of which no palette has to be found
    made = [PillowImage.new("L", (side, side), 25 * number) for number in range(frames)]
    made[0].save(stream, kind, save_all=frames > 1, append_images=made[1:])
    return stream.getvalue()


def picture(kind: str = "png", frames: int = 1) -> str:
    return f"data:image/{kind};base64," + base64.b64encode(film(kind, frames)).decode()


def test_documents_that_are_right() -> None:
    fields = {
        "name": "One",
        "image": picture(frames=3),
        "animation_url": "ipfs://somewhere",
        "background_color": "Ffcc00",
        "external_url": "https://example.org/1",
        "attributes": [{"trait_type": "Size", "value": 3, "display_type": "number"}, {"value": "Tall"}],
    }
    found = judge(uri(fields))
    assert found.problems == []
    assert found.image
    assert found.image.frames == 3
    assert judge(uri({"name": "Two", "image": picture("gif")})).problems == []
    assert judge_picture(picture()).problems == judge_picture(film()).problems == []


def one(**fields: Any) -> str:
    """Return the URI of a token that is right but for these fields."""
    return uri({"name": "One", "image": picture()} | fields)


WRONG = {
    "https://example.org/1": "not on the chain",
    "data:text/html,<p>": "has the type text/html, not application/json",
    uri("{"): "not valid JSON",
    uri('{"name": NaN}'): "not valid JSON",
    uri("[" * 10_000): "nested more than",
    uri('{"name": "\\ud800"}'): "not valid JSON",
    uri("[]"): "not an object",
    "data:application/json;base64,!": "not valid Base64",
    "data:application/json,%ff": "the tokenURI is not valid UTF-8: byte 0 is 0xff",
    one(name=3): "there is no name",
    one(description=[]): "description must be text",
    one(background_color="#ffffff"): "six hexadecimal digits without #",
    one(external_url="javascript:alert(1)"): "an address such as",
    one(attributes=[{"trait_type": "a"}]): "attribute 0 has no value",
    one(attributes=[{"value": 1, "display_type": {}}]): "display_type {} is none of",
    one(attributes=[{"value": 1_700_000_000_000, "display_type": "date"}]): "attribute 0 is a date after the year 5000",
    one(animation_url="data:model/gltf-binary;base64,Z2xURg=="): "not a complete GLB",
    one(image="data:text/html,<script>"): "image has the type text/html",
    one(description="a" * 100_000): "bytes; marketplaces show no more than 100,000",
    'data:application/json,{"name": "Token #1"}': "a # at position 38, where browsers end it: write %23",
}


@pytest.mark.parametrize(("given", "message"), WRONG.items(), ids=range(len(WRONG)))
def test_documents_that_are_wrong(given: str, message: str) -> None:
    first, *others = judge(given).problems
    assert message in first
    assert others == (["there is no image"] if "Token #1" in given else [])


def test_films() -> None:
    for kind in ("gif", "webp"):
        found = judge_picture(film(kind, 3))
        assert (found.problems, found.image and found.image.frames) == ([], 3)
    (problem,) = judge_picture(film("gif", 9, 4096)).problems
    assert "its 9 frames have more than 134,217,728 pixels together" in problem


@settings(max_examples=60)
@given(st.data())
def test_damaged_films_are_a_problem_of_one_line(data: st.DataObject) -> None:
    """Decoders fail at them in many ways."""
    whole = bytearray(film("gif", 3))
    for _ in range(3):
        whole[data.draw(st.integers(10, len(whole) - 1))] = data.draw(st.integers(0, 255))
    assert all(problem and "\n" not in problem for problem in judge_picture(bytes(whole)).problems)


def test_pictures_that_cannot_be_decoded() -> None:
    bomb = "<!DOCTYPE svg [" + "".join(
        f'<!ENTITY e{n} "{("&e" + str(n - 1) + ";") * 30 if n else "x" * 99}">' for n in range(9)
    )
    for content, message in (
        (film(frames=3)[:-30], "not a complete image/png"),
        (b"\x89PNG\r\n\x1a\n", "not a complete image/png"),
        ("<svg", "not a valid SVG"),
        ("<html/>", "its root is html"),
        (bomb + "]><svg xmlns='http://www.w3.org/2000/svg'>&e8;</svg>", "not a valid SVG"),
        ("https://example.org/1.png", "not on the chain"),
        ("<svg/>", "xmlns is missing: write <svg xmlns="),
        (b"<svg>\xff</svg>", "not a valid UTF-8: byte 5 is 0xff"),
        (b"", "not a valid SVG: it is empty"),
        ("data:text/html,<script>", "the picture has the type text/html"),
        (b"glTF" + bytes(8), "the picture has the type model/gltf-binary"),
        ("", "the picture is empty"),
        ("data:image/svg+xml," + SVG.replace("/>", " fill='#fff'/>"), "a # at position 65, where browsers end it"),
        ("data:image/svg+xml," + SVG.replace("/>", " width='50%'/>"), "a % at position 68 without two hexadecimal"),
    ):
        (problem,) = judge_picture(content).problems
        assert message in problem


@needs_solc
def test_the_command_checks(source: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["preview", str(source), "--arg", "0", "--setup", "mint(4)", "--check"]
    assert run([*words, "--tokens", "1"]) == 0
    assert "Odd.tokenURI: 1 tokens, " in capsys.readouterr().out
    assert run([*words, "--tokens", "2", "--json"]) == 1
    said = capsys.readouterr()
    assert [bool(token["problems"]) for token in json.loads(said.out)["tokens"]] == [False, True]
    assert "1 of 2 tokens have problems" in said.err
    assert run(["preview", str(source), "--json"]) == 2
    assert "--json needs --check" in capsys.readouterr().err


@contextmanager
def following(live: Live) -> Iterator[Iterator[dict[str, Any]]]:
    """Yield what the page is told."""
    thread = Thread(target=live.follow)
    thread.start()
    try:
        yield (json.loads(event.removeprefix(b"data: ")) for event in live.events())
    finally:
        live.end()
        thread.join(30)


def test_the_page_survives_every_error(tmp_path: Path) -> None:
    """Also mistakes of the preview itself."""
    source = tmp_path / "Small.sol"
    source.write_text("contract Small {}")
    faults = [RuntimeError("a mistake"), InputError("no"), None]

    class Faulty(Made):
        def compile(self) -> list[Compiled]:
            fault = faults.pop(0)
            if fault is not None:
                raise fault
            return super().compile()

    live = Live(Faulty(source, contract(answering(output(SVG), output(SVG)))), Request(count=1))
    found: list[dict[str, Any]] = []
    with following(live) as events:
        for message in events:
            found.append(message)
            if message.get("status") == "failed":
                source.write_text("contract Small {}" + " " * len(found))
            elif message.get("status") == "done":
                # ends the events too
                live.end()
    assert [m["error"] for m in found if m.get("status") == "failed"] == ["RuntimeError: a mistake", "no"]
    assert (found[-1]["status"], found[-1]["error"]) == ("done", "")


@needs_solc
def test_the_page_follows_the_sources(source: Path) -> None:
    """It shows tokens, errors of the compiler, and tokens again; files of tokens run nothing."""
    live = Live(Project(source), Request(arguments=("0",), setup=("mint(4)",), count=2))
    kept, found, saves = [], [], ["contract", source.read_text("utf-8")]
    with following(live) as events:
        for message in events:
            found.append(message)
            if message.get("status") in ("done", "failed"):
                kept.append(live.token(1, 0) is not None)
                if not saves:
                    break
                source.write_text(saves.pop(0), "utf-8")
    assert [m["status"] for m in found if "status" in m and m["version"] == 2] == ["compiling", "failed"]
    # the tokens of before stay, with their files, until all are read again
    assert kept == [True, True, False]
    assert any("--> Odd.sol" in m.get("error", "") for m in found)
    assert [m["token"]["number"] for m in found if m["version"] == 3 and "token" in m] == ["0", "1"]

    def answer(path: str) -> Answer:
        sent = live.answer(path)
        assert sent is not None
        return sent

    assert "script-src 'self'" in answer("/").headers["Content-Security-Policy"]
    assert all(answer(f"/{name}") for name in ("preview.js", "preview.css"))
    picture = answer(f"/file/{live.version}/0/image")
    assert picture.kind == "image/svg+xml"
    assert "sandbox" in picture.headers["Content-Security-Policy"]
    described = answer(f"/token/{live.version}/0").body
    assert isinstance(described, bytes)
    assert json.loads(described)["document"]["name"] == "Odd 0"
    absent = ("/../_server.py", "/other", f"/file/{live.version - 1}/0/image", f"/file/{live.version}/7/image")
    assert not any(map(live.answer, absent))
