swings = pendula.sweep("swings.toml", "memory://swings.zarr")
print(pendula.chunks.opened("memory://swings.zarr").sizes["row"])
