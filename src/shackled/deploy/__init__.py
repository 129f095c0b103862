"""Contracts put on a chain, at the same addresses everywhere, and the transactions that do it."""

from .account import environment_account, keystore_account
from .contract import Deployment, deployments
from .deployer import Deployer, Plan, Step
from .quote import Call, Fees, Quote
from .transactor import Receipt, Transactor

__all__ = [
    "Call",
    "Deployer",
    "Deployment",
    "Fees",
    "Plan",
    "Quote",
    "Receipt",
    "Step",
    "Transactor",
    "deployments",
    "environment_account",
    "keystore_account",
]
