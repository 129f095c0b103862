"""Developers' tools, not part of the package: building, measuring, nodes and chains for tests."""
