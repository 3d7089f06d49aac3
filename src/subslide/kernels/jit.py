"""How kernels are compiled.

Without fast-math: every operation then rounds as IEEE 754 says, so that mirrored states give mirrored bits, on any
processor, and no check for values that are not finite is deleted. The loops vectorise all the same.
"""

from numba import njit

inlined = njit(error_model="numpy", forceinline=True)
"""For functions of scalars or rows: inlined into the loop that calls them, so that the loop vectorises."""

summed = njit(error_model="numpy", forceinline=True, fastmath={"reassoc", "nsz"})
"""For sums over a row, which vectorise only in another order (fixed by the vector's width, not by the threads)."""

maximum = njit(error_model="numpy", forceinline=True, fastmath={"nnan", "nsz", "reassoc"})
"""For maxima over a row, which vectorise only so; what is not finite is caught by the sums (see `budget`)."""

launch = njit(error_model="numpy", parallel=True, cache=True)
"""For entry points: `prange` tells LLVM that array arguments do not alias, without which no loop here vectorises."""

driver = njit(error_model="numpy", cache=True)
"""For time loops that call launches."""
