"""Verification of a collection: its code, seeds and pictures are compared with those computed here."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..artifacts import artifact
from ..chain import CHAIN_ID, EmbeddedChain
from ..deploy import Deployer, deployment, local_chain
from ..errors import ChainError, NodeError, OutOfGasError, VerificationError
from ..ethereum import checksum_address, keccak256, parse_address, to_hex, word
from ..image import decode_bmp
from ..studio import STUDIO, stored_codes
from ._collection import EDITIONS, Collection, CollectionKind
from ._editions import Edition, edition_at
from ._icons import CollectionIcon, icon_at
from ._launch import CollectionTerms, creation_code, immutable_places, immutable_values, parts_of
from ._metadata import Metadata, read_data_uri, shrink

#: The type of the EIP-712 domain of permissions.
DOMAIN = b"EIP712Domain(string name,string version,uint256 chainId,address verifyingContract)"
#: Side of the canvas, in pixels.
SIDE = 128


@dataclass(frozen=True)
class Check:
    """The result of a comparison. failure: what is wrong, or "". unread: why it could not be read, or ""."""

    what: str
    failure: str = ""
    unread: str = ""


def check_code(collection: Collection) -> Iterator[Check]:
    """Compare the code of a collection, and of all contracts that it calls, with the compiled contracts."""
    connection = collection.connection
    parts = parts_of(collection.kind.contract)
    deployer = Deployer(connection)
    for part in parts:
        what = f"{part.name} at {checksum_address(part.address)}"
        try:
            yield Check(what, "" if deployer.is_deployed(part) else "it is not deployed")
        except ChainError as error:
            yield Check(what, str(error))
    what = f"{collection.kind.contract} at {collection.address}"
    try:
        check_collection_code(collection)
        yield Check(what)
    except ChainError as error:
        if isinstance(error, NodeError):
            raise
        yield Check(what, str(error))


def check_collection_code(collection: Collection) -> None:
    """Compare the code of a collection with the compiled contract and the terms that the collection returns.

    Raises VerificationError if a byte differs.
    """
    connection, kind = collection.connection, collection.kind
    if kind is EDITIONS:
        # it has no terms, so its code is the same everywhere
        (*_, expected) = parts_of(kind.contract, itself=True)
        if connection.code(bytes.fromhex(collection.address[2:])) != expected.code:
            raise VerificationError("its code differs from the compiled contract")
        return
    runtime = artifact(kind.contract).runtime
    code = connection.code(bytes.fromhex(collection.address[2:]))
    immutable_values(code, runtime)
    # a local run of the constructor with unique numbers shows where it writes each of them
    sentinels = CollectionTerms("0x" + "11" * 20, "0x" + "11" * 20, price=0xABCDEF01, reserve=513, per_transaction=77)
    trial, local = trial_code(kind, sentinels)
    numbers = {"price": sentinels.price, "reserve": sentinels.reserve, "perTransaction": sentinels.per_transaction}
    meaning = {
        word(number): word(collection.contract.call(name))
        for name, number in numbers.items()
        if name in ("perTransaction", *kind.terms)
    }
    fixed = _fixed_values(kind)
    here = {word(local.chain_id): {word(connection.chain_id)}}
    if kind.hidden:
        here.setdefault(word(local.block), set()).add(word(collection.contract.call("firstBlock")))
    place = word(int(collection.address, 16))
    for at in immutable_places(runtime):
        value, found = trial[at : at + 32], code[at : at + 32]
        if value in fixed:
            allowed = {value}
        elif value in meaning:
            allowed = {meaning[value]}
        elif value in here:
            allowed = here[value]
        else:
            allowed = {place if int.from_bytes(value, "big") < 1 << 160 else _domain(kind, connection.chain_id, place)}
        if found not in allowed:
            raise VerificationError(f"its code has 0x{found.hex()} at byte {at:,}, not 0x{min(allowed).hex()}")


def check_token(collection: Collection, token: int, local: EmbeddedChain, uri: str | None = None) -> Check:
    """Compare a token's seed with the block that determines it, and its `tokenURI` with the one computed here.

    local: an EVM with the contracts. uri: the `tokenURI`, if it was read already.
    """
    what = f"{collection.name} #{token}"
    try:
        uri = collection.token_uri(token) if uri is None else uri
        metadata = collection.parse(uri)
        if not collection.kind.hidden:
            return Check(f"{what}, {metadata.name}", _scene_failure(collection, token, metadata, local))
        if not collection.is_revealed(token):
            block = collection.contract.call("blockOf", collection.round_of(token))
            expected = local.ask("GenesisMetadata", "hiddenURI", token, block)
            return Check(
                f"{what}, not revealed", "" if uri == expected else "its tokenURI differs from the one computed here"
            )
        drawn, failure = draw(collection, token)
        if failure:
            return Check(what, failure)
        seed, _ = local.ask("GenesisMetadata", "settle", drawn)
        if seed != collection.contract.call("seedOf", token):
            return Check(what, "its seed does not follow from its block and its number")
        bmp = local.ask("Genesis", "render", seed)
        if uri != _of_chain(local.ask("GenesisMetadata", "tokenURI", token, drawn), collection.connection.chain_id):
            return Check(what, "its tokenURI differs from the one computed here from its seed")
        return Check(what, "" if _same_picture(metadata.pixels, bmp) else "its picture differs from that of its seed")
    except OutOfGasError as error:
        return Check(what, unread=str(error))
    except ChainError as error:
        if isinstance(error, NodeError):
            raise
        return Check(what, str(error))


def _scene_failure(collection: Collection, token: int, metadata: Metadata, local: EmbeddedChain) -> str:
    """Return what is wrong with a token of an icon or edition, whose picture is computed here from the stored bytes."""
    kind: CollectionIcon | Edition
    if collection.kind is EDITIONS:
        kind = edition_at(collection, collection.contract.call("editionOf", token))
    else:
        kind = icon_at(collection, collection.contract.call("iconOf", token))
    scene = bytes.fromhex(kind.scene[2:])
    for pointer, code in stored_codes(collection.connection, local.address(STUDIO), scene).items():
        local.put(pointer, code)
    picture = local.ask(STUDIO, "renderPNG(address,uint256)", kind.scene, kind.scale)
    if metadata.picture != picture:
        return "its picture differs from that of its scene"
    expected = {"animation_url": local.ask(STUDIO, "glbDataURI", kind.scene)} if getattr(kind, "model", False) else {}
    if {key: value for key, value in metadata.document.items() if key == "animation_url"} != expected:
        return "its model differs from that of its scene"
    if metadata.traits != kind.traits or metadata.name != f"{kind.name} #{token}":
        return "its name or its traits differ from those of its scene"
    return ""


def draw(collection: Collection, token: int) -> tuple[bytes, str]:
    """Return the random bytes of a token, computed here, and what is wrong with its round, or ""."""
    number = collection.round_of(token)
    randomness = collection.contract.call("randomnessOf", number)
    block_number = collection.contract.call("blockOf", number)
    block = collection.connection.block(block_number)
    drawn = keccak256(randomness + word(parse_address(collection.address, "the collection")) + word(token))
    if block.get("mixHash") != to_hex(randomness):
        return drawn, f"the randomness of its round differs from that of block {block_number:,}"
    return drawn, ""


def _of_chain(uri: str, chain_id: int) -> str:
    """Return a `tokenURI` that was computed here as contracts on another chain return it: its link names the chain."""
    media_type, content = read_data_uri(uri, "the metadata")
    content = content.replace(f":{CHAIN_ID}/render/0x".encode(), f":{chain_id}/render/0x".encode())
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def _same_picture(pixels: NDArray[np.uint8], bmp: bytes) -> bool:
    small = shrink(pixels, SIDE, SIDE)
    return small is not None and bool((small == decode_bmp(bmp, SIDE, SIDE)).all())


@dataclass(frozen=True)
class Surroundings:
    """Properties of the chain that a constructor reads."""

    chain_id: int
    block: int


def trial_code(kind: CollectionKind, terms: CollectionTerms) -> tuple[bytes, Surroundings]:
    """Return the code of a collection from a local run of its constructor, and what the constructor read there."""
    local, parts = local_chain(), parts_of(kind.contract)
    made = deployment(kind.contract, creation_code(kind, parts, terms), [each.name for each in parts], local)
    probe = bytes.fromhex("c0de") + bytes(17) + b"\xff"
    # CHAINID PUSH0 MSTORE NUMBER PUSH1 32 MSTORE PUSH1 64 PUSH0 RETURN
    local.put(probe, bytes.fromhex("465f524360205260405ff3"))
    answer = local.run(probe, b"").output
    return made.code, Surroundings(int.from_bytes(answer[:32], "big"), int.from_bytes(answer[32:], "big"))


def _fixed_values(kind: CollectionKind) -> set[bytes]:
    """Return the immutable values that all collections of a kind share: contracts that they call, and the name."""
    names = [kind.title.encode(), b"1"]
    parts = {word(part.address) for part in parts_of(kind.contract)}
    # OpenZeppelin's short strings: the characters, and their number in the last byte
    return parts | {keccak256(name) for name in names} | {name.ljust(31, b"\0") + bytes([len(name)]) for name in names}


def _domain(kind: CollectionKind, chain_id: int, place: bytes) -> bytes:
    """Return the EIP-712 domain hash of a collection's permissions."""
    return keccak256(keccak256(DOMAIN) + keccak256(kind.title.encode()) + keccak256(b"1") + word(chain_id) + place)
