"""The version of the package."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("carom")
except PackageNotFoundError:
    __version__ = "unknown"
