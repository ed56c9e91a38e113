found = chaos.section(rods, energy=10.0, starts=40, crossings=300)
megno = chaos.megno(rods, found.starts, [200.0])
picture = plot.section(found, megno.mean[:, -1])
print(found, (megno.verdict == "chaotic").sum(), "of them chaotic")
