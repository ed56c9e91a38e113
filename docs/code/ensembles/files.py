data = many.to_xarray()  # also many.to_pandas() | también many.to_pandas()
print(dict(data.sizes), data.theta1.units)
many.save("many.nc")  # or .zarr, .parquet, .csv | o .zarr, .parquet, .csv
print(flips.to_pandas().head(2).round(3).to_string(index=False))
