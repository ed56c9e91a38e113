shares = chaos.chaotic_share(rods, [4.0, 10.0, 20.0], n=50, t_max=100.0)
for energy, share, error in zip(shares.energy, shares.share, shares.standard_error):
    print(f"{energy:g} J: {share:.1f} ± {error:.2f}")
map = chaos.section_map(rods, 10.0, (24, 16), t_max=30.0)
print(dict(map.sizes), *map.data_vars)
picture = plot.stored_map(map)
