"""Tables of points as callers have them, to one block of doubles."""

from __future__ import annotations

from array import array
from collections.abc import Mapping, Sequence
from typing import Any, List, Optional, Tuple

from .errors import ArgumentError
from .table import numpy


class Block:
    """[count x width] doubles, row by row, with an address for C."""

    def __init__(self, data: Any, count: int, width: int) -> None:
        self.data, self.count, self.width = data, count, width

    @classmethod
    def empty(cls, count: int, width: int) -> "Block":
        if numpy is not None:
            return cls(numpy.empty((count, width)), count, width)
        return cls(array("d", bytes(8 * count * width)), count, width)

    @property
    def address(self) -> int:
        return self.data.ctypes.data if numpy is not None else self.data.buffer_info()[0]

    def column(self, i: int) -> Any:
        """[count]: a numpy array or a list."""
        if numpy is not None:
            return self.data[:, i].copy()
        return list(self.data[i :: self.width])


def _of_columns(columns: List[Any]) -> Block:
    """Columns of one length; a single number stands for a column of it."""
    scalar = [not hasattr(column, "__len__") for column in columns]
    lengths = {len(column) for column, single in zip(columns, scalar) if not single}
    if len(lengths) > 1:
        raise ArgumentError(f"columns of different lengths: {sorted(lengths)}")
    count = lengths.pop() if lengths else (1 if columns else 0)
    block = Block.empty(count, len(columns))
    for i, column in enumerate(columns):
        if numpy is not None:
            block.data[:, i] = column
        else:
            whole = [column] * count if scalar[i] else column
            block.data[i :: len(columns)] = array("d", (float(v) for v in whole))
    return block


def _of_rows(rows: Any, width: int) -> Block:
    if numpy is not None:
        data = numpy.ascontiguousarray(rows, dtype=float)
        if data.size == 0:
            data = data.reshape(0, width)
        if data.ndim != 2 or data.shape[1] != width:
            raise ArgumentError(f"points of shape {data.shape}; [n x {width}] is wanted")
        return Block(data, *data.shape)
    flat = array("d")
    for row in rows:
        if len(row) != width:
            raise ArgumentError(f"a point of {len(row)} numbers; {width} are wanted")
        flat.extend(float(v) for v in row)
    return Block(flat, len(flat) // width if width else 0, width)


def block(points: Any, paths: Optional[Sequence]) -> Tuple[List[str], Block]:
    """Paths and rows of a mapping (path: column or number), a DataFrame, or of rows with paths."""
    if isinstance(points, Mapping) or hasattr(points, "columns"):
        names = list(paths) if paths is not None else [str(name) for name in points.keys()]
        return names, _of_columns([points[name] for name in names])
    if paths is None:
        raise ArgumentError("rows of numbers want paths=[...], the key of each column")
    return list(paths), _of_rows(points, len(paths))
