import numpy as np

from pendula import SimplePendulum, degrees, exact, solve

pendulum = SimplePendulum(length=0.5)
start = (degrees(150), 0.0)  # angle [rad], angular velocity [rad/s] | ángulo [rad], velocidad angular [rad/s]
t = np.linspace(0.0, 10.0, 101)

truth = exact(pendulum, start, t)
for method in ("euler", "heun", "rk4"):
    run = solve(pendulum, start, t, method, step=0.01)
    error = np.degrees(abs(run.theta - truth.theta).max())
    print(f"{method:5} is off by up to {error:10.5f}°")
