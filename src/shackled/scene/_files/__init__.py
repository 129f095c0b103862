"""Scenes and meshes from files."""
