#!/usr/bin/env bash
# The library has no writable globals: no object in .data, .bss or thread storage. Constants with
# addresses in them (.data.rel.ro) are made read-only when the library is loaded.
#
#   scripts/lint-globals.sh LIBRARY.a
set -euo pipefail
symbols=$(objdump -t "$1")
[ "$(grep -c ' \.rodata' <<<"$symbols")" -gt 0 ] || { echo "$1: no symbols" >&2; exit 1; }
writable=$(grep -E ' O (\.data|\.bss|\.tdata|\.tbss|\*COM\*)(\.[^r][^[:space:]]*)?[[:space:]]' <<<"$symbols" || true)
[ -z "$writable" ] || { echo "writable globals: $writable" >&2; exit 1; }
