#!/bin/sh
# test_relax.sh RELAX TISSUE SURFMINK: does the energy of a tissue fall at every step, and is it that of what is
# written? Run it from the root of the repository.
. "$(dirname "$0")/harness.sh"
relax=$(absolute "$1")
tissue=$(absolute "$2")
surfmink=$(absolute "$3")
cd "$work" || exit 1

# energy FILE: as its first line says.
energy() {
    sed -n '1s/.*energy \([^,]*\),.*/\1/p' "$1"
}

# last COLUMN: of the log.
last() {
    tail -n 1 log | cut -f "$1"
}

# --- down, and never up -----------------------------------------------------------------------------------------------

"$tissue" --cells 60 --relax 1 --axes 90,60,50 > wild 2> err
for rank in 6 2 3; do
    "$relax" --axes 90,60,50 --rank $rank --steps 120 --log log < wild > calm 2> err
    check "rank $rank: succeeds" "$? $(cat err)" "0 "
    check "rank $rank: many steps" "$(awk 'END { print (NR > 20 ? "yes" : NR) }' log)" yes
    check "rank $rank: the energy falls at every step" \
        "$(awk 'NR > 2 && !($2 < before) { print "up at step", $1 } { before = $2 }' log)" ""
    check "rank $rank: mu rises" "$(awk 'NR == 2 { first = $4 } END { print ($4 > first + 0.1 ? "yes" : $4) }' log)" yes
    check "rank $rank: the table has the energy of the last step" "$(energy calm)" "$(last 2)"
    "$relax" --axes 90,60,50 --rank $rank --steps 0 < calm > again
    check "rank $rank: read again, it is the same to the digit" "$(energy again)" "$(energy calm)"
    "$surfmink" calm > measured 2> err
    check "rank $rank: surfmink measures all cells" "$? $(cat err)" "0 "
    mean=$(awk -v name="mu_$rank" -F '\t' '/^#/ { next }
        !column { for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
        { sum += $column; ++n } END { print sum / n }' measured)
    near "rank $rank: and finds the same mean mu" "$mean" "$(last 4)" 2e-6
done

# Where nothing is to be gained the gradient is 0.
"$tissue" --cells 60 --relax 1 --axes 90,60,50 | "$relax" --axes 90,60,50 --steps 1000 --log log > calm
check "at rest the gradient is a thousandth of what it was" \
    "$(awk 'NR == 2 { first = $3 } END { print ($3 < first / 1000 ? "yes" : $3) }' log)" yes

# Corners that are shared stay shared: every corner of a closed tissue belongs to three cells.
check "three cells at each corner" "$(awk 'NR > 2' calm | cut -f 2-4 | sort | uniq -c | awk '{ print $1 }' | sort -u)" 3
# In another unit the energy is the same.
"$tissue" --cells 60 --relax 1 --axes 180,120,100 | "$relax" --axes 180,120,100 --steps 10 > big
"$relax" --axes 90,60,50 --steps 10 < wild > small
near "twice as large: the same energy" "$(energy big)" "$(energy small)" 1e-6

# --- what is refused --------------------------------------------------------------------------------------------------

# refuses MESSAGE ARGUMENT...: with `in` as standard input; a message on standard error, nothing on standard output.
refuses() {
    want=$1
    shift
    "$relax" "$@" < in > out 2> err
    check "relax $*" "$? $(cat err) $(cat out)" "1 relax: $want "
}

cp wild in
refuses '--bogus: no such option (see relax --help)' --bogus 1
refuses '--rank: a value is missing (see relax --help)' --rank
refuses '--rank: must be a number from 1 to 24 (see relax --help)' --rank 0
refuses '--rank: must be a number from 1 to 24 (see relax --help)' --rank 25
refuses '--rank: must be a whole number (see relax --help)' --rank 2.5
refuses '--reward: must be a number from 0 to 100 (see relax --help)' --reward x
refuses '--perimeter: must be a number from 0 to 100 (see relax --help)' --perimeter -1
refuses '--shape: must be a number from 0 to 100 (see relax --help)' --shape 1e9
refuses '--steps: must be a number from 0 to 1e+06 (see relax --help)' --steps nan
refuses '--axes: must be three numbers from 1e-6 to 1e6 with commas between, as 110,50,40 (see relax --help)' --axes 1,2
refuses 'nowhere/log: No such file or directory (see relax --help)' --axes 90,60,50 --log nowhere/log
refuses 'line 5: the corner is not on the ellipsoid (--axes says which)' --axes 90,60,51
printf '' > in
refuses 'standard input: holds no cells (see relax --help)'
printf 'x\ty\n' > in
refuses 'line 1: the columns are not cell, x, y, z'
printf 'cell\tx\ty\tz\n\t1\t2\t3\n' > in
refuses 'line 2: does not begin with the name of a cell'
printf 'cell\tx\ty\tz\n1\t110\t0\n' > in
refuses 'line 2: x, y or z is not a number'
printf 'cell\tx\ty\tz\n1\t110\t0\t0\n1\t0\t50\t0\n' > in
refuses 'cell 1: a polygon needs at least 3 corners'
printf 'cell\tx\ty\tz\n1\t0\t50\t0\n1\t110\t0\t0\n1\t0\t0\t40\n' > in
refuses 'cell 1: the corners run clockwise (their turning angles add up to less than 0)'
"$relax" --help > out
has 'help names the options' out '--reward A'

if [ -w /dev/full ]; then
    full='relax: standard output: No space left on device (see relax --help)'
    "$relax" --help > /dev/full 2> err
    check "help on a full disk" "$? $(cat err)" "1 $full"
    "$relax" --axes 90,60,50 --steps 0 < wild > /dev/full 2> err
    check "a full disk" "$? $(cat err)" "1 $full"
    "$relax" --axes 90,60,50 --steps 0 --log /dev/full < wild > out 2> err
    check "a log on a full disk" "$? $(cat err)" "1 relax: /dev/full: cannot be written (see relax --help)"
fi

totals
