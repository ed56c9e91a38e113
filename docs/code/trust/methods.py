for method, step in (("euler", 1e-3), ("rk4", 1e-3), ("gauss8", 5e-3), ("dop853", None)):
    run = solve(rods, start, 60.0, method, step=step, certify=degrees(1))
    print(f"{method}: accurate for {run.trust_horizon:.1f} s")
calm = solve(rods, (0.5, 0.5, 0.0, 0.0), 1000.0, certify=degrees(1))
print(calm.trust_horizon, solve(rods, start, 1.0).trust_horizon)
