from pendula import DrivenPendulum

t = np.linspace(0.0, 10.0, 101)
for friction in ("viscous", "coulomb"):
    pendulum = DrivenPendulum.bob(**{friction: 0.5})
    truth = solve(pendulum, (degrees(60), 0.0), t).theta
    for method in ("euler", "heun", "rk4"):
        runs = (solve(pendulum, (degrees(60), 0.0), t, method, step=h) for h in (1e-2, 1e-3, 1e-4))
        errors = (f"{np.degrees(abs(run.theta - truth).max()):.0e}°" for run in runs)
        print(f"{friction}, {method}:", *errors)
