from ._abi import SOLIDITY_ERRORS, Errors, Interface, decode_error, decode_values, encode_values, error_table
from ._amounts import ETHER, GWEI, amount, at_most, ether, parse_ether, roughly, rounded
from ._encoding import (
    PROXY,
    SALT,
    checksum_address,
    create2_address,
    intrinsic_gas,
    keccak256,
    parse_address,
    to_hex,
    word,
)
from ._header import encode_header

__all__ = [
    "ETHER",
    "GWEI",
    "PROXY",
    "SALT",
    "SOLIDITY_ERRORS",
    "Errors",
    "Interface",
    "amount",
    "at_most",
    "checksum_address",
    "create2_address",
    "decode_error",
    "decode_values",
    "encode_header",
    "encode_values",
    "error_table",
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
