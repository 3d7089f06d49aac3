"""Formulas that judge the solver: one exact solution a file."""
