"""The attribute of files and datasets that holds what they were made from, as JSON."""

KEY = "pendula"
