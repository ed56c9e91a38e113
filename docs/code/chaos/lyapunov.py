import numpy as np
from pendula import DoublePendulum, chaos, plot, solve

rods = DoublePendulum.rods()
wild, calm = (2.0, 2.5, 0.0, 0.0), (0.4, -0.3, 0.2, 0.1)
for start in (wild, calm):
    found = chaos.lyapunov(rods, start, 400.0)
    print(f"{found.exponents[0]:.2f} ± {found.standard_error[0]:.2f} 1/s, {found.verdict}")
all_of_them = chaos.lyapunov(rods, wild, 400.0, exponents=4)
print(all_of_them.exponents.round(2) + 0.0)
print(abs(all_of_them.sum) < 20 / 400, (all_of_them.pairing_error < 20 / 400).all())
