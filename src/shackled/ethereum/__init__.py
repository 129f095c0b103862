"""The basics of Ethereum, each once: data, addresses, the ABI, headers of blocks, amounts of ether."""

from .addresses import PROXY, SALT, checksum_address, create2_address, parse_address
from .data import intrinsic_gas, keccak256, to_hex, word

__all__ = [
    "PROXY",
    "SALT",
    "checksum_address",
    "create2_address",
    "intrinsic_gas",
    "keccak256",
    "parse_address",
    "to_hex",
    "word",
]
