import numpy as np

print(np.radians(120), degrees(120))
print(solve(rods, (np.radians(120), np.radians(-10), 0, 0), [30.0], digits=10).theta)
