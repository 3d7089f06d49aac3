"""One function out of several, chosen by an integer flag when kernels run.

A flag that is an argument costs nothing in a loop (LLVM takes its tests out of it) and keeps numba's cache; functions
that are arguments lose the cache, 1.5 s and more a process.
"""

from subslide.kernels.jit import inlined


def chain(functions):
    """Return a kernel function of (flag, *arguments) that calls the function of that flag.

    functions: {flag: kernel function}; the last one is called for any other flag too.
    """
    *before, (_, last) = functions.items()
    chosen = _always(last)
    for flag, function in reversed(before):
        chosen = _or_else(flag, function, chosen)
    return chosen


def _always(function):
    """Return a function that calls `function`, whatever the flag."""

    @inlined
    def call(flag, *arguments):
        return function(*arguments)

    return call


def _or_else(place, function, others):
    """Return a function that calls `function` if the flag is `place`, else `others` with the flag."""

    @inlined
    def call(flag, *arguments):
        if flag == place:
            return function(*arguments)
        return others(flag, *arguments)

    return call
