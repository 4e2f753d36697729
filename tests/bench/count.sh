#!/bin/sh
# count.sh PROGRAM...: instructions a corner, of builds of bench.c, counted by valgrind's callgrind: repeatable to the
# digit, whatever else the machine does. Each program is run with and without one pass of a column over 4096 corners (or
# eight outlines); all that is not the column cancels. Instructions of libm count, too: those of the variant that libm
# picks on this machine, whatever the program was compiled for.
if ! command -v valgrind > /dev/null; then
    echo 'count.sh: needs valgrind' >&2
    exit 1
fi

# instructions PROGRAM COLUMN SURFACE SET RANK REPEAT
instructions() {
    LD_BIND_NOW=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        "$1" --count "$2" --surface "$3" --set "$4" --rank "$5" --repeat "$6" 2>&1 |
        awk '$1 == "corners" { corners = $2 }
             $2 == "Collected" { print $4, corners; found = 1 }
             END { exit !found }'
}

# row PROGRAM SURFACE SET RANK: one line of the table.
row() {
    printf '%-10s%-8s%4d' "$2" "$3" "$4"
    before=$(instructions "$1" B "$2" "$3" "$4" 0) || exit 1
    for column in A B C D single steps batch; do
        case $2$column in
        plane?* | *[!CD]) ;;
        *) printf '%10s' - && continue ;;
        esac
        after=$(instructions "$1" "$column" "$2" "$3" "$4" 1) || exit 1
        echo "$before $after" | awk '{ printf "%10.1f", ($3 - $1) / $4 }'
    done
    echo
}

for program in "$@"; do
    printf '\n%s: instructions a corner\n%-10s%-8s%4s%10s%10s%10s%10s%10s%10s%10s\n' "${program##*/}" \
        surface set P A B C D single steps batch
    for surface in plane sphere embedded; do
        for set in q6 ragged q40 q1000; do
            for rank in 6 12; do row "$program" "$surface" "$set" "$rank"; done
        done
    done
done
