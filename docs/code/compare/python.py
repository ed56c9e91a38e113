from pendula import SimplePendulum, plot
from pendula.analysis import work_precision

simple, start = SimplePendulum(0.5), (2.6, 0.0)
found = work_precision(simple, start, 5.0, ["heun", "verlet", "gauss8"], timed=False)
for work in found.methods:
    evaluations, seconds = work.to_reach(1e-6)
    print(f"{work.method:7} {work.error_at(2000):.0e} rad; 1e-6 rad: {evaluations:.2g}")
figure = plot.work_precision([found], against=["evaluations"])
