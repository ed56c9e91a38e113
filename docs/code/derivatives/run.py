import numpy as np
from pendula import DoublePendulum, DrivenPendulum, degrees, ensemble, solve
from pendula.events import angle

rods = DoublePendulum.rods()
run = solve(rods, (2.0, 2.5, 0.0, 0.0), [1.0, 2.0, 5.0], derivatives=("theta1", "m2", "gravity"))
print(run.derivatives.shape, run.derivative_names)
print(run.derivatives[1])  # of (θ1, θ2, ω1, ω2) at 2 s, a column for each name
