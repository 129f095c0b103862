"""Tools for those who work on Shackled, not part of the package: building, measuring, nodes and chains for tests."""
