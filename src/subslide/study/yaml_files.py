"""YAML files as mappings, with one line on whatever is wrong in them."""

from pathlib import Path
from typing import TYPE_CHECKING

from subslide.keys import schema, words
from subslide.keys.schema import ConfigError

if TYPE_CHECKING:
    import yaml


def read_yaml(path: Path | str) -> dict:
    """Return the mapping in a YAML file, unchecked but for repeated keys.

    Raises
    ------
    ConfigError
        If the file cannot be read as one: one line with its path.
    """
    import yaml

    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        near = words.closest(path.name, [p.name for p in path.parent.glob("*.y*ml")])
        raise ConfigError(f"{path}: there is no such file{near}") from None
    except UnicodeDecodeError:
        raise ConfigError(f"{path}: this is not a text file in UTF-8") from None
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    try:
        values = yaml.load(text, Loader=_strict_loader())
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else "?"
        raise ConfigError(f"{path}, line {line}: not valid YAML: {error.problem}") from None
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        raise ConfigError(f"{path}: not valid YAML: {' '.join(str(error).split())}") from None
    if values is None:
        raise ConfigError(f"{path}: the file is empty; allowed keys: {', '.join(schema.properties())}")
    if not isinstance(values, dict):
        raise ConfigError(f"{path}: expected lines of 'key: value', found {words.show(values)}")
    return values


def _strict_loader() -> type["yaml.SafeLoader"]:
    """Return a YAML loader that refuses a key given twice; the plain one keeps the last in silence."""
    import yaml

    class Loader(yaml.SafeLoader):
        """Loader that is given a check of its own for mappings."""

    def mapping(loader: yaml.SafeLoader, node: yaml.MappingNode, deep: bool = False) -> dict:
        seen = set()
        for key_node, _ in node.value:
            key = key_node.value if isinstance(key_node, yaml.ScalarNode) else str(key_node.start_mark)
            if key in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key '{key}' is given twice", key_node.start_mark
                )
            seen.add(key)
        return yaml.SafeLoader.construct_mapping(loader, node, deep)

    Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, mapping)
    return Loader
