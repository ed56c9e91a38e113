"""The colour scale of a map: its unit, its label and its ticks."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import one_of
from pendula._messages import ArgumentError
from pendula.plot.style import power_of_ten

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula.plot.labels import Labels


@dataclass(frozen=True)
class TimeScale:
    """Times in units of `unit` seconds, written as `symbol`."""

    unit: float
    symbol: str
    which: int | None
    """The rod whose flips are meant; None: either."""
    t_max: float | None

    def label(self, words: Labels) -> str:
        """What the colour bar shows."""
        name = "flip_time" if self.which is None else f"flip_time_{self.which}"
        return words.axis[name].format(unit=self.symbol)

    def end(self, words: Labels) -> str:
        """Until when flips were looked for; "" if unknown."""
        if self.t_max is None:
            return ""
        return f"{words.local(f'{self.t_max / self.unit:.4g}')} {self.symbol}"


def time_scale(attributes: Mapping[Any, Any], time_unit: str) -> TimeScale:
    """The scale of a map with these attributes, in seconds or in units of √(l₁/g).

    Raises:
        ValueError: for natural units where the attributes lack the system.
    """
    one_of("time_unit", time_unit, ("s", "natural"))
    inputs = inputs_of(attributes)
    which = inputs.get("which")
    rest = which, seconds_of(attributes)
    if time_unit == "s":
        return TimeScale(1.0, "s", *rest)
    try:
        parameters = inputs["system"]["parameters"]
        unit = math.sqrt(parameters["l1"] / parameters["gravity"])
    except (KeyError, TypeError):
        raise ArgumentError(
            "time_unit",
            '= "natural" needs a dataset whose attribute "pendula" tells l1 and gravity',
            'take time_unit = "s"',
        ) from None
    alike = parameters.get("l2", parameters["l1"]) == parameters["l1"]
    return TimeScale(unit, "√(l/g)" if alike else "√(l₁/g)", *rest)


def growth_time(attributes: Mapping[Any, Any]) -> float:
    """The time in which neighbours parted [s].

    Raises:
        ValueError: where the attributes lack it.
    """
    t_max = seconds_of(attributes)
    if t_max is None or not t_max > 0.0:
        raise ArgumentError(
            "dataset",
            'must have the attribute "t_max" [s]',
            "give what pendula.divergence_map returned",
        )
    return t_max


def seconds_of(attributes: Mapping[Any, Any]) -> float | None:
    """The length of a map's runs [s]; None: unknown."""
    t_max = attributes.get("t_max", inputs_of(attributes).get("t_max"))
    return None if t_max is None else float(t_max)


def inputs_of(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    """What a map was made from; empty: unknown."""
    try:
        inputs = json.loads(attributes.get(KEY, "{}"))
    except (TypeError, ValueError):
        return {}
    return inputs if isinstance(inputs, dict) else {}


def number_ticks(bar: Any, words: Labels) -> None:
    """Put plain numbers, 1, 2, 5, 10, …, at a colour bar's ticks."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

    low, high = bar.mappable.norm.vmin, bar.mappable.norm.vmax
    logarithmic = low > 0 and bar.ax.get_yscale() == "log" and high / low >= 5
    bar.locator = LogLocator(subs=_within(low, high)) if logarithmic else MaxNLocator(6)
    bar.minorlocator = NullLocator()
    bar.formatter = FuncFormatter(lambda x, _: words.local(f"{x:.6g}"))
    bar.update_ticks()


def power_ticks(bar: Any) -> None:
    """Put powers of ten at the ticks of a colour bar over many of them."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    bar.locator, bar.minorlocator = LogLocator(numticks=9), NullLocator()
    bar.formatter = FuncFormatter(power_of_ten)
    bar.update_ticks()


def _within(low: float, high: float) -> tuple[float, ...]:
    """Ticks within a power of ten, the fewer the more powers there are."""
    powers = math.log10(high / low)
    return (1.0, 2.0, 5.0) if powers < 4 else (1.0,)
