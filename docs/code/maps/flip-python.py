from math import pi
from pendula import DoublePendulum, flip_map, plot

rods, turn = DoublePendulum.rods(), (-pi, pi)
flips = flip_map(rods, turn, turn, (60, 60), t_max=10.0)
print(dict(flips.sizes), *flips.data_vars)
cell = flips.sel(theta1=2.0, theta2=2.5, method="nearest")
print(f"rod {cell.flipped_rod.item()} after {cell.flip_time.item():.4f} s")
figure = plot.flip_map(flips)
