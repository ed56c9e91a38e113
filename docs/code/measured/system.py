from pendula import DrivenPendulum

encoder = read("encoder.csv")
axle = DrivenPendulum.body(mass=0.1, centre=0.15, inertia=0.003, gravity=9.79, coulomb=0.001)
found = fit(encoder, axle, free=("inertia", "coulomb", "angle_offset"))
print(found.to_pandas()[["value", "unit"]].round(6))
both = fit(encoder, axle, free=("inertia", "mass", "coulomb", "angle_offset"))
print(both.not_told_apart)
print(both["inertia"].standard_error, round(both["omega0_squared"].value, 2))
