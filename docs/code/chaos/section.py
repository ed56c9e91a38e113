found = chaos.section(rods, energy=10.0, starts=40, crossings=300, indicator="megno", t_max=200.0)
picture = found.plot()
print(found, (found.values > 5.5).sum(), "of them chaotic")
