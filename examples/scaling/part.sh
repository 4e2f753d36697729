#!/bin/sh
# part.sh PART PARTS TABLE [COUNTS]: prints one part of a table of outlines, with the line that names the columns, for
# the command to read. Parts count from 0; together they have every outline once, whole and in order.
#
#   for part in 0 1 2 3; do sh part.sh $part 4 cells.tsv | surfmink > mu.$part & done; wait
#
# It seeks: a part reads little more than its share of the file, so it does not matter how large the rest is. TABLE has
# to be a file. Part i begins at byte i / PARTS of it, or rather at the first outline that begins there: the lines are
# followed from there until the id changes (without an id column: until a blank line). Where the next part begins is
# found in the same way, so that neither needs to know of the other.
# COUNTS is a file for three numbers: lines up to that with the names, lines of the part, whether there is an id column.
# Lines end with \n or \r\n. Fields in quotes are refused.
part=$1 parts=$2 table=$3 counts=${4-/dev/null}
LC_ALL=C # awk counts bytes
export LC_ALL
complain() {
    echo "part.sh: $1" >&2
    exit 1
}
[ "$part" -ge 0 ] && [ "$part" -lt "$parts" ] || complain "which part of how many? PART is 0 ... PARTS - 1"
[ -f "$table" ] || complain "$table: not a file"

# The names: their lines and bytes, what is between the fields, and which field is the id (0: none).
names=$(awk '
    { bytes += length($0) + 1 }
    NR == 1 { sub(/^\357\273\277/, "") }
    /^[ \t\v\f\r]*(#|$)/ { next }
    {
        sub(/\r$/, "")
        separator = index($0, "\t") ? "tab" : index($0, ",") ? "comma" : "blank"
        n = separator == "tab" ? split($0, name, "\t") : separator == "comma" ? split($0, name, ",") : split($0, name)
        for (i = n; i >= 1; --i) {
            gsub(/^[ \t\v\f]+|[ \t\v\f]+$/, "", name[i])
            if (name[i] != "" && name[i] !~ /^(k|x|y|z|nx|ny|nz|lon|lat)$/) id = i
        }
        printf "%d %.0f %s %d\n", NR, bytes, separator, id
        exit
    }' "$table")
[ "$names" ] || complain "$table: no line names the columns"
set -- $names
lines=$1 head=$2 separator=$3 id=$4
size=$(($(wc -c < "$table")))
[ "$size" -ge "$head" ] || size=$head
from=$((head + (size - head) * part / parts))
to=$((head + (size - head) * (part + 1) / parts))
[ "$to" -lt "$size" ] || to=$((size + 1)) # the last part ends with the file

head -n "$lines" "$table"
# Starting one byte early tells whether a line begins at `from`.
[ "$part" -eq 0 ] || from=$((from - 1))
tail -c +$((from + 1)) "$table" | awk -v at="$from" -v to="$to" -v whole="$((part == 0))" -v separator="$separator" \
    -v id="$id" -v names="$lines" -v counts="$counts" '
    # Does an outline begin with this line? Told by the lines since a boundary alone.
    function begins(boundary, answer) {
        answer = id ? seen[boundary] && is != last[boundary] : gap[boundary]
        seen[boundary] = 1
        last[boundary] = is
        return answer
    }
    { here = at; at += length($0) + 1 }
    NR == 1 && !whole { next }
    {
        if (separator == "comma" && index($0, "\"")) { quoted = 1; exit }
        blank = /^[ \t\v\f\r]*$/
        comment = /^[ \t\v\f]*#/
        if (blank) gap["from"] = 1
        if (blank && here >= to) gap["to"] = 1
        if (!blank && !comment) {
            if (id) {
                if (separator == "tab") split($0, field, "\t")
                else if (separator == "comma") split($0, field, ",")
                else split($0, field)
                is = field[id]
                gsub(/^[ \t\v\f\r]+|[ \t\v\f\r]+$/, "", is)
            }
            if (here >= to && begins("to")) exit
            if (!whole) whole = begins("from")
        }
        if (whole) { print; ++lines }
    }
    END {
        printf "%d %d %d\n", names, lines, (id > 0) > counts
        if (quoted) exit 3
    }'
status=$?
[ "$status" -ne 3 ] || complain "$table: fields in quotes"
exit "$status"
