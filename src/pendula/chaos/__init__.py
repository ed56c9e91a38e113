"""Order and chaos: periodic orbits, sections, bifurcations, frequencies and tests of series."""
