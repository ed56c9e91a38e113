"""Formulas written as text, as the typesetter reads them."""

from __future__ import annotations

import pytest

from pendula.study.errata import errata
from pendula.study.formulas import in_typst


@pytest.mark.parametrize(
    ("text", "typst"),
    [
        ("$u$", "$u$"),
        ("mgL", "mgL"),
        ("rod 2, $½ m₂gl₂$: so", "rod 2, $1/2 m_(2) g l_(2)$: so"),
        ("$v₂²$", "$v_(2)^(2)$"),
        ("$f⁽ⁿ⁾(x)$", "$f^((n))( x)$"),
        ("$l₁θ̇₁θ̈₂$", "$l_(1) dot(θ)_(1) dot.double(θ)_(2)$"),
        ("$sen²(θ₀/2)$", '$op("sen")^(2)( θ_(0) slash 2)$'),
        ("$(1 − x)^(−(2n + 1)/2)$", "$(1 − x)^(−(2 n + 1) slash 2)$"),
        ("$d/dt$", "$( dif ) / ( dif t)$"),
        ("$(∂zφ)²$", "$( ∂_z φ)^(2)$"),
        ("$∂L/∂θ̇₁$", "$(∂ L) / (∂ dot(θ)_(1))$"),
        ("$(2n)!/(2ⁿ n!)$", "$((2 n)!) / (2^(n) n!)$"),
        ("$Γ(½)/Γ(n + 1)$", "$( Γ( 1/2 )) / ( Γ( n + 1))$"),
        ("$(48) = (47) / (m₂)$", "$(48)$ $= (47) slash ( m_(2))$"),
        ("$T = 4K(k)$", "$T$ $= 4 K( k)$"),
        ("$2k cos φ dφ; x$", '$2 k$\u2009$op("cos") φ$\u2009$dif φ;$ $x$'),
        ("$K(k) sn[F(x) sn y]$", '$K( k)$\u2009$op("sn")[ F( x) op("sn") y]$'),
    ],
)
def test_formulas_are_translated(text: str, typst: str) -> None:
    assert in_typst(text) == typst


def test_no_formula_stands_on_a_line_of_its_own() -> None:
    """As one with spaces at both ends would."""
    for row in errata():
        for text in (row.equation, row.printed, row.correct, row.why):
            pieces = text.typst("es").split("$")[1::2]
            assert all(piece == piece.strip() for piece in pieces)
