"""Attributes of files and datasets; in what `KEY` holds, so is called the version that made it."""

KEY = "pendula"  # what they were made from, as JSON
UNFINISHED = "unfinished"  # of a store whose chunks are not all there
