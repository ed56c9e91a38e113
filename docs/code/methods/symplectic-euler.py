import numpy as np
from pendula import SimplePendulum, degrees, exact, solve

pendulum, start = SimplePendulum(length=0.5), (degrees(150), 0.0)
t = np.linspace(0.0, 10.0, 101)
truth = exact(pendulum, start, t).theta
for step in (0.02, 0.01, 0.005):
    run = solve(pendulum, start, t, "symplectic-euler", step=step)
    late = solve(pendulum, start, t + 990.0, "symplectic-euler", step=step)
    error = np.degrees(abs(run.theta - truth).max())
    first, last = (abs(each.energy_error).max() for each in (run, late))
    print(f"{run.n_evaluations} evaluations: {error:.0e}°, energy {first:.0e}, {last:.0e}")
