#!/usr/bin/env bash
# The map from the paper's equations to code, tests and pages, from the tags [Peng2023 Eq. N] in the
# sources, tests named eqN_* (or tagged), and "Eq. N" in docs/theory.
#
#   scripts/paper-map.sh           writes docs/paper-map.md
#   scripts/paper-map.sh --check   fails when an equation lacks code, test or page, or when the page
#                                  is older than the tags (line numbers aside)
set -euo pipefail
cd "$(dirname "$0")/.."

subjects=(
    "multibody system with constraints" "strut force, sum" "strut: air spring" "strut: oil damping"
    "strut: structural limit" "tyre: point of action" "tyre: direction" "tyre: lateral force"
    "hook damper" "hook on deck, Hertz" "cable: finite segments" "cable: axial stiffness"
    "cable: axial damping" "cable: bending stiffness" "cable: bending damping"
    "cable: twist stiffness" "cable: twist damping" "limit state" "support-vector classifier"
    "radial basis kernel")

# expand: lines file:line:Eqs. 2, 5-7 become "equation rank file:line", rank 1 where the tag is a
# range or a list, 0 where it names one equation
expand() {
    awk -F: '{
        text = $3; sub(/.*Eqs?\. ?/, "", text); gsub(/, */, " ", text)
        n = split(text, part, " ")
        for (i = 1; i <= n; ++i) {
            m = split(part[i], end, "-")
            for (e = end[1]; e <= end[m] && e <= 20; ++e) print e, (n > 1 || m > 1), $1 ":" $2
        }
    }'
}

# tests named after an equation
named() {
    grep -nHoE '^static void eq[0-9]+(_[0-9]+)?_' -r tests --include='test_*.c' | awk -F: '{
        text = $3; sub(/.*void eq/, "", text); sub(/_$/, "", text)
        print text + 0, 0, $1 ":" $2
    }'
}

number='Eqs?\. ?[0-9]+([-, ]+[0-9]+)*'
code=$(grep -nHoE "\[Peng2023 $number" -r src --include='*.[ch]' | expand)
tests=$(named; grep -nHoE "$number" -r tests --include='test_*.c' | expand)
pages=$(grep -nHoE "$number" -r docs/theory --include='*.md' | expand)

# of TABLE EQUATION LIMIT: its places, one per file, the most particular first
of() {
    awk -v e="$2" '$1 == e { print $2, $3 }' <<<"$1" | sort -t: -k1,1 -k2,2n | awk -F'[ :]' '!seen[$2]++' |
        sort -s -k1,1n | head -n "$3" | sed -E 's/^. (.*)/`\1`/' | paste -sd' '
}

missing=0
page() {
    echo "# Where each equation of the paper is"
    echo
    echo "Written by \`scripts/paper-map.sh\` from the tags in sources and tests; \`./dev lint\` checks it."
    echo "The paper: Peng et al., Chinese Journal of Aeronautics 36(1), 2023; its equations are missing from"
    echo "the text we have and are reconstructed on the theory pages."
    echo
    echo "| equation | what | code | tests | theory |"
    echo "| --- | --- | --- | --- | --- |"
    local e
    for e in $(seq 20); do
        echo "| $e | ${subjects[e - 1]} | $(of "$code" "$e" 4) | $(of "$tests" "$e" 3) | $(of "$pages" "$e" 2) |"
    done
}

for e in $(seq 20); do
    for kind in code tests pages; do
        [ -n "$(of "${!kind}" "$e" 1)" ] ||
            { echo "scripts/paper-map.sh: error: Eq. $e has no $kind" >&2; missing=1; }
    done
done
if [ "${1:-}" = --check ]; then
    strip() { sed -E 's/:[0-9]+`/`/g'; }
    diff <(page | strip) <(strip <docs/paper-map.md) >/dev/null ||
        { echo "docs/paper-map.md is out of date: run scripts/paper-map.sh" >&2; missing=1; }
else
    page >docs/paper-map.md
fi
exit $missing
