import pendula
from distributed import Client, LocalCluster

with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
    with Client(cluster) as client:
        swings = pendula.sweep("swings.toml", "swings.zarr", client=client)
print(swings.theta.shape, swings.equals(pendula.sweep("swings.toml")))
