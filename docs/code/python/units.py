import pint

quantity = pint.UnitRegistry().Quantity
start = quantity(120, "deg"), quantity(-10, "deg"), 0.0, quantity(90, "deg/s")
short = DoublePendulum.rods(l1=quantity(50, "cm"))
print(pendula.degrees(120), pendula.solve(short, start, quantity([1, 2], "min")).t)
