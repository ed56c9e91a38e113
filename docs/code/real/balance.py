lost = run.energy[0] - run.energy[-1]
print(f"{lost:.6f} J lost, {run.heat[-1]:.6f} J of heat")
for name, heat in run.energy_balance.heat_by.items():
    print(f"{name}: {heat[-1]:.6f} J")
print(f"defect: {abs(run.energy_error).max():.0e}")
