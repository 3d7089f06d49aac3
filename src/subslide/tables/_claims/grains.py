"""What the paper says of the grains: runout, deposit and front."""

from collections.abc import Callable

import numpy as np

from subslide.laboratory import lube as laboratory
from subslide.tables._claims.evidence import DEEP, SHALLOW, THRESHOLDS, Evidence, Field
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
    rises,
)

LIGHT = 0.8
"""Ratio of densities r of the paper's lightest grains."""
GOOD = 0.10
"""Share of the laboratory's runout within which an agreement is good."""
FRONT = f"{THRESHOLDS[0][:-2]} % front"


def length_falls_with_r(evidence: Evidence) -> Finding | None:
    """Judge whether L_f falls with r."""
    length = evidence.length()
    others = _elsewhere(evidence, lambda field: finding(falls(field, "r"), ""))
    return finding(falls(length, "r"), f"{over_r(length, evidence.radius, 4)}; {others}")


def length_falls_with_depth(evidence: Evidence) -> Finding | None:
    """Judge whether L_f falls with a_H; the numbers have r = 0 too, where the exact model knows no difference."""
    length = evidence.length()
    others = _elsewhere(evidence, lambda field: finding(falls(field.submerged(), "a_H"), ""))
    return finding(falls(length.submerged(), "a_H"), f"{over_depth(length, evidence.radius, 4)}; {others}")


def length_smaller_when_shallow(evidence: Evidence) -> Finding | None:
    """Judge whether L_f is smaller at a_H = 1 than at 10."""
    ends = evidence.length().submerged().ends()
    return ends and finding(rises(ends, "a_H"), over_depth(ends, evidence.radius, 4))


def greatest_loss_is_light_and_deep(evidence: Evidence) -> Finding | None:
    """Judge whether L_f differs most from r = 0 at r = 0.8, a_H = 10."""
    length = evidence.length()
    if not {0.0, LIGHT} <= set(evidence.ratios) or DEEP not in evidence.depths or len(evidence.depths) < 2:
        return None
    dry = {a: length.at(a, 0.0) for a in evidence.depths}
    wet = {(a, r): length.at(a, r) for a in evidence.depths for r in evidence.ratios if r > 0}
    loss = {key: (abs(v - dry[key[0]][0]), b + dry[key[0]][1]) for key, (v, b) in wet.items()}
    value, band = loss.pop((DEEP, LIGHT))
    a, r = max(loss, key=lambda key: np.nan_to_num(loss[key][0], nan=-np.inf))
    text = (
        f"{number(value, band, evidence.radius)} at a_H = {DEEP:g}, r = {LIGHT:g}; greatest elsewhere "
        f"{number(*loss[a, r], evidence.radius)} at a_H = {a:g}, r = {r:g}"
    )
    return finding((Comparison(value - other, band + width) for other, width in loss.values()), text)


def agrees_with_laboratory(evidence: Evidence) -> Finding | None:
    """Judge whether the runout at r = 0 is the laboratory's."""
    if 0.0 not in evidence.ratios:
        return None
    unit = evidence.radius * laboratory.runout(evidence.a_2)

    def judge(field: Field) -> Finding | None:
        pairs = (field.at(a, 0.0) for a in evidence.depths)
        ends = ", ".join(
            f"{number(*field.at(a, 0.0), evidence.radius, 4)} (a_H = {a:g})" for a in evidence.depths
        )
        text = f"{unit / evidence.radius:.4g} R in the laboratory; {ends}; {elsewhere}"
        return finding((Comparison(GOOD - abs(value / unit - 1), band / unit) for value, band in pairs), text)

    elsewhere = ""
    elsewhere = _elsewhere(evidence, judge)
    return judge(evidence.length())


def arrives_sooner(evidence: Evidence) -> Finding | None:
    """Judge whether the front arrives later for bigger r."""
    arrival = evidence.arrival()
    return finding(rises(arrival, "r"), over_r(arrival, 1e-3))


def spreads_faster(evidence: Evidence) -> Finding | None:
    """Judge whether the front is behind, early on, for bigger r."""
    front = evidence.at_time(f"x_front_{THRESHOLDS[0]}", evidence.times[0])
    return finding(falls(front, "r"), over_r(front, evidence.radius, 4))


def front_more_sensitive_when_shallow(evidence: Evidence) -> Finding | None:
    """Judge whether r spreads the front more at a_H = 1 than at 10."""
    if len(evidence.ratios) < 2 or not {SHALLOW, DEEP} <= set(evidence.depths):
        return None
    name = f"x_front_{THRESHOLDS[0]}"
    fields = {f"{1e3 * time:.3g} ms": evidence.at_time(name, time) for time in evidence.times[:-1]}
    low, high = evidence.ratios[0], evidence.ratios[-1]
    contrasts, words = [], []
    for when, field in {**fields, "L_f": evidence.length()}.items():
        spread = []
        for a in (SHALLOW, DEEP):
            (near, width), (far, other) = field.at(a, low), field.at(a, high)
            spread.append((near - far, width + other))
        contrasts.append(Comparison(spread[0][0] - spread[1][0], spread[0][1] + spread[1][1], when))
        words.append(f"{' / '.join(number(*one, evidence.radius) for one in spread)} ({when})")
    return finding(contrasts, f"a_H = {SHALLOW:g} / {DEEP:g}: {', '.join(words)}")


def length_complex_between(evidence: Evidence) -> Finding | None:
    """Judge whether L_f at some a_H between lies outside those at the ends."""
    length = evidence.length().submerged()
    return finding(outside(length), over_depth(length, evidence.radius, 4), some=True)


def _elsewhere(evidence: Evidence, judge: Callable[[Field], Finding | None]) -> str:
    """Return the verdicts of `judge` on L_f at the fronts that the claim itself does not take."""
    others = {threshold: judge(evidence.length(threshold)) for threshold in THRESHOLDS[1:]}
    words = (f"{t[:-2]} % front {made.verdict()}" for t, made in others.items() if made)
    return f"({', '.join(words)})"


CLAIMS = (
    Claim(
        "good agreement with the laboratory at r = 0",
        "4",
        f"L_f/R ({FRONT}) within {100 * GOOD:g} % of the runout of dry columns (Lube et al. 2004), at every a_H",
        agrees_with_laboratory,
    ),
    Claim(
        "deposit reached sooner for smaller r",
        "4, 5",
        f"time of arrest of the front ({FRONT}) rises with r, at every a_H; ms",
        arrives_sooner,
    ),
    Claim(
        "spreading faster for smaller r",
        "4",
        f"x_front/R ({FRONT}) at the first of the paper's times falls with r, at every a_H",
        spreads_faster,
    ),
    Claim(
        "L_f smaller for bigger r", "4, 5", f"L_f/R ({FRONT}) falls with r, at every a_H", length_falls_with_r
    ),
    Claim(
        "L_f smaller for bigger a_H",
        "4",
        f"L_f/R ({FRONT}) falls with a_H, at every r > 0",
        length_falls_with_depth,
    ),
    Claim(
        "L_f smaller at a_H = 1 than at 10",
        "5",
        f"L_f/R ({FRONT}) rises from a_H = 1 to 10, at every r > 0",
        length_smaller_when_shallow,
    ),
    Claim(
        "intermediate depths more complex: L_f",
        "5",
        f"L_f/R ({FRONT}) at some a_H between and some r > 0 lies outside those at the least and greatest a_H",
        length_complex_between,
    ),
    Claim(
        "L_f differs most from r = 0 at r = 0.8, a_H = 10",
        "4",
        f"|L_f - L_f(r = 0)|/R ({FRONT}), same a_H, is greatest there",
        greatest_loss_is_light_and_deep,
    ),
    Claim(
        "front more sensitive to r at a_H = 1 than at 10",
        "4",
        f"x_front/R ({FRONT}) at the least r less that at the greatest is larger at a_H = 1, at the paper's times "
        "and for L_f",
        front_more_sensitive_when_shallow,
    ),
)
