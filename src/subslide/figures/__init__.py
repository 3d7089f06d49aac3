"""Figures: each is one module of this folder, found by listing it (see `subslide.catalogue`).

A module has TITLE (text), CATEGORY (text: the heading in the report), NEEDS (for each key of a run, the
values that a study must have for the figure to make sense) and `draw(results)`, which returns a
matplotlib figure. The constants are literals: they are read without importing the module, so that
planning a study does not wait for plotting libraries. Names that begin with '_' are helpers.
"""
