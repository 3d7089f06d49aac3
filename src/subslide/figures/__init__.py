"""Figures of a study: each is one module of this folder, found by listing it (see `subslide.catalogue`).

To add a figure, write its module and its caption, ``workflow/report/NAME.rst``; nothing else is edited: the report, the
rules and ``figures: auto`` follow from here. Modules whose names begin with ``_`` are helpers. A figure's module
has four names:

TITLE : str
    What the figure shows, in one line: its caption's heading.
CATEGORY : str
    Heading in the report: a digit, by which headings are sorted, and words, such as ``"2 Front of the grains"``.
NEEDS : dict of str to tuple
    For each key of a run named here, the values that a study must all have for the figure to make sense, and as
    ``design`` the kinds of designs; left out where any study will do. ``figures: auto`` draws the figure in every
    such study.
draw(results) -> matplotlib.figure.Figure
    The figure of a finished study (`subslide.results.Results`). It is decorated with `_style.styled`, reads tables and
    records only, writes no file, and draws the same pixels for the same results. It raises `_style.NoRunsError` where
    the study has no run to show; the decorator makes that an empty figure that says so. It names under its panels
    every run that failed and every value of the study that it leaves out (see `_slices.cut`, `_words.trouble`).

The first three are literals: they are read from the source without importing the module, so that planning a study does
not wait for plotting libraries.
"""
