"""Maps: one number for each start from rest on a rectangle of the two angles."""

from pendula.many.maps.divergence import DivergenceMap, divergence_map
from pendula.many.maps.flip import FlipMap, flip_map
from pendula.many.maps.stored import open_map

__all__ = ["DivergenceMap", "FlipMap", "divergence_map", "flip_map", "open_map"]
