"""Attributes of files and datasets."""

KEY = "pendula"  # what they were made from, as JSON
UNFINISHED = "unfinished"  # of a store whose chunks are not all there
