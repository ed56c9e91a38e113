"""Maps: one number for each start, from rest on a rectangle of the two angles or on a section."""

from pendula.many.maps.divergence import DivergenceMap, divergence_map
from pendula.many.maps.flip import FlipMap, flip_map
from pendula.many.maps.indicator import IndicatorMap, indicator_map
from pendula.many.maps.section import SectionMap, section_map
from pendula.many.maps.stored import open_map

__all__ = [
    "DivergenceMap",
    "FlipMap",
    "IndicatorMap",
    "SectionMap",
    "divergence_map",
    "flip_map",
    "indicator_map",
    "open_map",
    "section_map",
]
