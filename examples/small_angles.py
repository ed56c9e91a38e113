"""Where do small angles stop being small? The true period beside that of the linear model."""

import numpy as np

from pendula import LinearPendulum, SimplePendulum, degrees
from pendula.analysis import period_limit

linear, simple = LinearPendulum(length=0.5), SimplePendulum(length=0.5)
print(f"linear model: {linear.period():.5f} s at every amplitude")
for amplitude in (5, 30, 90, 150, 179):
    period = simple.period(degrees(amplitude))
    print(f"{amplitude:4}°  {period:.5f} s, {period / linear.period() - 1:9.3%} longer")
for error in (0.001, 0.01, 0.1):
    print(f"wrong by {error:6.1%} from {np.degrees(period_limit(error)):.1f}° on")
