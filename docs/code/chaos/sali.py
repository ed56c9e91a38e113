t = np.linspace(1.0, 100.0, 100)
for start in (wild, calm):
    found = chaos.sali(rods, start, t)
    print(f"smallest above 1e-3: {found.value.min() > 1e-3}, aligned after {found.aligned:g} s")
