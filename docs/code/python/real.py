from pendula import DampedDoublePendulum, DrivenPendulum

bob = DrivenPendulum.bob(length=0.5, viscous=0.02, coulomb=0.1)  # N m s, N m
worn = DampedDoublePendulum.rods(viscous=(0.01, 0.01), coulomb=(0.05, 0.0))  # pivot, joint | pivote, articulación
small = LinearPendulum(viscous=0.1, torque=0.5, drive_frequency=3.0)
end = pendula.solve(bob, (1.0, 0.0), 60.0)
print(end.theta[-1], end.heat[-1], end.pieces.times[-1], abs(end.energy_error).max() < 1e-15)
