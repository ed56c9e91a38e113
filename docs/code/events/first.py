from pendula import DoublePendulum, solve
from pendula.events import angle, flip, tip_height, velocity_zero

rods, state = DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0)
asked = [flip(2), velocity_zero(1, direction=1), tip_height(0.0)]
run = solve(rods, state, 6.0, events=asked)
for each in run.events:
    print(each.times, each.states.shape)
first = solve(rods, state, 60.0, events=[flip(2, terminal=True)])
print(first.outcome, first.t[-1], first.theta[-1])
