from ._account import environment_account, keystore_account, read_keystore, signer_class
from ._contract import (
    CONTRACTS,
    STANDARD,
    Deployment,
    deployment,
    deployments,
    in_order,
    local_chain,
    write_verification,
)
from ._deployer import Deployer, Plan, create
from ._quote import Call, Fees, Quote, current_fees, make_quotes
from ._transactor import Receipt, Transactor

__all__ = [
    "CONTRACTS",
    "STANDARD",
    "Call",
    "Deployer",
    "Deployment",
    "Fees",
    "Plan",
    "Quote",
    "Receipt",
    "Transactor",
    "create",
    "current_fees",
    "deployment",
    "deployments",
    "environment_account",
    "in_order",
    "keystore_account",
    "local_chain",
    "make_quotes",
    "read_keystore",
    "signer_class",
    "write_verification",
]
