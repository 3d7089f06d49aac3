"""YAML files, and texts of YAML, as values: one strict reader, with one line on whatever is wrong in them.

Values are built from the parser's events, so nothing is expanded before it is counted. Aliases and merge keys (`<<`),
which long studies need, are allowed and counted as often as they stand; tags, several documents and numbers that may
be read in several ways (`subslide.keys.plain`) are not.
"""

import os
import stat
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from subslide.keys import plain, schema, words
from subslide.keys.schema import ConfigError

if TYPE_CHECKING:
    import yaml

MOST_BYTES = 1_000_000
MOST_VALUES = 200_000
"""Values in a file, those behind an alias counted each time."""
MOST_DEPTH = 20
MERGE = "<<"

KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}


def read_yaml(path: Path | str) -> dict:
    """Return the mapping in a YAML file, its keys as texts, unchecked but for what YAML says.

    Parameters
    ----------
    path
        A regular file in UTF-8, of at most MOST_BYTES.

    Returns
    -------
    dict
        Values by key; keys that stand in quotes or not are the same.

    Raises
    ------
    ConfigError
        If the file cannot be read as one: one line with its path and, where there is one, line and key.
    """
    values = _Reader(str(path)).read(read_text(path, MOST_BYTES))
    if values is None:
        raise ConfigError(f"{path}: the file is empty; allowed keys: {', '.join(schema.properties())}")
    if not isinstance(values, dict):
        raise ConfigError(f"{path}: expected lines of 'key: value', found {words.show(values)}")
    return values


def read_overrides(texts: Iterable[str]) -> dict:
    """Return the values that texts such as 'cells=40' or 'a_H=[1, 2]' state, as snakemake's `--config` takes them.

    Parameters
    ----------
    texts
        KEY=VALUE each, the value in YAML.

    Returns
    -------
    dict
        Values by key, unchecked but for what YAML says.

    Raises
    ------
    ConfigError
        If a text is none, or a key comes twice: one line that begins with `--config KEY`.
    """
    values: dict[str, Any] = {}
    for text in texts:
        key, sign, value = text.partition("=")
        if not (key.strip() and sign):
            raise ConfigError(f"--config: {words.show(text)} is not allowed; allowed: KEY=VALUE")
        if key.strip() in values:
            raise ConfigError(f"--config {key.strip()}: given twice; allowed: each key once")
        values[key.strip()] = values_of(value, f"--config {key.strip()}")
    return values


def values_of(text: str, name: str) -> Any:
    """Return the value that a text of YAML states, as strictly as a file.

    Parameters
    ----------
    text
        A number, a word, '[1, 2]', ...
    name
        What messages call it.

    Returns
    -------
    object
        The value.

    Raises
    ------
    ConfigError
        If it is not valid: one line that begins with the name.
    """
    if len(text) > MOST_BYTES:
        raise ConfigError(f"{name}: {len(text)} characters; allowed: at most {MOST_BYTES}")
    return _Reader(name, lines=False).read(text)


def read_text(path: Path | str, most: int) -> str:
    """Return the text of a file of the user's.

    Parameters
    ----------
    path
        A regular file in UTF-8.
    most
        Bytes that it may have.

    Returns
    -------
    str
        Its text, without a byte order mark.

    Raises
    ------
    ConfigError
        If there is no such file, or it is something else: one line, which begins with the path.
    """
    if not str(path):
        raise ConfigError("the path of a file (CONFIG, SPEC) is ''; allowed: the path of a file")
    path = Path(path)
    try:
        about = os.stat(path)  # before it is opened: opening a pipe waits for ever
        if not stat.S_ISREG(about.st_mode):
            kind = KINDS.get(stat.S_IFMT(about.st_mode), "no file")
            raise ConfigError(f"{path}: this is {kind}; allowed: a regular file")
        if about.st_size > most:
            raise ConfigError(f"{path}: {about.st_size / 1e6:.3g} MB; allowed: at most {most / 1e6:g} MB")
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        near = words.closest(path.name, [p.name for p in path.parent.glob(f"*{path.suffix[:2] or '.y'}*")])
        raise ConfigError(f"{path}: there is no such file{near}") from None
    except UnicodeDecodeError:
        raise ConfigError(f"{path}: this is not a text file in UTF-8") from None
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except ValueError as error:  # a NUL in the path
        raise error if isinstance(error, ConfigError) else ConfigError(f"{path}: {error}") from None


class _Level:
    """A mapping or list that is being read.

    Attributes
    ----------
    value
        What it holds so far.
    anchor
        Name by which aliases mean it, if any.
    before
        Count of the values that were read before it.
    key
        Key whose value comes next; None if a key comes next.
    merged
        Mappings whose keys it takes over by `<<`.
    """

    def __init__(self, value: dict | list, anchor: str | None, before: int) -> None:
        """Take what is known where it begins."""
        self.value, self.anchor, self.before = value, anchor, before
        self.key: str | None = None
        self.merged: list[dict] = []


class _Reader:
    """Values of the events of one text."""

    def __init__(self, name: str, lines: bool = True) -> None:
        """Take what messages call the text, and whether they tell its lines."""
        self.name, self.lines = name, lines
        self.levels: list[_Level] = []
        self.anchors: dict[str, tuple[Any, int]] = {}
        self.result: Any = None
        self.count, self.line = 0, 1

    def read(self, text: str) -> Any:
        """Return the value of a text; ConfigError if anything is wrong."""
        import yaml

        for self.line, line in enumerate(text.split("\n"), 1):
            if odd := plain.control(line.rstrip("\r").replace("\t", " ")):
                self._refuse(f"there is the character {odd}; allowed: text without control characters")
        documents = 0
        try:
            for event in yaml.parse(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
                self.line = event.start_mark.line + 1
                documents += isinstance(event, yaml.DocumentStartEvent)
                if documents > 1:
                    self._refuse("a second document begins; allowed: one")
                self._take(event)
        except yaml.YAMLError as error:
            mark = getattr(error, "problem_mark", None)
            self.line = mark.line + 1 if mark else self.line
            what = getattr(error, "problem", error)
            self._refuse(f"not valid YAML: {what}; allowed: lines of 'key: value'")
        return self.result

    def _take(self, event: "yaml.Event") -> None:
        """Put the next event of the parser to what has been read."""
        import yaml

        if getattr(event, "tag", None) is not None:
            self._refuse(f"{event.tag}: tags are not allowed; allowed: plain values, and text in quotes")
        level = self.levels[-1] if self.levels else None
        if isinstance(event, yaml.CollectionEndEvent):
            self._end()
        elif level and isinstance(level.value, dict) and level.key is None:
            if not isinstance(event, yaml.ScalarEvent):
                self._refuse("a list, mapping or alias is no key; allowed: text")
            self._begin_key(level, event.value)
        elif isinstance(event, yaml.ScalarEvent):
            value = self._scalar(event.value, event.style)
            self._keep(value, 1)
            self._name(event.anchor, value, 1)
        elif isinstance(event, yaml.AliasEvent):
            if event.anchor not in self.anchors:
                self._refuse(f"*{event.anchor} refers to itself or to nothing; allowed: an anchor before it")
            self._keep(*self.anchors[event.anchor])
        elif isinstance(event, yaml.CollectionStartEvent):
            if len(self.levels) == MOST_DEPTH:
                self._refuse(f"nested too deep; allowed: at most {MOST_DEPTH} levels")
            value = {} if isinstance(event, yaml.MappingStartEvent) else []
            self.levels.append(_Level(value, event.anchor, self.count))

    def _end(self) -> None:
        """End the mapping or list that is being read."""
        level = self.levels.pop()
        value = level.value
        if isinstance(value, dict):
            for other in level.merged:  # the first of several wins
                value = {**other, **value}
        self._keep(value, 1)
        self._name(level.anchor, value, self.count - level.before)

    def _begin_key(self, level: _Level, key: str) -> None:
        """Set the key whose value comes next in a mapping."""
        if plain.control(key):
            self._refuse(f"the key {key} has a control character; allowed: text in one line")
        if key in level.value or (key == MERGE and level.merged):
            self._refuse(f"the key '{key}' is given twice")
        level.key = key

    def _scalar(self, text: str, style: str | None) -> Any:
        """Return the value of a text, which stands for itself if it is in quotes."""
        if plain.control(text):
            allowed = "lines of 'key: value'" if self.lines and not self.levels else "text in one line"
            self._refuse(f"{words.show(text)} has several lines or a control character; allowed: {allowed}")
        if style not in (None, ""):
            return text
        try:
            return plain.value_of(text) if text else None
        except ValueError as error:
            self._refuse(f"{words.cut(text)} {error}")

    def _keep(self, value: Any, size: int) -> None:
        """Put a value, which counts for `size` of them, where it belongs."""
        self.count += size
        if self.count > MOST_VALUES:
            self._refuse(
                f"more than {MOST_VALUES} values, those of aliases counted; allowed: at most {MOST_VALUES}"
            )
        level = self.levels[-1] if self.levels else None
        if level is None:
            self.result = value
        elif isinstance(level.value, list):
            level.value.append(value)
        elif level.key == MERGE:
            level.merged = value if isinstance(value, list) else [value]
            if not (level.merged and all(isinstance(other, dict) for other in level.merged)):
                self._refuse(
                    f"{words.show(value)} is not allowed; allowed: an alias of a mapping, or a list of them"
                )
            level.key = None
        else:
            level.value[level.key] = value
            level.key = None

    def _name(self, anchor: str | None, value: Any, size: int) -> None:
        """Hold a value, and how many it counts for, by its anchor."""
        if anchor in self.anchors:
            self._refuse(f"the anchor &{anchor} is given twice")
        if anchor:
            self.anchors[anchor] = value, size

    def _refuse(self, problem: str) -> NoReturn:
        """Raise a ConfigError that names file, line and the key whose value is being read."""
        place = ""
        for level in self.levels:
            if isinstance(level.value, list):
                place += f"[{len(level.value)}]"
            elif level.key is not None:
                place += f".{level.key}"
        line = f", line {self.line}" if self.lines else ""
        raise ConfigError(f"{self.name}{line}: {place.lstrip('.')}{': ' if place else ''}{problem}")
