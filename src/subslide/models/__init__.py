"""Models: a grid, its boundaries and how a step sweeps it."""
