"""The names that keys may take, each declared once, and whether the lean kernels know it."""

from collections.abc import Mapping

LEAN, GENERAL = True, False

SCHEMES = {"rusanov": LEAN, "hll": LEAN, "ifcp": LEAN, "ifcph": LEAN, "roe": GENERAL}
LAWS = {"coulomb": LEAN, "voellmy": GENERAL, "pouliquen": GENERAL}
TREATMENTS = {"real": LEAN, "hll": GENERAL, "friction": GENERAL, "stop": GENERAL}
SPEEDS = {"exact": LEAN, "approximate": GENERAL}
AS_PRINTED = {"none": LEAN, "friction": GENERAL, "upwinding": GENERAL}
BOUNDARIES = {"open": LEAN, "wall": LEAN, "periodic": LEAN}


def flags(names: Mapping[str, bool]) -> dict[str, int]:
    """Return the integer by which kernels know each name: its place."""
    return {name: flag for flag, name in enumerate(names)}
