"""Of what order is a method? Half the step, and see by how much the error falls."""

import numpy as np

from pendula import SimplePendulum, degrees, exact, methods, solve

pendulum, start, end = SimplePendulum(length=0.5), (degrees(150), 0.0), 1.0
truth = exact(pendulum, start, end).theta[-1]
steps = [2.0**-n for n in range(3, 12)]
for method in (each for each in methods() if not each.adaptive):
    runs = [solve(pendulum, start, end, method.name, step=step) for step in steps]
    errors = np.array([abs(run.theta[-1] - truth) for run in runs])
    errors = errors[errors > 1e-12][-4:]  # the finest steps above rounding
    orders = np.log2(errors[:-1] / errors[1:])
    print(f"{method.name:16} order {method.order}, measured", *(f"{each:.3f}" for each in orders))
