from ._account import environment_account, keystore_account
from ._contract import deployment, deployments
from ._deployer import Deployer
from ._transactor import Transactor

__all__ = [
    "Deployer",
    "Transactor",
    "deployment",
    "deployments",
    "environment_account",
    "keystore_account",
]
