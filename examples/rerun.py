"""A file holds its own recipe: load it, run it again, and get the same bits."""

import tempfile
from pathlib import Path

import pendula

rods = pendula.DoublePendulum.rods(m1=0.2, m2=0.1, l1=0.3, l2=0.3)
run = pendula.solve(rods, (2.0, 2.5, 0.0, 0.0), 20.0, "rk4", step=1e-3)
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "rods.csv"
    run.save(file)
    loaded, again = pendula.load(file), pendula.rerun(file)
print(loaded)
print("the same bits:", again.states.tobytes() == run.states.tobytes())
