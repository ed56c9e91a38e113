"""Where the fit of a system starts: at the optimum of the model that it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, cast

from pendula.measured.begun import Begun
from pendula.measured.driven_start import driven_values
from pendula.measured.ladder import grown
from pendula.measured.least_squares import CLOSE
from pendula.measured.model import DRIVE, FRICTIONS, SingleModel
from pendula.measured.problem import Optimum, Problem, minimise
from pendula.measured.starts import MOST
from pendula.measured.system_model import TIME_OFFSET, SystemModel, inertia_and_pull

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.plan import Plan
    from pendula.measured.problem import Sampled

_MOVERS = ("torque", "pivot_amplitude", "a")  # parameters that drive where they are not zero
_SCALES = {"gravity": 1, "length": -1, "inertia": -1, "centre": 1, "mass": 1}  # powers of ω0²


def system_optimum(plan: Plan, recordings: tuple[Sampled, ...]) -> tuple[Problem, Optimum, float]:
    """The optimum of a system of one angle, and what viscous friction leaves beside none [rms].

    Without a drive a system is a model by other names: the model's optimum, found without start
    values, is written in them. With one the system's own values are where the fit starts.
    """
    problem, own = plan.problem(recordings), _own_values(plan)
    driven = any(own.get(name) or name in problem.free for name in _MOVERS)
    model = _as_model(plan, problem, own)
    begun = Begun(model, recordings)
    if driven:
        best = _driven_optimum(plan, problem, own, begun)
        return problem, best, best.rms
    as_model = model.problem(recordings)
    found = begun.best(model, as_model)
    known = dict(zip(found.names, found.x.tolist(), strict=True))
    start = _Translation(plan, problem, own, known, as_model.states(found.x)).start()
    best = minimise(problem, start, robust=plan.robust)
    viscous = best.rms
    if (
        not plan.bounds
        and not model.frictions
        and not any(model.fixed.get(name) for name in FRICTIONS)
    ):
        damped = replace(model, frictions=("viscous",))
        viscous = begun.best(damped, damped.problem(recordings)).rms
    return problem, best, viscous


def _driven_optimum(
    plan: Plan, problem: Problem, own: Mapping[str, float], begun: Begun
) -> Optimum:
    """The better of the optima from the system's own values and from what the record says."""
    start = _Translation(plan, problem, own, begun.first, []).start()
    ends = [grown(problem, start, begun.length, robust=plan.robust)]
    if "torque" in own and {*DRIVE} & {*problem.free} and plan.model.quantity == "angle":
        known = dict(problem.constants)
        if "drive_frequency" not in problem.free:
            known["drive_frequency"] = own["drive_frequency"]
        said = driven_values(problem.recordings[0], known)
        start = _Translation(plan, problem, own, said, [], driven=True).start()
        whole = problem.thinned(MOST)
        ends.append(minimise(whole, start, robust=plan.robust, search=CLOSE))
    best = min(ends, key=lambda end: end.rms)
    return minimise(problem, best.x, robust=plan.robust)


def _own_values(plan: Plan) -> dict[str, float]:
    """The system's parameters, where they are held as they are held."""
    known = cast("SystemModel", plan.model).known.parameters
    return known | {name: plan.fixed[name] for name in known if name in plan.fixed}


def _scale(problem: Problem, own: Mapping[str, float]) -> str:
    """The free parameter by which ω0² is reached; empty: none changes it."""
    usable = [name for name in _SCALES if name in problem.free and name in own]
    if "inertia" not in own:  # of a bob the mass does not matter
        usable = [name for name in usable if name != "mass"]
    return next(iter(usable), "")


def _as_model(plan: Plan, problem: Problem, own: Mapping[str, float]) -> Plan:
    """The plan of the model that the system is, without its drive."""
    made = cast("SystemModel", plan.model)
    linear = made.known.name in ("linear", "driven-linear")
    model = SingleModel(made.quantity, linear)
    inertia, pull = inertia_and_pull(own)
    fixed = {name: x for name, x in problem.constants.items() if name not in own}
    fixed = {name: x for name, x in fixed.items() if name in {row.name for row in model.rows}}
    if not _scale(problem, own):
        fixed["omega0_squared"] = pull / inertia
    frictions = [name for name in FRICTIONS if name in problem.free]
    held = {name: own[name] / inertia for name in FRICTIONS if own.get(name)}
    if "q" in own:
        frictions, held = ["viscous"], {"viscous": 1.0 / own["q"]}
    fixed |= {name: x for name, x in held.items() if name not in frictions}
    if model.offset not in problem.free:
        fixed.setdefault(model.offset, 0.0)
    if TIME_OFFSET not in problem.free:
        fixed |= {name: problem.constants.get(name, 0.0) for name in _held(problem)}
    return replace(
        plan,
        model=model,
        frictions=tuple(frictions),
        fixed=fixed,
        free=tuple(name for name in ("scale",) if name in problem.free),
        shared=None if plan.shared is None else (),
        start={},
    )


def _held(problem: Problem) -> list[str]:
    """Components of the start that are not fitted."""
    return [name for name in ("theta", "omega") if name not in problem.free]


@dataclass(frozen=True)
class _Translation:
    """The optimum of a model in the parameters of a system.

    Attributes:
        plan: of the system.
        problem: of the system.
        own: the system's values.
        found: the model's values, by name.
        states: of the model's motion at the samples of each recording; none: not needed.
        driven: the drive is among the model's values.
    """

    plan: Plan
    problem: Problem
    own: Mapping[str, float]
    found: Mapping[str, float]
    states: list[Array]
    driven: bool = False

    def start(self) -> Array:
        """Values of the system's problem, (k,)."""
        import numpy as np

        several = len(self.problem.recordings) > 1
        values = [self._of(i) for i in range(len(self.problem.recordings))]
        x = []
        for name in self.problem.names:
            bare, _, number = name.partition("[")
            i = int(number.rstrip("]")) - 1 if several and number else 0
            x.append(self.plan.start.get(bare, values[i].get(bare, self._standard(bare))))
        return np.array(x)

    def _standard(self, name: str) -> float:
        rows = {row.name: row.standard for row in self.problem.model.rows}
        return rows[name]

    def _of(self, i: int) -> dict[str, float]:
        """Values of recording i, by their names."""
        mark = f"[{i + 1}]"
        found = {**self.found}
        found |= {n.removesuffix(mark): x for n, x in self.found.items() if n.endswith(mark)}
        if not self.states and not self.driven:  # the rest is the system's own
            names = {"theta", "omega", *self.problem.model.offsets}  # type: ignore[attr-defined]
            return {**self.own, **{n: x for n, x in found.items() if n in names}}
        own = dict(self.own)
        scale = _scale(self.problem, own)
        if scale:
            inertia, pull = inertia_and_pull(own)
            own[scale] *= (found["omega0_squared"] * inertia / pull) ** _SCALES[scale]
        inertia, _ = inertia_and_pull(own)
        own |= {name: found[name] * inertia for name in FRICTIONS if name in found}
        if "q" in own:
            own["q"] = 1.0 / max(found.get("viscous", 0.0), 1e-9)
        if self.driven:
            drive = {name: found[name] for name in DRIVE if name in own}
            return {**found, **own, **drive, "torque": found["torque"] * inertia}
        return {**found, **own, **self._turned(i)}

    def _turned(self, i: int) -> dict[str, float]:
        """The time offset at which the motion passes what is held of its start."""
        import numpy as np

        held = _held(self.problem)
        if TIME_OFFSET not in self.problem.free or not held:
            return {}
        t, states = self.problem.recordings[i].t, self.states[i]
        at = 0 if held[0] == "theta" else 1
        away = states[:, at] - self.problem.constants.get(held[0], 0.0)
        passes = np.flatnonzero(np.diff(np.signbit(away)))
        if not passes.size:
            return {}
        j = int(passes[0])
        share = float(away[j] / (away[j] - away[j + 1]))
        state = states[j] + share * (states[j + 1] - states[j])
        when = float(t[j] + share * (t[j + 1] - t[j]) - t[0])
        return {TIME_OFFSET: when, "theta": float(state[0]), "omega": float(state[1])}
