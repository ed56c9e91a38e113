brake = DrivenPendulum.bob(length=0.5, coulomb=0.02)
names = "coulomb", "length"
run = solve(brake, (degrees(40), 0.0), 10.0, events=[angle(1, 0.0)], derivatives=names)
print(run.events[0].times[:2])  # where it passes the bottom [s]
print(run.event_derivatives[0].times[:2])  # by the torque [s/(N m)], by the length [s/m]
