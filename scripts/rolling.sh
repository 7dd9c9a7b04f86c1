#!/bin/sh
# Rolling in with the hook at several distances behind the main wheels: engaged or missed, by speed and by the
# height of the lip. Prints a Markdown table for docs/theory/rolling.md.
# Usage: scripts/rolling.sh [STUDY.yaml]; BOLTER names the program. Overridden by the environment: SPEEDS (m/s),
# COUPLINGS (m), LIPS (mm), THROAT (mm: a low lip needs a longer one), LIFT (share of the weight).
set -eu
cd "$(dirname "$0")/.."
bolter=${BOLTER:-build/bolter}
study=${1:-studies/reference/study.yaml}
speeds=${SPEEDS:-40 50 60}
couplings=${COUPLINGS:-1.2 2.2 3 4 5 6 7}
lips=${LIPS:-30 13}
lift=${LIFT:-0.3}
throat=${THROAT:-45}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# One run with the pivot at $1 (m): the coupling length, from where the hook stands when the wheels are 25 m away.
coupling() {
    "$bolter" land "$study" --set landing.start=rolling --set aircraft.lift_ratio="$lift" \
        --set "aircraft.hook.pivot_x=$1 m" --set landing.distance='25 m' \
        --set landing.distance_from=main_wheels -o "$work/run.csv" >/dev/null
    awk -F, '/^time/ { for (i = 1; i <= NF; ++i) if ($i == "hook_shoe_x [m]") x = i; next }
             x { printf "%.6f", -25 - $x; exit }' "$work/run.csv"
}

at_5=$(coupling -5)
set -- $speeds
printf '| hook behind the wheels | lip |'
for v; do printf ' %s m/s |' "$v"; done
printf '\n| --- | --- |'
for v; do printf ' --- |'; done
printf '\n'
for c in $couplings; do
    pivot=$(awk -v c="$c" -v at="$at_5" 'BEGIN { printf "%.6f", -5 + at - c }')
    for lip in $lips; do
        printf '| %s m | %s mm |' "$c" "$lip"
        for v; do
            "$bolter" land "$study" --json --set landing.start=rolling --set aircraft.lift_ratio="$lift" \
                --set "aircraft.hook.pivot_x=$pivot m" --set "landing.horizontal_speed=$v m/s" \
                --set "aircraft.hook.profile.lip_height=$lip mm" --set "aircraft.hook.profile.throat_length=$throat mm" \
                --set landing.distance='25 m' \
                --set landing.distance_from=main_wheels >"$work/run.json"
            sed -n 's/.*"outcome": *"\([a-z]*\)".*/\1/p' "$work/run.json" | tr -d '\n' | sed 's/^/ /'
            sed -n 's/.*"margin_m": *\([-0-9.e]*\).*/\1/p' "$work/run.json" |
                awk '{ printf ", %.0f mm |", 1000 * $1 }'
        done
        printf '\n'
    done
done
