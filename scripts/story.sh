#!/usr/bin/env bash
# Writes docs/story.md: does the reference study tell the paper's story? Landings of the full model,
# no surrogate. About two minutes on two cores.
#
# usage: scripts/story.sh [BOLTER]     (default: build/bolter)
set -euo pipefail
cd "$(dirname "$0")/.."
bolter=${1:-build/bolter}
study=studies/reference/study.yaml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
landings=400

# share MEAN_OF=VALUE D_MEAN D_SD: engaged share of fresh landings with one mean moved
share() {
    "$bolter" campaign "$study" --quiet --json -o "$work/$RANDOM$RANDOM" \
        --set campaign.design=monte_carlo --set campaign.samples=$landings \
        --set "uncertainty.landing.distance.mean=$2" --set "uncertainty.landing.distance.sd=$3" \
        --set "uncertainty.landing.$1" >"$work/answer.json"
    awk -F'[:,}]' -v n=$landings '{for (i = 1; i < NF; ++i) if ($i ~ /"engaged"/) {printf "%.3f", $(i + 1) / n; exit}}' \
        RS='\0' "$work/answer.json"
}

exec >docs/story.md
echo "# Does it tell the paper's story?"
echo
echo "Written by \`scripts/story.sh\`: landings of the full model, no surrogate."
echo
echo "## Distance (Fig. 22), the other inputs frozen at their means"
echo
echo "| D, m | outcome | margin, mm |"
echo "| --- | --- | --- |"
for d in 0.5 1 1.5 2 2.5 3 4 5 6 7 7.5 8 8.5 9 10 11 12; do
    "$bolter" land "$study" --json --set "landing.distance=$d m" >"$work/answer.json"
    awk -v d=$d 'BEGIN {RS = "\0"} {
        match($0, /"outcome": *"[a-z]*"/); o = substr($0, RSTART, RLENGTH); gsub(/.*: *"|"/, "", o)
        match($0, /"margin_m": *[-0-9.e]*/); m = substr($0, RSTART, RLENGTH); sub(/.*: */, "", m)
        printf "| %s | %s | %+.1f |\n", d, o, 1000 * m }' "$work/answer.json"
done
cat <<'TEXT'

Low while the hook is in its first bounce (below 2.5 m; the paper says 4 m), high from 3 to 7 m, lowest of all at 8 m, where the main
wheels have just beaten the cable down, and up again after. Negative margins are misses.

## One mean moved, everything else scattering (Figs. 19-21)

TEXT
echo "Share engaged of $landings landings each (one standard error is about 0.013)."
echo
echo "| mean | D from N(6 m, 2 m) | D from N(5 m, 1.5 m) |"
echo "| --- | --- | --- |"
for moved in "sink_speed.mean=3 m/s" "sink_speed.mean=4.5 m/s" "sink_speed.mean=6 m/s" \
    "pitch.mean=2 deg" "pitch.mean=5 deg" "pitch.mean=8 deg" \
    "horizontal_speed.mean=41 m/s" "horizontal_speed.mean=47.5 m/s" "horizontal_speed.mean=54 m/s"; do
    echo "| ${moved/.mean=/ } | $(share "$moved" "6 m" "2 m") | $(share "$moved" "5 m" "1.5 m") |"
done
cat <<'TEXT'

Read with its errors: for D about 5 m the reliability falls with the sinking velocity, as in the paper; for D about 6 m it does not move by more
than the error. With the pitch it hardly moves between 2 and 5 deg and falls clearly beyond, for both spreads. With the horizontal
velocity it falls by 5 to 6 points between 41 and 54 m/s, for both spreads: here the paper has almost no change. The distance matters most, as
in the paper.
TEXT
