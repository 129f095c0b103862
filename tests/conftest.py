"""Settings of all tests."""

from __future__ import annotations

import os

from hypothesis import settings

# The same examples each time, so that a change fails for what it changed; `make fuzz` looks for new ones.
settings.register_profile("same", derandomize=True)
settings.register_profile("new", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "same"))
