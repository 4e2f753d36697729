#!/bin/sh
# part.sh PART PARTS TABLE [COUNTS]: prints one part of a table of outlines, with the line that names the columns, for
# the command to read. Parts count from 0; together they have every outline once, whole and in order.
#
#   for part in 0 1 2 3; do sh part.sh $part 4 cells.tsv | surfmink > mu.$part & done; wait
#
# It seeks: a part reads little more than its share of the file, so it does not matter how large the rest is. TABLE has
# to be a file. Part i begins at byte i / PARTS of it, or rather at the first outline that begins there: awk follows the
# lines from there until the id changes (without an id column: until a blank line). Where the next part begins is found
# in the same way, so that neither needs to know of the other. What lies between is copied as bytes, by head -c.
# COUNTS is a file for three numbers: lines up to that with the names, lines of the part, whether there is an id column.
# Separators, quotes, and which column is the id are as the command reads them. Lines end with \n or \r\n.
part=$1 parts=$2 table=$3 counts=$4
lone='lines end with \r alone'
LC_ALL=C # awk counts bytes
export LC_ALL
complain() {
    printf 'part.sh: %s\n' "$1" >&2
    exit 1
}
[ "$part" -ge 0 ] && [ "$part" -lt "$parts" ] || complain "which part of how many? PART is 0 ... PARTS - 1"
[ -f "$table" ] || complain "$table: not a file"

# Lines and their fields, as in examples/command/lines.h.
lines='
    function trim_end(text) { sub(/[ \t\v\f]+$/, "", text); return text }
    function is_blank(line) { return line ~ /^[ \t\v\f]*$/ }
    function is_comment(line) { return line ~ /^[ \t\v\f]*#/ }
    # Without its \r; a lone \r within would be the end of a line, too.
    function whole_line(line) {
        sub(/\r$/, "", line)
        if (index(line, "\r")) { lone = 1; exit }
        return line
    }
    function split_line(line, separator, field,    n, at, text) {
        if (separator == " ") line = trim_end(line)
        for (n = 1;; ++n) {
            sub(separator == "\t" ? "^ +" : "^[ \t\v\f]+", "", line)
            if (separator == "," && substr(line, 1, 1) == "\"") {
                line = substr(line, 2)
                text = ""
                while ((at = index(line, "\"")) && substr(line, at + 1, 1) == "\"") { # "" is one quote
                    text = text substr(line, 1, at)
                    line = substr(line, at + 2)
                }
                field[n] = at ? text substr(line, 1, at - 1) : text line
                line = at ? substr(line, at + 1) : ""
                at = index(line, ",")
            } else {
                at = separator == " " ? match(line, /[ \t\v\f]/) : index(line, separator)
                field[n] = trim_end(at ? substr(line, 1, at - 1) : line)
            }
            if (!at) return n
            line = substr(line, at + 1)
        }
    }'

# The names: their lines and bytes, what is between the fields, and which field is the id (0: none), as in table.h.
names=$(awk "$lines"'
    { bytes += length($0) + 1 }
    NR == 1 { sub(/^\357\273\277/, "") }
    { line = whole_line($0) }
    is_blank(line) || is_comment(line) { next }
    {
        line = trim_end(line)
        separator = index(line, "\t") ? "\t" : index(line, ",") ? "," : " "
        for (i = split_line(line, separator, name); i >= 1; --i)
            if (name[i] != "" && name[i] != "k" && (name[i] == "K" || tolower(name[i]) !~ /^(k|[xyz]|n[xyz]|lon|lat)$/))
                id = i
        word = separator == "\t" ? "tab" : separator == "," ? "comma" : "blank"
        printf "%d %.0f %s %d\n", NR, bytes, word, id
        exit
    }
    END { if (lone) print "lone" }' "$table")
[ "$names" ] || complain "$table: no line names the columns"
[ "$names" != lone ] || complain "$table: $lone"
set -- $names
names=$1 head=$2 separator=$3 id=$4
size=$(($(wc -c < "$table")))
[ "$size" -ge "$head" ] || head=$size # a line of names without an end

# cut PART: the byte at which this part begins. A line counts if it begins at PART / PARTS of the bytes or later:
# reading starts one byte early, and what is up to the first end of a line does not count.
cut() {
    at=$((head + (size - head) * $1 / parts))
    if [ "$1" -eq 0 ] || [ "$1" -eq "$parts" ]; then
        echo "$at"
        return
    fi
    tail -c +"$at" "$table" | awk -v at=$((at - 1)) -v separator="$separator" -v id="$id" -v size="$size" "$lines"'
        BEGIN { separator = separator == "tab" ? "\t" : separator == "comma" ? "," : " " }
        { here = at; at += length($0) + 1 }
        NR == 1 { next }
        {
            line = whole_line($0)
            if (is_blank(line)) gap = 1
            if (is_blank(line) || is_comment(line)) next
            if (id) {
                delete field[id]
                split_line(line, separator, field)
                begins = seen && field[id] != last
                seen = 1
                last = field[id] ""
            } else
                begins = gap
            if (begins) exit
        }
        END { if (lone) print "lone"; else printf "%.0f\n", begins ? here : size }'
}
from=$(cut "$part")
to=$(cut $((part + 1)))
[ "$from" != lone ] && [ "$to" != lone ] || complain "$table: $lone"

copy() { # dd moves the place in the file at which head begins
    [ "$from" -ge "$to" ] || { dd bs=1 skip="$from" count=0 2> /dev/null; head -c $((to - from)); } < "$table"
}
# The last line of a file may lack its end. ($(...) drops a \n, and nothing else.)
open=$([ "$from" -ge "$to" ] || [ "$to" -lt "$size" ] || tail -c 1 "$table")
head -n "$names" "$table"
copy
[ -z "$open" ] || echo
[ -z "$counts" ] || echo "$names $(($(copy | wc -l) + ${#open})) $((id > 0))" > "$counts"
