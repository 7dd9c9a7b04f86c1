#!/usr/bin/env bash
# Manual pages from the program itself: one per verb by help2man, bolter-study(5) from the tables of
# keys.
#
#   scripts/man.sh BUILD-DIRECTORY      writes BUILD-DIRECTORY/man
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
program=$build/bolter
man=$build/man
mkdir -p "$man"
version=$("$program" --version | head -n 1 | awk '{ print $2 }')
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
date=$(date -u -d "@$SOURCE_DATE_EPOCH" +%F)

# page NAME SUMMARY ARGUMENT... : bolter-NAME(1) from what the program says about itself
page() {
    local name=$1 summary=$2
    shift 2
    local script=$man/.$name
    printf '#!/bin/sh\n[ "$1" = --version ] && { echo "bolter %s"; exit; }\nexec %q %s --help\n' \
        "$version" "$PWD/$program" "$*" >"$script"
    chmod +x "$script"
    help2man --no-info --no-discard-stderr --section=1 --source="Bolter $version" \
        --manual="Bolter" --name="$summary" --output="$man/$name.1" "$script" 2>/dev/null ||
        help2man --no-info --section=1 --source="Bolter $version" --manual="Bolter" \
            --name="$summary" --output="$man/$name.1" "$script"
    sed -i "s|\\.$name|$name|g; s|^\\.TH BOLTER |.TH ${name^^} |; s|^bolter \\\\- |$name \\\\- |" "$man/$name.1"
    rm -f "$script"
}

page bolter "probability that an arresting hook catches the wire"
while read -r verb summary; do
    page "bolter-$verb" "$summary" "$verb"
done < <("$program" --help | sed -n '/^Verbs:/,/^$/p' | sed -n 's/^  \([a-z]*\)  *\(.*\)/\1 \2/p')

# bolter-study(5): each table of keys as a list
{
    printf '.TH BOLTER-STUDY 5 "%s" "Bolter %s" "Bolter"\n' "$date" "$version"
    printf '.SH NAME\nbolter-study \\- the study file of bolter: every key\n.SH DESCRIPTION\n'
    "$program" keys | awk '
        function roff(text) { gsub(/\\/, "\\\\", text); gsub(/`/, "", text); gsub(/-/, "\\-", text)
            sub(/^[.\x27]/, "\\\\\\&&", text); return text }
        function trim(text) { gsub(/^ +| +$/, "", text); return text }
        /^# / { next }
        /^## / { print ".SH " toupper(roff(substr($0, 4))); next }
        /^\|-/ || /^\| key / { next }
        /^\|/ {
            gsub(/\\\|/, "\001"); split($0, c, "|"); for (i in c) gsub(/\001/, "|", c[i])
            print ".TP\n.B " roff(trim(c[2]))
            line = trim(c[7])
            unit = trim(c[3]); fallback = trim(c[4]); range = trim(c[5]); paper = trim(c[6])
            if (unit != "") line = line ". Unit: " unit
            if (fallback != "") line = line ". Default: " fallback
            if (range != "") line = line ". Range: " range
            if (paper != "") line = line ". Paper: " paper
            print roff(line) "."
            next
        }
        { print roff($0) }'
    printf '.SH SEE ALSO\n.BR bolter (1),\n.BR bolter-keys (1)\n'
} >"$man/bolter-study.5"
echo "$man"
