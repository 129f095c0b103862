"""The version of the package that is installed."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("shackled")
except PackageNotFoundError:  # from a source tree that was not installed
    __version__ = "0+unknown"
