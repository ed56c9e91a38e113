import numpy as np
from pendula import SimplePendulum, degrees, exact, solve

pendulum, start = SimplePendulum(length=0.5), (degrees(120), 0.0)
t = np.linspace(0.0, 10.0, 101)
truth = exact(pendulum, start, t).theta
for tolerance in (1e-3, 1e-6, 1e-9, None):
    run = solve(pendulum, start, t, "dop853", tolerance=tolerance)
    error, energy = np.degrees(abs(run.theta - truth).max()), abs(run.energy_error).max()
    cost = f"{run.n_steps} steps, {run.n_evaluations} evaluations"
    print(f"{cost}: {error:.0e}°, energy {energy:.0e}")
