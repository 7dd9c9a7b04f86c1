#!/usr/bin/env bash
# Installs the library from a build directory into a scratch place, builds examples/ against what
# was installed (CMake target and pkg-config), and runs them.
#
#   scripts/clients.sh BUILD-DIRECTORY
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

cmake --install "$build" --prefix "$prefix" >/dev/null
cmake -S examples -B "$scratch/examples" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_BUILD_TYPE=Release --log-level=WARNING >/dev/null
ninja -C "$scratch/examples" --quiet

# plain C users: pkg-config, shared and static; C++ reads the headers too
libdir=$(dirname "$(find "$prefix" -name bolter.pc)")
export PKG_CONFIG_PATH=$libdir LD_LIBRARY_PATH=$libdir/..
# shellcheck disable=SC2046
cc -Wall -Werror examples/drop_test.c -o "$scratch/shared" $(pkg-config --cflags --libs bolter) -lm
# shellcheck disable=SC2046
cc -Wall -Werror examples/drop_test.c -o "$scratch/static" $(pkg-config --cflags bolter) \
    "$libdir/../libbolter.a" $(pkg-config --static --libs bolter | sed 's/-lbolter//')
for header in "$prefix"/include/bolter/*.h; do
    cc -x c -std=c11 -Wall -Wextra -pedantic -Werror -fsyntax-only -I"$prefix/include" "$header"
done

# only what the headers document is visible
nm -D --defined-only "$libdir/../libbolter.so" | awk '{print $3}' | sort >"$scratch/visible"
sed -n 's/.*\b\(bt_[a-z_]*\)(.*/\1/p' "$prefix"/include/bolter/*.h | sort -u >"$scratch/documented"
undocumented=$(comm -23 "$scratch/visible" "$scratch/documented")
[ -z "$undocumented" ] || { echo "visible but not documented: $undocumented" >&2; exit 1; }

study=$prefix/share/bolter/studies/reference/study.yaml
run() {
    echo "== $1"
    "$scratch/examples/$@"
}
run landing "$study" landing.distance 8
run drop_test studies/rigs/open_nose_gear.yaml nose_drop examples/drop.csv
"$scratch/static" studies/rigs/open_nose_gear.yaml nose_drop examples/drop.csv >"$scratch/a"
"$scratch/shared" studies/rigs/open_nose_gear.yaml nose_drop examples/drop.csv >"$scratch/b"
cmp "$scratch/a" "$scratch/b"
run reliability "$study" 64 "$scratch/reliability" uncertainty.landing.pitch.sd "0.8 deg" \
    reliability.samples 20000 reliability.high_fidelity_runs 0
run campaign "$study" 64 "$scratch/campaign" 2>/dev/null
# Python, from the installed files alone
if command -v python3 >/dev/null; then
    (cd "$scratch" && unset LD_LIBRARY_PATH &&
        PYTHONPATH=$prefix/lib/python3/dist-packages python3 -m bolter.examples.drop_test_fit)
fi
echo "clients: every example built against the installed library and ran"
