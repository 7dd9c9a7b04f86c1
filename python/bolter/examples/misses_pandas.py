"""A campaign, and a look at its misses with pandas.

::

    python3 -m bolter.examples.misses_pandas [LANDINGS [DIRECTORY]]

Runs LANDINGS (256) of the reference study into DIRECTORY (a temporary one) and shows how landings
were missed, which inputs tell a miss from a catch, and the nearest misses.
"""

from __future__ import annotations

import sys
import tempfile
from typing import Any

import bolter
from bolter.examples import needed


def show_progress(counts: bolter.Counts) -> None:
    print(f"\r{counts.done} of {counts.total} landings", end="", file=sys.stderr)


def look(pandas: Any, study: bolter.Study) -> None:
    landings = study.ledger().frame()
    inputs = [name for name in landings.columns if "." in name]
    missed = landings[landings.outcome == "missed"]
    print(f"{len(missed)} of {len(landings)} missed\n")
    print("how they ended")
    print(landings.groupby(["outcome", "mode"]).size().to_string(), "\n")
    print("mean of the inputs (SI), and of the margin")
    columns = [*inputs, "margin_m", "first_bounce_height_m"]
    print(landings.groupby("outcome")[columns].mean().T.to_string(float_format="%.4g"), "\n")
    print("where along the deck: share missed by the distance to the wire")
    edges = pandas.cut(landings["landing.distance"], range(0, 14, 2))
    print((landings.outcome == "missed").groupby(edges).mean().to_string(float_format="%.2f"), "\n")
    print("nearest misses")
    nearest = missed.dropna(subset=["margin_m"]).nlargest(5, "margin_m")
    print(nearest[["run", *inputs, "mode", "margin_m"]].to_string(index=False))


def main() -> int:
    pandas = needed("pandas", "python3-pandas")
    landings = int(sys.argv[1]) if len(sys.argv) > 1 else 256
    with tempfile.TemporaryDirectory() as scratch, bolter.Study.example() as study:
        study["campaign.samples"] = landings
        study.directory = sys.argv[2] if len(sys.argv) > 2 else f"{scratch}/misses"
        study.campaign(progress=show_progress)
        print(file=sys.stderr)
        look(pandas, study)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
