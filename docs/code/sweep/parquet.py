import numpy as np
import pandas

pendula.sweep("rods.toml", "rods.parquet")
table = pandas.read_parquet("rods.parquet", columns=["outcome", "l1 [m]", "theta1 [rad]"])
print(np.stack(table["theta1 [rad]"]).shape)
