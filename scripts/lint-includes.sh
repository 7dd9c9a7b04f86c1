#!/usr/bin/env bash
# Includes point only down the staircase: a source of one floor may include its own floor and the
# ones below it, and the public headers (bolter/). A params.h, the field tables of a floor, that
# includes no more than base may be included from below: a study holds the tables of all.
set -euo pipefail
cd "$(dirname "$0")/.."

floors=(base mechanics elements cable landing rigs study campaign statistics surrogate reliability
    calibration pipeline report api cluster cli)
declare -A height
for i in "${!floors[@]}"; do height[${floors[i]}]=$i; done

bad=0
for floor in "${floors[@]}"; do
    while IFS=: read -r file line text; do
        included=$(sed -E 's/.*"([a-z_]+)\/.*/\1/' <<<"$text")
        [ "$included" = bolter ] && continue
        if [ -z "${height[$included]:-}" ]; then
            echo "$file:$line: error: \"$included\" is no floor of src/"
            bad=1
        elif [ "${height[$included]}" -gt "${height[$floor]}" ]; then
            [[ $text == *"$included/params.h\""* ]] &&
                ! grep '^#include' "src/$included/params.h" | grep -qv '"base/' && continue
            echo "$file:$line: error: $floor may not include $included, which lies above it"
            bad=1
        fi
    done < <(grep -nHE '^ *# *include *"[a-z_]+/' -r "src/$floor" --include='*.[ch]' || true)
done
exit $bad
