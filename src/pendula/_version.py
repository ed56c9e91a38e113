"""The version; in a module of its own, as many import it."""

__version__ = "0.1.0"
