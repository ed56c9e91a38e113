crossings = chaos.section(rods, [wild, calm], crossings=600)
tests = chaos.zero_one(crossings.points[..., 0])  # a row for each motion | una fila por movimiento
for value, verdict in zip(tests.value, tests.verdict):
    print(f"K = {abs(value):.2f}, {verdict}")
times = np.arange(0.0, 100.0, 0.05)
angles = solve(rods, calm, times).states[:, :2].T
lines = chaos.frequencies(times, angles, 2)
# of the two normal modes, bent by their size | de los dos modos normales, que su tamaño desvía
print(np.sort(lines.frequencies).round(6))
