"""Rusanov's solver (local Lax-Friedrichs)."""

from subslide.kernels.jit import inlined


@inlined
def largest(s_l, s_r):
    """Return max(|S_L|, |S_R|)."""
    return max(abs(s_l), abs(s_r))


@inlined
def alpha(waves, dry):
    """Return alpha0..2 of p(x) = max(|S_L|, |S_R|)."""
    zero = type(waves.s_l)(0)
    return largest(waves.s_l, waves.s_r), zero, zero
