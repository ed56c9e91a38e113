slow = DrivenPendulum.bob(coulomb=0.5, torque=1.2, drive_frequency=0.8)
pieces = solve(slow, (0.0, 0.0), 10.0).pieces
print(*(f"{t:.3f} s: {state[0]:+.0f}" for t, state in zip(pieces.times, pieces.states)))
