from pendula import SimplePendulum

pendulum = SimplePendulum(length=0.5)
swing = solve(pendulum, (1.0, 0.0), 2.0, events=[angle(1, -0.999999), angle(1, -1.000001)])
print(*(each.times for each in swing.events))
turn = solve(pendulum, (0.0, 10.0), 3.0, events=[angle(1, 0.0), angle(1, 0.0, every_turn=True)])
print(*(each.times for each in turn.events))
