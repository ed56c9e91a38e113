import pendula

rods = pendula.chunks.opened("rods.zarr")  # or xarray.open_zarr; read on demand | o xarray.open_zarr; se lee según hace falta
print(dict(rods.sizes), rods.theta1.units)
row = rods.isel(row=7)
system = pendula.DoublePendulum.rods(l1=float(row.l1), l2=float(row.l2))
start = [float(row[f"{name}_start"]) for name in system.components]
run = pendula.solve(system, start, row.t.values, tolerance=1e-10)
print((run.states[:, 0] == row.theta1.values).all())
