import numpy as np
from pendula import DoublePendulum, ensemble, solve
from pendula.events import flip

rods = DoublePendulum.rods()
states = np.zeros((1000, 4))
states[:, 0], states[:, 1] = np.linspace(1.0, 3.0, 1000), 0.5
many = ensemble(rods, states, [1.0, 5.0, 10.0], events=flip(2, terminal=True))
print(many.states.shape, *np.unique(many.outcomes, return_counts=True))
alone = solve(rods, states[7], [1.0, 5.0, 10.0])
print((many.states[7] == alone.states).all())
