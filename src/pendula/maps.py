"""Maps: one number for each start from rest on a rectangle of the two angles."""

from pendula.many.maps import divergence_map, flip_map, open_map

__all__ = ["divergence_map", "flip_map", "open_map"]
