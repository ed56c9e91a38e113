"""Benchmarks: each figure beside its peers in the same run. `make bench` prints them."""
