import numpy as np
from pendula import DoublePendulum, degrees, solve
from pendula.analysis import angle_difference, largest_energy_errors, parting_time

rods, start = DoublePendulum.rods(), (degrees(120), degrees(-10), 0.0, 0.0)
t = np.linspace(0.0, 25.0, 2501)
for step in (1e-2, 1e-3, 1e-4):
    run, finer = (solve(rods, start, t, "rk4", step=h) for h in (step, step / 2))
    moment = parting_time(t, angle_difference(run, finer), degrees(1))
    energy = largest_energy_errors(run).max()
    print(f"step {step:.0e} s: agrees to 1° for {moment:.0f} s, energy error {energy:.0e}")
