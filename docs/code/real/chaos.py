turn = 2 * np.pi / (2 / 3)
for a in (1.0644, 1.0684):
    pendulum = DrivenPendulum.scaled(q=2.0, a=a, drive_frequency=2 / 3)
    print(a, solve(pendulum, (0.0, 0.0), turn * np.arange(2001)).omega[-4:])
chaotic = DrivenPendulum.scaled(q=2.0, a=1.15, drive_frequency=2 / 3)
print(round(solve(chaotic, (0.0, 0.0), 1000.0, certify=degrees(1)).trust_horizon), "s")
