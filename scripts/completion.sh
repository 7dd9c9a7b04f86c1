#!/usr/bin/env bash
# bash completion from the program itself: verbs, options of each verb, every key path.
#
#   scripts/completion.sh BUILD-DIRECTORY      writes BUILD-DIRECTORY/bolter.bash
set -euo pipefail
cd "$(dirname "$0")/.."
program=$1/bolter
out=$1/bolter.bash

verbs=$("$program" --help | sed -n '/^Verbs:/,/^$/p' | sed -n 's/^  \([a-z]*\)  .*/\1/p')

# full paths: "## a, b" opens a group at paths a and b; "(the study)" stands for none
paths=$("$program" keys | awk '
    /^## / { n = split(substr($0, 4), group, ", "); next }
    /^\|-/ || /^\| key / { next }
    /^\| / { key = $2; for (i = 1; i <= n; ++i) print group[i] "." key }' |
    sed -E 's/`//g' | grep -E '^[a-z_.]+$' | sort -u)

{
    echo "# bash completion of bolter; made by scripts/completion.sh"
    echo "_bolter_verbs='$(paste -sd' ' <<<"$verbs")'"
    echo "_bolter_keys='"
    echo "$paths"
    echo "'"
    echo "_bolter_options() {"
    echo "    case \$1 in"
    for verb in $verbs; do
        options=$("$program" "$verb" --help | grep -oE -- '(^| )--[a-z][a-z-]*=?' | tr -d ' ' | sort -u | paste -sd' ')
        echo "    $verb) echo '$options' ;;"
    done
    echo "    esac"
    echo "}"
    cat <<'TEXT'
_bolter() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "$_bolter_verbs --help --version" -- "$word"))
        return
    fi
    case $before in
    -s | --set | --key)
        COMPREPLY=($(compgen -W "$_bolter_keys" -- "$word"))
        [ "$before" = --key ] || COMPREPLY=("${COMPREPLY[@]/%/=}")
        compopt -o nospace
        return
        ;;
    esac
    case $word in
    -*)
        COMPREPLY=($(compgen -W "$(_bolter_options "$verb")" -- "$word"))
        [[ ${COMPREPLY[0]:-} == *= ]] && compopt -o nospace
        ;;
    *) COMPREPLY=($(compgen -f -- "$word")) && compopt -o filenames ;;
    esac
}
complete -F _bolter bolter
TEXT
} >"$out"
echo "$out"
