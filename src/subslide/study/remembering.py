"""Answers that follow from some values of a point, worked out once for all points that share these values."""

import functools
from collections.abc import Callable
from types import MethodType
from typing import Any, Generic, TypeVar, cast

from subslide.points import RUN_KEYS, Point

READ = frozenset((*RUN_KEYS, "has_weightless_water"))
"""What a function of a point is seen to read: keys, and one thing that most points share where r is no list."""

MOST_KEPT = 1 << 18
"""Answers that are kept: those of the largest study, and some."""

Answer = TypeVar("Answer")


class Remembered(Generic[Answer]):
    """Function of a point that keeps its answers by the values which it read, in the order in which it read them.

    What it reads next may hang on what it has read, so the answers are the leaves of a tree: a branch is a key with a
    mapping from its values to branches and leaves. It may read nothing else that changes.

    Parameters
    ----------
    function
        The function.
    """

    def __init__(self, function: Callable[[Point], Answer]) -> None:
        """Keep the function; no answer is known."""
        functools.update_wrapper(self, function)
        self.function = function
        self.tree: dict[Any, Any] = {}
        self.kept = 0

    def __call__(self, point: Point) -> Answer:
        """Return the function's answer; what it raises is raised, and not kept."""
        node = self.tree.get(None)
        while node.__class__ is tuple:
            node = node[1].get(getattr(point, node[0]))
        return self._new(point) if node is None else node.answer

    def _new(self, point: Point) -> Answer:
        """Return the answer for a point, and keep it."""
        reader = _Reader(point)
        answer = self.function(cast(Point, reader))
        self.kept += 1
        if self.kept > MOST_KEPT:
            self.tree, self.kept = {}, 1
        above, last = self.tree, None
        for key, value in reader.values.items():
            above, last = above.setdefault(last, (key, {}))[1], value
        above[last] = _Leaf(answer)
        return answer


class _Leaf:
    """An answer."""

    __slots__ = ("answer",)

    def __init__(self, answer: Any) -> None:
        """Keep the answer."""
        self.answer = answer


class _Reader:
    """A point that notes which of its values are read; what follows from them is worked out from those."""

    def __init__(self, point: Point) -> None:
        """Take the point, nothing of which was read yet."""
        self.point = point
        self.values: dict[str, Any] = {}

    @property
    def chosen(self) -> dict[str, Any]:
        """Every value by key, noted."""
        return {key: getattr(self, key) for key in RUN_KEYS}

    def __getattr__(self, name: str) -> Any:
        """Return a value, noted, or what the class of points makes of values."""
        if name in READ:
            self.values[name] = getattr(self.point, name)
            return self.values[name]
        made: Any = getattr(Point, name)
        return (
            made.__get__(self)
            if isinstance(made, property | functools.cached_property)
            else MethodType(made, self)
        )
