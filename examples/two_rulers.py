"""A pendulum of one's own: two rulers, hung from holes 1 cm below their upper ends."""

import numpy as np

from pendula import DoublePendulum, degrees, solve

mass, length, hole = 0.030, 0.31, 0.01  # kg, m, m
inertia = mass * length**2 / 12  # of a thin ruler about its middle
below = length / 2 - hole  # from a hole to the middle
rulers = DoublePendulum.bodies(
    m1=mass, m2=mass, l1=length - 2 * hole, c1=below, c2=below, I1=inertia, I2=inertia,
    l2=length - hole,
)  # fmt: skip

modes = rulers.normal_modes()
for frequency, (first, second) in zip(modes.frequencies, modes.shapes, strict=True):
    print(f"swings at {frequency / (2 * np.pi):.3f} Hz with θ2/θ1 = {second / first:+.3f}")

run = solve(rulers, degrees([90, 90, 0, 0]), 5.0, "rk4", step=1e-4)
turns = np.abs(run.theta).max(axis=0) / (2 * np.pi)
print(f"released from 90°: the lower ruler gets to {turns[1]:.2f} turns in 5 s")
print(f"energy kept to {np.abs(run.energy_error).max():.1e}")
