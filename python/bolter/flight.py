"""A landing in one's own hands: stepped, looked at, copied, compared."""

from __future__ import annotations

import ctypes as c
from typing import Any, Callable, Dict

from . import _library as lib
from .errors import BY_STATUS

_L = lib.LIBRARY


class Flight:
    """The landing of a study as the study was, at its start; see ``Study.flight``.

    ::

        flight = study.flight()
        while flight.step():
            if flight.look()["hook_height_m"] < 0.01:
                other = flight.copy()       # what happens from here on, tried apart
        print(flight.report()["mode"])
    """

    def __init__(self, create: Callable[[Any], int]) -> None:
        """Use ``Study.flight`` or ``copy``."""
        self._flight = c.c_void_p()
        status = create(c.byref(self._flight))
        if status != 0:
            raise BY_STATUS[status](lib.decode(_L.bt_status_text(status)))  # type: ignore[misc]

    def step(self) -> bool:
        """One step of the airframe; False once the landing is over."""
        return bool(_L.bt_flight_step(self._flight))

    def look(self) -> Dict[str, float]:
        """The present state: the columns of ``Landing.histories``, SI."""
        state: Dict[str, float] = {}

        def watch(_user: Any, line: Any) -> None:
            now = line.contents
            values = memoryview(c.string_at(now.values, 8 * now.count)).cast("d")
            state.update((lib.decode(now.names[i]), values[i]) for i in range(now.count))

        _L.bt_flight_look(self._flight, lib.LANDING_WATCH(watch), None)
        return state

    def copy(self) -> "Flight":
        """A flight of its own in the same state."""
        return Flight(lambda to: _L.bt_flight_copy(self._flight, to))

    def equals(self, other: "Flight") -> bool:
        """Whether both are equal to the bit in what decides how they go on."""
        return bool(_L.bt_flight_equal(self._flight, other._flight))

    def report(self) -> Dict[str, Any]:
        """What has become of it so far: the columns of ``Study.ledger`` from ``outcome`` on, and
        ``state_hash``."""
        from .study import _REPORT_COLUMNS, _report_row

        report = lib.bt_landing_report(size=c.sizeof(lib.bt_landing_report))
        status = _L.bt_flight_report(self._flight, c.byref(report))
        if status != 0:
            raise BY_STATUS[status](lib.decode(_L.bt_status_text(status)))  # type: ignore[misc]
        return dict(zip(_REPORT_COLUMNS, _report_row(report)))

    def __del__(self) -> None:
        if getattr(self, "_flight", None):
            _L.bt_flight_destroy(self._flight)
            self._flight = c.c_void_p()
