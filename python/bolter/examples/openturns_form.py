"""Reliability with a tool of your own: OpenTURNS calls Bolter's landings.

::

    python3 -m bolter.examples.openturns_form [LIMIT_MM [SAMPLES]]

With what probability does the hook's first bounce rise above a limit (70 mm)? Three random inputs;
FORM, subset simulation (SAMPLES per level, 500) and plain Monte Carlo (four times that) on the same
function, each with its count of landings. FORM replaces the limit state by a plane and has no interval; the two samplers have one,
and must agree with each other.
"""

from __future__ import annotations

import math
import sys
from typing import Any, List, Tuple

import bolter
from bolter.examples import needed

PATHS = ["landing.sink_speed", "landing.horizontal_speed", "landing.pitch"]
MEAN = [3.6, 47.5, math.radians(3)]
SD = [0.9, 2.5, math.radians(1.33)]


def bounce_study() -> bolter.Study:
    """The reference far before the wire, with a coarse cable: nothing meets it in this bounce."""
    coarse = [f"deck.cable.mesh.{part}_length=0.6 m" for part in ("fine", "medium", "coarse")]
    return bolter.Study.example("reference", [*coarse, "landing.distance=9 m"])


def event(ot: Any, study: bolter.Study, limit_m: float) -> Any:
    """The event: bounce height at or above the limit. OpenTURNS asks for whole samples."""

    def heights(sample: Any) -> List[Tuple[float]]:
        column = "bounce_height_m"
        # drawn sinking speeds of 0 or less touch the deck but hardly bounce
        rows = [[max(row[0], 0.05), row[1], row[2]] for row in sample]
        return [(height,) for height in study.map(rows, [column], paths=PATHS)[column]]

    function = ot.PythonFunction(3, 1, func_sample=heights)
    steps = [1e-2 * sd for sd in SD]
    function.setGradient(ot.CenteredFiniteDifferenceGradient(steps, function.getEvaluation()))
    inputs = ot.ComposedDistribution([ot.Normal(m, s) for m, s in zip(MEAN, SD)])
    output = ot.CompositeRandomVector(function, ot.RandomVector(inputs))
    return ot.ThresholdEvent(output, ot.GreaterOrEqual(), limit_m)


def form(ot: Any, wanted: Any) -> Tuple[float, float]:
    solver = ot.AbdoRackwitz()
    solver.setMaximumIterationNumber(50)
    algorithm = ot.FORM(solver, wanted, MEAN)
    algorithm.run()
    result = algorithm.getResult()
    return result.getEventProbability(), result.getHasoferReliabilityIndex()


def sampled(ot: Any, algorithm: Any) -> Tuple[float, float, float]:
    """Probability with its 95 % interval."""
    ot.RandomGenerator.SetSeed(1)
    algorithm.run()
    result = algorithm.getResult()
    p, half = result.getProbabilityEstimate(), 0.5 * result.getConfidenceLength(0.95)
    return p, max(p - half, 0.0), p + half


def subset(ot: Any, wanted: Any, samples: int) -> Any:
    algorithm = ot.SubsetSampling(wanted)
    algorithm.setMaximumOuterSampling(10)
    algorithm.setBlockSize(samples // 10)
    return algorithm


def monte_carlo(ot: Any, wanted: Any, samples: int) -> Any:
    algorithm = ot.ProbabilitySimulationAlgorithm(wanted, ot.MonteCarloExperiment())
    algorithm.setMaximumOuterSampling(4)
    algorithm.setBlockSize(samples)
    algorithm.setMaximumCoefficientOfVariation(0.0)
    return algorithm


def main() -> int:
    ot = needed("openturns", "python3-openturns")
    limit_m = 1e-3 * float(sys.argv[1]) if len(sys.argv) > 1 else 0.070
    samples = int(sys.argv[2]) if len(sys.argv) > 2 else 500
    print(f"probability that the hook's first bounce rises to {1e3 * limit_m:g} mm or more")
    with bounce_study() as study:
        wanted = event(ot, study, limit_m)
        function = wanted.getFunction()
        before = function.getEvaluationCallsNumber()

        def landings() -> int:
            nonlocal before
            now = function.getEvaluationCallsNumber()
            since, before = now - before, now
            return since

        p, beta = form(ot, wanted)
        print(f"FORM               {p:.2e}  (index {beta:.3f}), {landings()} landings")
        bounds = []
        for name, build in (("subset simulation", subset), ("Monte Carlo", monte_carlo)):
            p, low, high = sampled(ot, build(ot, wanted, samples))
            bounds.append((low, high))
            print(f"{name:18} {p:.2e}  95 % {low:.2e} .. {high:.2e}, {landings()} landings")
    agree = bounds[0][0] <= bounds[1][1] and bounds[1][0] <= bounds[0][1]
    print("the intervals agree" if agree else "the intervals do NOT agree")
    return 0 if agree else 1


if __name__ == "__main__":
    raise SystemExit(main())
