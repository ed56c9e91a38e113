import numpy as np
from pendula import SimplePendulum, action, elliptic, exact, time_at

simple = SimplePendulum(length=0.5)
print(exact(simple, (1.0, 2.0), [1.0, 1e9]).theta)  # swings | oscila
print(exact(simple, (0.0, 10.0), [1.0, 1e9]).theta)  # rotates; turns are counted | rota; se cuentan las vueltas
border = SimplePendulum(length=1.0, gravity=16.0)  # ωn = 4 rad/s exactly | ωn = 4 rad/s exactamente
print(exact(border, (0.0, 8.0), [1.0, 100.0]).states)  # on the separatrix: never reaches the top | en la separatriz: nunca llega arriba
