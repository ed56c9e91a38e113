"""Attributes of files and datasets. In what `KEY` holds, the version that made them has the same name."""

KEY = "pendula"  # what they were made from, as JSON
UNFINISHED = "unfinished"  # of a store whose chunks are not all there
