"""IFCP: Intermediate Field Capturing Parabola (Fernandez-Nieto, Castro, Pares 2011)."""

from subslide.kernels.jit import inlined


@inlined
def alpha(waves, dry):
    """Return alpha0..2 of the parabola through |S| at S_L, S_int and S_R (Eq. 10), whether a layer is dry or not.

    Written without the differences of Eq. (10) that vanish when S_int meets the outer speed on its own side; S_int
    has the sign of the larger outer speed (Eq. 12), so what remains in the denominators is never small.
    """
    s_l, s_int, s_r = waves.s_l, waves.s_int, waves.s_r
    real = type(s_l)
    zero = real(0)
    one = real(1)
    right = abs(s_r) > abs(s_l)  # not the sign of s_int, which is lost where it is 0
    near = s_r if right else s_l
    far = s_l if right else s_r
    sign = one if right else -one
    denominator = (far - s_int) * (far - near)
    a2 = -sign * (far + far) / (denominator if abs(denominator) > real(1e-30) else one)
    a0 = a2 * s_int * near
    a1 = zero if s_r == -s_l else sign - a2 * (near + s_int)  # exactly 0 by symmetry, else the mirror breaks
    left_going = s_r <= zero
    right_going = s_l >= zero
    one_sided = left_going or right_going
    direction = one if right_going else -one
    return (zero if one_sided else a0), (direction if one_sided else a1), (zero if one_sided else a2)
