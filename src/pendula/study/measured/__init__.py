"""A recording in a report: experiment, formula and method side by side."""
