swing = pendula.exact(simple, (pendula.degrees(150), 0.0), [0.0, 1.0, -2.0])
print(swing.theta)
print(pendula.exact(LinearPendulum(), [(0.1, 0.0), (0.0, 0.5)], np.linspace(0, 1, 11)).states.shape)
print(pendula.time_at(simple, (0.0, 10.0), [1.0, 100.0]), pendula.action(simple, (0.0, 10.0)))
