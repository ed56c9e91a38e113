import numpy as np
from pendula import DrivenPendulum, SimplePendulum, degrees, solve

noise = np.random.default_rng(7).normal  # all of it is simulated | todo es simulado
t = np.arange(3000) / 100
phone = DrivenPendulum.body(mass=0.18, centre=0.6, inertia=0.066, gravity=9.79, viscous=0.002)
turning = solve(phone, (degrees(20), 0.0), t).omega
axes = np.outer(turning, (0.05, 0.10, 0.99)) + noise(0, 0.02, (t.size, 3))  # rad/s
head = "Time (s),Gyroscope x (rad/s),Gyroscope y (rad/s),Gyroscope z (rad/s)"
np.savetxt("phone.csv", np.column_stack([t, axes]), "%.5f", ",", header=head, comments="")

t = np.arange(600) / 30
ball = DrivenPendulum.bob(length=0.8, gravity=9.79, viscous=0.02)
x, y = ball.positions(solve(ball, (degrees(25), 0.0), t).states)[:, 0].T + noise(0, 0.001, (2, 600))
rows = [f"{row[0]:.3f};{row[1]:.4f};{row[2]:.4f}" for row in np.column_stack([t, x + 0.4, y + 1])]
with open("video.csv", "w") as file:
    file.write("\n".join(["t [s];x [m];y [m]", *rows]).replace(".", ",") + "\n")

t = np.arange(4000) / 200
bearing = DrivenPendulum.body(mass=0.1, centre=0.15, inertia=0.003, gravity=9.79, coulomb=0.0004)
angle = np.degrees(solve(bearing, (degrees(60), 0.0), t).theta) + noise(3, 0.05, t.size)
head = "time [s], angle [deg]"
np.savetxt("encoder.csv", np.column_stack([t, angle]), "%.4f", ",", header=head, comments="")

lengths = np.array([0.4, 0.6, 0.8, 1.0])
period = [SimplePendulum(length, 9.79).period(degrees(10)) for length in lengths]
times = 10 * np.outer(period, np.ones(3)) + noise(0, 0.1, (4, 3))
head = "length (cm),10 swings (s),10 swings (s),10 swings (s)"
table = np.column_stack([100 * lengths, times])
np.savetxt("stopwatch.csv", table, "%.2f", ",", header=head, comments="")
