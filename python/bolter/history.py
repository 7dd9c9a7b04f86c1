"""Files of time histories: CSV, and HDF5 where h5py is there."""

from __future__ import annotations

import csv
import os
from typing import Any, Dict, List, Union

from .errors import FileError, InputError, Message
from .table import Table, column

#: unit as written in a heading: how names end
_TOKENS = {
    "m": "m",
    "s": "s",
    "N": "N",
    "N m": "Nm",
    "J": "J",
    "W": "W",
    "Pa": "Pa",
    "rad": "rad",
    "m/s": "mps",
    "rad/s": "radps",
    "m/s^2": "mps2",
}


def read_history(path: Union[str, "os.PathLike[str]"]) -> Table:
    """Reads what `bolter land -o`, `replay --history` and `rig -o` write.

    :param path: a ``.csv`` file, else HDF5
    :returns: one column per name with its unit ("nose_stroke_m"); of HDF5, datasets by their path
        ("legs/stroke_m" [n x 3], "cable/x_m" [k x segments])
    :raises FileError: it cannot be read; ImportError: HDF5 without h5py
    """
    return _read_csv(path) if os.fspath(path).endswith(".csv") else _read_hdf5(path)


def _name(heading: str) -> str:
    """ "nose_stroke_m" of "nose_stroke [m]"."""
    quantity, _, rest = heading.partition(" [")
    token = _TOKENS.get(rest.rstrip("]"), "")
    return f"{quantity}_{token}" if token else quantity


def _read_csv(path: Any) -> Table:
    file = os.fspath(path)
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            rows = csv.reader(line for line in stream if not line.startswith("#"))
            names = [_name(heading.strip()) for heading in next(rows, [])]
            values: List[List[float]] = [[float(v) for v in row] for row in rows]
    except OSError as error:
        raise FileError(str(error)) from error
    except ValueError as error:
        raise InputError("", [Message("error", file, None, None, str(error))]) from error
    return Table({name: column(v) for name, v in zip(names, zip(*values))})


def _read_hdf5(path: Any) -> Table:
    import h5py

    columns: Dict[str, Any] = {}
    units: Dict[str, str] = {}

    def keep(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset):
            columns[name] = item[()]
            unit = item.attrs.get("unit", "")
            units[name] = unit.decode() if isinstance(unit, bytes) else str(unit)

    try:
        with h5py.File(os.fspath(path), "r") as file:
            file.visititems(keep)
    except OSError as error:
        raise FileError(str(error)) from error
    return Table(columns, units)
