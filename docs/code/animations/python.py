import pendula
from pendula import DoublePendulum, solve

rods = DoublePendulum.rods()
run = solve(rods, (2.0, 2.5, 0.0, 0.0), 2.0)
run.animate("run.gif", size=(360, 300))
others = [solve(rods, (2.0 + off, 2.5, 0.0, 0.0), 2.0) for off in (0.01, 0.02)]
pendula.plot.animate([run, *others], "near.mp4", names=["2.00 rad", "2.01 rad", "2.02 rad"])
