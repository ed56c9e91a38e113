"""Sets of parameters and starts: grids and random draws, each row by itself, the same everywhere.

Row i follows from the description and from i alone: not from the rows asked for together, the
number of draws, or the machine.
"""

from pendula.many.sampling.distributions import (
    KINDS,
    Choice,
    Distribution,
    Fixed,
    Grid,
    Listed,
    LogUniform,
    Normal,
    SameAs,
    Uniform,
)
from pendula.many.sampling.sampler import LARGEST_SEED, Sampler, sampler_from

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
