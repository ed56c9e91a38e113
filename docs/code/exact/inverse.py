print(time_at(simple, (1.0, 0.0), [0.0, -1.0, 1.5]))  # first passages [s] | primeros pasos [s]
print(time_at(simple, (0.0, 10.0), 20 * np.pi), time_at(border, (0.0, 8.0), np.pi))
print(action(simple, (1.0, 0.0)), action(simple, (0.0, 10.0)))  # [J s]
print(elliptic.sncndn(1e15, 0.5).sn, elliptic.sncndn(1.0, 2.0).dn, elliptic.F(0.3, 2.0))
