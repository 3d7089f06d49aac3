"""The scheme, compiled by numba: states in arrays, one step in each geometry, and the time loops.

`arrays` draws how cells, faces and edges are numbered; `edge` holds the fluxes through one edge; docs/equations.md says
which function holds which formula.
"""
