starts = np.zeros((3, 4))
starts[:, :2] = [[0.1, 0.1], [1.0, 1.0], [2.0, 2.5]]
many = ensemble(rods, starts, [10.0], derivatives="state")
for matrix in many.derivatives[:, 0]:
    print(f"{np.linalg.norm(matrix, 2):.4g}")  # by how much a small displacement has grown
