"""Contracts put on a chain, at the same addresses everywhere, and the transactions that do it."""

from .account import environment_account, keystore_account
from .contract import Deployment, deployments
from .deployer import Deployer, Plan, Step
from .transactor import Fees, Receipt, Transactor

__all__ = [
    "Deployer",
    "Deployment",
    "Fees",
    "Plan",
    "Receipt",
    "Step",
    "Transactor",
    "deployments",
    "environment_account",
    "keystore_account",
]
