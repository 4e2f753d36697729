#!/bin/sh
# test_outlines.sh BUILD: holds the command `outlines` in BUILD to what its --help promises, pipes it into `surfmink`
# and paints the numbers back; and holds the tables of docs/images.md to what BUILD/test_outlines measures. Needs only
# a POSIX shell. Run it from the root of the repository.
. "$(dirname "$0")/harness.sh"
build=$(absolute "$1")
outlines=$build/outlines surfmink=$build/surfmink rasterise=$build/image/rasterise
page=$PWD/docs/images.md
cd "$work" || exit 1
tab=$(printf '\t')

# --- harness ----------------------------------------------------------------------------------------------------------

# run ARGUMENT...: the command, with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$outlines" "$@" < in > out 2> err
    status=$?
}

# refuses MESSAGE ARGUMENT...: status 1, exactly that on standard error, nothing on standard output, no file.
refuses() {
    want=$1
    shift
    rm -f new.off new.tsv new.tif
    run "$@"
    check "status of outlines $*" $status 1
    check "complaint of outlines $*" "$(cat err)" "$want"
    check "output of outlines $*" "$(cat out)$(ls new.* 2> /dev/null)" ""
}

# column FILE NAME: of a table.
column() {
    awk -F '\t' -v name="$2" '
        /^#/ { next }
        !names { names = 1; for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
        { print column ? $column : "no such column" }' "$1"
}

# cells FILE: the labels in a table of outlines.
cells() {
    column "$1" cell | uniq | tr '\n' ' '
}

: > in
cat > four.pgm << 'END'
P2 # two cells above, two below
8 6
9
0 0 0 0 0 0 0 0
0 1 1 1 2 2 2 0
0 1 1 1 2 2 2 0
0 3 3 3 4 4 4 0
0 3 3 3 4 4 4 0
0 0 0 0 0 0 0 0
END

# --- what is left out -------------------------------------------------------------------------------------------------

# report FILE ARGUMENT...: labels and statuses, and that of the run.
report() {
    run "$@" --report report.tsv
    awk 'NR > 1 { printf "%s %s ", $1, $4 }' report.tsv
    echo "$status"
}
echo 'P2 4 8 9 0 0 0 0 1 1 1 1 0 0 0 0 0 1 1 0 0 1 1 0 0 1 1 0 0 0 0 0 0 0 0 0' > ring.pgm
for points in pixels curve junctions; do
    check "a ring round the image and a patch, $points" "$(report ring.pgm --wrap x --points $points)" "1 winds 2"
done
# Cell 3 is a cup that holds 1 and 2: its junctions are those of the bay, and run round it.
awk 'function in_box(r0, r1, c0, c1) { return r >= r0 && r < r1 && c >= c0 && c < c1 }
    BEGIN { print "P2 22 16 3"; for (r = 0; r < 16; ++r) for (c = 0; c < 22; ++c)
        print in_box(2, 8, 6, 11) ? 1 : in_box(2, 8, 11, 16) ? 2 : 3 * in_box(2, 14, 2, 20) }' > cup.pgm
check "a cup, its junctions" "$(report cup.pgm --points junctions)" "1 ok 2 ok 3 turned 2"
check "a cup, drawn as a curve" "$(report cup.pgm)" "1 ok 2 ok 3 ok 0"
# Two cells with a line of 0 between them that ends a pixel from the border of the image: sharing it out cuts neither.
awk 'BEGIN { print "P2 23 12 2"; for (r = 0; r < 12; ++r) for (c = 0; c < 23; ++c)
    print (r < 1 || r > 10 || c < 1 || c == 11 || c > 21 ? 0 : c < 11 ? 1 : 2) }' > two.pgm
check "lines beside the border" "$(report two.pgm --lines)" "1 ok 2 ok 0"

# --- what comes out ---------------------------------------------------------------------------------------------------

run --help
check "help succeeds" $status 0
check "help leads with examples" "$(sed -n 3p out)" "EXAMPLES"
check "help is no complaint" "$(cat err)" ""

run four.pgm --points pixels
check "status" $status 0
check "small cells are measured with a word" "$(cat err)" \
    "four.pgm: measured, but of fewer than 20 pixels: 4 (1 2 3 4)"
check "where it comes from" "$(sed -n 1p out)" "# outlines of four.pgm, 8 x 6 pixels: 4 of 4 cells"
check "the names of the columns" "$(sed -n 2p out)" "$(printf 'cell\tk\tx\ty')"
check "the cells" "$(cells out)" "1 2 3 4 "
check "the staircase of the first" "$(awk '$1 == 1 { printf "%s,%s ", $3, $4 }' out)" \
    "3.5,-0.5 2.5,-0.5 1.5,-0.5 0.5,-0.5 0.5,-1.5 0.5,-2.5 1.5,-2.5 2.5,-2.5 3.5,-2.5 3.5,-1.5 "
cp out expected
cat four.pgm > in
run - --points=pixels
check "from standard input" "$(grep -v '^#' out)" "$(grep -v '^#' expected)"
: > in
run four.pgm --points pixels --spacing 2,0.5
check "with a spacing" "$(awk '$1 == 1 { printf "%s,%s ", $3, $4 }' out | cut -d ' ' -f 1-3)" "7,-0.25 5,-0.25 3,-0.25"
run four.pgm --points pixels --spacing 2 --digits 2
check "one spacing for both" "$(awk '$1 == 4 && $2 == 0 { print $3 "," $4 }' out)" "13,-5"
run four.pgm --points junctions
check "junctions" "$status $(awk '$1 == 1' out | wc -l | tr -d ' ')" "0 3"
run four.pgm --background 2
check "another background" "$(cells out)" "1 3 4 "

printf 'P2 9 5 9 0 0 0 0 0 0 0 0 0  1 2 2 0 3 3 3 0 0  0 2 2 0 3 0 3 0 4\n0 0 0 0 3 3 3 0 0  0 0 5 0 5 0 0 0 0\n' \
    > bad.pgm
run bad.pgm --report report.tsv
check "cells that are left out: status 2" $status 2
check "and why" "$(cat err)" "bad.pgm: left out, cut by the border of the image: 3 (1 4 5)
bad.pgm: measured by the outer outline, with holes: 1 (3)
bad.pgm: measured, but of fewer than 20 pixels: 2 (2 3)"
check "the others are measured" "$(cells out)" "2 3 "
check "the report" "$(tr '\t' ' ' < report.tsv)" "cell pixels corners status word
1 1 0 border small
2 4 10 ok small
3 8 14 ok holes,small
4 1 0 border small
5 2 0 border small"
awk 'BEGIN { print "P2 60 3 60"; for (i = 0; i < 180; ++i) print (i < 60 || i > 119 ? 0 : i - 59) }' > many.pgm
run many.pgm --points junctions
check "not all names where there are many" "$(sed -n 2p err)" \
    "many.pgm: measured, but of fewer than 20 pixels: 58 (2 3 4 5 6 7 8 9 10 11 ...)"
printf 'P2 3 3 9 0 0 0 0 0 0 0 0 0\n' > none.pgm
run none.pgm
check "no cell at all" "$status $(cat err) $(cells out)" "0 outlines: no pixel has a label above 0 "
for width in 1 2 3; do
    awk -v w=$width 'BEGIN {
        print "P2", 10 + w, 10 + w, 4
        for (y = 0; y < 10 + w; y++) for (x = 0; x < 10 + w; x++)
            print (x >= 5 && x < 5 + w) || (y >= 5 && y < 5 + w) ? 0 : 1 + (x > 5) + 2 * (y > 5)
    }' > lined.pgm
    for option in "" --lines; do
        "$outlines" lined.pgm $option 2>&1 > out | grep -c 'lined.pgm: lines of 0 part the cells: --lines'
    done
done | tr '\n' ' ' > said
check "lines of 0 without --lines are told" "$(cat said)" "1 0 1 0 0 0 "
run four.pgm --wrap x
check "wrapped" "$status $(cells out)" "0 1 2 3 4 "

# --- a mesh -----------------------------------------------------------------------------------------------------------

run four.pgm --off mesh.off
"$surfmink" < out 2> /dev/null | cut -f 2,4-12 > by_table
"$surfmink" mesh.off --surface plane 2> /dev/null | cut -f 2,4-12 > by_mesh
check "the mesh: vertices and faces" "$(sed -n 2p mesh.off)" "35 4 0"
check "the mesh: as many faces as cells" "$(sed '1,37d' mesh.off | wc -l | tr -d ' ')" 4
check "the mesh: every vertex is used" \
    "$(sed '1,37d' mesh.off | cut -d ' ' -f 2- | tr ' ' '\n' | sort -u | wc -l | tr -d ' ')" 35
awk '!/^#/ && NR > 2 { print $3, $4 }' out | sort -u | wc -l | tr -d ' ' > points
check "the mesh: the points of the table" \
    "$(sed '1,2d' mesh.off | awk 'NF == 3 { print $1, $2 }' | wc -l | tr -d ' ')" \
    "$(cat points)"

# --- on a chart -------------------------------------------------------------------------------------------------------
# x = column, y = 9 - row, z = 0 as bytes; NPY of three planes

npy() { # npy FILE VALUE_OF_CHANNEL_0 _1 _2, as awk expressions of r and c
    {
        printf '\223NUMPY\001\000v\000'
        printf "%-117s\n" "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 6, 8), }"
        awk -v n=48 "BEGIN { for (k = 0; k < 3; ++k) for (i = 0; i < n; ++i) { r = int(i / 8); c = i % 8
            v = k == 0 ? $2 : k == 1 ? $3 : $4; printf \"\\\\\\\\%03o\", v } }" > octal
        printf "$(sed 's/\\\\/\\/g' octal)"
    } > "$1"
}
npy xyz.npy c "9 - r" 0
npy n.npy 0 0 200
run four.pgm --positions xyz.npy --normals n.npy --points pixels --off mesh.off
check "on a chart" "$status $(sed -n 2p out)" "0 $(printf 'cell\tk\tx\ty\tz\tnx\tny\tnz')"
check "its places" "$(awk '$1 == 1 { print $3, $4, $5, $6, $7, $8 }' out | head -n 2)" "3.5 8.5 0 0 0 1
2.5 8.5 0 0 0 1"
check "the mesh has normals" "$(sed -n '1p;3p' mesh.off)" "NOFF
$(sed -n 3p mesh.off)"
check "six numbers a vertex" "$(sed -n 3p mesh.off | wc -w | tr -d ' ')" 6
run four.pgm --positions xyz.npy --points pixels
check "normals from positions" "$(awk '$1 == 1 { print $6, $7, $8 }' out | sort -u)" "0 0 1"
cp out expected
run four.pgm --positions xyz.npy --points pixels --flip
check "turned round" "$(awk '$1 == 1 { print $6, $7, $8 }' out | sort -u)" "0 0 -1"
check "and the outlines with them" "$(awk '$1 == 1 { print $3, $4 }' out | sort)" \
    "$(awk '$1 == 1 { print $3, $4 }' expected | sort)"
npy edge.npy "c < 5 ? c : 5" "9 - r" 0
run four.pgm --positions edge.npy --normals n.npy
check "smeared beyond a rim" "$status $(head -n 1 err)" \
    "2 four.pgm: left out, where the chart is folded or torn: 2 (2 4)"
npy edge.npy 0 0 "c < 5 ? 1 : 0"
run four.pgm --positions xyz.npy --normals edge.npy
check "beyond the rim" "$status $(head -n 1 err)" \
    "2 four.pgm: left out, reaching beyond the rim of the chart: 2 (2 4)"

"$rasterise" sphere 8 . 5
run labels.npy --positions positions.npy --normals normals.npy --wrap x
"$surfmink" < out > mu 2> mu.err
check "a sphere is measured" "$status $(column mu status | sort | uniq -c | tr -s ' ')" "2  385 ok"
has "and what lies at 80 degrees is left out" err "left out, reaching beyond the rim of the chart: 14"
"$surfmink" exact.tsv > exact.mu
awk -F '\t' 'FNR == 1 { ++file; for (i = 1; i <= NF; ++i) at[$i] = i; next }
    file == 1 { mu[$1] = $at["mu_6"]; L[$1] = $at["L"]; next }
    { d = $at["mu_6"] - mu[$1]; s += d * d; d = $at["L"] / L[$1] - 1; l += d * d; ++n }
    END { exit !(n > 350 && sqrt(s / n) < 0.12 && sqrt(l / n) < 0.03) }' exact.mu mu
count $? "as the exact cells" "not" "rms of mu_6 below .12, of L below 3 %"

# --- paint ------------------------------------------------------------------------------------------------------------

run four.pgm --points pixels
"$surfmink" < out > mu
"$outlines" four.pgm --paint - --column n --out n.tif < mu > out 2> err
check "painting says nothing" "$? $(cat out err)" "0 "
check "32-bit floats behind the head" "$(wc -c < n.tif | tr -d ' ')" $((134 + 4 * 48))
run n.tif --points pixels
check "what is painted can be read: all cells have as many corners" "$(cells out)" "10 "
sed -n '1,3p' mu > two
printf '77\t4\n' >> two
cut -f 1,2 two > few
run four.pgm --paint few --column n --out n.tif
check "cells without a row, and rows without a cell" "$status $(cat err)" \
    "0 few: rows of cells that the image does not have: 1"
run n.tif --points pixels
check "they are left blank" "$(tail -n 1 out | cut -f 1) $(grep -c . out)" "10 18"
refuses "few: no column is called mu_6" four.pgm --paint few --column mu_6 --out new.tif
refuses "four.pgm: no column is called id: a table of surfmink is wanted" four.pgm --paint four.pgm --column x \
    --out new.tif
printf 'id\tn\n1\t2\n1\t3\n' > twice
refuses "twice: line 3: a second row of cell 1" four.pgm --paint twice --column n --out new.tif
printf 'id\tn\n1\ttwo\n' > twice
refuses "twice: line 2: 'two' is not a number" four.pgm --paint twice --column n --out new.tif
printf 'id\tn\none\t2\n' > twice
refuses "twice: line 2: the id 'one' is no label" four.pgm --paint twice --column n --out new.tif
printf 'id\tn\n1\n' > twice
refuses "twice: line 2: a row with too few columns" four.pgm --paint twice --column n --out new.tif
: > twice
refuses "twice: the file is empty" four.pgm --paint twice --column n --out new.tif
printf '#\n' > twice
refuses "twice: no line names the columns" four.pgm --paint twice --column n --out new.tif

# --- refusals ---------------------------------------------------------------------------------------------------------

hint="(outlines --help shows examples)"
refuses "outlines: there is no label image $hint"
refuses "outlines: one label image at a time, this is one file more: more $hint" four.pgm more
refuses "outlines: unknown option: --smooth $hint" four.pgm --smooth 4
refuses "outlines: a value is missing behind: --points $hint" four.pgm --points
refuses "outlines: no value is wanted behind: --lines $hint" four.pgm --lines=1
refuses "outlines: --points wants curve, junctions or pixels: mask $hint" four.pgm --points mask
for bad in 0 -1 nan inf 1,0 1,2,3 x 1,; do
    refuses "outlines: --spacing wants one positive number, or two with a comma: $bad $hint" four.pgm --spacing $bad
done
refuses "outlines: --wrap wants x: y $hint" four.pgm --wrap y
refuses "outlines: --background wants a label, a whole number: 1.5 $hint" four.pgm --background 1.5
refuses "outlines: --digits wants 1 to 17: 18 $hint" four.pgm --digits 18
refuses "outlines: --normals without --positions: n.npy $hint" four.pgm --normals n.npy --off new.off
refuses "outlines: --flip is for normals: there are none without --positions $hint" four.pgm --flip
refuses "outlines: --spacing is for the plane: with --positions, these tell where a pixel is $hint" \
    four.pgm --positions xyz.npy --spacing 2 --off new.off
refuses "outlines: --off with --wrap needs --positions: in the plane the two sides do not meet $hint" \
    four.pgm --wrap x --off new.off
refuses "outlines: --column and --out go with --paint TABLE $hint" four.pgm --out new.tif
refuses "outlines: --paint TABLE wants --column NAME and --out FILE $hint" four.pgm --paint mu --out new.tif
refuses "outlines: --paint draws no outlines: of the other options only --lines and --background go with it $hint" \
    four.pgm --paint mu --column n --out new.tif --off new.off
refuses "outlines: this file would be overwritten: four.pgm $hint" four.pgm --off four.pgm
refuses "outlines: this file would be overwritten: new.off $hint" four.pgm --off new.off --report new.off
# by whatever name
ln -s four.pgm link.pgm
for name in ./four.pgm "$PWD/four.pgm" link.pgm; do
    refuses "outlines: this file would be overwritten: $name $hint" four.pgm --report "$name"
done
refuses "./new.off: this file would be overwritten" four.pgm --off new.off --report ./new.off
refuses "nowhere/r: cannot be written: No such file or directory" four.pgm --off new.off --report nowhere/r
mkfifo pipe
cat pipe > piped &
run four.pgm --report pipe
wait
check "a report through a pipe" "$status $(wc -l < piped | tr -d ' ')" "0 5"
echo kept > kept.off
refuses "nowhere/r: cannot be written: No such file or directory" four.pgm --off kept.off --report nowhere/r
check "what is there when another file cannot be written" "$(cat kept.off)" kept
refuses "outlines: a file is wanted, not standard output: - $hint" four.pgm --off -
refuses "outlines: standard input is one file $hint" - --positions -
refuses "nowhere.tif: No such file or directory" nowhere.tif --off new.off
refuses "nowhere/new.off: cannot be written: No such file or directory" four.pgm --off nowhere/new.off
refuses "xyz.npy: 3 pages or colours: a label image has one number for each pixel" xyz.npy --off new.off
refuses "four.pgm: 1 numbers for each pixel: a map has three, x, y and z" four.pgm --positions four.pgm --off new.off
refuses "xyz.npy: 8 x 6 pixels, and the image has 9 x 5" bad.pgm --positions xyz.npy --report new.tsv
printf 'id\tn\n1\t1.5\n' > half
run four.pgm --paint half --column n --out half.tif
refuses "half.tif: row 1, column 1: 1.5 is no whole number: labels are wanted, not a grey image" half.tif --off new.off
head -c 150 half.tif > cut.tif
refuses "cut.tif: truncated: 8 x 6 pixels with 1 numbers of 4 bytes do not fit into 150 bytes" cut.tif --off new.off
"$surfmink" --version > version.txt
refuses "version.txt: no image that can be read: TIFF without compression, NPY and PGM can" version.txt --off new.off

# Orientation 4: the first row is the lowest
{
    printf 'MM\0\052\0\0\0\010\0\006'
    printf '\001\0\0\003\0\0\0\001\0\002\0\0\001\001\0\003\0\0\0\001\0\002\0\0'
    printf '\001\002\0\003\0\0\0\001\0\010\0\0\001\021\0\004\0\0\0\001\0\0\0\126'
    printf '\001\022\0\003\0\0\0\001\0\004\0\0\001\027\0\004\0\0\0\001\0\0\0\004'
    printf '\0\0\0\0\001\001\001\001'
} > turned.tif
run turned.tif
check "a TIFF upside down" "$status $(cut -d ';' -f 1 err)" \
    "1 turned.tif: a TIFF whose first row is not the top one (Orientation 4)"
printf 'P55 1 9 00000' > magic.pgm
run magic.pgm
check "P55 is no P5" "$status $(cat err)" "1 magic.pgm: a PGM begins with P5, width, height and greatest grey"

# what is quoted does not command the terminal: control characters, of 8 bits too, and bytes that are no text
odd=$(printf 'a\033[2J\302\233b\377c\011d.pgm')
cp four.pgm "$odd"
run "$odd"
check "a name on standard error" "$(cut -d : -f 1 err)" "a?[2J??b?c?d.pgm"
check "a name in the table" "$(sed -n 1p out)" "# outlines of a?[2J??b?c?d.pgm, 8 x 6 pixels: 4 of 4 cells"
refuses "outlines: unknown option: --?[2J??x $hint" four.pgm "$(printf -- '--\033[2J\302\233x')"
if [ -w /dev/full ]; then
    for full in "" "--off /dev/full" "--report /dev/full" "--paint half --column n --out /dev/full"; do
        if [ "$full" ]; then
            run four.pgm $full
        else
            "$outlines" four.pgm > /dev/full 2> err
            status=$?
        fi
        check "a full disk: $full" "$status $(tail -n 1 err | sed 's/.*cannot/cannot/; s/written.*/written/')" \
            "1 cannot be written"
    done
fi

# --- the tables of docs/images.md -------------------------------------------------------------------------------------

"$build/test_outlines" --table > measured
grep -E '^\| (straight|curved|sphere|ellipsoid)' "$page" > printed
check "the tables have as many rows as are measured" "$(wc -l < printed | tr -d ' ')" "$(wc -l < measured | tr -d ' ')"
# the last digit may depend on compiler and libm: a pixel in the middle between two seeds goes to either
paste -d '#' measured printed | awk '
    {
        split($0, half, "#")
        n = split(half[1], a, /[ |]+/)
        m = split(half[2], b, /[ |]+/)
        bad = n != m
        for (i = 1; i <= n; ++i) {
            number = a[i] ~ /^[-+]?[0-9.]+$/ && b[i] ~ /^[-+]?[0-9.]+$/
            d = a[i] - b[i]
            if (number ? d > 0.0025 || d < -0.0025 : a[i] != b[i]) bad = 1
        }
        if (bad) print half[1]
    }' > differ
check "docs/images.md has the tables that are measured (.build/test_outlines --table)" "$(cat differ)" ""

totals
