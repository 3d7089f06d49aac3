"""HLL in its path-conservative form (Harten, Lax, van Leer 1983; the paper's coefficients for wet/dry edges)."""

from subslide.kernels.jit import inlined


@inlined
def line(s_l, s_r):
    """Return alpha0 and alpha1 of the line through (S_L, |S_L|) and (S_R, |S_R|)."""
    real = type(s_l)
    width = s_r - s_l
    scale = real(1) / (width if width > real(1e-30) else real(1))  # one over a subnormal width is infinite
    return (s_r * abs(s_l) - s_l * abs(s_r)) * scale, (abs(s_r) - abs(s_l)) * scale


@inlined
def alpha(waves, dry):
    """Return alpha0..2 of that line."""
    a0, a1 = line(waves.s_l, waves.s_r)
    return a0, a1, type(a0)(0)
