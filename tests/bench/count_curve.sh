#!/bin/sh
# count_curve.sh PROGRAM: instructions a corner of a build of curve.c, counted by valgrind's callgrind: the table of
# docs/internals/beyond.md. Ten calls less none, over 1000 corners.
if ! command -v valgrind > /dev/null; then
    echo 'count_curve.sh: needs valgrind' >&2
    exit 1
fi

# instructions SURFACE WHAT CALLS
instructions() {
    LD_BIND_NOW=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$@" 2>&1 |
        awk '$2 == "Collected" { print $4; found = 1 } END { exit !found }'
}

program=$1
printf '\n%s: instructions a corner\n%-10s%10s%10s%10s%10s\n' "${program##*/}" \
    surface measure 'order 4' 'errors 2' 'errors 4'
for surface in plane sphere embedded; do
    printf '%-10s' "$surface"
    for what in 0 1 2 3; do
        none=$(instructions "$surface" "$what" 0) && ten=$(instructions "$surface" "$what" 10) || exit 1
        echo "$none $ten" | awk '{ printf "%10.0f", ($2 - $1) / 10000 }'
    done
    echo
done
