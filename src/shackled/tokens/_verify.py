"""Verification of a collection: its code, seeds and pictures are compared with those computed here."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from dataclasses import dataclass

from ..artifacts import artifact
from ..chain._embedded import CHAIN_ID, EmbeddedChain
from ..deploy._contract import deployment, local_chain
from ..deploy._deployer import Deployer
from ..errors import ChainError, NodeError, OutOfGasError, VerificationError
from ..ethereum._encoding import checksum_address, keccak256, to_hex, word
from ..studio._storage import STUDIO, stored_codes
from ._collection import EDITIONS, Collection, CollectionKind
from ._editions import Edition, edition_at
from ._icons import CollectionIcon, icon_at
from ._launch import CollectionTerms, creation_code, immutable_values, parts_of
from ._metadata import Metadata, read_data_uri

#: The type of the EIP-712 domain of permissions.
DOMAIN = b"EIP712Domain(string name,string version,uint256 chainId,address verifyingContract)"


@dataclass(frozen=True)
class Check:
    """The result of a comparison. failure: what is wrong, or "". unread: why it could not be read, or ""."""

    what: str
    failure: str = ""
    unread: str = ""


def check_code(collection: Collection) -> Iterator[Check]:
    """Compare the code of a collection, and of all contracts that it calls, with the compiled contracts."""
    deployer = Deployer(collection.connection)
    for part in parts_of(collection.kind.contract):
        what = f"{part.name} at {checksum_address(part.address)}"
        try:
            yield Check(what, "" if deployer.is_deployed(part) else "it is not deployed")
        except ChainError as error:
            yield Check(what, str(error))
    what = f"{collection.kind.contract} at {collection.address}"
    try:
        check_collection_code(collection)
        yield Check(what)
    except NodeError:
        raise
    except ChainError as error:
        yield Check(what, str(error))


def check_collection_code(collection: Collection) -> None:
    """Compare the code of a collection with the compiled contract and the terms that the collection returns.

    Raises VerificationError if a byte differs.
    """
    kind, call = collection.kind, collection.contract.call
    code = collection.connection.code(collection.contract.place)
    if kind is EDITIONS:
        # it has no terms, so its code is the same everywhere
        if code != local_chain().code(kind.contract):
            raise VerificationError("its code differs from the compiled contract")
        return
    runtime = artifact(kind.contract).runtime
    values = immutable_values(code, runtime)
    # a local run of the constructor with unique numbers shows where it writes each of them
    sentinels = CollectionTerms("0x" + "11" * 20, "0x" + "11" * 20, price=0xABCDEF01, reserve=513, per_transaction=77)
    parts = parts_of(kind.contract)
    trial = deployment(kind.contract, creation_code(kind, parts, sentinels), [each.name for each in parts]).code
    chain_id, place = collection.connection.chain_id, word(collection.contract.place)
    meaning = {word(sentinels.per_transaction): word(call("perTransaction")), word(CHAIN_ID): word(chain_id)}
    meaning |= {word(getattr(sentinels, term)): word(call(term)) for term in kind.terms}
    meaning |= {value: value for value in _fixed_values(kind)}
    for at, value in immutable_values(trial, runtime).items():
        if value in meaning:
            wanted = meaning[value]
        elif int.from_bytes(value, "big") < 1 << 64:
            wanted = word(call("firstBlock"))
        else:
            wanted = place if int.from_bytes(value, "big") < 1 << 160 else _domain(kind, chain_id, place)
        if values[at] != wanted:
            raise VerificationError(f"its code has {to_hex(values[at])} at byte {at:,}, not {to_hex(wanted)}")


def check_token(collection: Collection, token: int, local: EmbeddedChain) -> Check:
    """Compare a token's seed with the block that determines it, and its `tokenURI` with the one computed here.

    local: an EVM with the contracts.
    """
    what, call = f"{collection.name} #{token}", collection.contract.call
    try:
        metadata = collection.metadata(token)
        if not collection.kind.hidden:
            return Check(f"{what}, {metadata.name}", _scene_failure(collection, token, metadata, local))
        number = collection.round_of(token)
        block_number, randomness = call("blockOf", number), call("randomnessOf", number)
        if not any(randomness):
            expected = local.ask("GenesisMetadata", "hiddenURI", token, block_number)
            failure = "" if metadata.uri == expected else "its tokenURI differs from the one computed here"
            return Check(f"{what}, not revealed", failure)
        if collection.connection.block(block_number).get("mixHash") != to_hex(randomness):
            return Check(what, f"the randomness of its round differs from that of block {block_number:,}")
        drawn = keccak256(randomness + word(collection.contract.place) + word(token))
        seed, _ = local.ask("GenesisMetadata", "settle", drawn)
        if seed != call("seedOf", token):
            return Check(what, "its seed does not follow from its block and its number")
        uri = _of_chain(local.ask("GenesisMetadata", "tokenURI", token, drawn), collection.connection.chain_id)
        return Check(what, "" if metadata.uri == uri else "its tokenURI differs from the one computed from its seed")
    except OutOfGasError as error:
        return Check(what, unread=str(error))
    except NodeError:
        raise
    except ChainError as error:
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


def _of_chain(uri: str, chain_id: int) -> str:
    """Return a `tokenURI` that was computed here as contracts on another chain return it: its link names the chain."""
    media_type, content = read_data_uri(uri, "the metadata")
    content = content.replace(f":{CHAIN_ID}/render/0x".encode(), f":{chain_id}/render/0x".encode())
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def _fixed_values(kind: CollectionKind) -> set[bytes]:
    """Return the immutable values that all collections of a kind share: contracts that they call, and the name."""
    names = [kind.title.encode(), b"1"]
    parts = {word(part.address) for part in parts_of(kind.contract)}
    # OpenZeppelin's short strings: the characters, and their number in the last byte
    return parts | {keccak256(name) for name in names} | {name.ljust(31, b"\0") + bytes([len(name)]) for name in names}


def _domain(kind: CollectionKind, chain_id: int, place: bytes) -> bytes:
    """Return the EIP-712 domain hash of a collection's permissions."""
    return keccak256(keccak256(DOMAIN) + keccak256(kind.title.encode()) + keccak256(b"1") + word(chain_id) + place)
