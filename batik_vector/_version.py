"""The version: written into every file that leaves."""

__version__ = "0.1.0"
