"""Where the contracts run."""

from .chain import CallResult, Chain, ContractChain, Drawing
from .opening import CHAINS, open_chain, open_node

__all__ = ["CHAINS", "CallResult", "Chain", "ContractChain", "Drawing", "open_chain", "open_node"]
