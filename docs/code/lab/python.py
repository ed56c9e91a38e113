from pendula import DoublePendulum, solve
from pendula.lab import Recipe, read_link

run = solve(DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0), 10.0, "rk4", step=1e-3)
link = Recipe.of(run).link()
print(link)
print(read_link(link).run().states.tobytes() == run.states.tobytes())
