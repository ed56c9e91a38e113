import numpy as np
from pendula import DrivenPendulum, degrees, solve
from pendula.events import velocity_zero

phone = DrivenPendulum.body(mass=0.175, centre=0.25, inertia=0.0118, viscous=2e-4, coulomb=2e-3)
run = solve(phone, (degrees(15), 0.0), 60.0, events=[velocity_zero(1)])
turns = np.degrees(run.events[0].states[:, 0])
print(len(turns), turns[:3], turns[-2:])  # where it turns round and stops [°] | donde invierte su sentido y donde se para [°]
print(run.pieces.times[-1], run.pieces.states[-1], np.degrees(run.theta[-1]))  # at rest | en reposo
