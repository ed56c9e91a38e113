import numpy as np
from pendula import divergence_map

apart = divergence_map(rods, (2.0, 2.4), (2.0, 2.4), (5, 5), t_max=5.0)
print((np.log(apart.growth) / apart.t_max).mean().round(2).item())
figure = plot.divergence_map(apart)
