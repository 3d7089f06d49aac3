"""What laboratories measured of the height of deposits."""


def height(a_2: float) -> float:
    """Return the height over R that dry round columns of aspect ratio a_2 keep on their axis, 0.74 at most.

    E. Lajeunesse, A. Mangeney-Castelnau and J. P. Vilotte, Phys. Fluids 16, 2371 (2004); lower columns keep their top.
    """
    return min(a_2, 0.74)
