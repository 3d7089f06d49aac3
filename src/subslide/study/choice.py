"""The choice of model: the cheapest that is exact for what is asked of a point. Imports no kernels."""

from subslide import scenes

EXACT = {
    "round": ("radial", "quarter", "plane"),
    "line": ("line",),
    "quarter": ("quarter", "plane"),
    "none": ("plane",),
}
"""Models that give the answer for scenes of each symmetry, the cheapest first."""

WORDS = {
    "round": "round scene",
    "line": "scene on a line",
    "quarter": "scene with two mirrors",
    "none": "scene without mirrors",
}


def exact_models(point):
    """Return the models that give the answer for the point's scene and densities, the cheapest first."""
    symmetry = scenes.symmetry(point)
    alone = ("one-layer",) if symmetry in ("round", "line") and point.r == 0 else ()
    return alone + EXACT[symmetry]


def resolve_model(point):
    """Return the model of a point: its own, or for `auto` the cheapest that gives all that is asked for."""
    if point.model != "auto":
        return point.model
    models = exact_models(point)
    return models[0] if point.quantities == "grains" else next(name for name in models if name != "one-layer")


def model_reason(point):
    """Return why a point has its model, in words."""
    if point.model != "auto":
        return "asked for"
    reason = WORDS[scenes.symmetry(point)]
    lone = resolve_model(point) == "one-layer"
    return f"auto: {reason}, r = 0 and grains alone asked for" if lone else f"auto: {reason}"


def geometry(model, point):
    """Return the geometry of a model's grid: "radius", "line", "quarter" or "plane"."""
    if model == "one-layer":
        return "line" if scenes.symmetry(point) == "line" else "radius"
    return {"radial": "radius"}.get(model, model)


def needs_general(point):
    """Return whether a point needs the general kernels: whatever the lean ones leave out for speed."""
    lean = {
        "wave_speeds": "exact",
        "friction": "coulomb",
        "treatment": "real",
        "as_printed": "none",
        "friction_in_viscosity": True,
    }
    return point.scheme == "roe" or any(getattr(point, key) != value for key, value in lean.items())
