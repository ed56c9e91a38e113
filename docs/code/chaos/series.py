crossings = chaos.section(rods, [wild, calm], crossings=600)
for points in crossings.points:
    test = chaos.zero_one(points[:, 0])
    print(f"K = {abs(test.value):.2f}, {test.verdict}")
times = np.arange(0.0, 100.0, 0.05)
lines = chaos.frequencies(times, solve(rods, calm, times).states[:, 0], 2)
print(np.sort(lines.frequencies).round(6))  # of the two normal modes, bent by their size
