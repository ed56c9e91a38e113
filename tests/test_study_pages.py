"""The pages of the PDF: none is half empty, and no caption stands apart from its table."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import pytest
import typst

from pendula.study import run_study

A4, MARGIN = 29.7, 2.5  # cm
EMPTY = 0.15  # of a page's text
# Added to the report: of each table the pages on which its figure's caption and the table begin.
PLACES = """
#include "report.typ"
#context [#metadata(query(figure.where(kind: table)).map(it => (figure.caption, table).map(
  kind => query(selector(kind).after(it.location())).first().location().page()))) <places>]
"""

Typeset = tuple[list[np.ndarray[Any, Any]], list[list[int]]]


@pytest.fixture(scope="module", params=["en", "es"])
def typeset(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Typeset:
    """Pictures of the pages of the study's own recipe, and the pages of captions and tables."""
    pages: list[np.ndarray[Any, Any]] = []
    places: list[list[int]] = []
    compile_it = typst.compile_with_warnings

    def look(source: str, **given: Any) -> Any:
        if given["format"] == "pdf":
            how = {key: given[key] for key in ("root", "font_paths", "ignore_system_fonts")}
            how["sys_inputs"] = given["sys_inputs"]
            drawn: Any = typst.compile(source, format="png", ppi=36, **how)
            pages.extend(matplotlib.image.imread(io.BytesIO(each)) for each in drawn)
            asking = Path(source).with_name("places.typ")
            asking.write_text(PLACES)
            found = typst.query(str(asking), "<places>", field="value", one=True, **how)
            places.extend(json.loads(found))
        return compile_it(source, **given)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(typst, "compile_with_warnings", look)
        run_study(None, tmp_path_factory.mktemp("pages") / "out", request.param)
    return pages, places


def test_no_page_but_the_last_is_half_empty(typeset: Typeset) -> None:
    pages, _ = typeset
    assert len(pages) > 10
    for number, page in enumerate(pages[:-1], start=1):
        margin = round(MARGIN / A4 * len(page))
        inked = np.min(page[margin:-margin, :, :3], axis=(1, 2)) < 0.95
        rows = np.flatnonzero(np.concatenate(([True], inked, [True])))
        assert np.diff(rows).max() - 1 < EMPTY * len(inked), number


def test_captions_stand_with_their_tables(typeset: Typeset) -> None:
    _, places = typeset
    assert len(places) == 10
    for caption, table in places:
        assert caption == table
