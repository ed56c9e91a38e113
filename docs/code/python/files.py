run.save("run.csv")
again = pendula.rerun("run.csv")  # from the recipe inside the file | a partir de la receta que está en el archivo
print(bool((again.states == run.states).all()), pendula.load("run.csv").request.tolerance)
print(*run.to_pandas().columns)
run.plot().savefig("run.svg")
