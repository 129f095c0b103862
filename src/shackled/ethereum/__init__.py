"""Basics of Ethereum: hashes, addresses, the ABI, block headers, amounts of ether."""
