"""Meshes and scenes kept on chain: contracts/src/studio."""
