"""The collections, deployed on a chain in this process."""
