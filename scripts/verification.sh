#!/usr/bin/env bash
# Writes docs/verification.md: every row "| problem | quantity | got | reference | error | tolerance |
# source |" that the verify and valid tests print when BT_TABLES is set. Fails when a test fails. What
# follows "# Measured once" stays as it is: comparisons too long to be repeated each time.
#
# usage: scripts/verification.sh [BUILD_DIRECTORY]     (default: build)
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
out=docs/verification.md
new=$(mktemp "$out.XXXXXX")
trap 'rm -f "$new"' EXIT

cat >"$new" <<'TEXT'
# Verification

Written by `scripts/verification.sh` after `./dev build`: each row is printed by the test that checks it. Numbers in SI units unless
the row says otherwise; the error is absolute. Rows whose tolerance equals their error are convergence records: the test checks
the order over three step sizes, not the size.
TEXT

failed=0
for group in verify valid; do
    for source in tests/"$group"/test_*.c; do
        [ -e "$source" ] || continue
        name=$(basename "$source" .c)
        rows=$(BT_TABLES=1 BOLTER="$(realpath "$build")/bolter" "$build/tests/$name" 2>/dev/null) || {
            echo "$name: failed" >&2
            failed=1
        }
        rows=$(grep '^| ' <<<"$rows" || true)
        [ -n "$rows" ] || continue
        # the first paragraph of the file's comment says what the test shows
        about=$(sed -n '/^\/\/\/ /!q; s/^\/\/\/ \?//p' "$source")
        {
            printf '\n## %s/%s\n\n%s\n\n' "$group" "$name" "$about"
            echo '| problem | quantity | got | reference | error | tolerance | source |'
            echo '| --- | --- | --- | --- | --- | --- | --- |'
            echo "$rows"
        } >>"$new"
    done
done
[ "$failed" -eq 0 ] || exit 1
if grep -q '^# Measured once' "$out"; then
    { echo; sed -n '/^# Measured once/,$p' "$out"; } >>"$new"
fi
chmod 644 "$new"
mv "$new" "$out"
trap - EXIT
echo "$out"
