"""Whether a collection is what it should be: its code, its seeds and its pictures, all made again here."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..artifacts import artifact
from ..chain import EmbeddedChain
from ..deploy import Deployer, deployment, local_chain
from ..errors import ChainError, NodeError, OutOfGasError, VerificationError
from ..ethereum import checksum_address, keccak256, parse_address, to_hex, word
from ..studio import STUDIO
from ._collection import Collection
from ._deploying import Offer, creation_code, parts_of
from ._icons import icon_at
from ._immutables import immutable_places, immutable_values
from ._kept import kept_codes
from ._kinds import Kind
from ._metadata import Metadata, read_token_uri, shrink

#: EIP-712: what the domain of permissions is made of.
DOMAIN = b"EIP712Domain(string name,string version,uint256 chainId,address verifyingContract)"
SIDE = 128


@dataclass(frozen=True)
class Check:
    """Something that was compared. failure: what is wrong; "" if nothing is. unread: why it could not be read, and so
    not be compared; "" if it was.
    """

    what: str
    failure: str = ""
    unread: str = ""


def check_code(collection: Collection) -> Iterator[Check]:
    """Yield the code of the collection and of all contracts that it uses against the compiled ones."""
    connection = collection.connection
    parts = parts_of(collection.kind.contract)
    deployer = Deployer(connection)
    for part in parts:
        what = f"{part.name} at {checksum_address(part.address)}"
        try:
            yield Check(what, "" if deployer.stands(part) else "it is not there")
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
    """Compare the code with that of the compiled contract with the terms that the collection tells.

    Raises VerificationError if a byte differs.
    """
    connection, kind = collection.connection, collection.kind
    runtime = artifact(kind.contract).runtime
    code = connection.code(bytes.fromhex(collection.address[2:]))
    immutable_values(code, runtime)
    # the constructor is run here with numbers that nothing else has, which shows where it writes each of them
    sentinels = Offer("0x" + "11" * 20, "0x" + "11" * 20, price=0xABCDEF01, reserve=513, per_transaction=77)
    trial, local = trial_code(kind, sentinels)
    told = {"price": sentinels.price, "reserve": sentinels.reserve, "perTransaction": sentinels.per_transaction}
    meaning = {
        word(number): word(collection.contract.call(name))
        for name, number in told.items()
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
            raise VerificationError(f"at byte {at:,} of its code stands 0x{found.hex()}, not 0x{min(allowed).hex()}")


def check_token(collection: Collection, token: int, local: EmbeddedChain, uri: str | None = None) -> Check:
    """Compare a token's seed with the block that drew it, and its whole `tokenURI` with what is computed here.

    uri: the `tokenURI`, if it was read already.
    """
    what = f"{collection.name} #{token}"
    try:
        uri = collection.token_uri(token) if uri is None else uri
        metadata = read_token_uri(uri)
        if not collection.kind.hidden:
            return Check(f"{what}, {metadata.name}", _icon_failure(collection, token, metadata, local))
        if not collection.is_revealed(token):
            block = collection.contract.call("blockOf", collection.round_of(token))
            expected = local.ask("GenesisMetadata", "hiddenURI", token, block)
            return Check(f"{what}, not revealed", "" if uri == expected else "it shows something else than it should")
        drawn, failure = draw(collection, token)
        if failure:
            return Check(what, failure)
        seed, _ = local.ask("GenesisMetadata", "settle", drawn)
        if seed != collection.contract.call("seedOf", token):
            return Check(what, "its seed is not that which its block and its number give")
        bmp = local.ask("Genesis", "render", seed)
        if uri != local.ask("GenesisMetadata", "tokenURI", token, drawn):
            return Check(what, "what it says of itself is not what is computed here from its seed")
        return Check(what, "" if _same_picture(metadata.pixels, bmp) else "its picture is not that of its seed")
    except OutOfGasError as error:
        return Check(what, unread=str(error))
    except ChainError as error:
        if isinstance(error, NodeError):
            raise
        return Check(what, str(error))


def _icon_failure(collection: Collection, token: int, metadata: Metadata, local: EmbeddedChain) -> str:
    """Return what is wrong with the token of an icon: its picture is made here of the bytes that the chain keeps."""
    icon = icon_at(collection, collection.contract.call("iconOf", token))
    for pointer, code in kept_codes(collection.connection, local.address(STUDIO), bytes.fromhex(icon.scene[2:])):
        local.put(pointer, code)
    picture = local.ask(STUDIO, "renderPNG(address,uint256)", icon.scene, icon.scale)
    if metadata.picture != picture:
        return "its picture is not that of its scene"
    if metadata.traits != {"Icon": icon.name, "Supply": icon.supply}:
        return "its traits are not those of its icon"
    return ""


def draw(collection: Collection, token: int) -> tuple[bytes, str]:
    """Return what was drawn for a token, computed here, and what is wrong with it; "" if nothing is."""
    number = collection.round_of(token)
    randomness = collection.contract.call("randomnessOf", number)
    block_number = collection.contract.call("blockOf", number)
    block = collection.connection.block(block_number)
    drawn = keccak256(randomness + word(parse_address(collection.address, "the collection")) + word(token))
    if block.get("mixHash") != to_hex(randomness):
        return drawn, f"the randomness of its round is not that of block {block_number:,}"
    return drawn, ""


def _same_picture(pixels: NDArray[np.uint8], bmp: bytes) -> bool:
    from ..image import decode_bmp

    small = shrink(pixels, SIDE, SIDE)
    return small is not None and bool((small == decode_bmp(bmp, SIDE, SIDE)).all())


@dataclass(frozen=True)
class Surroundings:
    """What a constructor sees of the chain on which it is run."""

    chain_id: int
    block: int


def trial_code(kind: Kind, offer: Offer) -> tuple[bytes, Surroundings]:
    """Return the code of a collection as the EVM here makes it, and what the constructor saw there."""
    local, parts = local_chain(), parts_of(kind.contract)
    made = deployment(kind.contract, creation_code(kind, parts, offer), [each.name for each in parts], local)
    probe = bytes.fromhex("c0de") + bytes(17) + b"\xff"
    # CHAINID PUSH0 MSTORE NUMBER PUSH1 32 MSTORE PUSH1 64 PUSH0 RETURN
    local.put(probe, bytes.fromhex("465f524360205260405ff3"))
    answer = local.run(probe, b"").output
    return made.code, Surroundings(int.from_bytes(answer[:32], "big"), int.from_bytes(answer[32:], "big"))


def _fixed_values(kind: Kind) -> set[bytes]:
    """Return the values that every collection of a kind has in its code: the contracts that it uses, and its name."""
    names = [kind.title.encode(), b"1"]
    parts = {word(part.address) for part in parts_of(kind.contract)}
    # short strings as OpenZeppelin keeps them: the characters, and their number in the last byte
    return parts | {keccak256(name) for name in names} | {name.ljust(31, b"\0") + bytes([len(name)]) for name in names}


def _domain(kind: Kind, chain_id: int, place: bytes) -> bytes:
    """EIP-712: the hash of the domain of a collection's permissions."""
    return keccak256(keccak256(DOMAIN) + keccak256(kind.title.encode()) + keccak256(b"1") + word(chain_id) + place)
