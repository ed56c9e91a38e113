t = [20.0, 100.0, 400.0]
for start in (wild, calm):
    found = chaos.megno(rods, start, t)
    print(found.mean.round(1), found.rate.round(2), found.verdict)
