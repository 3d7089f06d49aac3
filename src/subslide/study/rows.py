"""Points as the files of a study state them: what all of a file share once, and of each point only what differs."""

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.keys.values import RUN_KEYS, default_of, held
from subslide.points import Point, from_dict, to_dict
from subslide.study import checking

SHARED = "shared"
"""Key of a file under which stand the values, by key, that all its points share."""

KEYS = frozenset(RUN_KEYS)


def unlike(points: Sequence[Point]) -> list[str]:
    """Return the keys in which not all of some points agree.

    Parameters
    ----------
    points
        At least one point.

    Returns
    -------
    list of str
        Keys, in their order.
    """
    chosen = frozenset().union(*(point.chosen for point in points))  # what nobody chose is the default
    plain = [key for key in RUN_KEYS if key in chosen and key != "scene_options"]
    first = {key: getattr(points[0], key) for key in plain}
    keys = [key for key, value in first.items() if any(getattr(point, key) != value for point in points)]
    options = {repr(point.scene_options) for point in points}
    if len(options) > 1:  # text, since 1 and 1.0 are two values of an option
        keys.append("scene_options")
    return keys


def text(head: Mapping[str, Any], sections: Mapping[str, Iterable[tuple[Mapping[str, Any], Point]]]) -> str:
    """Return the JSON of a file that states points, a line for each.

    Parameters
    ----------
    head
        What the file says beside its points, by key.
    sections
        By key, what is said of each point, its id among it, and the point.

    Returns
    -------
    str
        The text, which `Reader` reads.
    """
    listed = {name: list(rows) for name, rows in sections.items()}
    points = [point for rows in listed.values() for _, point in rows]
    differing = unlike(points)
    shared = to_dict(points[0], [key for key in RUN_KEYS if key not in differing])
    encode = json.JSONEncoder(allow_nan=False, separators=(", ", ": ")).encode
    parts = [f"{encode(name)}: {encode(value)}" for name, value in {**head, SHARED: shared}.items()]
    for name, rows in listed.items():
        lines = ",\n".join(encode({**about, **to_dict(point, differing)}) for about, point in rows)
        parts.append(f"{encode(name)}: [\n{lines}\n]")
    return "{" + ",\n".join(parts) + "}\n"


class Reader:
    """Points of the rows of a file.

    Parameters
    ----------
    file
        What the file states; older ones have no values that all points share.
    check
        Whether values are checked as those of a study, and ids against values. A file that a checksum vouches for
        needs it not.
    """

    def __init__(self, file: Mapping[str, Any], check: bool) -> None:
        """Keep what all rows share; ConfigError if it is no mapping, or a value is not allowed."""
        self.shared = file.get(SHARED, {})
        if not isinstance(self.shared, dict):
            raise ConfigError(
                f"{SHARED}: {words.show(self.shared)} is not allowed; allowed: a mapping of keys"
            )
        self.check = check
        known = {key: value for key, value in self.shared.items() if key in KEYS}
        if check:
            known = {key: schema.checked(key, value, f"{SHARED}: {key}") for key, value in known.items()}
        whole = from_dict(known).chosen
        self.base = {key: value for key, value in whole.items() if value != default_of(key)}

    def point(self, row: Mapping[str, Any], others: frozenset[str] = frozenset(("id",))) -> Point:
        """Return the point of a row.

        Parameters
        ----------
        row
            Value by key of what is not shared, and the id.
        others
            Keys that a row has beside those of a run.

        Returns
        -------
        Point
            The point; its id is that of the row.

        Raises
        ------
        ConfigError
            If it is to be checked, and a key is missing or one too many, a value is not allowed, or the values are not
            those of the id: one line.
        """
        if self.check:
            return self._checked(row, others)
        values = {key: held(key, value) for key, value in row.items() if key in KEYS}
        return Point.of({**self.base, **values, "id": row["id"]})  # where the property keeps it

    def _checked(self, row: Any, others: frozenset[str]) -> Point:
        """Return the point of a row, checked."""
        if not isinstance(row, dict):
            raise ConfigError(f"{words.show(row)} is no point; allowed: a mapping with every key of a run")
        keys = (*others, *RUN_KEYS)
        if len(row) + len(self.shared) != len(keys) or not KEYS.issuperset(row.keys() - others):
            for key in keys:
                if key not in row and (key not in self.shared or key in others):
                    raise ConfigError(f"{key}: this key is missing")
            for key in (*row, *self.shared):
                if key not in keys:
                    raise ConfigError(f"{words.show(key)}: there is no such key{words.closest(key, keys)}")
            raise ConfigError("a key stands in the row and among those that all share; allowed: one of them")
        values = {key: held(key, schema.checked(key, v)) for key, v in row.items() if key in KEYS}
        point = Point.of({**self.base, **values})
        checking.check_whole(point)
        if point.id != row["id"]:
            raise ConfigError(
                f"the values of {words.show(row['id'])} belong to {point.id}; was the file edited?"
            )
        return point
