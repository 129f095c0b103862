"""glTF 2.0, as text or binary (GLB).

An own reader: trimesh passes over sparse accessors, fans, normalized positions, poses, and what a file requires of its
reader.
"""
