"""What the paper says of the water surface, over the whole box as it has it, and beyond R, where no waves meet."""

from collections.abc import Callable
from functools import partial

from subslide import naming
from subslide.tables._claims.evidence import DEEP, GAUGE, SHALLOW, WAVES, Evidence
from subslide.tables._claims.verdicts import (
    Claim,
    Comparison,
    Finding,
    falls,
    finding,
    number,
    outside,
    over_depth,
    over_r,
)

ALMOST_NONE = 0.01
"""Share of H2 below which a displacement of the surface is almost none: the depth that ends a front, too."""


def where_known(
    quantity: str, judge: Callable[[Evidence], Finding | None], evidence: Evidence
) -> Finding | None:
    """Judge a claim on a wave; None where no run has it, as on grids fitted to the grains."""
    return judge(evidence) if evidence.wave(quantity).value.notna().any(axis=None) else None


def waves_fall(quantity: str, along: str, evidence: Evidence) -> Finding | None:
    """Judge whether max|eta| at each of the paper's times falls with r or a_H; the numbers are the largest of them."""
    words = over_r if along == "r" else over_depth
    comparisons = [
        one
        for time in evidence.times
        for one in falls(evidence.at_time(quantity, time).submerged(), along, f"{1e3 * time:.3g} ms, ")
    ]
    return finding(comparisons, f"largest {words(evidence.wave(quantity).submerged(), 1e-3)}")


def amplitude_falls_with_r(quantity: str, evidence: Evidence) -> Finding | None:
    """Judge whether the wave is smaller for bigger r."""
    wave = evidence.wave(quantity).submerged()
    return finding(falls(wave, "r"), over_r(wave, 1e-3))


def amplitude_bigger_when_shallow(quantity: str, evidence: Evidence) -> Finding | None:
    """Judge whether the wave is bigger at a_H = 1 than at 10."""
    ends = evidence.wave(quantity).submerged().ends()
    return ends and finding(falls(ends, "a_H"), over_depth(ends, 1e-3))


def amplitude_complex_between(quantity: str, evidence: Evidence) -> Finding | None:
    """Judge whether the wave at some a_H between lies outside those at the ends."""
    wave = evidence.wave(quantity).submerged()
    return finding(outside(wave), over_depth(wave, 1e-3), some=True)


def almost_no_wave_when_deep(quantity: str, evidence: Evidence) -> Finding | None:
    """Judge whether max|eta| at a_H = 10 is almost none; the numbers say how many times bigger it is at a_H = 1."""
    if DEEP not in evidence.depths:
        return None
    wave = evidence.wave(quantity).submerged()
    deep = {r: wave.at(DEEP, r) for r in wave.value.columns}
    words = [f"{number(*pair, evidence.height / 100)} (r = {r:g})" for r, pair in deep.items()]
    if SHALLOW in evidence.depths:
        ratios = (f"{pair[0] / wave.at(SHALLOW, r)[0]:.2g}" for r, pair in deep.items())
        words.append(f"of those at a_H = {SHALLOW:g} {' / '.join(ratios)}")
    text = f"% of H2: {', '.join(words)}"
    return finding(
        (Comparison(ALMOST_NONE * evidence.height - value, band) for value, band in deep.values()), text
    )


def _about_waves() -> list[Claim]:
    """Return each claim on the surface, over each region."""
    claims = []
    for quantity, where in {**WAVES, GAUGE: f"at {naming.GAUGE:g} R"}.items():
        each, top = f"max|eta| ({where})", f"largest max|eta| ({where}) among the paper's times"
        if quantity == GAUGE:
            top = f"{GAUGE}_peak"
        for words, section, measure, judge in (
            (
                "wave bigger for smaller r",
                "4",
                f"{each} at each of the paper's times falls with r > 0, at every a_H; mm",
                partial(waves_fall, quantity, "r"),
            ),
            (
                "wave bigger for smaller a_H",
                "4",
                f"{each} at each of the paper's times falls with a_H, at every r > 0; mm",
                partial(waves_fall, quantity, "a_H"),
            ),
            (
                "almost no wave at a_H = 10",
                "4",
                f"{top} stays below {100 * ALMOST_NONE:g} % of H2 at every r > 0",
                partial(almost_no_wave_when_deep, quantity),
            ),
            (
                "lighter grains raise a smaller wave",
                "5",
                f"{top} falls with r > 0, at every a_H; mm",
                partial(amplitude_falls_with_r, quantity),
            ),
            (
                "wave bigger at a_H = 1 than at 10",
                "5",
                f"{top} falls from a_H = 1 to 10, at every r > 0; mm",
                partial(amplitude_bigger_when_shallow, quantity),
            ),
            (
                "intermediate depths more complex: wave",
                "5",
                f"{top} at some a_H between and some r > 0 lies outside those at the least and greatest a_H; mm",
                partial(amplitude_complex_between, quantity),
            ),
        ):
            if quantity == GAUGE and each in measure:
                continue  # of a gauge there is a peak alone
            judged = partial(where_known, quantity, judge)
            claims.append(Claim(f"{words} ({where})", section, measure, judged))
    return claims


CLAIMS = tuple(_about_waves())
