orbit = chaos.normal_mode(rods, 2, energy=2.0)
print(f"{orbit.period:.6f} s, {orbit.kind}")
family = chaos.family(orbit, 30, energy=(1.0, 12.0))
for change in family.changes:
    print(f"{change.value:.6f} J: {change.below} below, {change.above} above")
