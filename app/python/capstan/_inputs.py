"""Recordings, tables and files as callers give them, in the form that the compiled part takes."""

from __future__ import annotations

import os
from typing import Any, Callable, Iterable, Mapping, Optional, Union

import numpy as np

from ._errors import InputError, refuse
from .session import Path, Session

#: Columns in memory: a mapping (dict, DataFrame) from column names to arrays, or a structured array.
Columns = Union[Mapping[str, Any], np.ndarray]
#: A recording or table: a file, columns in memory, or an open session.
Table = Union[Path, Columns, Session]
#: Called with the finished share (0 to 1) and a phrase about the work.
Progress = Optional[Callable[[float, str], object]]
#: Units of a table that is not in SI: ``{"q_m": "deg", "p_c": "mm"}``, or the same as text.
ReadAs = Union[str, Mapping[str, str], None]


def path_of(path: Path | None) -> str:
    """The path as text; None: empty."""
    return "" if path is None else os.fspath(path)


def read_as_of(units: ReadAs) -> str:
    """Text ``q_m=deg,p_c=mm`` of the units."""
    if units is None:
        return ""
    if isinstance(units, str):
        return units
    return ",".join(f"{name}={unit}" for name, unit in units.items())


def _column(name: str, values: Any, table: str) -> list[tuple[str, np.ndarray]]:
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise refuse(name, type(values).__name__, "is no column of numbers",
                     f"Give {table} arrays of numbers, and NaN where there is no value") from None
    if array.ndim == 1:
        return [(name, array)]
    if array.ndim == 2:
        return [(f"{name}{i + 1}", array[:, i]) for i in range(array.shape[1])]
    raise refuse(name, f"shape {array.shape}", "is no column", "Give an array of shape (n,), or (n, joints)")


def table_of(table: Table, name: str = "arrays") -> Any:
    """The path of a file as text; of columns in memory the pair (name, [(column, array of shape (n,)), …])."""
    if isinstance(table, (str, os.PathLike)):
        return os.fspath(table)
    if isinstance(table, Session):
        return table.path
    if isinstance(table, np.ndarray):
        names: Iterable[str] = table.dtype.names or ()
        if not names:
            raise refuse(name, f"array of shape {table.shape}", "has no column names",
                         "Give a dict from column names to arrays, or a structured array")
    elif hasattr(table, "keys"):
        names = list(table.keys())
    else:
        raise refuse(name, type(table).__name__, "is no recording", "Give the path of a file, or a dict of arrays")
    columns: list[tuple[str, np.ndarray]] = []
    for column in names:
        columns += _column(str(column), table[column], name)
    return name, columns


def tables_of(tables: Table | Iterable[Table], name: str = "arrays") -> list[Any]:
    """One table_of() for each of several tables, or for the only one."""
    if isinstance(tables, (list, tuple)):
        if len(tables) == 1:
            return [table_of(tables[0], name)]
        return [table_of(table, f"{name} {i + 1}") for i, table in enumerate(tables)]
    return [table_of(tables, name)]  # type: ignore[arg-type]


def recordings_of(recordings: Table | Iterable[Table]) -> list[Any]:
    """tables_of() one or more recordings."""
    tables = tables_of(recordings)
    if not tables:
        raise InputError("recordings: is empty. Give one or more recordings", key="recordings", reason="is empty",
                         remedy="Give one or more recordings")
    return tables


def write_text(path: Path, text: str) -> None:
    """Writes a whole file."""
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
