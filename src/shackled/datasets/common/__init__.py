"""Common objects of computer graphics: shapes, scenes of the Shackled paper, and models of other authors."""
