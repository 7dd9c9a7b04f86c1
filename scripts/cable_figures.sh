#!/usr/bin/env bash
# Draws the figures of docs/theory/{cable,tyre_on_cable,hook_on_cable,outcome}.md from the
# verification tests and the reference study.
#
# usage: scripts/cable_figures.sh [BUILD_DIRECTORY]     (default: build, after ./dev build)
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Transverse impact: what was computed beside the theory, from slack and from 15.5 kN.
BT_TABLES=1 "$build/tests/test_cable_waves" 2>/dev/null |
    sed -n 's/^| impact \([0-9.]*\) m.s, T0 = \([0-9.]*\) kN | \(tension\|speed\)[^|]*| \([^ ]*\) | \([^ ]*\) .*/\2 \3 \1 \4 \5/p' >"$work/impact"
# A wheel over the reference cable: the second of two crossings.
BT_CURVES=1 "$build/tests/test_wheel_over_cable" 2>/dev/null |
    awk '$1 == "curve" { if ($2 < before) ++run; before = $2; if (run == 1) print $2, $3, $4, $5 }' >"$work/crossing"
# The head, and where a rope that comes level first touches it.
BT_CURVES=1 "$build/tests/test_lip" 2>/dev/null >"$work/head"
for zone in shoe point throat arm; do
    awk -v zone=$zone '$1 == "outline" { if ($2 == zone) print $3, $4; else if ($2 == "gap") print "" }' "$work/head" >"$work/$zone"
done
for rise in 5 20 29 45; do
    awk -v want=0.0$(printf %02d $rise) '$1 == "touch" && !seen && ($4 - want) ^ 2 < 1e-8 { print $2, $3; seen = 1 }' "$work/head"
done >"$work/ropes"
# Margin and mode over the distance, the other inputs at their means.
for tenth in $(seq 5 110); do
    "$build/bolter" land studies/reference/study.yaml --json \
        --set "landing.distance=$((tenth / 10)).$((tenth % 10)) m" |
        awk -v d="$((tenth / 10)).$((tenth % 10))" -F'[:,]' '
            /"mode"/ { gsub(/[ "]/, "", $2); mode = $2 }
            /"margin_m"/ { margin = $2 }
            END { print d, 1000 * margin, mode }'
done >"$work/margin"

mkdir -p docs/figures
gnuplot <<PLOT
set terminal svg size 900,560 font "sans,14" background "#ffffff" noenhanced
set grid lc rgb "#dddddd"
set style line 1 lw 2 lc rgb "#1f5fa8"
set style line 2 lw 2 lc rgb "#c0392b"
set style line 3 lw 2 lc rgb "#2e7d32"
set style line 4 lw 2 lc rgb "#555555"

set output "docs/figures/cable_impact.svg"
set xlabel "speed of the struck point [m/s]"
set ylabel "tension behind the front [kN]"
set y2label "speed of the kink [m/s]"
set ytics nomirror
set y2tics
set key top left
set yrange [0:230]
set y2range [0:230]
plot "< grep '^0 tension' $work/impact" using 3:(\$5/1e3) with lines ls 1 title "tension from slack, theory", \
     "< grep '^0 tension' $work/impact" using 3:(\$4/1e3) with points pt 7 ps 0.8 lc rgb "#1f5fa8" title "computed", \
     "< grep '^15.5 tension' $work/impact" using 3:(\$5/1e3) with lines ls 2 title "tension from 15.5 kN, theory", \
     "< grep '^15.5 tension' $work/impact" using 3:(\$4/1e3) with points pt 7 ps 0.8 lc rgb "#c0392b" title "computed", \
     "< grep '^15.5 speed' $work/impact" using 3:5 axes x1y2 with lines ls 3 title "kink from 15.5 kN, theory (right)", \
     "< grep '^15.5 speed' $work/impact" using 3:4 axes x1y2 with points pt 7 ps 0.8 lc rgb "#2e7d32" title "computed"
unset y2label
unset y2tics
set autoscale

set output "docs/figures/tyre_on_cable.svg"
set xlabel "time [ms]"
set ylabel "underside of the cable above the deck [mm]"
set xrange [0:200]
set yrange [-5:105]
set key outside top center horizontal
plot "$work/crossing" using (1e3*\$1):(1e3*\$2) with lines ls 1 title "in the wheel's track", \
     "" using (1e3*\$1):(1e3*\$3) with lines ls 2 title "0.3 m from the middle", \
     "" using (1e3*\$1):(1e3*\$4) with lines ls 3 title "over the support"
set autoscale

set output "docs/figures/hook_on_cable.svg"
set xlabel "forward [mm]"
set ylabel "above the lowest point of the shoe [mm]"
set size ratio -1
set key outside right
set style fill transparent solid 0.2 border lc rgb "#555555"
set yrange [-5:200]
plot "$work/ropes" using (1e3*\$1):(1e3*\$2):(18.25) with circles lc rgb "#555555" title "rope at first touch", \
     "$work/shoe" using (1e3*\$1):(1e3*\$2) with lines ls 4 title "shoe", \
     "$work/point" using (1e3*\$1):(1e3*\$2) with lines ls 2 title "point", \
     "$work/throat" using (1e3*\$1):(1e3*\$2) with lines ls 3 title "throat", \
     "$work/arm" using (1e3*\$1):(1e3*\$2) with lines ls 1 title "arm"
set size noratio
set autoscale

set output "docs/figures/outcome_margin.svg"
set xlabel "distance from the hook's touchdown to the cable [m]"
set ylabel "margin [mm]"
set key inside vertical top left
set xzeroaxis lw 1 lc rgb "#000000"
plot "$work/margin" using 1:2 with lines lw 1 lc rgb "#bbbbbb" notitle, \
     "< grep -w arm $work/margin" using 1:2 with points pt 7 ps 0.6 lc rgb "#1f5fa8" title "engaged, arm", \
     "< grep -w ridden_over $work/margin" using 1:2 with points pt 7 ps 0.6 lc rgb "#c0392b" title "missed, ridden_over"
PLOT
