state = (2.0, 2.5, 0.0, 0.0)
print(rods.rhs(state))  # time derivative, (…, d) | derivada temporal, (…, d)
print(rods.positions(state).shape)  # ends of the rods, (…, d/2, 2) [m] | extremos de las varillas, (…, d/2, 2) [m]
print(rods.kinetic_energy(state), rods.potential_energy(state), rods.energy(state))  # [J]
