"""Sets of parameters and starts: grids and random draws, each row by itself, the same everywhere.

Row i follows from the description and from i alone: not from the rows asked for together, nor from
the machine. A normal distribution is not among them: it would take a logarithm, whose
last bit differs from one C library to the next.
"""

from pendula.many.sampling.distributions import (
    KINDS,
    Choice,
    Distribution,
    Fixed,
    Grid,
    Listed,
    LogUniform,
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
    "SameAs",
    "Sampler",
    "Uniform",
    "sampler_from",
]
