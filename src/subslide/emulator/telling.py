"""Predictions in words: a line a quantity, scaled and in SI units."""

from collections.abc import Iterator

from subslide.emulator import measures as named
from subslide.emulator.model import Emulator
from subslide.points import Point

SCALES = {
    **dict.fromkeys((*named.LENGTHS, *named.FRONTS), ("R", "m", "radius")),
    **dict.fromkeys(named.ARRESTS, ("sqrt(R/(g a_2))", "s", "time_scale")),
    **dict.fromkeys((named.PEAK, named.SURFACE), ("H2", "m", "column_height")),
}
"""What a quantity is scaled by, in words and in the unit, and the property of a point that has its size."""


def lines(emulator: Emulator, point: Point) -> Iterator[str]:
    """Give what is predicted of a column as lines of text.

    Parameters
    ----------
    emulator
        The emulator.
    point
        The column.

    Yields
    ------
    str
        A heading, and a line for each quantity and time: scaled value and 95 % band, then both in SI units.
    """
    a_H, r, m = point.a_H, point.r, point.friction_number
    answers = emulator.predict(a_H, r, m)  # refused before a line is printed
    scales = (
        f"R = {point.radius:g} m, H2 = {point.column_height:g} m, sqrt(R/(g a_2)) = {point.time_scale:.4g} s"
    )
    yield f"a_H = {a_H:g}, r = {r:g}, m = tan(delta)/a_2 = {m:.4g}; {scales}"
    yield f"{'quantity':<22}{'time s':>9}{'value':>12}{'band':>11}{'':>5}{'value':>12}{'band':>11}"
    for name, (values, bands) in answers.items():
        scale, unit, key = SCALES[name]
        size = getattr(point, key)
        times = named.TIMES if values.ndim == 2 else (None,)
        for time, value, band in zip(times, values.ravel(), bands.ravel(), strict=True):
            at = "" if time is None else f"{time * point.time_scale:.4g}"
            numbers = f"{value:>12.5g}{band:>11.2g}{'':>5}{value * size:>12.5g}{band * size:>11.2g} {unit}"
            yield f"{name:<22}{at:>9}{numbers}  (over {scale})"
