from ._address_book import VARIABLE, AddressBook, book_path
from ._chain import CallResult, Chain, ContractChain, Drawing, returned_bytes
from ._connection import PATIENCE, Connection, Report, check_timeout, check_url, quantity, read_all
from ._embedded import CHAIN_ID, DEFAULT_GAS_LIMIT, EmbeddedChain, RevmChain
from ._failures import describe_revert, out_of_gas, revert_error
from ._node import NodeChain, metered
from ._opening import CHAINS, check_chain, open_chain, open_node

__all__ = [
    "CHAINS",
    "CHAIN_ID",
    "DEFAULT_GAS_LIMIT",
    "PATIENCE",
    "VARIABLE",
    "AddressBook",
    "CallResult",
    "Chain",
    "Connection",
    "ContractChain",
    "Drawing",
    "EmbeddedChain",
    "NodeChain",
    "Report",
    "RevmChain",
    "book_path",
    "check_chain",
    "check_timeout",
    "check_url",
    "describe_revert",
    "metered",
    "open_chain",
    "open_node",
    "out_of_gas",
    "quantity",
    "read_all",
    "returned_bytes",
    "revert_error",
]
