(flips,) = many.events
print(flips.trajectories[:3], flips.times[:3])
certified = ensemble(rods, states[::100], 10.0, "rk4", step=1e-3, certify=1e-6)
print(certified.trust_horizon.round(1))
lengths = [DoublePendulum.rods(l2=length) for length in (0.5, 1.0, 1.5)]
print(ensemble(lengths, (2.0, 2.5, 0.0, 0.0), 3.0).states[:, -1, 0])
