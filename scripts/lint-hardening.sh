#!/usr/bin/env bash
# What a program or shared library is built with against overruns: position independence, relocations
# that are read-only from the start (RELRO, BIND_NOW), a stack that cannot be run, stack protector,
# checked copies of the C library's functions (_FORTIFY_SOURCE).
#
#   scripts/lint-hardening.sh FILE...      says what is missing; exit code 1 if anything is
set -euo pipefail
bad=0
for file; do
    has() { # has WHAT READELF-OPTION PATTERN
        grep -qE "$3" <<<"$(readelf -W "$2" "$file")" || { echo "$file: $1 missing" >&2; bad=1; }
    }
    has "position independence (PIE)" -h 'Type: +DYN'
    has RELRO -l GNU_RELRO
    has BIND_NOW -d 'BIND_NOW|FLAGS.*NOW'
    has "stack that cannot be run" -l 'GNU_STACK.* RW '
    has "stack protector" --dyn-syms __stack_chk_fail
    has _FORTIFY_SOURCE --dyn-syms '__[a-z]+_chk(@|$)'
done
exit $bad
