"""Exceptions and warnings of the package."""

from __future__ import annotations

import warnings
from typing import Any, Iterable, Sequence


class InputError(ValueError):
    """A file or an argument that cannot be used.

    Attributes:
        file: path of the file, or name of the arrays; None for an argument.
        line: line in the file, from 1; None where the file as a whole or an argument is meant.
        key: column, field or argument; of arrays with the row, as in ``"q_m2, row 12"``; None: none.
        value: the value as it was given; None: none.
        reason: what is wrong with it.
        remedy: what to do; None: not known.
    """

    def __init__(self, text: str, file: str | None = None, line: int | None = None, key: str | None = None,
                 value: str | None = None, reason: str = "", remedy: str | None = None) -> None:
        super().__init__(text)
        self.file = file
        self.line = line
        self.key = key
        self.value = value
        self.reason = reason or text
        self.remedy = remedy

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.file, self.line, self.key, self.value, self.reason, self.remedy))


class Notice(UserWarning):
    """A remark on the data, for example on columns that are not used."""


def refuse(key: str, value: object, reason: str, remedy: str) -> InputError:
    """The error about an argument."""
    return InputError(f"{key} = {value}: {reason}. {remedy}", key=key, value=str(value), reason=reason, remedy=remedy)


def require_one_of(key: str, value: str, allowed: Sequence[str]) -> str:
    """Returns `value`. Raises InputError unless it is one of `allowed`."""
    if value not in allowed:
        raise refuse(key, value, "is not known", "Give one of " + ", ".join(allowed))
    return value


def require_range(key: str, value: float, low: float, high: float) -> float:
    """Returns `value`. Raises InputError unless it is in [low, high]."""
    if not low <= value <= high:
        raise refuse(key, value, f"is not from {low:g} to {high:g}", "Give a number in this range")
    return value


def warn(notices: Iterable[str]) -> list[str]:
    """Warns of each remark and returns all of them."""
    all_notices = list(notices)
    for notice in all_notices:
        warnings.warn(notice, Notice, stacklevel=3)
    return all_notices
