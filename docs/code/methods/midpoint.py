import numpy as np
from pendula import DoublePendulum, solve

rods, start = DoublePendulum.rods(), (0.5, 0.5, 0.0, 0.0)
t = np.linspace(0.0, 10.0, 101)
truth = solve(rods, start, t).theta
for step in (0.02, 0.01, 0.005):
    run = solve(rods, start, t, "midpoint", step=step)
    late = solve(rods, start, t + 990.0, "midpoint", step=step)
    error = np.degrees(abs(run.theta - truth).max())
    first, last = (abs(each.energy_error).max() for each in (run, late))
    print(f"{run.n_evaluations} evaluations: {error:.0e}°, energy {first:.0e}, {last:.0e}")
