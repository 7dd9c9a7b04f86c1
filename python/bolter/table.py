"""Columns of numbers: numpy arrays where numpy is there, ``array.array`` otherwise."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Optional, Sequence

try:
    import numpy
except ImportError:  # lists do
    numpy = None  # type: ignore[assignment]

if TYPE_CHECKING:
    import pandas

#: unit token at the end of a name, as in "nose_stroke_m"
_UNITS = {
    "m": "m",
    "m2": "m^2",
    "m3": "m^3",
    "s": "s",
    "kg": "kg",
    "N": "N",
    "Nm": "N m",
    "J": "J",
    "W": "W",
    "Pa": "Pa",
    "rad": "rad",
    "mps": "m/s",
    "mps2": "m/s^2",
    "radps": "rad/s",
    "radps2": "rad/s^2",
    "m3ps": "m^3/s",
    "Npm": "N/m",
}


def unit_of(name: str) -> str:
    """The SI unit that a name ends in: "m" of "nose_stroke_m"; "" where it has none."""
    return _UNITS.get(name.rpartition("_")[2], "")


def column(values: Sequence[Any]) -> Any:
    """One column of a table: a numpy array [n], or a list."""
    return numpy.asarray(values) if numpy is not None else list(values)


class Table(Mapping):
    """Named columns of equal length.

    ``table["stroke_m"]`` is a column [n]; ``table.unit("stroke_m")`` its SI unit;
    ``table.frame()`` a pandas DataFrame.
    """

    def __init__(self, columns: Dict[str, Any], units: Optional[Dict[str, str]] = None) -> None:
        self._columns = columns
        self._units = units or {}

    @classmethod
    def of_rows(cls, names: Sequence[str], rows: bytes) -> "Table":
        """Of rows of doubles, one after another, each ``len(names)`` wide."""
        width = len(names)
        if numpy is not None:
            matrix = numpy.frombuffer(rows, dtype=float).reshape(-1, max(width, 1))
            return cls({name: matrix[:, i].copy() for i, name in enumerate(names)})
        flat = array("d")
        flat.frombytes(rows)
        return cls({name: list(flat[i::width]) for i, name in enumerate(names)})

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        """How many columns; ``rows`` is the number of rows."""
        return len(self._columns)

    @property
    def names(self) -> List[str]:
        return list(self._columns)

    @property
    def rows(self) -> int:
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def unit(self, name: str) -> str:
        """SI unit of a column, as written: "m/s"; "" for ratios, flags and texts."""
        if name not in self._columns:
            raise KeyError(name)
        return self._units.get(name, unit_of(name))

    def frame(self) -> "pandas.DataFrame":
        """As a pandas DataFrame, [rows x columns]; ImportError where pandas is missing."""
        import pandas

        return pandas.DataFrame(dict(self._columns))

    def __repr__(self) -> str:
        return f"<Table of {self.rows} rows: {', '.join(self._columns)}>"
