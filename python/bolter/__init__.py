"""Bolter: with what probability does an arresting hook catch the wire, and why would it not?

::

    import bolter

    study = bolter.Study.example()                  # the reference study
    study["landing.sink_speed"] = "4.5 m/s"
    print(study.land())                             # engaged (direct), margin 12.3 mm
    table = study.map({"landing.distance": [2, 4, 6, 8]}, columns=["outcome", "margin_m"])

Numbers are SI: m, kg, s, rad, N, Pa. Tables hold numpy arrays where numpy is there, lists
otherwise. Examples: ``python3 -m bolter.examples.drop_test_fit``, ``.misses_pandas``,
``.openturns_form``.
"""

from ._library import LIBRARY as _LIBRARY
from ._library import find_shipped, find_study
from .errors import (
    ArgumentError,
    BolterError,
    BolterWarning,
    FailedRunsError,
    FileError,
    InputError,
    InternalError,
    InterruptedRunError,
    Message,
    NumericError,
    OutOfMemoryError,
)
from .flight import Flight
from .history import read_history
from .results import Cable, Counts, Fit, Key, Landing, Metric, Quantity, Rig
from .study import Study, keys, modes, results
from .table import Table

__version__: str = _LIBRARY.bt_version().decode()

__all__ = [
    "ArgumentError",
    "BolterError",
    "BolterWarning",
    "Cable",
    "Counts",
    "FailedRunsError",
    "FileError",
    "Fit",
    "Flight",
    "InputError",
    "InternalError",
    "InterruptedRunError",
    "Key",
    "Landing",
    "Message",
    "Metric",
    "NumericError",
    "OutOfMemoryError",
    "Quantity",
    "Rig",
    "Study",
    "Table",
    "find_shipped",
    "find_study",
    "keys",
    "modes",
    "read_history",
    "results",
]
