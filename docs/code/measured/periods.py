import numpy as np
from pendula.measured import Apparatus, g_from_periods, with_uncertainty

lengths = np.array([0.4, 0.6, 0.8, 1.0])  # m
periods = np.array([1.272, 1.556, 1.799, 2.011])  # s, ten swings over ten | diez entre diez
known = Apparatus(amplitude=np.radians(10), bob_radius=0.02, bob_mass=0.26)
found = g_from_periods(lengths, periods, apparatus=known, length_error=0.001)
print(with_uncertainty(*found["gravity"]))
for correction in found.corrections:
    print(f"{correction.name:12} {100 * correction.change:+.3f} %")
