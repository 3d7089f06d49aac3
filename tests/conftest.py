"""Settings that hold for every test."""

from hypothesis import settings

settings.register_profile(
    "subslide", deadline=None, derandomize=True
)  # the first call compiles; CI must not be a lottery
settings.load_profile("subslide")
