"""The published JSON Schema of a study, config/study.schema.json, for editors that complete and check YAML."""

from subslide import catalogue, scenes
from subslide.keys import published

PATH = "config/study.schema.json"


def text() -> str:
    """Return the file."""
    return published.text({name: scenes.load(name).OPTIONS for name in catalogue.names("scenes")})
