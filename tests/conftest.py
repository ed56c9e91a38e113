"""Property tests: the same examples in every run, and none of them timed."""

from hypothesis import settings

settings.register_profile("pendula", deadline=None, derandomize=True)
settings.load_profile("pendula")
