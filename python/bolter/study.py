"""A study: its keys, its landings, its campaign, its classifier, its rigs."""

from __future__ import annotations

import ctypes as c
import math
import os
import threading
import warnings
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

from . import _library as lib
from .errors import BY_STATUS, ArgumentError, BolterError, BolterWarning, Message
from .flight import Flight
from .points import Block, block
from .results import Cable, Counts, Fit, Key, Landing, Metric, Quantity, Rig
from .table import Table, column

Path = Union[str, "os.PathLike[str]"]
Value = Union[float, int, bool, str, list, tuple, dict]

_L = lib.LIBRARY
_CABLE_INTERVAL_S = 1e-3


def keys() -> List[Key]:
    """Every key of the model with unit, range and meaning, in the order of `bolter keys`."""
    found: List[Key] = []

    def visit(_user: Any, key: Any) -> bool:
        k = key.contents
        texts = [lib.decode(t) for t in (k.path, k.unit, k.kind, k.equation, k.text)]
        found.append(Key(*texts, default=k.fallback, least=k.least, greatest=k.greatest))
        return True

    _L.bt_keys(lib.KEY_VISIT(visit), None)
    return found


def results() -> List[Quantity]:
    """Every result of a landing with unit and meaning, in the order of `bolter keys --results`."""
    found: List[Quantity] = []

    def visit(_user: Any, info: Any) -> bool:
        i = info.contents
        found.append(Quantity(lib.decode(i.name), lib.decode(i.unit), lib.decode(i.text)))
        return True

    _L.bt_results(lib.RESULT_VISIT(visit), None)
    return found


def modes() -> List[str]:
    """The ways to catch or miss; a mode in a table is a place in this list."""
    found: List[str] = []
    while (label := _L.bt_mode_label(len(found))) is not None:
        found.append(lib.decode(label))
    return found


def _flow(value: Value) -> str:
    """A value as a study file writes it on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_flow(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k}: {_flow(v)}" for k, v in value.items()) + "}"
    return str(value)


class _Callback:
    """A Python function called by C: an exception in it stops the call and is raised after it."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.error: Optional[BaseException] = None

    def __call__(self, *arguments: Any) -> bool:
        if self.error is not None:
            return False
        try:
            return self.function(*arguments) is not False
        except BaseException as error:  # KeyboardInterrupt too: it must not be lost in C
            self.error = error
            return False

    def raise_again(self) -> None:
        if self.error is not None:
            raise self.error


class _Rows:
    """Lines of a history as they come: names once, values as bytes."""

    def __init__(self) -> None:
        self.names: List[str] = []
        self.rows: List[bytes] = []
        self.timed = False  # whether the lines hold their time

    def add(self, line: Any) -> None:
        if not self.names:
            self.names = [lib.decode(line.names[i]) for i in range(line.count)]
            self.timed = "time_s" in self.names
            if not self.timed:
                self.names.insert(0, "time_s")
        row = c.string_at(line.values, 8 * line.count)
        self.rows.append(row if self.timed else bytes(c.c_double(line.time_s)) + row)

    def table(self) -> Table:
        return Table.of_rows(self.names, b"".join(self.rows))


class _CableRows:
    """Shapes of the cable, at most one a millisecond, and the last."""

    def __init__(self) -> None:
        self.times: List[float] = []
        self.parts: Tuple[List[Any], ...] = ([], [], [], [])
        self.last: Optional[Tuple[float, Tuple[bytes, ...]]] = None

    def add(self, line: Any) -> None:
        if line.cable_count < 2:
            return
        n = line.cable_count
        due = not self.times or line.time_s >= self.times[-1] + _CABLE_INTERVAL_S
        addresses = (line.cable_x_m, line.cable_y_m, line.cable_z_m, line.cable_tension_N)
        shape = tuple(
            c.string_at(address, 8 * (n - (i == 3))) for i, address in enumerate(addresses)
        )
        self.last = None if due else (line.time_s, shape)
        if due:
            self._keep(line.time_s, shape)

    def _keep(self, time_s: float, shape: Tuple[bytes, ...]) -> None:
        self.times.append(time_s)
        for part, row in zip(self.parts, shape):
            part.append(memoryview(row).cast("d").tolist())

    def cable(self) -> Optional[Cable]:
        if self.last is not None:
            self._keep(*self.last)
            self.last = None
        return Cable(column(self.times), *map(column, self.parts)) if self.times else None


class Study:
    """A study in memory. One thread at a time may use it; several studies may be used at once.

    ::

        with bolter.Study.open("study.yaml") as study:
            study["landing.sink_speed"] = "4.5 m/s"   # or 4.5, in SI
            print(study.land())
    """

    # --- opening and closing ----------------------------------------------------------------

    def __init__(self, opener: Callable[[Any, Any], int], what: str) -> None:
        """Use ``open``, ``open_rigs``, ``from_text`` or ``defaults``."""
        self._said: List[str] = []
        self._lock = threading.Lock()
        said = self._said
        self._message = lib.MESSAGE(lambda _user, text: said.append(lib.decode(text)))
        self._case = c.c_void_p()
        self._fit_inputs: List[str] = []
        self._check(opener(self._message, c.byref(self._case)), what)

    @classmethod
    def open(cls, path: Path, sets: Sequence[str] = ()) -> "Study":
        """Reads and checks a study file.

        :param sets: texts ``PATH=VALUE`` with units, as ``--set`` on the command line
        :raises InputError: what is wrong with it, each with file, line and column
        :raises FileError: it cannot be read
        """
        name, texts = os.fsencode(path), lib.texts(list(sets))
        return cls(lambda m, to: _L.bt_case_open(name, texts, len(sets), m, None, to), str(path))

    @classmethod
    def open_rigs(cls, path: Path, sets: Sequence[str] = ()) -> "Study":
        """As ``open`` for a file that may describe no more than rigs; then only ``rig`` works."""
        name, texts = os.fsencode(path), lib.texts(list(sets))
        return cls(lambda m, to: _L.bt_case_open_rigs(name, texts, len(sets), m, None, to), str(path))

    @classmethod
    def from_text(cls, text: str, name: str = "study.yaml") -> "Study":
        """Reads a study from YAML text; ``name`` stands for the file in messages and names the
        study directory. The text cannot name other files."""
        data = text.encode()
        file = name.encode()
        return cls(lambda m, to: _L.bt_case_open_text(file, data, len(data), m, None, to), name)

    @classmethod
    def defaults(cls, name: str = "study.yaml") -> "Study":
        """Every key at its default."""
        file = name.encode()
        return cls(lambda m, to: _L.bt_case_open_defaults(file, m, None, to), name)

    @classmethod
    def example(cls, name: str = "reference", sets: Sequence[str] = ()) -> "Study":
        """A study that is shipped with Bolter; its directory is ``name``, here."""
        study = cls.open(lib.find_study(name), sets)
        study.directory = name
        return study

    def close(self) -> None:
        """Releases the study; a second time does nothing."""
        if self._case:
            _L.bt_case_close(self._case)
            self._case = c.c_void_p()

    def __enter__(self) -> "Study":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_case", None):
            self.close()

    def _check(self, status: int, summary: str = "") -> None:
        """Raises what a status says; of a success, warns with what was said."""
        messages = [Message.parse(text) for text in self._said]
        self._said.clear()
        if status == 0:
            for message in messages:
                warnings.warn(str(message), BolterWarning, stacklevel=3)
            return
        text = lib.decode(_L.bt_status_text(status))
        kind = BY_STATUS[status] if 0 < status < len(BY_STATUS) else BolterError
        raise kind(f"{summary}: {text}" if summary else text, messages)  # type: ignore[misc]

    def _call(self, function: Callable[..., int], *arguments: Any, summary: str = "") -> None:
        """Calls the library with this study, alone."""
        if not self._case:
            raise ArgumentError("the study is closed")
        if not self._lock.acquire(blocking=False):
            raise ArgumentError("the study is in use: one call at a time")
        try:
            self._check(function(self._case, *arguments), summary)
        finally:
            self._lock.release()

    # --- keys -------------------------------------------------------------------------------

    def set(self, path: str, value: Value) -> None:
        """Sets any key of the study.

        :param path: "landing.sink_speed", "uncertainty.landing.pitch", "campaign.samples"
        :param value: a text as ``--set`` takes it ("4 deg"); a number, SI, where the key is a
            number; a list or a dictionary of such, for lists, tables and distributions
        :raises ArgumentError: no such key, or a value outside its range; nothing is changed
        :raises InputError: the same for a text; nothing is changed
        """
        if not isinstance(value, (str, bool, list, tuple, dict)) and path in _numbers():
            self._call(_L.bt_case_set, path.encode(), float(value), summary=path)
        else:
            text = _flow(value).encode()
            self._call(_L.bt_case_set_text, path.encode(), text, summary=path)

    def get(self, path: str) -> float:
        """A number of the model, SI."""
        value = c.c_double()
        self._call(_L.bt_case_get, path.encode(), c.byref(value), summary=path)
        return value.value

    __setitem__ = set
    __getitem__ = get

    @staticmethod
    def keys() -> List[Key]:
        """Every key of the model, with unit, range and meaning."""
        return keys()

    def _own_text(self, function: Callable[[Any], bytes]) -> str:
        if not self._case:
            raise ArgumentError("the study is closed")
        return lib.decode(function(self._case))

    @property
    def title(self) -> str:
        return self._own_text(_L.bt_case_title)

    @property
    def text(self) -> str:
        """The whole study as one YAML text, changes applied."""
        return self._own_text(_L.bt_case_text)

    @property
    def directory(self) -> str:
        """Where ledger, classifier and results are kept; made when it is needed."""
        return self._own_text(_L.bt_case_directory)

    @directory.setter
    def directory(self, path: Path) -> None:
        self._call(_L.bt_case_set_directory, os.fsencode(path), summary=str(path))

    def __repr__(self) -> str:
        return f"<Study {self.title!r}>" if self._case else "<Study, closed>"

    # --- landings ---------------------------------------------------------------------------

    def land(self, histories: bool = False) -> Landing:
        """Runs one landing. One that diverges is a result (``failed``), no exception.

        :param histories: keep time histories and the shapes of the cable
        :raises InputError: aircraft or cable cannot be assembled
        """
        report = lib.bt_landing_report(size=c.sizeof(lib.bt_landing_report))
        rows, cable = _Rows(), _CableRows()

        def watch(_user: Any, line: Any) -> None:
            rows.add(line.contents)
            cable.add(line.contents)

        seen = _Callback(watch)
        hook = lib.LANDING_WATCH(seen) if histories else lib.LANDING_WATCH()
        definition = lib.bt_landing_def(c.sizeof(lib.bt_landing_def), hook)
        self._call(_L.bt_case_land_watched, c.byref(definition), c.byref(report))
        seen.raise_again()
        return Landing(
            **_report_texts(report),
            state_hash=report.state_hash,
            values=self._values(),
            units={q.name: q.unit for q in _numeric_results(self)},
            histories=rows.table() if histories else None,
            cable=cable.cable() if histories else None,
        )

    def flight(self) -> Flight:
        """The landing of the study as it is now, at its start, to be stepped and looked at; it may
        outlive the study."""
        return Flight(self._create_flight)

    def _create_flight(self, to: Any) -> int:
        self._call(_L.bt_flight_create, to)
        return 0

    def _values(self) -> Dict[str, float]:
        value = c.c_double()
        to, case, read = c.byref(value), self._case, _L.bt_case_result
        numbers = {}
        for quantity in _numeric_results(self):
            if read(case, quantity.name.encode(), to) == 0:
                numbers[quantity.name] = value.value
        return numbers

    def map(
        self,
        points: Any,
        columns: Sequence[str] = ("outcome", "margin_m"),
        paths: Optional[Sequence[str]] = None,
        threads: int = 0,
        progress: Optional[Callable[[int, int], Any]] = None,
    ) -> Table:
        """Runs one landing per point on all cores; other keys are the study's.

        :param points: a mapping of paths to columns [n] or single numbers, a pandas DataFrame
            whose columns are paths, or rows [n x len(paths)] with ``paths``; SI
        :param columns: names of results (``bolter.results()``). ``outcome`` is 1 engaged, 0
            missed, NAN failed; ``mode`` a place in ``bolter.modes()``
        :param threads: 0: one per core that the process may use; the values do not depend on it
        :param progress: called with (done, count) a few times a second; False stops
        :returns: a column [n] per name. Points that cannot be landed are failed ones
        :raises ArgumentError: an unknown path or column
        :raises InterruptedRunError: progress returned False
        """
        names, rows = block(points, paths)
        values = Block.empty(rows.count, len(columns))
        pulse = _Callback(lambda _user, done, count: progress(done, count) if progress else True)
        path_texts, column_texts = lib.texts(names), lib.texts(list(columns))
        definition = lib.bt_batch_def(
            size=c.sizeof(lib.bt_batch_def),
            path_count=len(names),
            paths=path_texts,
            count=rows.count,
            points=rows.address,
            column_count=len(columns),
            columns=column_texts,
            threads=threads,
            progress=lib.BATCH_PROGRESSED(pulse),
        )
        self._stoppable(pulse, _L.bt_case_land_batch, c.byref(definition), values.address)
        units = {q.name: q.unit for q in results()}
        return Table({name: values.column(i) for i, name in enumerate(columns)}, units)

    def _stoppable(self, pulse: _Callback, function: Callable[..., int], *arguments: Any) -> None:
        """A call that a callback may stop: its exception goes before the library's."""
        try:
            self._call(function, *arguments)
        except BolterError:
            pulse.raise_again()
            raise
        pulse.raise_again()

    # --- campaign and classifier ------------------------------------------------------------

    def campaign(
        self,
        progress: Optional[Callable[[Counts], Any]] = None,
        shard: int = 0,
        shards: int = 0,
    ) -> Counts:
        """Runs what the ledger in ``directory`` lacks of the study's design.

        :param progress: called about five times a second; False stops, everything finished kept
        :param shards: only landings whose number is ``shard`` modulo ``shards``; 0: all
        :raises InterruptedRunError: progress returned False
        :raises FailedRunsError: more failed than the study allows; all are done
        """
        pulse = _Callback(lambda _user, n: progress(_counts(n.contents)) if progress else True)
        definition = lib.bt_campaign_def(
            c.sizeof(lib.bt_campaign_def), shard, shards, lib.CAMPAIGN_PROGRESSED(pulse)
        )
        counts = lib.bt_campaign_counts()
        self._stoppable(pulse, _L.bt_case_campaign, c.byref(definition), c.byref(counts))
        return _counts(counts)

    def ledger(self) -> Table:
        """The landings of the ledger in order of number.

        Columns: ``run``; the inputs by path, SI; ``log_density`` (natural logarithm, NAN unknown);
        ``outcome`` and ``mode`` (texts), ``retained``, ``margin_m``, peak loads, bounces, strokes
        and tyre forces per leg, ``remarks``, ``failure``, ``state_hash``.
        """
        names: List[str] = []
        rows: List[List[Any]] = []

        def visit(_user: Any, row: Any) -> bool:
            r = row.contents
            if not names:
                paths = [lib.decode(r.inputs[i]) for i in range(r.input_count)]
                names.extend(["run", *paths, "log_density", *_REPORT_COLUMNS])
            rows.append([r.run, *r.values[: r.input_count], r.log_density, *_report_row(r.report)])
            return True

        walk = _Callback(visit)
        self._stoppable(walk, _L.bt_case_ledger, lib.CAMPAIGN_VISIT(walk), None)
        units = {key.path: key.unit for key in keys()}
        return Table({n: column(v) for n, v in zip(names, zip(*rows))}, units)

    def fit(self, again: bool = False) -> Fit:
        """Trains the classifier on the ledger, or takes the one on disk when it is up to date.

        :param again: train even then
        :raises FileError: there is no ledger
        """
        report = lib.bt_fit_report(size=c.sizeof(lib.bt_fit_report))
        definition = lib.bt_fit_def(c.sizeof(lib.bt_fit_def), again)
        self._call(_L.bt_case_fit, c.byref(definition), c.byref(report))
        count = _L.bt_case_fit_inputs(self._case)
        self._fit_inputs = [lib.decode(_L.bt_case_fit_input(self._case, i)) for i in range(count)]
        plain = {name: getattr(report, name) for name in _FIT_NUMBERS}
        return Fit(
            inputs=list(self._fit_inputs),
            holdout_ci95=tuple(report.holdout_ci95),
            confusion=tuple(tuple(row) for row in report.confusion),
            **plain,
        )

    def predict(self, points: Any) -> Any:
        """Decision values [n] of points: engaged when above 0. Points as ``map`` takes them; rows
        stand in the order of ``fit().inputs``."""
        if not self._fit_inputs:
            raise ArgumentError("no classifier yet: call fit() first")
        _, rows = block(points, self._fit_inputs)
        values = Block.empty(rows.count, 1)
        self._call(_L.bt_case_predict, rows.address, rows.count, values.address)
        return values.column(0)

    def reliability(self, progress: Optional[Callable[[int, int], Any]] = None) -> Table:
        """The probability that the hook catches the wire, for every condition of the study.

        Uses the ledger and the classifier, which is trained when it is not up to date. One row
        per condition in the study's order, last the study as it stands (``parameter`` ""); columns:
        ``parameter``, ``unit``, ``value`` (the mean of that input, SI); ``corrected`` (classifier
        and landings together: the number to defend) with ``corrected_low``, ``corrected_high``
        and the parts ``corrected_sampling``, ``corrected_unseen`` of its half-width; ``reweighted``
        (landings alone), ``surrogate`` (classifier alone) with their intervals;
        ``effective_landings``, ``outside_share``, ``landings``. Intervals at 95 %; NAN: not found.

        :param progress: called with (done, total) after each condition; False stops
        :raises FileError: there is no ledger
        """
        rows: List[Tuple[Any, ...]] = []
        seen = _Callback(lambda _user, line: rows.append(_reliability_row(line.contents)))
        pulse = _Callback(lambda _user, done, total: progress(done, total) if progress else True)
        definition = lib.bt_reliability_def(
            c.sizeof(lib.bt_reliability_def), lib.RELIABILITY_PROGRESSED(pulse)
        )
        visit = lib.RELIABILITY_VISIT(seen)
        self._stoppable(pulse, _L.bt_case_reliability, c.byref(definition), visit, None)
        seen.raise_again()
        return Table({n: column(v) for n, v in zip(_RELIABILITY_COLUMNS, zip(*rows))})

    # --- rigs -------------------------------------------------------------------------------

    def rig(self, name: str, histories: bool = True) -> Rig:
        """Runs a rig of the study.

        :param name: "nose_drop", "main_drop", "hook_rebound", "nose_static", "main_static"
        :param histories: keep them; without, rigs of several studies run at once in threads
        :returns: metrics against the study's references, and histories [steps]
        :raises ArgumentError: no such rig, or the study does not describe it
        """
        rows = _Rows()
        seen = _Callback(lambda _user, line: rows.add(line.contents))
        watch = lib.RIG_WATCH(seen) if histories else lib.RIG_WATCH()
        definition = lib.bt_rig_def(c.sizeof(lib.bt_rig_def), name.encode(), watch)
        metrics = (lib.bt_rig_metric * _METRICS_MAX)()
        count = c.c_int()
        call = (c.byref(definition), metrics, _METRICS_MAX, c.byref(count))
        self._call(_L.bt_case_rig, *call, summary=name)
        seen.raise_again()
        found = [_metric(metrics[i]) for i in range(min(count.value, _METRICS_MAX))]
        return Rig(name, {m.name: m for m in found}, rows.table())


# --- helpers --------------------------------------------------------------------------------

_METRICS_MAX = 128
_LEGS = ("nose", "left", "right")
_FIT_NUMBERS = (
    "trained_now",
    "train_count",
    "train_correct",
    "holdout_count",
    "holdout_correct",
    "constant",
    "C",
    "gamma",
    "support_vectors",
    "seconds",
)
_REPORT_NUMBERS = (
    "retained",
    "margin_m",
    "throat_force_peak_N",
    "hook_deck_force_peak_N",
    "cable_tension_max_N",
    "bounces",
    "first_bounce_height_m",
    "first_bounce_distance_m",
)
_REPORT_COLUMNS = (
    "outcome",
    "mode",
    *_REPORT_NUMBERS,
    *(f"strut_stroke_max_{leg}_m" for leg in _LEGS),
    *(f"tyre_force_max_{leg}_N" for leg in _LEGS),
    "remarks",
    "failure",
    "state_hash",
)


def _report_texts(report: Any) -> Dict[str, Any]:
    remarks = lib.decode(report.remarks)
    return {
        "outcome": "failed" if report.failed else "engaged" if report.engaged else "missed",
        "mode": lib.decode(report.mode),
        "remarks": remarks.split("; ") if remarks else [],
        "failure": lib.decode(report.failure),
    }


def _report_row(report: Any) -> Iterator[Any]:
    texts = _report_texts(report)
    yield texts["outcome"]
    yield texts["mode"]
    for name in _REPORT_NUMBERS:
        yield getattr(report, name)
    yield from report.strut_stroke_max_m
    yield from report.tyre_force_max_N
    yield "; ".join(texts["remarks"])
    yield texts["failure"]
    yield report.state_hash


_RELIABILITY_COLUMNS = (
    "parameter",
    "unit",
    "value",
    *(
        f"{kind}{end}"
        for kind in ("corrected", "reweighted", "surrogate")
        for end in ("", "_low", "_high")
    ),
    "corrected_sampling",
    "corrected_unseen",
    "effective_landings",
    "outside_share",
    "landings",
)


def _reliability_row(r: Any) -> Tuple[Any, ...]:
    return (
        lib.decode(r.parameter),
        lib.decode(r.unit),
        r.value,
        r.corrected,
        *r.corrected_ci95,
        r.reweighted,
        *r.reweighted_ci95,
        r.surrogate,
        *r.surrogate_ci95,
        r.corrected_sampling,
        r.corrected_unseen,
        r.effective_landings,
        r.outside_share,
        r.landings,
    )


def _counts(n: Any) -> Counts:
    return Counts(n.total, n.before, n.done, n.engaged, n.missed, n.failed, n.seconds)


def _metric(m: Any) -> Metric:
    name, unit = lib.decode(m.name), lib.decode(m.unit)
    return Metric(name, unit, m.value, m.reference, m.error_percent, m.accepted)


_cache: Dict[str, Any] = {}


def _numbers() -> Dict[str, Key]:
    """Keys that are numbers, by path."""
    if "numbers" not in _cache:
        _cache["numbers"] = {k.path: k for k in keys() if k.kind in ("number", "count")}
    return _cache["numbers"]


def _numeric_results(study: Study) -> List[Quantity]:
    """Results that are numbers: known once a landing was made."""
    if "results" not in _cache:
        value = c.c_double()
        _cache["results"] = [
            q
            for q in results()
            if _L.bt_case_result(study._case, q.name.encode(), c.byref(value)) == 0
        ]
    return _cache["results"]
