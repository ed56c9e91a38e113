"""What is asked of a fit of a system, checked: which of its parameters are fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula.measured import asked
from pendula.measured.double_model import JOINTS
from pendula.measured.model import FRICTIONS
from pendula.measured.system_model import TIME_OFFSET, SystemModel

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula.measured.measurement import Measurement
    from pendula.systems import System

RESISTANCES = (*FRICTIONS, *JOINTS)


def system_model(
    measurements: Sequence[Measurement], system: System, given: Mapping[str, Any]
) -> SystemModel:
    """The model that a system is of recordings.

    Raises:
        ValueError: where it has not as many angles, or for what a model only is asked.
    """
    first, bodies = measurements[0], system.can.degrees_of_freedom
    if bodies != first.bodies or (bodies == 2 and first.quantity != "angle"):
        one = {1: "one pendulum", 2: "a double pendulum"}
        rule = "must be {text} as the recording is, of its {other}s, got {value}"
        told = {"text": one[first.bodies], "other": first.quantity}
        raise ArgumentError("system", rule, value=system, **told)
    for name in ("length", "gravity"):
        if given.get(name) is not None:
            rule = "cannot be given beside a system, which has its own"
            way_out = 'with an uncertainty, fit a model such as <system="viscous">'
            raise ArgumentError(name, rule, way_out)
    if bodies == 2 and len(measurements) > 1:
        rule = "must be one recording of a double pendulum, got {value}"
        raise ArgumentError("measurement", rule, "fit each alone", value=len(measurements))
    return SystemModel(system, first.quantity)


def free_names(model: SystemModel, free: Any, fixed: Mapping[str, float]) -> tuple[str, ...]:
    """What is fitted: the start, as far as it is not held, and the parameters that are named.

    Args:
        model: of the recordings.
        free: names; None: gravity, the frictions that are not zero, the offset of what is measured.
            A start of which a component is named is fitted in the named ones, otherwise in all.
        fixed: what is held.

    Raises:
        ValueError: for a name that the system does not have, or one that cannot be told.
    """
    own, start = model.known.parameters, model.known.components
    if free is None:
        resisting = [name for name in (*RESISTANCES, "q") if own.get(name)]
        offsets = model.offsets if model.bodies == 1 else ()
        named: tuple[str, ...] = (*(["gravity"] if "gravity" in own else []), *resisting, *offsets)
    else:
        named = asked.names_of("free", free, model.rows)
    told = [name for name in start if name in named] or [n for n in start if n not in fixed]
    names = tuple(dict.fromkeys([*told, *(name for name in named if name not in start)]))
    both = next((name for name in names if name in fixed), None)
    if both is not None and free is not None:
        rule = "cannot be named in both {choices}"
        raise ArgumentError(both, rule, "hold it or fit it", choices=("free", "fixed"))
    names = tuple(name for name in names if name not in fixed)
    if TIME_OFFSET in names and set(start) <= set(names) and model.known.can.autonomous:
        rule = "cannot be told beside a start that is fitted: the motion starts anywhere on its way"
        way_out = 'hold a part of the start, such as <fixed={"omega": 0}> of a release from rest'
        raise ArgumentError(TIME_OFFSET, rule, way_out)
    return names


def bounds_of(given: Any, model: Any) -> dict[str, tuple[float, float]]:
    """Least and largest values by names of parameters.

    Raises:
        ValueError: for a name that there is none of, or bounds that are not (low, high).
    """
    from pendula._checks import number, one_of

    if given is None:
        return {}
    rule = "must be (low, high) by the names of parameters, got {value}"
    way_out = 'such as <bounds={"gravity": (9.7, 9.9)}>'
    if not hasattr(given, "items"):
        raise ArgumentError("bounds", rule, way_out, value=given)
    found = {}
    for name, pair in given.items():
        one_of("bounds", name, [row.name for row in model.rows])
        if not isinstance(pair, tuple | list) or len(pair) != 2:
            raise ArgumentError("bounds", rule, way_out, value=given)
        low, high = (number("bounds", each) for each in pair)
        if not low < high:
            rule = f"of {name} must rise, got {{value}}"
            raise ArgumentError("bounds", rule, value=(low, high))
        found[str(name)] = (low, high)
    return found
