"""Fits two numbers of a leg to a recorded drop, by Gauss-Newton steps over the drop rig.

::

    python3 -m bolter.examples.drop_test_fit

The recording is no measurement: another integration of the same leg made it (studies/rigs). The
fit starts 10 and 15 % away and must come back to the numbers of the file. Pure Python: numpy is
not needed.
"""

from __future__ import annotations

from bisect import bisect_left
from typing import Any, List, Sequence

import bolter

PARAMETERS = {  # path: where the fit starts
    "aircraft.nose_gear.oleo.discharge": 0.76,
    "aircraft.nose_gear.oleo.air_volume": 4.2e-3,
}
CURVES = {"stroke_m": 1e-3, "tyre_force_N": 1e3}  # followed, and what counts as an error of 1


def interpolated(x: Sequence[float], xs: Sequence[float], ys: Sequence[float]) -> List[float]:
    """ys over xs, on the straight line between neighbours, at every x."""
    values = []
    for at in x:
        i = min(max(bisect_left(xs, at), 1), len(xs) - 1)
        share = (at - xs[i - 1]) / (xs[i] - xs[i - 1])
        values.append(ys[i - 1] + share * (ys[i] - ys[i - 1]))
    return values


def residuals(study: bolter.Study, values: Sequence[float], recording: bolter.Table) -> List[float]:
    """Simulated minus recorded at every recorded time, each curve in its own unit of error."""
    for path, value in zip(PARAMETERS, values):
        study[path] = value
    histories = study.rig("nose_drop").histories
    times = list(histories["time_s"])
    all_of_them: List[float] = []
    for name, error in CURVES.items():
        simulated = interpolated(recording["time_s"], times, list(histories[name]))
        all_of_them += [(s - r) / error for s, r in zip(simulated, recording[name])]
    return all_of_them


def gauss_newton(function: Any, start: Sequence[float], steps: int = 6) -> List[float]:
    """The two numbers that make the sum of squares least; derivatives by 0.1 % differences."""
    x = list(start)
    for _ in range(steps):
        r = function(x)
        columns = []
        for i in range(2):
            moved = [v * (1.001 if k == i else 1) for k, v in enumerate(x)]
            columns.append([(b - a) / (0.001 * x[i]) for a, b in zip(r, function(moved))])
        p, q = columns
        pp, pq, qq = dot(p, p), dot(p, q), dot(q, q)
        pr, qr = dot(p, r), dot(q, r)
        whole = pp * qq - pq * pq
        x = [x[0] - (qq * pr - pq * qr) / whole, x[1] - (pp * qr - pq * pr) / whole]
    return x


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum(u * v for u, v in zip(a, b))


def rms(values: Sequence[float]) -> float:
    return (dot(values, values) / len(values)) ** 0.5


def main() -> int:
    recording = bolter.read_history(bolter.find_shipped("examples/drop.csv"))
    file = bolter.find_shipped("studies/rigs/open_nose_gear.yaml")
    with bolter.Study.open_rigs(file) as study:
        right = [study[path] for path in PARAMETERS]
        start = list(PARAMETERS.values())
        before = rms(residuals(study, start, recording))
        found = gauss_newton(lambda x: residuals(study, x, recording), start)
        after = rms(residuals(study, found, recording))
    print(f"{'key':40} {'start':>10} {'found':>10} {'in file':>10}")
    for path, *numbers in zip(PARAMETERS, start, found, right):
        print(f"{path:40} " + " ".join(f"{v:10.6f}" for v in numbers))
    print(f"root mean square of the residuals: {before:.3f} before, {after:.3f} after")
    near = all(abs(f / r - 1) < 2e-3 for f, r in zip(found, right))
    print("the numbers of the file were found" if near else "the numbers of the file were NOT found")
    return 0 if near else 1


if __name__ == "__main__":
    raise SystemExit(main())
