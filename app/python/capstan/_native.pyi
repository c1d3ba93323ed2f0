"""The compiled part (app/python/native). The functions of the package check its arguments and type its results."""

from typing import Any

version: str
software: str
gates: tuple[str, ...]
default_parameters: str
low_confidence: float

def __getattr__(name: str) -> Any: ...
