"""How much of the energy surfaces is chaotic, over the energy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula.plot.case import stored_case
from pendula.plot.labels import labels
from pendula.plot.map_scale import inputs_of
from pendula.plot.running import VERDICTS
from pendula.plot.style import FAINT, legend_above, panels, styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@styled
def chaotic_share(dataset: xr.Dataset, *, title: str | None = None, language: str = "en") -> Figure:
    """The chaotic share of energy surfaces with its error, and below the exponent in the chaos.

    Grey above the share is what the verdict leaves open.

    Args:
        dataset: what `pendula.chaos.chaotic_share` returned.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Raises:
        ValueError: for another dataset, or an unknown language.
    """
    words = labels(language)
    if not {"share", "undecided", "exponent"} <= set(getattr(dataset, "data_vars", ())):
        rule = "must be what pendula.chaos.chaotic_share returned, got {value}"
        raise ArgumentError("dataset", rule, value=type(dataset).__name__)
    found = dataset.sortby("energy")
    energy, share, error = (found[each].values for each in ("energy", "share", "standard_error"))
    figure, axes = panels(2, 1, 4.6, words, sharex=True, gridspec_kw={"height_ratios": (1.6, 1)})
    above, below = axes[:, 0]
    how: dict[str, Any] = {"markersize": 3.5, "linewidth": 1.0, "color": VERDICTS["chaotic"]}
    open_to = share + found["undecided"].values
    undecided = words.curve["undecided"]
    above.fill_between(energy, share, open_to, color=FAINT, linewidth=0, label=undecided)
    chaotic = words.curve["chaotic"]
    above.errorbar(energy, share, error, marker="o", capsize=2.0, label=chaotic, **how)
    above.set_ylim(-0.03, 1.03)
    above.set_ylabel(words.axis["share"])
    below.plot(energy, found["exponent"].values, marker="o", **how)
    below.set_ylim(bottom=0.0)
    below.set_ylabel(words.axis["exponent"])
    below.set_xlabel(words.axis["energy"])
    legend_above(figure, above, columns=2)
    t_max = inputs_of(dataset.attrs).get("chaotic_share", {}).get("t_max")
    values = {} if t_max is None else {"t": (float(t_max), "s")}
    shown = stored_case(dataset.attrs, words, values) if title is None else title
    above.set_title(shown or "")
    return figure
