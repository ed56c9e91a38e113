"""Formulas that are written as text, v₂² = l₁²θ̇₁², for the typesetter: as mathematics.

The errata have each formula once, readable as it stands; the report sets it from there.
"""

from __future__ import annotations

import re
import unicodedata

# A thin space, after which a line may end: between factors. Equals signs have a whole one.
_THIN = "\u2009"
_SLASH, _BAR = "\u2044", "\u2215"  # a division that stays on the line, and a fraction
_NAMES = "arcsin|arcsen|sin|sen|cos|sec|sn|cn|dn"
_GROUP = r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
_OPERAND = rf"(?:[^\s()\[\]/=−+·,;]|{_GROUP}|\[[^\[\]]*\])+"
_DOTS = {"\u0307": "dot", "\u0308": "dot.double"}
_SYMBOLS = {
    "…": "dots", "·": "dot.op", "Σ": "∑", "∫": "integral",
    "/": "slash", _SLASH: "slash", _BAR: "/",
}  # fmt: skip
# The first that fits is taken: runs of superscripts and subscripts, dotted letters, what has a name
# of its own, differentials, the paper's ∂z for ∂/∂z, any letter.
_TOKEN = re.compile(
    rf"(?P<up>[⁰¹²³⁴-⁹⁺⁻⁽⁾ⁿ]+)|(?P<down>[₀-₉ₙ]+)|(?P<dotted>\w[\u0307\u0308])|(?P<part>[½¼⅓⅙])"
    rf"|(?P<name>{_NAMES})|(?P<differential>\bd(?=[^\W\d]|\b))|(?P<slope>∂z(?=\w))"
    rf"|(?P<symbol>[{''.join(_SYMBOLS)}])|(?P<letter>[^\W\d_])"
)
_FACTOR = re.compile(rf"(?<![=−+·/;,Σ]) (?=[(\[ΓΣ]|(?:{_NAMES})\b|d[^\W\d])|(?<=[;,]) | (?==)")


def in_typst(text: str) -> str:
    """A text with formulas between dollar signs, as the typesetter reads it."""
    return re.sub(r"\$([^$]+)\$", lambda found: _set(found[1]), text)


def _set(formula: str) -> str:
    """A formula in pieces, between which a line may end: browsers break no line inside of one."""
    written, start = "", 0
    for found in _FACTOR.finditer(formula):
        piece = formula[start : found.start()]
        if all(piece.count(left) == piece.count(right) for left, right in ("()", "[]")):
            space = " " if formula[found.end()] == "=" or piece[-1] in ";," else _THIN
            written += f"${_mathematics(piece)}${space}"
            start = found.end()
    return f"{written}${_mathematics(formula[start:])}$"


def _mathematics(formula: str) -> str:
    """In the typesetter's own notation."""
    # Exponents and what is alone in parentheses, θ/2, stay on the line.
    formula = re.sub(rf"\^{_GROUP}", lambda found: found[0].replace("/", _SLASH), formula)
    formula = re.sub(r"\(([^()/\s]+)/([^()/\s]+)\)", rf"(\1{_SLASH}\2)", formula)
    formula = re.sub(rf"({_OPERAND})/({_OPERAND})", _fraction, formula)
    spaced = _TOKEN.sub(_translated, formula)
    # A space at both ends would set the formula on a line of its own.
    return re.sub(r" +", " ", spaced).strip()


def _fraction(found: re.Match[str]) -> str:
    above, below = (
        part if re.fullmatch(_GROUP, part) else f"({part})" for part in (found[1], found[2])
    )
    return f"{above}{_BAR}{below}"


def _translated(found: re.Match[str]) -> str:
    token = found[0]
    plain = unicodedata.normalize("NFKC", token).replace(_SLASH, "/")
    return {
        "up": f"^({plain})",
        "down": f"_({plain})",
        "dotted": f" {_DOTS.get(token[-1])}({token[0]})",
        "part": f" {plain} ",
        "name": f' op("{token}")',
        "differential": " dif ",
        "slope": " ∂_z ",
        "symbol": f" {_SYMBOLS.get(token)} ",
        "letter": f" {token}",
    }[str(found.lastgroup)]
