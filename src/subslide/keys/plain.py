"""Plain texts, without quotes, as values: one grammar for files, options of the command line and `--config`.

Numbers are decimal. What YAML 1.1 reads otherwise than a person does (octal, base 60, underscores, dates) is refused
rather than guessed at; yes, no, on and off are words.
"""

import math
import re
import sys
from typing import Any

NUMBER = re.compile(r"[-+]?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
WHOLE = re.compile(r"[-+]?[0-9]+")
SEVERAL_WAYS = re.compile(
    r"[-+]?0[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?"  # octal, or decimal
    r"|[-+]?0[xXbBoO][0-9a-fA-F_]+"
    r"|[-+]?(?=[0-9.]*_)\.?[0-9][0-9_.]*([eE][-+]?[0-9]+)?"  # digits in groups, or a name
    r"|[-+]?[0-9][0-9_]*(:[0-9]{1,2})+(\.[0-9_]*)?"  # base 60, or a time of day
    r"|[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt ].*)?"
)
WORDS = {
    **dict.fromkeys(("null", "Null", "NULL", "~"), None),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **{sign + word: float(sign + word[1:]) for sign in ("", "+", "-") for word in (".inf", ".Inf", ".INF")},
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
}


def value_of(text: str) -> Any:
    """Return the number, true, false, nothing or text that a plain text stands for.

    Parameters
    ----------
    text
        The text, without blanks around it.

    Returns
    -------
    object
        Its value; an integer where it has neither point nor exponent.

    Raises
    ------
    ValueError
        If it may be read in several ways, or no number of 64 bits is as large or as small: words that go on after the
        text.
    """
    if text in WORDS:
        return WORDS[text]
    if NUMBER.fullmatch(text):
        number = float(text)
        nothing = not re.search("[1-9]", re.split("[eE]", text)[0])
        if not nothing and not sys.float_info.min <= abs(number) <= sys.float_info.max:
            raise ValueError(
                "is beyond what a number can be; allowed: up to about 1e308, down to about 1e-308"
            )
        return int(text) if WHOLE.fullmatch(text) else number
    if SEVERAL_WAYS.fullmatch(text):
        raise ValueError(
            "may be read in several ways; allowed: decimal numbers without leading zeros, '_' or ':', such as 200 or"
            " 1e-3; text in quotes"
        )
    return text


def is_text(text: str) -> bool:
    """Return whether a plain text stands for itself."""
    try:
        return isinstance(value_of(text), str)
    except ValueError:
        return False


def control(text: str) -> str:
    """Return the first character of a text that no name or value may have (control, or half of a pair), or ''."""
    return next((c for c in text if c < " " or "\x7f" <= c < "\xa0" or "\ud800" <= c <= "\udfff"), "")
