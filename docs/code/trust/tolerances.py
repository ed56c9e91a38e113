import numpy as np
from pendula import DoublePendulum, solve

rods, start = DoublePendulum.rods(), (np.radians(120), np.radians(-10), 0.0, 0.0)
for tolerance in (1e-3, 1e-6, 1e-9, 1e-12, None):
    run = solve(rods, start, 60.0, tolerance=tolerance, certify=np.radians(1))
    horizon, energy = run.trust_horizon, abs(run.energy_error).max()
    print(f"{run.request.tolerance:.0e}: accurate for {horizon:.0f} s, energy error {energy:.0e}")
