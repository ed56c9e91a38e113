"""The attribute of files and datasets that holds what they were made from, as JSON.

In it the version that made them has the same name.
"""

KEY = "pendula"
