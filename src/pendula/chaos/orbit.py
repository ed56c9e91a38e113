"""What a periodic orbit is."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import whole_number
from pendula._late_methods import with_promised
from pendula._tables import html_table
from pendula.chaos.closing import Closing
from pendula.chaos.multipliers import is_stable, kind_of, multipliers_of, rotation_angle
from pendula.chaos.newton import Closed, with_matrix
from pendula.run.solve import solve

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory
    from pendula.systems import System

_MOST_POINTS = 10**6


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class PeriodicOrbit:
    """A motion that repeats itself, and how motions beside it behave.

    Attributes:
        system: the pendulum.
        state: on the orbit, at t = 0, (d,) [rad, rad/s].
        period: after which all is as before, but for whole turns [s].
        energy: at the start [J]; without a drive, always.
        multipliers: eigenvalues of the monodromy matrix, (d,) complex; without a drive 1, 1, μ, 1/μ
            (one bob: 1, 1).
        kind: "elliptic", "hyperbolic", "inverse hyperbolic", "parabolic"; with drive and friction
            also "stable node", "stable focus", "unstable node", "unstable focus".
        monodromy: d state(T) / d state(0), (d, d).
        turns: whole turns of each angle in a period, (d/2,).
        drive_periods: how many of the drive's the period is; None: no drive.
        symmetry: "brake": the orbit passes through rest and runs back; "odd": it is its own mirror
            image half a period later; "brake, odd": both; "none" of which was made use of.
        closure: the largest difference of state(T) from the start, turns left out [rad, rad/s].
        correction: the last of Newton's method, angles in radians, velocities over 2π/T.
        iterations: of Newton's method.
        n_steps: of all its runs.
        closing: the conditions that made it.
        recipe: the arguments that it was made with.
    """

    system: System
    state: Array
    period: float
    energy: float
    multipliers: NDArray[Any]
    kind: str
    monodromy: Array
    turns: tuple[int, ...]
    drive_periods: int | None
    symmetry: str
    closure: float
    correction: float
    iterations: int
    n_steps: int
    closing: Closing
    recipe: Mapping[str, Any] = field(default_factory=dict)

    @property
    def stable(self) -> bool:
        """Whether motions beside it stay there, as far as its multipliers tell."""
        return is_stable(self.kind)

    @property
    def rotation_angle(self) -> float | None:
        """By how much motions beside it turn about it in a period [rad]; None: they do not."""
        return rotation_angle(self.multipliers)

    @property
    def multiplier_sum(self) -> float:
        """μ + 1/μ without a drive, μ1 + μ2 with one."""
        return float(self.multipliers[-2:].sum().real)

    @property
    def conservative(self) -> bool:
        """Whether the energy is constant."""
        return self.drive_periods is None

    def trajectory(self, n: int = 401) -> Trajectory:
        """The motion over one period, at n even times from its start."""
        import numpy as np

        times = np.linspace(0.0, self.period, whole_number("n", n, _MOST_POINTS))
        return solve(self.system, self.state, times)

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, language: str = "en") -> Any:
            """See `pendula.plot.periodic_orbit`."""

    def __repr__(self) -> str:
        return (
            f"<PeriodicOrbit of {self.system!r}: period {self.period:.12g} s, "
            f"energy {self.energy:.6g} J, {self.kind}>"
        )

    def _repr_html_(self) -> str:
        """What a notebook shows: period, energy, multipliers, and how well it closes."""
        shown = ", ".join(f"{each:.10g}" for each in self.multipliers)
        rows = [
            ("system", repr(self.system)),
            ("state", ", ".join(f"{each:.15g}" for each in self.state)),
            ("period", f"{self.period:.15g} s"),
            ("energy", f"{self.energy:.12g} J"),
            ("multipliers", shown),
            ("kind", self.kind),
            ("closes to", f"{self.closure:.1e}"),
        ]
        return html_table("Periodic orbit", rows)


def orbit_of(
    system: System,
    closing: Closing,
    closed: Closed,
    drive_periods: int | None,
    recipe: Mapping[str, Any],
) -> PeriodicOrbit:
    """The orbit of a start and period that close, with its monodromy matrix.

    Raises:
        OrbitError: where the run over a period does not come to its end.
    """
    import numpy as np

    state, period = closed.state, closed.period
    end, monodromy, steps = with_matrix(system, state, period)
    dof, conservative = state.size // 2, drive_periods is None
    turns = np.round((end - state)[:dof] / math.tau)
    back = end - state
    back[:dof] -= math.tau * turns
    multipliers = multipliers_of(monodromy, conservative=conservative)
    return PeriodicOrbit(
        system,
        state,
        float(period),
        float(system.energy(state)),
        multipliers,
        kind_of(multipliers, conservative=conservative),
        monodromy,
        tuple(int(each) for each in turns),
        drive_periods,
        closing.symmetry,
        float(abs(back).max()),
        closed.correction,
        closed.iterations,
        closed.n_steps + steps,
        closing,
        recipe,
    )
