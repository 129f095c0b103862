from ._address_book import VARIABLE, AddressBook, book_path
from ._chain import CallResult, Chain, ContractChain, Drawing, count_call, returned_bytes, returned_counts
from ._connection import PATIENCE, Connection, check_timeout, check_url, quantity
from ._embedded import (
    CHAIN_ID,
    DEFAULT_GAS_LIMIT,
    SENDER,
    EmbeddedChain,
    PyEvmChain,
    PyrevmChain,
    RevmChain,
    pyrevm_error,
)
from ._failures import describe_revert, out_of_gas, retry_after, revert_data, revert_error
from ._node import GAS_LEFT, MAX_INIT_CODE, NodeChain, engines, metered
from ._opening import CHAINS, check_chain, open_chain, open_node
from ._reading import Report, read_all

__all__ = [
    "CHAINS",
    "CHAIN_ID",
    "DEFAULT_GAS_LIMIT",
    "GAS_LEFT",
    "MAX_INIT_CODE",
    "PATIENCE",
    "SENDER",
    "VARIABLE",
    "AddressBook",
    "CallResult",
    "Chain",
    "Connection",
    "ContractChain",
    "Drawing",
    "EmbeddedChain",
    "NodeChain",
    "PyEvmChain",
    "PyrevmChain",
    "Report",
    "RevmChain",
    "book_path",
    "check_chain",
    "check_timeout",
    "check_url",
    "count_call",
    "describe_revert",
    "engines",
    "metered",
    "open_chain",
    "open_node",
    "out_of_gas",
    "pyrevm_error",
    "quantity",
    "read_all",
    "retry_after",
    "returned_bytes",
    "returned_counts",
    "revert_data",
    "revert_error",
]
