"""The paper's study: one call computes it, draws it and sets the report."""

from pendula.study.study import run_study

__all__ = ["run_study"]
