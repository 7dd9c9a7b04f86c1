#!/usr/bin/env bash
# Draws the figures of docs/theory with the program that was built: scripts/figures.sh [bolter]
set -euo pipefail
cd "$(dirname "$0")/.."

bolter=${1:-build/bolter}
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
for rig in nose-drop main-drop hook-rebound; do
    "$bolter" rig "$rig" studies/reference/study.yaml --quiet -o "$made"
done
"$bolter" sweep studies/reference/study.yaml --quiet -o "$made"
"$bolter" rig nose-static studies/rigs/currey.yaml --quiet -o "$made"
"$bolter" rig main-drop studies/rigs/open_main_gear.yaml --quiet -o "$made/open"
"$bolter" rig main-static studies/rigs/open_main_gear.yaml --quiet -o "$made/open"
mkdir -p docs/figures
for name in nose_drop_stroke main_drop_strut main_drop_tyre hook_rebound_height \
    hook_rebound_impact nose_static_strut fig14 fig15 fig16; do
    cp "$made/figures/$name.svg" docs/figures/
done
for name in main_drop_strut main_static_strut; do
    cp "$made/open/figures/$name.svg" "docs/figures/open_$name.svg"
done
