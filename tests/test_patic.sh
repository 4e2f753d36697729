#!/bin/sh
# test_patic.sh PATIC SURFMINK: holds the command `patic` to what its --help promises. Needs only a POSIX shell and awk.
# Run it from the root of the repository.
. "$(dirname "$0")/harness.sh"
patic=$(absolute "$1")
surfmink=$(absolute "$2")
data=$PWD/examples/data
cd "$work" || exit 1

# --- harness ----------------------------------------------------------------------------------------------------------

# run ARGUMENT...: the command, with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$patic" "$@" < in > out 2> err
    status=$?
}

# field FILE ROW NAME: of a table; row 1 is the first below the names.
field() {
    awk -F '\t' -v row="$2" -v name="$3" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
        NR == row + 1 { print column ? $column : "no such column" }' "$1"
}

# sum FILE NAME: of a column.
sum() {
    awk -F '\t' -v name="$2" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
        { sum += $column } END { printf "%.12g\n", sum }' "$1"
}

# said NAME: the value of that line of the summary.
said() {
    awk -F '\t' -v name="$1" '$1 == name { print $2 }' err
}

# refuses MESSAGE ARGUMENT...: status 1, exactly that on standard error, nothing on standard output.
refuses() {
    want=$1
    shift
    run "$@"
    check "status of patic $*" $status 1
    check "complaint of patic $*" "$(cat err)" "$want"
    check "output of patic $*" "$(cat out)" ""
}

# Three squares in a row and one above the first: two vertices with cells on three sides, none with cells all round.
cat > squares.tsv << 'END'
cell	x	y
a	0	0
a	1	0
a	1	1
a	0	1
b	1	0
b	2	0
b	2	1
b	1	1
c	2	0
c	3	0
c	3	1
c	2	1
d	0	1
d	1	1
d	1	2
d	0	2
END
: > in

# torus ROWS COLUMNS SHAKE: that many quadrilaterals, with normals.
torus() {
    awk -v rows="$1" -v columns="$2" -v shake="$3" 'BEGIN {
        OFS = "\t"; pi = atan2(0, -1)
        print "cell", "x", "y", "z", "nx", "ny", "nz"
        for (i = 0; i < rows; ++i) for (j = 0; j < columns; ++j) for (k = 0; k < 4; ++k) {
            a = (i + (k == 1 || k == 2)) % rows; b = (j + (k > 1)) % columns
            u = 2 * pi * (a + shake * sin(100 * a + 57 * b)) / rows
            v = 2 * pi * (b + shake * sin(31 * a + 200 * b)) / columns; r = 1.2 + cos(v)
            print i "/" j, r * cos(u), r * sin(u), sin(v), cos(v) * cos(u), cos(v) * sin(u), sin(v)
        } }'
}

# --- what comes out ---------------------------------------------------------------------------------------------------

run --help
check "help succeeds" $status 0
check "help leads with examples" "$(sed -n 3p out)" "EXAMPLES"
check "help is no complaint" "$(cat err)" ""

run --rank 4 squares.tsv
check "status" $status 0
check "nothing to complain" "$(cat err)" ""
check "the names" "$(sed -n 1p out | tr '\t' ' ')" "id n x y z nx ny nz mu order dx dy dz neighbours boundary status"
check "one line a cell" "$(awk 'END { print NR }' out)" 5
check "the second cell" "$(sed -n 3p out | cut -f 1-8,14- | tr '\t' ' ')" "b 4 1.5 0.5 0 0 0 1 2 1 ok"
near "mu of a square" "$(field out 2 mu)" 1
near "order without a radius" "$(field out 2 order)" 1
near "a direction that crosses a side" "$(awk -F '\t' 'NR == 3 { print $11 * $11 * $12 * $12 }' out)" 0
cp out expected
cp squares.tsv in
run --rank=4 < squares.tsv
check "the same from standard input" "$(cat out)" "$(cat expected)"
run --rank 4 --
check "the same behind --" "$(cat out)" "$(cat expected)"
: > in
run --rank 2 squares.tsv
check "a square has no direction at rank 2" "$(field out 1 dx)" ""
near "and no order" "$(field out 1 order)" 0 1e-12

run --rank 4 --summary squares.tsv
check "cells" "$(said cells)" 4
check "components" "$(said components)" 1
check "chi" "$(said chi)" 1
check "boundary loops" "$(said 'boundary loops')" 1
check "sum of charges" "$(said 'sum of charges')" 0
check "boundary sum" "$(said 'boundary sum')" 1

# A cell in a bay of another: one border, more than half way round the first. Both walks go all round.
bay='a 0 0\na 1 0\na .8 1\na .2 1\nb -1 -1\nb 2 -1\nb 2 1\nb .8 1\nb 1 0\nb 0 0\nb .2 1\nb -1 1\n'
# Two cells round a gap, which touch on two sides of it.
gap='a 0 0\na 4 0\na 4 2\na 3 2\na 3 1\na 1 1\na 1 2\na 0 2\n'
gap=$gap'b 0 2\nb 1 2\nb 1 3\n'
gap=$gap'b 3 3\nb 3 2\nb 4 2\nb 4 4\nb 0 4\n'
for p in 1 2 3 4 5 6; do
    printf "id x y\n$bay" > in
    run --rank $p --summary
    check "a bay, p = $p" "$(said chi) $(said 'sum of charges') $(said 'boundary sum')" "1 0 1"
    printf "id x y\n$gap" > in
    run --rank $p --summary
    check "a gap, p = $p" "$(said chi) $(said 'sum of charges') $(said 'boundary sum')" "0 0 0"
done
# What surfmink refuses is a hole here, too, under the same name; what closes twice meets itself.
printf 'id x y\na 0 0\na 1 1.2\na 2 1.2\na 3 0\na 3 1\na 0 1\nb 3 0\nb 4 0\nb 4 2\nb 3 1\n' > in
run --rank 2
check "a cell that crosses itself" "$status $(field out 1 status) $(field out 2 status) $(field out 2 neighbours)" \
    "2 crosses_itself ok 0"
has "by an edge" err "-:2: cell a: crosses_itself: the edge that begins here crosses another one"
printf 'id x y\na 0 0\na 1 0\na 1 1\na 0 0\na 5 5\na 6 5\na 6 6\na 5 5\n' > in
run --rank 2
check "a cell of two rings" "$status $(field out 1 status)" "2 meets_itself"
printf 'id k x y\na 1 0 0\na 1 1 0\na 3 1 1\n' > in
run --rank 2
check "corners in no order" "$status $(field out 1 status)" "2 bad_order"
has "with the reason" err "-:3: cell a: bad_order: k is no order: it is not whole, or twice the same, "
# A cube is six squares, none of which has a direction at rank 2: one core, with nothing round it.
printf 'OFF\n8 6\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1
4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n' > cube.off
run --rank 2 --surface sphere --defects defects.tsv cube.off
check "a cube is one core" "$status $(cut -f 4,6 defects.tsv | tr '\t\n' '  ')" "0 charge order 2 0 "

for p in 2 4 6; do
    run --rank $p --summary --defects defects.tsv "$data/tissue.tsv"
    check "the tissue at rank $p" $status 0
    near "its charges add up to 2" "$(sum defects.tsv charge)" 2 1e-9
    check "and the summary says so" "$(said 'sum of charges')" 2
    check "chi of the tissue" "$(said chi)" 2
    check "as many as are listed" "$(($(said 'defects +') + $(said 'defects -')))" \
        "$(awk 'END { print NR - 1 }' defects.tsv)"
done
check "names of the defects" "$(sed -n 1p defects.tsv | tr '\t' ' ')" "x y z charge cells order margin"
check "cells round a corner" "$(awk -F '\t' 'NR > 1 && split($5, c, ",") < 3' defects.tsv)" ""

# The pentagons of the H3 grid have no direction at rank 6: twelve cores.
"$surfmink" "$data/h3_res2.tsv" | awk -F '\t' '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next } $at["mu_5"] > 0.999999 { print $1 }' | sort > pentagons
run --rank 6 --summary --defects defects.tsv "$data/h3_res2.tsv"
check "twelve defects" "$(awk 'END { print NR - 1 }' defects.tsv)" 12
check "each of a sixth" "$(cut -f 4 defects.tsv | sort -u | tr '\n' ' ')" "0.16666666666666666 charge "
check "at the pentagons" "$(sed 1d defects.tsv | cut -f 5 | cut -d , -f 1 | sort | tr '\n' ' ')" \
    "$(tr '\n' ' ' < pentagons)"
check "that add up to 2" "$(said 'sum of charges')" 2
cut -f 1-4 defects.tsv > here
run --rank 6 --sphere-radius 2 --defects defects.tsv "$data/h3_res2.tsv"
near "on a sphere of radius 2" "$(sum defects.tsv x)" "$(sum here x)" 1e-9
near "twice as far out" "$(awk -F '\t' 'NR == 2 { printf "%.15g", $1 * $1 + $2 * $2 + $3 * $3 }' defects.tsv)" 4 1e-9

# --- radii ------------------------------------------------------------------------------------------------------------

run --rank 6 --radius 1c,2c,4c "$data/tissue.tsv"
check "a scan" $status 0
check "its names" "$(sed -n 1p out | tr '\t' ' ')" \
    "radius cells components chi loops charges boundary plus minus margin order"
check "a line a radius" "$(awk 'END { print NR }' out)" 4
check "charges at every radius" "$(cut -f 6 out | tr '\n' ' ')" "charges 2 2 2 "
check "fewer defects farther out" "$(awk 'NR > 1 { n = $8 + $9; if (NR > 2 && n >= last) print; last = n }' out)" ""
unit=$(field out 1 radius)
run --rank 6 --radius "$unit" "$data/tissue.tsv"
cp out expected
run --rank 6 --radius 1c "$data/tissue.tsv"
check "cells are a unit of length" "$(cat out)" "$(cat expected)"
run --rank 6 --radius 0 "$data/tissue.tsv"
cp out expected
run --rank 6 "$data/tissue.tsv"
check "radius 0 is no radius" "$(cat out)" "$(cat expected)"
run --rank 6 --radius 1c,4c --summary "$data/tissue.tsv"
check "a summary a radius" "$(grep -c '^radius	' err)" 2

# --- correlation, picture ---------------------------------------------------------------------------------------------

run --rank 4 --correlation g.tsv squares.tsv
check "names of the correlation" "$(sed -n 1p g.tsv | tr '\t' ' ')" "r pairs G"
check "pairs of all cells" "$(sum g.tsv pairs)" 6
near "three neighbours, and a and c are two apart" "$(awk 'NR == 2 { print $1, $2 }' g.tsv | tr ' ' '.')" 1.5.4 0
check "squares agree" "$(awk 'NR > 1 && ($3 < 1 - 1e-12 || $3 > 1 + 1e-12)' g.tsv)" ""
run --rank 6 --radius 1c --svg field.svg --title 'a < b' "$data/tissue.tsv"
check "a picture" $status 0
check "of all cells, each seen once" "$(grep -c '^<path d="M.*Z" fill="#' field.svg)" 400
drawn_strokes field.svg > drawn
check "rays, none of which leaves its cell" "$(cut -d ' ' -f 1,2 drawn)" \
    "$((6 * $(grep -c '^<path fill="none" stroke-linecap' field.svg))) 0"
check "in most cells" "$(awk '{ print ($1 > 6 * 300) }' drawn)" 1
check "they show on every hue" "$(awk '{ print ($3 >= 37) }' drawn)" 1
check "hues of five angles" "$(
    sed -n '/<g id="hues"/,/<\/g>/p' field.svg | grep -c '<circle.*fill="#.*<path stroke="#.*d="M')" 5
has "with the title in XML" field.svg "a &#60; b"
check "no numbers that are none" "$(grep -c -i -e nan -e inf field.svg)" 0
run --rank 4 --svg plane.svg --color-by order squares.tsv
check "a picture of the plane" "$(grep -c '^<path d="M.*Z" fill="#' plane.svg)" 4
check "coloured by order: no hues" "$(grep -c 'id="hues"' plane.svg)" 0
check "and the rays show on the palest colour" "$(
    drawn_strokes plane.svg | awk '{ print $1, $2, ($3 >= 37) }')" "16 0 1"
run --rank 6 --radius 2c --svg field.svg --color-by order "$data/tissue.tsv"
check "and on every other" "$(drawn_strokes field.svg | awk '{ print ($1 > 1800), $2, ($3 >= 37) }')" "1 0 1"
# Which way the rays of a box lie on the page: 0 right, 90 up.
rays() {
    run --rank 2 --svg plane.svg "$@" boxes.tsv
    sed -n 's/^<path fill="none" stroke-linecap.* d="M\([^M]*\)M.*/\1/p' plane.svg | tr L ' ' |
        awk '{ a = atan2($2 - $4, $3 - $1) * 57.29577951308232; printf "%d ", (a < -1 ? a + 180.5 : a + 0.5) % 180 }'
}
printf 'cell\tx\ty\n' > boxes.tsv
for corner in '0 0' '2 0' '2 1' '0 1'; do printf 'a\t%s\t%s\n' $corner; done >> boxes.tsv
for corner in '2 0' '4 0' '4 1' '2 1'; do printf 'b\t%s\t%s\n' $corner; done >> boxes.tsv
check "rays lie along the cells" "$(rays)" "0 0 "
check "as they do if one asks" "$(rays --strokes along)" "0 0 "
check "or across them" "$(rays --strokes across)" "90 90 "
hue() {
    sed -n 's/^<path d="M.*Z" fill="\(#[0-9a-f]*\)".*/\1/p' plane.svg | sort -u
}
rays > out
along=$(hue)
check "the hue is that of the rays in the key" "$along" "$(
    sed -n '/<g id="hues"/,/<\/g>/s/.* fill="\(#[0-9a-f]*\)".*/\1/p' plane.svg | head -n 1)"
rays --strokes across > out
check "another one across" "$([ "$(hue)" = "$along" ]; echo $?)" 1
# Charges beside the discs cover neither each other nor a disc.
run --rank 2 --radius 1.5c --svg field.svg "$data/tissue.tsv"
check "charges stand clear of discs and of each other" "$(
    awk '/^<circle/ { gsub(/[^0-9.]+/, " "); split($0, a, " "); x[++n] = a[1]; y[n] = a[2]; w[n] = h[n] = a[3]; next }
        /^<text text-anchor="middle".*\/2<\/text>/ { gsub(/[^0-9.]+/, " "); split($0, a, " ")
            x[++n] = a[1]; y[n] = a[2] - 5; w[n] = 12; h[n] = 5; text[n] = 1; ++texts }
        END { for (i = 1; i <= n; ++i) for (j = 1; j <= n; ++j)
                  if (i != j && text[i] && (x[i] - x[j]) ^ 2 < (w[i] + w[j]) ^ 2 &&
                      (y[i] - y[j]) ^ 2 < (h[i] + h[j]) ^ 2) ++bad
              print (texts > 38), bad + 0 }' field.svg)" "1 0"

# --- refusals ---------------------------------------------------------------------------------------------------------

cp squares.tsv bad.tsv
printf 'e\t1\t0\ne\t2\t0\ne\t2\t1\ne\t1\t1\nf\t9\t9\nf\t9\t10\nf\t10\t9\n' >> bad.tsv
printf 'g\t5\t5\ng\t6\t5\ng\tnan\t6\ng\t5\t6\nh\t3\t0\nh\t4\t0\nh\t4\t1\nh\t3\t1\n' >> bad.tsv
printf 'i\t20\t20\ni\t22\t20\ni\t21\t21\ni\t22.5\t22\ni\t20.5\t22.5\ni\t21\t21\ni\t19\t22\n' >> bad.tsv
run --rank 4 bad.tsv
check "some are refused" $status 2
check "their statuses" "$(cut -f 1,16 out | tr '\t\n' '= ')" \
    "id=status a=ok b=ok c=ok d=ok e=overlaps f=clockwise g=not_finite h=ok i=meets_itself "
check "refused cells have no numbers" \
    "$(awk -F '\t' '$16 != "ok" && NR > 1 { $1 = $2 = $16 = ""; print }' out | tr -d ' \n')" ""
check "who overlaps whom" "$(sed -n 1p err)" \
    "bad.tsv:18: cell e: overlaps: an edge of it belongs to another cell already, to cell b; drop one of the two, or \
turn the one round that runs clockwise"
check "the file, the line, the cell, the reason" "$(sed -n 2p err | cut -c 1-30)" "bad.tsv:22: cell f: clockwise:"
check "an outline that meets itself" "$(sed -n 4p err | cut -d : -f 1-4)" "bad.tsv:33: cell i: meets_itself"
run --rank 4 --quiet bad.tsv
check "quiet" "$(cat err)" ""
check "quiet, but the status" $status 2
printf 'a\t0\t0\n' > short.tsv
sed 1q squares.tsv | cat - short.tsv > two.tsv
run --rank 4 two.tsv
check "too few corners" "$(cut -f 16 out | tr '\n' ' ')" "status too_few_corners "

# --- warnings ---------------------------------------------------------------------------------------------------------

awk 'BEGIN { OFS = "\t" } NR > 1 { $2 *= 1 + 0.01 * (($1 == "b") - ($1 == "d"))
    $3 *= 1 + 0.01 * ($1 == "c" || $1 == "d") }
    { print }' squares.tsv > loose.tsv
run --rank 4 loose.tsv
check "cells that touch nowhere are measured" $status 0
has "with a loud warning" err "WARNING: 4 of 4 cells share no edge"
has "that names the remedy" err "--weld D"
has "and the other one" err "outlines"
run --rank 4 --weld 0.1 --summary loose.tsv
check "welded" "$(said isolated)" 0
check "welded, chi" "$(said chi)" 1

torus 16 12 0.1 > fine.tsv
run --rank 4 --summary fine.tsv
check "a torus" "$(said chi)" 0
check "has charges that add up to 0" "$(said 'sum of charges')" 0
check "and no warning" "$(grep -c WARNING err)" 0
# An octahedron whose upper normals point down, as of a tissue that has too few cells to show which way it bends.
awk 'BEGIN {
    OFS = "\t"; split("1 0 -1 0", c, " "); split("0 1 0 -1", d, " ")
    print "cell", "x", "y", "z", "nx", "ny", "nz"; down = -1
    for (s = 1; s > -2; s -= 2) for (k = 1; k < 5; ++k) {
        m = s > 0 ? k : k % 4 + 1; n = s > 0 ? k % 4 + 1 : k; normal = c[m] + c[n] OFS d[m] + d[n] OFS down
        print s k, c[m], d[m], 0, normal; print s k, c[n], d[n], 0, normal; print s k, 0, 0, s, normal
    } }' > coarse.tsv
run --rank 6 --radius 0,1c --summary coarse.tsv
check "an octahedron" "$(said chi | tr '\n' ' ')" "2 2 "
check "has too few cells" "$(grep WARNING err)" \
    "patic: WARNING: the component of cell 11 (8 cells) is too coarse for its \
curvature: its charges sum to 0, its Euler characteristic is 2"

# --- without any order of its own -------------------------------------------------------------------------------------

# slope FILE: of log order over log radius, of a scan.
slope() {
    awk 'NR > 1 { x = log($1); y = log($NF); ++n; a += x; b += y; aa += x * x; ab += x * y }
         END { printf "%.3f\n", (n * ab - a * b) / (n * aa - a * a) }' "$1"
}

# An average over independent cells falls as 1/R; at odd ranks only the rim of the ball is left, which falls as R^-1.5.
# With 2000 cells the exponents scatter: -0.86 to -1.06 and -1.48 to -1.50 in these and others.
for tissue in "--seed 5 --relax 1 --axes 100,100,100" "--seed 6 --relax 0" "--seed 7 --relax 0 --axes 110,70,50"; do
    "$(dirname "$patic")/tissue" --cells 2000 $tissue > disordered.tsv
    for rank in 2 3 4 5 6; do
        run --rank "$rank" --radius 1c,1.5c,2.1c,3c,4.2c disordered.tsv
        case $rank in
        3 | 5) near "$tissue: order falls at rank $rank" "$(slope out)" -1.5 0.04 ;;
        *) near "$tissue: order falls at rank $rank" "$(slope out)" -1 0.2 ;;
        esac
        check "$tissue: charges at rank $rank" "$(sed 1d out | cut -f 6 | sort -u)" 2
    done
done

# --- wrong calls ------------------------------------------------------------------------------------------------------

explains="(patic --help explains)"
refuses "patic: --rank is missing: 2 for elongation, 4 for squares, 6 for hexagons $explains" squares.tsv
refuses "patic: --rank is a whole number from 1 to 1000, not '0' $explains" --rank 0 squares.tsv
refuses "patic: --rank is a whole number from 1 to 1000, not '2.5' $explains" --rank 2.5 squares.tsv
refuses "patic: --rank needs a value $explains" --rank
refuses "patic: --radius is a length, or a number of cells as 1.5c, not '3x' $explains" --rank 4 --radius 3x
refuses "patic: --radius is a length, or a number of cells as 1.5c, or several with commas, not '1c,' $explains" \
    --rank 4 --radius 1c,
refuses "patic: --weld is a length, not negative, not '-1' $explains" --rank 4 --weld -1
refuses "patic: unknown option '--wield' $explains" --rank 4 --wield=1
refuses "patic: --summary takes no value $explains" --rank 4 --summary=1
refuses "patic: --surface is plane, sphere or embedded, not 'disc' $explains" --rank 4 --surface disc
refuses "patic: one FILE at a time: a tissue is one file $explains" --rank 4 squares.tsv bad.tsv
refuses "patic: --defects needs one --radius $explains" --rank 4 --radius 1c,2c --defects d.tsv squares.tsv
refuses "patic: --defects and --correlation would write the same file $explains" --rank 4 --defects d --correlation d
refuses "patic: --color-by is for pictures: add --svg FILE $explains" --rank 4 --color-by order squares.tsv
refuses "patic: --strokes is for pictures: add --svg FILE $explains" --rank 4 --strokes across squares.tsv
refuses "patic: --strokes is along or across, not 'up' $explains" --rank 4 --strokes up --svg a.svg squares.tsv
refuses "squares.tsv: --defects would overwrite it" --rank 4 --defects squares.tsv squares.tsv
refuses "squares.tsv: --sphere-radius is for spheres, and this is none" --rank 4 --sphere-radius 2 squares.tsv
check "nothing was overwritten" "$(sed -n 2p squares.tsv)" "a	0	0"

totals
