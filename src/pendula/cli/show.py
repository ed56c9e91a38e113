"""`pendula show`: what a file holds, with a plot in the terminal or a picture."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.map_picture import axes_of, checked_map_picture, look_of, look_options, shaded
from pendula.cli.pictures import picture_options, write_picture
from pendula.cli.show_measured import show_measured
from pendula.cli.shown import Held, held
from pendula.cli.tables import paragraph, table

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from pendula.many.sweep import SweepRecipe
    from pendula.run.trajectory import Trajectory

Drawing = Callable[[str], "Figure"] | None  # in a language; None: there is no picture


def _show(**given: Any) -> None:
    from pendula.lab.address import is_link

    picture = checked_map_picture(given)
    link = is_link(given["file"])
    found = Held(given["file"], "", "link", {}) if link else held(given["file"])
    if found.kind != "map" and look_of(given):
        raise click.UsageError(f"--{next(iter(look_of(given)))} goes with a map")
    if given["row"] is not None and found.kind not in ("sweep", "recipe"):
        raise click.UsageError(f"--row goes with a sweep, not with a {found.kind}")
    draw = _SHOWN[found.kind](found, given)
    if picture is None:
        return
    if draw is None:
        hint = "; name a --row of it" if found.kind == "recipe" else ""
        raise click.UsageError(f"--picture draws trajectories, maps and sweeps{hint}")
    write_picture(draw(given["lang"]), picture, given)
    click.echo(picture)


def _say(text: str) -> None:
    click.echo(paragraph(text))


# ---- trajectories ----


def _trajectory(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula.io import load

    run = load(found.path)
    if run.states.ndim != 2:
        count = math.prod(run.states.shape[:-2])
        _say(f"{count} exact solutions of {run.system!r}, {run.t.size} times")
        return None
    _say(f"trajectory of {run.system!r}")
    return _run(run, given)


def _link(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula.lab import read_link

    run = read_link(found.path).run()
    _say(f"link to a run of {run.system!r}")
    return _run(run, given)


def _run(run: Trajectory, given: dict[str, Any]) -> Drawing:
    from pendula import plot
    from pendula.cli.run import deliver

    components = zip(run.system.component_units.items(), run.request.state, strict=True)
    start = ", ".join(f"{name} = {value:.6g} {unit}" for (name, unit), value in components)
    _say(f"at t = {run.request.t0:g} s: {start}")
    click.echo()
    deliver(run, None, force=False, every_row=given["all"], more="--all prints all")
    return lambda language: plot.trajectory(run, language=language)


# ---- maps ----


def _map(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula import plot
    from pendula.cli.map_output import summary
    from pendula.systems import system_from

    known, data = found.known, _dataset(found)
    _say(f"{known['map']} map of {system_from(known['system'])!r}")
    for name in axes_of(data):
        centres = data[name].values
        ends = f"{centres[0]:.6g} to {centres[-1]:.6g} {data[name].attrs['units']}"
        click.echo(f"{name}: {centres.size} cells, centres {ends}")
    energy = f"energy {known['energy']:g} J, " if "energy" in known else ""
    click.echo(f"{energy}t_max = {known['t_max']:g} s, tolerance {known['tolerance']:.3g}")
    _unfinished(data)
    shaded(data)
    _say(summary(data))
    return lambda language: plot.stored_map(data, language=language, **look_of(given))


def _dataset(found: Held) -> xr.Dataset:
    """The dataset of a file of a map or an ensemble."""
    from pendula._checks import extra
    from pendula.many.chunks import opened

    if found.ending == ".zarr" and found.kind != "ensemble":
        return opened(found.path)
    xarray = extra("xarray", "io")
    if found.ending == ".zarr":
        data: xr.Dataset = xarray.open_zarr(found.path, chunks=None, consolidated=False)
    else:
        data = xarray.open_dataset(found.path, engine="h5netcdf")
    return data


def _unfinished(data: xr.Dataset) -> None:
    if "unfinished" in data.attrs:
        click.echo(f"unfinished: {data.attrs['unfinished']}")


# ---- sweeps and their recipes ----


def _sweep(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula.cli.sweep import ends_of
    from pendula.many.sweep import sweep_from

    outcomes, known = _outcomes(found), found.known["sweep"]
    _describe(known)
    missing = outcomes.count("")
    if missing:
        click.echo(f"unfinished: {missing} of {len(outcomes)} rows are missing")
    _say(f"outcomes: {ends_of(outcomes)}")
    try:
        recipe = sweep_from(known)
    except ValueError as error:
        if given["row"] is not None or given["picture"] is not None:
            raise
        click.echo(error)
        return None
    return _row(recipe, given["row"] or 0, given)


def _outcomes(found: Held) -> list[str]:
    """The outcome of each row, as text in earlier versions' stores too; "": not computed."""
    from pendula._checks import extra

    if found.ending == ".parquet":
        table = extra("pyarrow.parquet", "io").read_table(found.path, columns=["outcome"])
        return list(table["outcome"].to_pylist())
    data = _dataset(found)["outcome"]
    values = data.values.tolist()
    if "flag_meanings" in data.attrs:
        names = dict(enumerate(data.attrs["flag_meanings"].split()))
        return [names.get(each, "") for each in values]
    return list(values)


def _describe(known: dict[str, Any]) -> None:
    """A sweep in words, from its recipe as data: its columns, its rows, its times."""
    from pendula.cli.tables import table
    from pendula.many.sampling import sampler_from

    sampler, form = sampler_from(known["sampler"]), f" {known['form']}" if known["form"] else ""
    click.echo(f"sweep of the {known['system']} pendulum{form} by {known['method']}")
    rows = []
    for name, kind, *values in known["sampler"]["columns"]:
        flat = [x for each in values for x in (each if isinstance(each, list) else [each])]
        told = ", ".join(f"{x:.6g}" if isinstance(x, float) else str(x) for x in flat)
        rows.append([name, kind, told])
    click.echo(table(["column", "is", "values in SI units"], rows))
    points = " x ".join(map(str, sampler.shape))
    grid = f" (grid {points}, draws {sampler.draws})" if sampler.shape else ""
    every = "" if known["every"] is None else f" every {known['every']:g} s"
    _say(
        f"{sampler.count} rows{grid}, until {known['t_max']:g} s{every}, "
        f"{known.get('dtype', 'float64')}, chunks of {known['chunk']}"
    )


def _row(recipe: SweepRecipe, row: int, given: dict[str, Any]) -> Drawing:
    """One row as a run, which has the bits of the sweep's."""
    from pendula.run.solve import solve
    from pendula.systems import system_from

    if not 0 <= row < recipe.sampler.count:
        rule = f"--row must be from 0 to {recipe.sampler.count - 1}"
        raise ValueError(f"{rule}, got {row}")
    parameters, states = recipe.rows(row, row + 1)
    values = dict(zip(recipe.parameters, parameters[0].tolist(), strict=True))
    system = system_from({"name": recipe.system, "form": recipe.form, "parameters": values})
    times = recipe.times if recipe.every is not None else recipe.t_max
    run = solve(system, states[0], times, recipe.method, **recipe.options)
    click.echo()
    _say(f"row {row}: {system!r}")
    return _run(run, given)


def _recipe(found: Held, given: dict[str, Any]) -> Drawing:
    from pathlib import Path

    from pendula._recipe_file import RecipeFile
    from pendula.many.sweep import read_sweep

    tables = RecipeFile.read(Path(found.path)).tables
    if not tables.keys() & {"system", "state"}:
        from pendula.study.recipe import read_recipe

        recipe = read_recipe(Path(found.path))
        click.echo(f"recipe of a study; run it with: pendula study {found.path}\n")
        click.echo(recipe.text.rstrip())
        return None
    asked = read_sweep(found.path)
    _describe(asked.resolved)
    return None if given["row"] is None else _row(asked, given["row"], given)


# ---- ensembles, tables ----


def _ensemble(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula.cli.sweep import ends_of
    from pendula.systems import system_from

    run = found.known["ensemble"]
    systems = "different systems" if run["system"] is None else repr(system_from(run["system"]))
    _say(f"ensemble of {found.known['trajectories']} trajectories of {systems}")
    click.echo(f"method {run['method']}, from t = {run['t0']:g} s")
    if found.ending in (".nc", ".zarr"):
        with _dataset(found) as data:
            _say(f"{data.sizes['t']} times; {ends_of(data['outcome'].values.tolist())}")
            for number, _ in enumerate(run["events"], start=1):
                click.echo(f"event {number}: {data.sizes[f'event{number}']} crossings")
    return None


def _table(found: Held, given: dict[str, Any]) -> Drawing:
    from pendula.cli.shown import rows_of

    names = {"comparison": "comparison of methods", "events": "events of a run"}
    _say(names.get(found.kind, "measure of chaos"))
    for name, each in found.known.items():
        if name != "rows":
            _say(f"{name}: {each if isinstance(each, str) else json.dumps(each)}")
    click.echo(f"\n{table(*rows_of(found))}")
    return None


_SHOWN: dict[str, Callable[[Held, dict[str, Any]], Drawing]] = {
    "trajectory": _trajectory,
    "link": _link,
    "map": _map,
    "sweep": _sweep,
    "recipe": _recipe,
    "ensemble": _ensemble,
    "comparison": _table,
    "events": _table,
    "chaos": _table,
    "recording or fit": show_measured,
}

command = click.Command(
    "show",
    params=[
        click.Argument(["file"], type=click.Path(), metavar="FILE|LINK"),
        *picture_options("a trajectory, a map or a row of a sweep"),
        *look_options(),
        click.Option(
            ["--row"], type=int, metavar="N", help="row of a sweep to show, from 0 [default: 0]"
        ),
        click.Option(["--all"], is_flag=True, help="print every row of a run"),
        click.Option(["--force"], is_flag=True, help="replace the picture if it exists"),
    ],
    callback=_show,
    help="Show what a FILE holds that pendula wrote, or a recipe, or the run of a LINK of the "
    "laboratory, with a plot in the terminal.",
)
