"""Many motions: ensembles, maps and sweeps, and what cuts such work into chunks."""
