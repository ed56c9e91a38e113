"""Linear algebra on one thread, whose last bits do not depend on how many a library would take.

BLAS shares the sums of large matrices among its threads, and with them the order of additions. The
matrices here are small: more threads are no faster.
"""

from __future__ import annotations

from functools import cache, wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from pendula._checks import extra

if TYPE_CHECKING:
    from collections.abc import Callable


P = ParamSpec("P")
R = TypeVar("R")


def on_one_thread(function: Callable[P, R]) -> Callable[P, R]:
    """The function with linear algebra on one thread while it runs."""

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        with _libraries().limit(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return limited


@cache
def _libraries() -> Any:
    """The libraries of linear algebra in this process; SciPy carries one of its own."""
    extra("scipy.linalg", "fit")
    return extra("threadpoolctl", "fit").ThreadpoolController()
