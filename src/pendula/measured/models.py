"""What all models of a pendulum can do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula._types import Array
    from pendula.measured.model import Row
    from pendula.systems import System


class Model(Protocol):
    """What a problem asks of a model; `SingleModel` says more."""

    @property
    def rows(self) -> tuple[Row, ...]:
        """Its parameters."""

    def states(self, t: Array, values: Mapping[str, float]) -> Array:
        """Of the motion at the times, the first that of the start, (n, d); NaN: not finite."""

    def seen(self, states: Array, values: Mapping[str, float]) -> Array:
        """What is measured of states (n, d), (n, m)."""

    @property
    def components(self) -> tuple[str, ...]:
        """Names of its state, (d,)."""

    def state_slopes(self, t: Array, values: Mapping[str, float], columns: Sequence[str]) -> Array:
        """Derivatives of the states by some of the parameters, (n, d, k)."""

    def slopes(
        self, t: Array, states: Array, values: Mapping[str, float], columns: Sequence[str]
    ) -> Array:
        """Derivatives of what is measured by some of the parameters, (n, m, k)."""

    def roughly(self) -> Model:
        """The same, computed with fewer digits."""

    def system(self, values: Mapping[str, float]) -> System | None:
        """The pendulum with these values; None: one of them is unphysical."""
