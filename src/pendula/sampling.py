"""Sets of parameters and starts: grids and random draws, each row by itself."""

from pendula.many.sampling import (
    KINDS,
    LARGEST_SEED,
    Choice,
    Distribution,
    Fixed,
    Grid,
    Listed,
    LogUniform,
    Normal,
    SameAs,
    Sampler,
    Uniform,
    sampler_from,
)

__all__ = [
    "KINDS",
    "LARGEST_SEED",
    "Choice",
    "Distribution",
    "Fixed",
    "Grid",
    "Listed",
    "LogUniform",
    "Normal",
    "SameAs",
    "Sampler",
    "Uniform",
    "sampler_from",
]
