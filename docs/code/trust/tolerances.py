from pendula import DoublePendulum, degrees, solve

rods, start = DoublePendulum.rods(), (degrees(120), degrees(-10), 0.0, 0.0)
for tolerance in (1e-3, 1e-6, 1e-9, 1e-12, None):
    run = solve(rods, start, 60.0, tolerance=tolerance, certify=degrees(1))
    horizon, energy = run.trust_horizon, abs(run.energy_error).max()
    print(f"{run.request.tolerance:.0e}: accurate for {horizon:.0f} s, energy error {energy:.0e}")
