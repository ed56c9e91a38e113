plain = solve(rods, start, [10.0, 20.0, 30.0])
sure = solve(rods, start, [10.0, 20.0, 30.0], digits=10)
print(plain.theta)
print(sure.theta, sure.precision > 16)
