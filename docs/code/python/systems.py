import numpy as np
import pendula
from pendula import DoublePendulum, LinearPendulum, SimplePendulum

simple = SimplePendulum(length=0.5)  # gravity=9.80665, mass=1.0
rods = DoublePendulum.rods(m1=1.0, m2=1.0, l1=1.0, l2=1.0)  # uniform, the paper's | uniformes, las del artículo
bobs = DoublePendulum.bobs(m1=1.0, m2=2.0, l1=1.0, l2=0.5)  # point masses | masas puntuales
rulers = DoublePendulum.bodies(  # any two rigid bodies | dos cuerpos rígidos cualesquiera
    m1=0.03, m2=0.03, l1=0.29, c1=0.145, c2=0.145, I1=2.4e-4, I2=2.4e-4
)
print(simple)
print(simple.natural_frequency, simple.period(pendula.degrees(150)))
print(rods.normal_modes().frequencies)
