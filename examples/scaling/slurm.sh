#!/bin/sh
# slurm.sh PARTS TABLE RESULT [OPTION ...]: measures part $SLURM_ARRAY_TASK_ID of PARTS of a table, with the options of
# the command; leaves it in RESULT.parts.
# slurm.sh --join PARTS TABLE RESULT: puts the parts together in RESULT: the same bytes, complaints and exit status as
# those of `surfmink TABLE > RESULT`.
#
#   run="sh examples/scaling/slurm.sh"
#   job=$(sbatch --parsable --array=0-99 --mem=200M --wrap "$run 100 cells.tsv mu.tsv --max-rank 12")
#   sbatch --dependency=afterany:$job --wrap "$run --join 100 cells.tsv mu.tsv"
#
# Parts that are missing are named; to try some again: sbatch --array=7,12 --wrap "$run 100 ...", and join again.
# Other engines set SLURM_ARRAY_TASK_ID themselves: seq 0 99 | xargs -P 8 -I{} env SLURM_ARRAY_TASK_ID={} $run 100 ...
# SURFMINK is the command, if it is not `surfmink`.
here=${0%/*}
surfmink=${SURFMINK:-surfmink}

if [ "$1" != --join ]; then
    parts=$1 table=$2 result=$3 i=$SLURM_ARRAY_TASK_ID
    shift 3
    mkdir -p "$result.parts"
    at=$result.parts/$i
    rm -f "$at.status"
    {
        sh "$here/part.sh" "$i" "$parts" "$table" "$at.counts"
        echo $? > "$at.cut"
    } | "$surfmink" "$@" > "$at.out" 2> "$at.err"
    status=$?
    [ "$(cat "$at.cut")" -eq 0 ] || exit 1
    echo "$status" > "$at.now" && mv "$at.now" "$at.status" # last: what has a status is whole
    [ "$status" -ne 1 ] # refused outlines are no reason to stop an array
    exit
fi

parts=$2 table=$3 result=$4 i=0 missing=
while [ "$i" -lt "$parts" ]; do
    [ -f "$result.parts/$i.status" ] || missing="$missing $i"
    i=$((i + 1))
done
if [ "$missing" ]; then
    echo "slurm.sh: not finished:$missing" >&2
    exit 1
fi

i=0 before=0 rows=0 worst=0
: > "$result"
while [ "$i" -lt "$parts" ] && { [ "$worst" -eq 0 ] || [ "$worst" -eq 2 ]; }; do
    at=$result.parts/$i
    read -r names lines named < "$at.counts"
    read -r status < "$at.status"
    # The names stand in each part. Outlines without an id are numbered in each from 0.
    awk -v first="$i" -v rows="$rows" -v named="$named" '
        NR == 1 && /^id\t/ { if (first == 0) print; next }
        !named && match($0, /[0-9]+/) {
            $0 = substr($0, 1, RSTART - 1) sprintf("%.0f", rows + substr($0, RSTART, RLENGTH)) \
                substr($0, RSTART + RLENGTH)
        }
        { print }' "$at.out" >> "$result"
    # Each part has counted its lines for itself.
    awk -v before="$before" -v table="$table" '
        match($0, /^-:[0-9]+:/) {
            $0 = table ":" sprintf("%.0f", before + substr($0, 3, RLENGTH - 3)) substr($0, RLENGTH)
        }
        { print }' "$at.err" >&2
    before=$((before + lines))
    [ "$named" -eq 1 ] || rows=$((rows + $(grep -c -v '^id	' "$at.out")))
    [ "$status" -eq 0 ] || worst=$status # all but 0 and 2 end the loop: that run had ended
    i=$((i + 1))
done
exit "$worst"
