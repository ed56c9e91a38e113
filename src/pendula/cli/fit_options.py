"""The options of `pendula fit`: how the file is read, what is known, what is fitted."""

from __future__ import annotations

from typing import Any

import click

# Options that name columns of the file, by the arguments of `pendula.measured.read`.
_COLUMNS = {
    "time": "of times, or of frames",
    "angle": "of angles; of a double pendulum give it twice, as the further ones",
    "rate": "of angular rates",
    "x": "of positions to the right",
    "y": "of positions along the vertical",
    "radial": "of the acceleration along the string",
    "period": "of periods, or of times of several swings",
    "length_column": "of lengths, in a table of periods",
    "amplitude_column": "of amplitudes, in a table of periods",
}
_MANY = ("angle", "rate", "x", "y", "period")
_ARGUMENTS = {"length_column": "length", "amplitude_column": "amplitude"}
# The other arguments of `read`: unit of a quantity, or what the option takes, and its help.
_READING: dict[str, tuple[str | None, str]] = {
    "unit": (None, "of what was measured: deg, rad/s, mm, px …"),
    "time_unit": (None, "of the times, if no header tells it"),
    "frame_rate": ("1/s", "frames a second of a film, e.g. 240"),
    "scale": ("m", "length of a pixel"),
    "mass": ("kg", "of the bob, for a force along its string"),
    "sheet": (None, "which of several in a file"),
    "run": (None, "which of several in a file"),
}
# What is known of the pendulum, by the arguments of `fit` and `fit_periods`.
_KNOWN = {
    "length": ("m", "from the pivot to the bob's centre, then g is told"),
    "length_error": ("m", "standard uncertainty of each length"),
    "gravity": ("m/s^2", "if known, then the length is told"),
}
# Arguments of `Apparatus` and `fit_periods` for tables of periods.
APPARATUS = {
    "amplitude": ("rad", "of the swings, if the table does not tell it"),
    "bob_radius": ("m", "of the ball"),
    "bob_mass": ("kg", "of the ball"),
    "string_density": ("kg/m", "mass of the string over its length"),
    "string_stiffness": ("N", "E A of a string that was measured without the ball on it"),
    "decay_rate": ("1/s", "of an amplitude that falls as exp(-rate t)"),
    "air_density": ("kg/m^3", "of the air [1.2]"),
}
ERRORS = {
    "timing_error": ("s", "standard uncertainty of one timing, over the swings timed at once"),
    "amplitude_error": ("rad", "standard uncertainty of each amplitude"),
}
_QUANTITIES = {name: row[0] for name, row in {**_READING, **_KNOWN, **APPARATUS, **ERRORS}.items()}


def reading_options() -> list[click.Parameter]:
    """How the file is read, where it does not tell itself."""
    columns = [
        click.Option(
            [name, _long(name)], metavar="COLUMN", multiple=name in _MANY, help=f"column {text}"
        )
        for name, text in _COLUMNS.items()
    ]
    return [
        *columns,
        *_values(_READING),
        click.Option(["--swings"], type=int, metavar="N", help="how many were timed at once"),
        click.Option(["--y-axis"], type=click.Choice(["up", "down"]), help="which way y grows"),
        click.Option(
            ["--zero"], type=click.Choice(["down", "up"]), help="where angles are counted from"
        ),
        click.Option(["kept", "--t"], metavar="FROM,TO", help="times that are kept, e.g. 2s,30s"),
        click.Option(
            ["--outliers"], type=click.Choice(["keep", "leave out"]), help="what is done with them"
        ),
    ]


def fitting_options() -> list[click.Parameter]:
    """What is known, and what is fitted."""
    return [
        *_values(_KNOWN),
        click.Option(
            ["--model"],
            metavar="NAMES",
            help="kinds of friction joined by +: viscous, coulomb, quadratic, cubic; undamped "
            "[default: all are compared; of a double pendulum viscous]",
        ),
        click.Option(
            ["--signs"],
            type=click.Choice(["physical", "free"]),
            default="physical",
            show_default=True,
            help="whether frictions may be negative",
        ),
        click.Option(["--robust"], is_flag=True, help="outliers count less"),
        click.Option(
            ["--uncertainty"],
            type=click.Choice(["corrected", "profile", "bootstrap"]),
            default="corrected",
            show_default=True,
            help="how uncertainties are found",
        ),
        click.Option(
            ["--corrections"],
            metavar="NAMES",
            help="of a table of periods, e.g. amplitude,bob,offset [default: all that can be made]",
        ),
        *_values({**APPARATUS, **ERRORS}),
    ]


def reading_of(given: dict[str, Any]) -> dict[str, Any]:
    """Arguments of `pendula.measured.read` from the options."""
    found: dict[str, Any] = {}
    for name in _COLUMNS:
        if given[name]:
            named = [given[name]] if isinstance(given[name], str) else given[name]
            columns = [int(each) if each.isdecimal() else each for each in named]
            found[_ARGUMENTS.get(name, name)] = columns if len(columns) > 1 else columns[0]
    for name in (*_READING, "swings", "y_axis", "zero", "outliers"):
        if given[name] is not None:
            found[name] = quantity_of(given, name)
    if given["run"] is not None and given["run"].isdecimal():
        found["run"] = int(given["run"])
    if given["kept"] is not None:
        from pendula.units import quantities

        found["t"] = tuple(quantities(given["kept"], "s", "kept"))
    return found


def quantity_of(given: dict[str, Any], name: str) -> Any:
    """An option's value, in its SI unit if it has one; None: not given."""
    from pendula.units import quantity

    unit, text = _QUANTITIES.get(name), given[name]
    return text if unit is None or text is None else quantity(text, unit, name)


def _values(rows: dict[str, Any]) -> list[click.Parameter]:
    return [
        click.Option([name, _long(name)], metavar="VALUE", help=text)
        for name, (_, text) in rows.items()
    ]


def _long(name: str) -> str:
    return f"--{name.replace('_', '-')}"
