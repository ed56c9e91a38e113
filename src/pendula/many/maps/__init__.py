"""Maps: one number for each start from rest on a rectangle of the two angles."""

from pendula.many.maps.divergence import divergence_map
from pendula.many.maps.flip import flip_map

__all__ = ["divergence_map", "flip_map"]
