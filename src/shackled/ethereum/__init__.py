"""The basics of Ethereum, each once: data, addresses, the ABI, headers of blocks, amounts of ether."""

from .addresses import PROXY, SALT, checksum_address, create2_address, parse_address
from .amounts import ETHER, GWEI, amount, at_most, ether, parse_ether, roughly, rounded
from .data import intrinsic_gas, keccak256, to_hex, word

__all__ = [
    "ETHER",
    "GWEI",
    "PROXY",
    "SALT",
    "amount",
    "at_most",
    "checksum_address",
    "create2_address",
    "ether",
    "intrinsic_gas",
    "keccak256",
    "parse_address",
    "parse_ether",
    "roughly",
    "rounded",
    "to_hex",
    "word",
]
