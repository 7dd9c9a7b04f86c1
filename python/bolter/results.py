"""What calls give back: landings, rigs, fits, counts of a campaign."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple

from .table import Table


@dataclass(frozen=True)
class Key:
    """One key of a study."""

    path: str  #: "landing.sink_speed"
    unit: str  #: SI, as written: "m/s"; "" for ratios, counts, choices
    kind: str  #: "number", "count", "flag", "choice", "list", "table"
    equation: str  #: "Eq. 3"; "" where the paper has none
    text: str  #: meaning
    default: float  #: SI; numbers and counts only
    least: float
    greatest: float


@dataclass(frozen=True)
class Quantity:
    """One result of a landing."""

    name: str  #: "strut_stroke_max_left_m"
    unit: str  #: SI, as written; "" where there is none
    text: str  #: meaning


@dataclass(frozen=True)
class Cable:
    """Shapes of the cable: times [k], coordinates [k][segments], tension [k][segments - 1]; SI."""

    time_s: Any
    x_m: Any
    y_m: Any
    z_m: Any
    tension_N: Any


@dataclass(frozen=True)
class Landing:
    """One landing.

    ``values`` holds every number that `bolter keys --results` lists, SI; ``landing["margin_m"]`` and
    ``landing.margin_m`` read it. NAN where there is none (no meeting, no bounce).
    """

    outcome: str  #: "engaged", "missed", "failed"
    mode: str  #: "direct", "arm", "bounced_over", "passed_over", "ridden_over", ..., "none"
    failure: str  #: "element: quantity at time"; "" unless failed
    remarks: List[str]  #: "strut_bottomed left 0.125": what, element, time in s
    state_hash: int  #: equal for landings that are equal to the bit
    values: Dict[str, float]
    units: Dict[str, str]
    histories: Optional[Table] = None  #: one row per airframe step; land(histories=True)
    cable: Optional[Cable] = None  #: at most one shape per millisecond; land(histories=True)

    @property
    def engaged(self) -> bool:
        """The throat caught the cable."""
        return self.outcome == "engaged"

    @property
    def failed(self) -> bool:
        """The computation diverged: neither engaged nor missed."""
        return self.outcome == "failed"

    def __getitem__(self, name: str) -> float:
        return self.values[name]

    def __getattr__(self, name: str) -> float:
        try:
            return self.__dict__["values"][name]
        except KeyError:
            raise AttributeError(name) from None

    def unit(self, name: str) -> str:
        """SI unit of a result, as written."""
        return self.units[name]

    def __str__(self) -> str:
        margin = self.values.get("margin_m", math.nan)
        by = "" if math.isnan(margin) else f", margin {1e3 * margin:.1f} mm"
        return f"{self.outcome} ({self.mode}){by}"


@dataclass(frozen=True)
class Counts:
    """How far a campaign is."""

    total: int  #: landings of the design, or of this shard
    before: int  #: of them, in the ledger before the call
    done: int  #: of them, in the ledger now
    engaged: int
    missed: int
    failed: int
    seconds: float  #: since the call


@dataclass(frozen=True)
class Fit:
    """How good a classifier is."""

    inputs: List[str]  #: paths, in the order of a point
    trained_now: bool  #: False: the one on disk was up to date
    train_count: int
    train_correct: int  #: its own landings: no evidence of accuracy
    holdout_count: int
    holdout_correct: int
    holdout_ci95: Tuple[float, float]  #: Clopper-Pearson, of the share that is correct
    confusion: Tuple[Tuple[int, int], Tuple[int, int]]  #: [true][predicted]; 0 missed, 1 engaged
    constant: bool  #: every landing was of one kind
    C: float
    gamma: float
    support_vectors: int
    seconds: float


@dataclass(frozen=True)
class Metric:
    """One number of a rig."""

    name: str  #: with its unit: "stroke_max_m"
    unit: str
    value: float  #: NAN where it does not exist
    reference: float  #: measured value of the study; NAN where it gives none
    error_percent: float  #: of value against reference
    accepted: bool  #: no reference, or an error within the study's tolerance


@dataclass(frozen=True)
class Rig:
    """What a rig measured: ``rig["stroke_max_m"]`` is a value, ``rig.metrics`` the whole."""

    name: str
    metrics: Dict[str, Metric]
    histories: Table  #: one row per step; the columns of a measured curve, with units

    def __getitem__(self, name: str) -> float:
        return self.metrics[name].value
