#!/bin/sh
# test_command.sh COMMAND: holds the command `surfmink` to what its --help promises. Needs only a POSIX shell.
. "$(dirname "$0")/harness.sh"
surfmink=$(absolute "$1")
cd "$work" || exit 1

# --- harness ----------------------------------------------------------------------------------------------------------

# run ARGUMENT...: the command, with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$surfmink" "$@" < in > out 2> err
    status=$?
}

# The field of a column (by name) in a row of the table (1 is the first below the names).
field() {
    awk -F '\t' -v row="$1" -v name="$2" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
        NR == row + 1 { print column ? $column : "no such column" }' out
}

# A column of all rows, on one line.
column() {
    awk -F '\t' -v name="$1" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
        NR > 1 { printf "%s%s", (NR > 2 ? " " : ""), $column }' out
}

# measured NAME COLUMN WANT: the run was a full success, and the column reads like this.
measured() {
    check "$1: exit status" "$status" 0
    check "$1: standard error" "$(cat err)" ""
    check "$1: $2" "$(column "$2")" "$3"
}

# refused NAME STATUS LINE [TEXT]: the first polygon is refused with this name, the message blames this line.
refused() {
    check "$1: exit status" "$status" 2
    check "$1: status" "$(field 1 status)" "$2"
    check "$1: nothing after the status" "$(awk -F '\t' 'NR == 2 { for (i = 4; i <= NF; ++i) printf "%s", $i }' out)" ""
    has "$1: line" err "-:$3: "
    has "$1: message" err "${4-: }"
}

# stopped NAME TEXT: the run ended with an error that says this.
stopped() {
    check "$1: exit status" "$status" 1
    has "$1: message" err "$2"
}

square() {
    printf '%s x y\n%s 0 0\n%s 1 0\n%s 1 1\n%s 0 1\n' "${1-cell}" a a a a
}

# --- the table that comes out -----------------------------------------------------------------------------------------

square > in
run
check "names of the columns" "$(head -n 1 out | tr '\t' ' ')" \
    "id n status L S area mu_1 mu_2 mu_3 mu_4 mu_5 mu_6 theta_1 theta_2 theta_3 theta_4 theta_5 theta_6"
check "tabs between them" "$(head -n 1 out | tr -cd '\t' | wc -c | tr -d ' ')" 17
measured "a square" id a
check "a square has 4 corners" "$(field 1 n)" 4
check "a square is ok" "$(field 1 status)" ok
near "a square has L = 4" "$(field 1 L)" 4
near "a square turns by 2 pi" "$(field 1 S)" 6.283185307179586
near "a square has area 1" "$(field 1 area)" 1
near "a square has mu_4 = 1" "$(field 1 mu_4)" 1
near "a square has mu_2 = 0" "$(field 1 mu_2)" 0
near "theta_4 of a square is the co-normal" "$(field 1 theta_4)" 0
check "theta_2 of a square is undefined" "$(field 1 theta_2)" ""
check "all rows have all columns" "$(awk -F '\t' 'NF != 18' out)" ""

printf 'cell x y\nt 0 0\nt 4 0\nt 0 3\n' > in
run
near "3-4-5 triangle: mu_2" "$(field 1 mu_2)" 0.44721359549995793
near "3-4-5 triangle: mu_3" "$(field 1 mu_3)" 0.8
near "3-4-5 triangle: mu_4" "$(field 1 mu_4)" 0.32249030993194200

printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run
measured "an octant of the sphere" n 3
near "octant: L" "$(field 1 L)" 4.71238898038469
near "octant: S" "$(field 1 S)" 4.71238898038469
near "octant: area" "$(field 1 area)" 1.5707963267948966
near "octant: mu_3" "$(field 1 mu_3)" 1
near "octant: mu_4" "$(field 1 mu_4)" 0
for p in 1 2 3 4 5 6; do
    check "theta_$p lies in (-pi/p, pi/p]" "$(awk -v t="$(field 1 theta_$p)" -v p=$p -v pi=3.1415926535897936 '
        BEGIN { print (t == "" || (t > -pi / p && t <= pi / p)) }')" 1
done

cat > octant.tsv << 'END'
ring x y z nx ny nz
o 1 0 0  1 0 0
o 0 1 0  0 2 0
o 0 0 1  0 0 3
END
cp octant.tsv in
run
measured "straight chords of the octant" n 3
near "chords: L" "$(field 1 L)" 4.242640687119286
near "chords: mu_3" "$(field 1 mu_3)" 1
near "chords: the area is an estimate of that of the octant" "$(field 1 area)" 1.5707963267948966 0.12

# --- tables that go in ------------------------------------------------------------------------------------------------

cat > in << 'END'
# a comment

   # another one, then the names
 id  y  k  colour  x
 a   0  7  red     0
 # within a polygon
 a   0  3  blue    2

 a   1  5  -       2
 b   0  0  -       5
 b   0  0  -       6
 b   1  0  -       6
END
run
measured "comments, blank lines, columns in any order, others ignored" id "a b"
check "order: first polygon" "$(field 1 n)" 3
near "order: area" "$(field 1 area)" 1

printf 'name\tx\ty\nNew Zealand\t0\t0\nNew Zealand\t1\t0\nNew Zealand\t1\t1\n' > in
run
check "tabs: ids with blanks" "$(field 1 id)" "New Zealand"
printf 'name, x , y\n "a, ""b""" , 0, 0\n "a, ""b""",1 ,0\n"a, ""b""",1,1\n' > in
run
check "commas: quoted ids" "$(field 1 id)" 'a, "b"'
near "commas: blanks around numbers" "$(field 1 area)" 0.5
printf ',x,y,cell\n0,0,0,q\n1,1,0,q\n2,1,1,q\n' > in
run
measured "a column without a name is no id" id q
printf 'cell x y\na 0 0\na 1 0\na 1 1\nb 0 0\nb 1 0\nb 1 1\na 0 0\na 1 0\na 1 1\n' > in
run
measured "an id that comes again is another polygon" id "a b a"
printf 'x y\n\n0 0\n1 0\n# not an end\n1 1\n\n\n2 0\n3 0\n3 1\n' > in
run
measured "without ids a blank line ends a polygon" id "0 1"
check "without ids: corners" "$(column n)" "3 3"
printf '\357\273\277x\ty\tcell\t\r\n0\t0\ta\r\n1\t0\ta\r\n\r\n1\t1\ta' > in
run
measured "byte order mark, CRLF, no end of the last line" n 3
printf 'cell x y\t\na 0 0 \na 1 0  \na 1 1\n' > in
run
measured "blanks at the end of lines" n 3
printf 'cell x y\ra 0 0\ra 1 0\ra 1 1\r' > in
run
measured "lone CR" n 3
awk 'BEGIN { printf "cell x y"; for (i = 0; i < 20000; ++i) printf " c%d", i; print ""
             for (k = 0; k < 3; ++k) {
                 printf "a %d %d", (k > 0), (k > 1)
                 for (i = 0; i < 20000; ++i) printf " %d", i
                 print ""
             } }' > in
run
measured "lines of 100 kB" n 3
awk 'BEGIN { print "cell x y"; n = 50000; step = 6.283185307179586 / n
             for (k = 0; k < n; ++k) printf "a %.17g %.17g\n", cos(step * k), sin(step * k) }' > in
run
measured "50000 corners" n 50000
printf 'cell x y\na 0x0p0 0e5\na +1 0\na 1.0 10E-1\n' > in
run
near "numbers in all notations of C" "$(field 1 area)" 0.5
square > in
env LC_ALL=de_DE.UTF-8 "$surfmink" in > out
near "the decimal point does not depend on the locale" "$(field 1 L)" 4

# --- the first corner, repeated ---------------------------------------------------------------------------------------

printf 'cell x y\na 0 0\na 1 0\na 1 1\na 0 0\nb 0 0\nb 1 0\nb 1 1\n' > in
run
measured "the first corner at the end is dropped" n "3 3"
printf 'cell lon lat\na -180 0\na -170 0\na -170 10\na 180 0\nb 0 90\nb 0 80\nb 20 80\nb 77 90\n' > in
run
measured "180 and -180 degrees, and all longitudes of a pole, are one point" n "3 3"
printf 'cell x y\na 0 0\na 1 0\na 0 0\n' > in
run
refused "what is left may be too little" too_few_corners 2
check "n counts without the dropped corner" "$(field 1 n)" 2

# --- which surface ----------------------------------------------------------------------------------------------------

cut -d ' ' -f 1-4 octant.tsv > xyz.tsv
cp xyz.tsv in
run
stopped "x y z alone" "-:1: columns nx ny nz are missing, or --surface sphere"
run --surface sphere
measured "x y z on a sphere" n 3
near "x y z on a sphere: area" "$(field 1 area)" 1.5707963267948966
run --surface=sphere --radius 2
near "radius: L" "$(field 1 L)" 9.42477796076938
near "radius: area" "$(field 1 area)" 6.283185307179586
near "radius: mu_3" "$(field 1 mu_3)" 1
printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --radius 2
near "radius with lon lat" "$(field 1 L)" 9.42477796076938
cp octant.tsv in
run --surface sphere
near "a sphere does not look at normals" "$(field 1 L)" 4.71238898038469
run --surface plane
near "a plane does not look at z" "$(field 1 area)" 0.5
run --surface embedded
near "embedded" "$(field 1 L)" 4.242640687119286
run --radius 2
stopped "a radius is for spheres" "-: --radius is for spheres"
printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --surface plane
stopped "lon lat are not a plane" "-:1: no column 'x'"
run --surface embedded
stopped "lon lat have no normals" "-:1: no column 'x'"
square > in
run --surface sphere
stopped "a sphere needs z" "-:1: no column 'z'"

# --- malformed tables -------------------------------------------------------------------------------------------------

: > in
run
stopped "nothing at all" "-: no line names the columns"
printf '# only this\n\n' > in
run
stopped "only comments" "-: no line names the columns"
printf 'cell x y\n' > in
run
measured "only names: an empty table" id ""
printf '\n0 1 2\n3 4 5\n' > in
run
stopped "no names" "-:2: this line should name the columns"
printf 'cell x y lon lat\n' > in
run
stopped "two surfaces" "-:1: columns lon lat and x y: choose with --surface"
printf 'cell x y x\n' > in
run
stopped "a column twice" "-:1: two columns are named 'x'"
printf 'cell x y X\n' > in
run
stopped "a column twice, once in capitals" "-:1: two columns are named 'x'"
square > in
run
cp out lower
{ echo 'cell X Y' && square | tail -n +2; } > in
run
check "names of coordinates in capitals" "$(cat out)" "$(cat lower)"
printf 'K X Y\na 0 0\na 1 0\na 0 1\nb 0 0\nb 1 0\nb 0 1\n' > in
run
measured "but K is an id, and k the order of corners" id "a b"
printf 'cell x\n' > in
run
stopped "half a point" "-:1: no column 'y'"
printf 'cell x y z nx ny\n' > in
run
stopped "half a normal" "-:1: no column 'nz'"

square > in
printf 'b 0 0\nb 1 oops\nb 1 1\n' >> in
run
stopped "no number" "-:7: 'oops' in column 'y' is not a number"
check "what came before has been printed" "$(column id)" a
square > in
printf 'b 0 1,5\n' >> in
run
stopped "a decimal comma" "-:6: '1,5' in column 'y' is not a number"
square > in
printf 'b 0\n' >> in
run
stopped "a missing field" "-:6: no field for column 'y'"
printf 'cell\tx\ty\na\t0\t\n' > in
run
stopped "an empty field" "-:2: column 'y' is empty"
printf 'cell x y\nNew Zealand 0 0\n' > in
run
stopped "too many fields" "-:2: 4 fields, but 3 columns are named"
printf 'cell,x,y\n"a,0,0\n' > in
run
stopped "an open quote" "-:2: a quote is not closed"
printf 'cell x y\na 0 0\na 1\0 0\n' > in
run
stopped "binary" "-:3: a zero byte"

# --- refused polygons, each by its name -------------------------------------------------------------------------------

printf 'cell x y\na 0 0\na 1 0\nb 0 0\nb 1 0\nb 1 1\n' > in
run
refused "two corners" too_few_corners 2
check "the run goes on" "$(column status)" "too_few_corners ok"
check "n of a refused polygon" "$(column n)" "2 3"
for number in nan inf -inf 1e999; do
    printf 'cell x y\na 0 0\na 1 0\na %s 1\n' $number > in
    run
    refused "$number" not_finite 4
    run --smooth 3 --merge
    refused "$number is not smeared over its neighbours" not_finite 4
done
printf 'cell lon lat\na 0 0\na 1 0\na 1 91\n' > in
run
refused "a latitude of 91" bad_argument 4 ": a latitude lies between -90 and 90"
printf 'cell lon lat\na 0 0\na 0 0\na 1 91\n' > in
run --merge
check "what is at fault is not repaired" "$(field 1 n)" 3
printf 'cell x y\na 0 0\n# here\na 1 0\n\na 1 0\na 1 1\n' > in
run
refused "coincident corners" coincident_corners 6 "; --merge drops one of them"
printf 'cell x y z nx ny nz\na 0 0 0 0 0 1\na 1 0 0 0 0 0\na 1 1 0 0 0 1\n' > in
run
refused "zero normal" zero_normal 3
printf 'cell x y z nx ny nz\na 0 0 0 0 0 1\na 0 0 1 0 0 1\na 1 1 0 0 0 1\n' > in
run
refused "upright edge" upright_edge 3
printf 'cell lon lat\na 0 0\na 0 10\na 180 -10\na 90 0\n' > in
run
refused "antipodes" antipodal_corners 4
printf 'cell x y\n\na 0 0\na 0 1\na 1 1\na 1 0\n' > in
run
refused "clockwise" clockwise 3
has "clockwise: what to do" err "--reverse auto"
printf 'cell lon lat\na 0 0\na 120 0\na -120 0\n' > in
run
refused "a great circle" too_much_curvature 2
printf 'cell x y\na 0 0\na 2 0\na 2 2\na 0 2\na 0 0\na 3 -1\na 3 3\na -1 3\na -1 -1\n' > in
run
check "a double loop" "$(field 1 status)" crosses_itself
printf 'one x y\na 0 0\na 0 1\na 1 1\n' > one.tsv
run one.tsv
has "messages name the file" err "one.tsv:2: "

# --- repairs: --merge, --smooth, --reverse ----------------------------------------------------------------------------

printf 'cell x y\na 0 0\na 0 0\na 1 0\na 1 0\na 1 0\na 1 1\na 0 1\na 0 0\na 0 0\n' > in
run --merge
measured "merge" n 4
near "merge: area" "$(field 1 area)" 1
printf 'cell x y z\na 1 0 0\na 2 0 0\na 0 1 0\na 0 0 1\n' > in
run --surface sphere
check "on a sphere one direction is one point" "$(field 1 status)" coincident_corners
run --surface sphere --merge
measured "merge on a sphere" n 3
printf 'cell x y z nx ny nz\na 0 0 0  0 0 1\na 0 0 0  0 0 1\na 1 0 0  0 0 1\na 1 1 0  0 0 0\n' > in
run --merge
refused "merge: lines go along" zero_normal 5
printf 'cell x y z nx ny nz\na 0 0 0  0 0 1\na 0 1 0  0 0 0\na 1 1 0  0 0 1\na 1 0 0  0 0 1\n' > in
run --reverse always
refused "reverse: lines go along" zero_normal 3

printf 'cell x y\na 0 0\na 0 1\na 1 1\na 1 0\nb 0 0\nb 1 0\nb 1 1\nb 0 1\n' > in
run --reverse never
check "reverse never" "$(column status)" "clockwise ok"
run --reverse auto
measured "reverse auto" status "ok ok"
near "reversed area" "$(field 1 area)" 1
run --reverse always
check "reverse always" "$(column status)" "ok clockwise"
has "reverse always: where" err "-:6: "
printf 'cell x y z nx ny nz\na 0 0 0 0 0 1\na 0 1 0 0 .1 1\na 1 1 0 .1 .1 1\na 1 0 0 .1 0 1\n' > in
run --reverse auto
measured "reverse: normals go along" status ok
first=$(field 1 mu_4)
printf 'cell x y z nx ny nz\na 1 0 0 .1 0 1\na 1 1 0 .1 .1 1\na 0 1 0 0 .1 1\na 0 0 0 0 0 1\n' > in
run
check "reverse: the same as written in reverse" "$first" "$(field 1 mu_4)"

printf 'cell x y\na 0 0\na 3 0\na 3 3\na 0 3\n' > in
run --smooth 1
near "smooth: each corner is the mean of three" "$(field 1 area)" 1
run --smooth 2
near "smooth twice" "$(field 1 L)" 1.3333333333333333
cat > in << 'END'
cell x y z nx ny nz
a 1 0 0  1 0 0
a 0 1 0  0 1 0
a 0 0 1  0 0 1
END
run --smooth 1
check "smooth: three corners become one" "$(field 1 status)" coincident_corners
printf 'cell x y z nx ny nz\na 0 0 0 0 0 1\na 3 0 0 3 0 1\na 3 3 0 0 3 1\na 0 3 0 0 0 1\n' > in
run --smooth 1
first=$(sed -n 2p out)
printf 'cell x y z nx ny nz\na 1 1 0 1 0 1\na 2 1 0 1 1 1\na 2 2 0 1 1 1\na 1 2 0 0 1 1\n' > in
run
check "smooth: normals as well as corners" "$first" "$(sed -n 2p out)"

# --- options that change the numbers ----------------------------------------------------------------------------------

square > in
run --max-rank 1
check "one rank" "$(head -n 1 out)" "$(printf 'id\tn\tstatus\tL\tS\tarea\tmu_1\ttheta_1')"
run --max-rank=128
check "many ranks" "$(awk -F '\t' '{ print NF }' out | tr '\n' ' ')" "262 262 "
near "many ranks: mu_128" "$(field 1 mu_128)" 1
near "many ranks: mu_127" "$(field 1 mu_127)" 0
printf 'cell x y\na 0 0\na 1 0\na 0 0.3\n' > in
run --digits 3
check "three digits" "$(field 1 L)" 2.34
run --digits 17
check "17 digits by default" "$(run; cat out)" "$(run --digits 17; cat out)"
check "17 digits" "$(field 1 L)" 2.3440306508910549

printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --transport parallel
near "classical transport of the octant: mu_3 = sqrt(u^2 + (1-u)^2)/3 at u = 1/2" "$(field 1 mu_3)" 0.23570226039551584
near "classical transport: L" "$(field 1 L)" 4.71238898038469
run --transport corrected
near "corrected transport" "$(field 1 mu_3)" 1
printf 'ring lon lat\no 0 0\no 0 90\no 90 0\n' > in
run --transport parallel
refused "classical transport refuses the same" clockwise 2

printf 'cell x y\na 0 0\na 0 -2\na 1 -2\na 1 0\n' > in
run --directions
check "directions: columns" "$(head -n 1 out | cut -f 19-)" \
    "$(for p in 1 2 3 4 5 6; do printf 'e_%s_x e_%s_y ' $p $p; done | sed 's/ $//' | tr ' ' '\t')"
near "the first edge runs down, and the long sides face left and right: e_2_x" "$(field 1 e_2_x)" -1
near "e_2_y" "$(field 1 e_2_y)" 0
check "e_1 is undefined" "$(field 1 e_1_x)$(field 1 e_1_y)" ""
printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --directions
near "the octant points away from its third corner: e_3_x" "$(field 1 e_3_x)" 0
near "e_3_z" "$(field 1 e_3_z)" -1
cp octant.tsv in
run --directions --surface embedded
near "chords: the co-normal of the first edge is the same" "$(field 1 e_3_z)" -1
printf 'cell x y z\na 1 0 0\na 0 1 1\na 0 0 1\n' > in
run --surface sphere --directions --digits 12
first=$(sed -n 2p out)
printf 'cell x y z\na 3 0 0\na 0 1 1\na 0 0 2\n' > in
run --surface sphere --directions --digits 12
check "directions do not notice corners off the sphere" "$first" "$(sed -n 2p out)"
for triangle in '0 0 4 0 0 3' '4 0 0 3 0 0' '0 3 0 0 4 0'; do
    { echo 'cell x y'; printf 'a %s %s\n' $triangle; } > in
    run --directions
    near "a direction of the plane, wherever the outline begins: $triangle" \
        "$(awk -v x="$(field 1 e_2_x)" -v y="$(field 1 e_2_y)" 'BEGIN { printf "%.17g", x * y / (x * x + y * y) }')" \
        0.4472135954999579
done

# --- several files ----------------------------------------------------------------------------------------------------

square one > one.tsv
printf 'lon lat\n0 0\n90 0\n0 90\n\n0 0\n10 0\n0 10\n' > two.csv
square three > in
run one.tsv two.csv - one.tsv
measured "files, and - among them, in their order" id "a 0 1 a a"
check "one line of names" "$(grep -c '^id' out)" 1
run one.tsv --directions two.csv
stopped "directions of plane and space" "two.csv: directions in the plane and in space"
run one.tsv --directions --json two.csv
check "but in JSON: exit status" "$status" 0
run one.tsv none.tsv
stopped "no such file" "none.tsv: "
check "what came before has been printed" "$(column id)" a
run .
stopped "a directory" ".: "
cp one.tsv ./--json
run -- --json
measured "-- ends the options" id a

# --- blocks of a file, batches of polygons ----------------------------------------------------------------------------
# Files are read in blocks of 64 KiB, and some thousand polygons are measured together. Nobody shall notice.

# A table behind a comment that grows: the first block ends at every byte of the table in turn.
printf '\r\ncell x y\r\na 0 0\r\na 1 0\r\na 1.25 1\r\rb 0 0\rb 1 0\nb 1 -1\nc 5e-1 0' > table
comment=$(awk 'BEGIN { text = "#"; while (length(text) < 65460) text = text text; print substr(text, 1, 65460) }')
for byte in $(awk 'BEGIN { for (i = 0; i < 80; ++i) print i }'); do
    { printf %s "$comment" && cat table; } > in
    "$surfmink" --max-rank 1 in
    comment=$comment#
done > outs 2>&1
sed 's/^\(in:[0-9]*\):.*/\1/' outs | cut -f 1-4 > got
check "the end of a block within lines" "$(sort got | uniq -c | tr -s ' ')" \
    "$(printf ' 80 %s\n' "a	3	ok	3.6315574657626275" "b	3	clockwise	" "c	1	too_few_corners	" \
        "id	n	status	L" in:10 in:7)"
printf 'cell x y\r\na 0 0\r\na 1 0\r\na 1 1\rb 0 0\rb 1 0\rb 1 1\r' > in
dd bs=1 if=in 2> /dev/null | "$surfmink" > out 2> err
status=$?
measured "a pipe that yields byte by byte" n "3 3"
{
    awk 'BEGIN { text = "#"; while (length(text) < 1000000) text = text text; print text }'
    square
    printf 'b 0 1'
} > in
cat in | "$surfmink" > out 2> err
has "a line of a megabyte, and its successors" err "-:7: a polygon"
square > in
printf 'b 0 0\nb 0\0 1\n' >> in
run
stopped "a zero byte behind a polygon" "-:7: a zero byte"
check "the polygon has been measured" "$(column id)" a

awk 'BEGIN { print "cell x y"; for (i = 0; i < 9000; ++i) print i " 0 0\n" i " 1 0\n" i " 1 1" }' > in
printf 'z 0\0 0\n' >> in
run
stopped "a zero byte in a later block" "-:27002: a zero byte"
check "all polygons that ended before it have been measured" "$(tail -n 1 out | cut -f 1)" 8998

# Many polygons, some of them clockwise or with a corner twice, then a line that says nothing. Both outputs go to one
# file.
awk 'BEGIN { print "cell x y"
             for (i = 1; i <= 5000; ++i)
                 print i (i % 400 ? " 0 0\n" : " 1 1\n") i " 1 0\n" i (i % 300 ? i % 400 ? " 1 1" : " 0 0" : " 1 0")
             print "last 0 0\nlast oops 0" }' > in
"$surfmink" --max-rank 1 in > out 2>&1
check "many polygons: exit status" $? 1
awk 'BEGIN { print "id\tstatus"
             for (i = 1; i <= 5000; ++i)
                 print i "\t" (i % 300 == 0 ? "coincident_corners\nin:" 3 * i + 1 : \
                               i % 400 == 0 ? "clockwise\nin:" 3 * i - 1 : "ok")
             print "in:15003" }' > want
sed 's/^\(in:[0-9]*\):.*/\1/' out | cut -f 1,3 > got
check "many polygons: rows and complaints keep their order" "$(cmp got want && echo same)" same
printf 'cell x y\na 0 0\na 1 0\na 1 0\n' > in
printf 'b %s\n' '0 0' '-1 -1' '-1 3' '3 3' '3 -1' '0 0' '0 2' '2 2' '2 0' >> in
printf 'c 0 0\nc 0 1\nc 1 0\n' >> in
run --reverse auto
check "what is turned round changes nothing for the others" "$(column status) $(cut -d : -f 2 err | tr '\n' ' ')" \
    "coincident_corners crosses_itself ok 4 5 "
awk 'BEGIN { print "cell x y"; for (i = 1; i <= 5000; ++i) print i " 0 0\n" i " 1 0\n" i " 1 1" }' > in
run --max-rank 250
check "many polygons, many ranks" "$(tail -n 1 out | cut -f 1-3)" "$(printf '5000\t3\tok')"
awk 'BEGIN { print "cell x y"; step = 6.283185307179586 / 7000
             for (i = 1; i <= 5; ++i)
                 for (k = 0; k < 7000; ++k) printf "%d %.17g %.17g\n", i, cos(step * k), sin(step * k) }' > in
run
measured "a few polygons of many corners" n "7000 7000 7000 7000 7000"

# Memory grows with the largest polygon, not with the table. (Not all shells and programs can be limited.)
limited() {
    (ulimit -v 40000 && exec "$surfmink" --max-rank 12 in) 2> err
}
square > in
if { limited > /dev/null; } 2> /dev/null; then
    awk 'BEGIN { print "cell x y"; for (i = 0; i < 200000; ++i) print i " 0 0\n" i " 1 0\n" i " 1 1" }' > in
    limited | tail -n 1 > out
    check "a long table takes little memory" "$(cut -f 1-3 out) $(cat err)" "$(printf '199999\t3\tok ')"
fi

# Polygons of one file are measured together, those of many files alone. These have much in common, and many faults.
awk 'function ring(id, n, turn, east, north, size,   i, a) {
         for (i = 0; i < n; ++i) {
             a = 6.283185307179586 * turn * i / n
             point(id, east + size * cos(a), north + size * (1 + (n > 3) * 0.3 * cos(3 * i)) * sin(a))
         }
     }
     function point(id, x, y) { print id, x, y, 1, x, y, 1 }
     BEGIN { CONVFMT = OFMT = "%.17g"
             print "cell x y z nx ny nz"
             for (k = 0; k < 20; ++k) {
                 ring("hexagon" k, 6, 1, k / 20, 0.1, 0.2); ring("back" k, 5, -1, 0.1, k / 20, 0.3)
                 ring("long" k, 6 * k + 3, 1, 0, 0, 0.5); ring("round" k, 6 * k + 3, -1, 0, 0, 0.4)
                 ring("two" k, 2, 1, 0, 0, 1)
             }
             point("again", 0, 0); point("again", 0, 0); point("again", 1, 0); point("again", 1, 1)
             ring("closed", 7, 1, 0, 0, 0.4); point("closed", 0.4, 0)
             point("nan", 0, 0); point("nan", 1, 0); point("nan", "nan", 1)
             ring("square", 4, 1, 0, 0, 0.1) }' > in
awk 'NR == 1 { names = $0; next }
     $1 != last { close(file); file = sprintf("alone.%03d", ++files); print names > file; last = $1 }
     { print > file }' in
for surface in plane sphere embedded; do
    for options in "--max-rank 12" "--reverse auto --directions" \
        "--reverse auto --merge --smooth 1 --transport parallel --json" "--order 4 --error --sharp 40"; do
        run --surface $surface $options in
        check "$surface $options, together as alone" "$status $(cat out)" \
            "2 $("$surfmink" --surface $surface $options alone.* 2> err)"
    done
done

# A user who types, and a pipe that goes on later: what is complete is written. A command that waits is killed.
mkfifo typed shown
"$surfmink" < typed > shown 2> err &
command=$!
{ sleep 20 && kill "$command"; } > /dev/null 2>&1 < /dev/null &
guard=$!
exec 3> typed 4< shown
printf 'cell x y\na 0 0\na 1 0\na 1 1\nb 0 0\nb 1' >&3
read -r names <&4
read -r row <&4
check "while the input pauses, no row is held back" "${row%%	*}" a
printf ' 0\nb 1 1\n' >&3
exec 3>&-
cat <&4 > out
exec 4<&-
wait "$command"
check "the input went on: exit status" $? 0
check "the input went on" "$(cut -f 1-3 out)" "$(printf 'b\t3\tok')"
kill "$guard"

# --- meshes -----------------------------------------------------------------------------------------------------------

cat > cube.off << 'END'
# a cube
OFF
8 6 12   # vertices, faces, edges
-1 -1 -1
 1 -1 -1
 1  1 -1   # a vertex
-1  1 -1 

-1 -1  1
 1 -1  1
 1  1  1
-1  1  1
4 3 2 1 0
4 4 5 6 7   .5 .5 .5
# a face
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
END
run cube.off
measured "a cube" id "0 1 2 3 4 5"
check "faces" "$(column n)" "4 4 4 4 4 4"
near "L of a face" "$(field 3 L)" 8
near "mu_4 of a face" "$(field 6 mu_4)" 1
near "with normals only the area is an estimate" \
    "$(column area | awk '{ printf "%.17g", $1 + $2 + $3 + $4 + $5 + $6 }')" 37.69911184307752 1.6
near "the normals of a cube's corners make of each right angle a turn by pi/3" "$(field 1 S)" 4.1887902047863905
run cube.off --surface sphere
near "six faces tile the sphere" \
    "$(column area | awk '{ printf "%.17g", $1 + $2 + $3 + $4 + $5 + $6 }')" 12.566370614359172
run cube.off --surface plane
check "seen from above, four faces vanish, one shows its back" \
    "$(column status | tr ' ' '\n' | sort | uniq -c | tr -s ' \n' ' ')" " 1 clockwise 4 coincident_corners 1 ok "
has "a refused face: its line" err "cube.off:13: "
{ echo 'OFF 3 1 0'; printf '0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n'; } > flat.OFF
run flat.OFF
measured "counts on the first line" n 3
near "a flat triangle is measured as in the plane" "$(field 1 S)" 6.283185307179586

# Three faces of different areas: at each corner their normals are weighted by them.
cat > pyramid.off << 'END'
OFF
4 3 0
0 0 0
3 0 0
0 1 0
0 0 1
3 0 1 2
3 0 3 1
3 0 2 3
END
run pyramid.off
cat > in << 'END'
face x y z nx ny nz
0 0 0 0 1 3 3
0 3 0 0 0 3 3
0 0 1 0 1 0 3
END
check "mesh normals are area-weighted" "$(sed -n 2p out)" "$("$surfmink" in | sed -n 2p)"

mesh() {
    printf "$1" > bad.off
    run bad.off
}
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n'
stopped "an index too large" "bad.off:6: there is no vertex 3"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n'
stopped "a negative index" "bad.off:6: '-1' is not the index of a vertex"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n'
stopped "a face cut short" "bad.off:6: 4 corners are announced, 3 follow"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 \n'
stopped "a face cut short, before a blank" "bad.off:6: 4 corners are announced, 3 follow"
mesh 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n'
stopped "a face too few" "bad.off:6: the file ends before face 1"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n'
stopped "a vertex too few" "bad.off:4: the file ends before vertex 2"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n'
stopped "a face too many" "bad.off:7: a line after the last of 1 faces"
mesh 'OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n'
stopped "half a vertex" "bad.off:4: a vertex needs x y z"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 z\n0 1 0\n3 0 1 2\n'
stopped "no number" "bad.off:4: 'z' is not a number"
mesh 'OFF\nmany 1 0\n'
stopped "no count" "bad.off:2: 'many' is not the number of vertices"
mesh 'OFF\n99999999999999999999 1 0\n'
stopped "a count too large" "bad.off:2: '99999999999999999999' is not the number of vertices"
mesh 'OFF\n4000000000000 1 0\n0 0 0\n'
stopped "a count without vertices takes no memory" "bad.off:3: the file ends before vertex 1"
mesh 'ply\n'
stopped "no mesh" "bad.off:1: a mesh begins with OFF"
mesh 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n2 0 1\n'
check "refused faces: exit status" "$status" 2
check "refused faces" "$(column status)" "not_finite too_few_corners"
has "refused faces: line" err "bad.off:7: "

# --- JSON -------------------------------------------------------------------------------------------------------------

square > in
run --json --max-rank 2 --digits 2
check "JSON" "$(sed 's/"mu_\([12]\)":[0-9.e-]*/"mu_\1":0/g' out)" \
    '{"id":"a","n":4,"status":"ok","L":4,"S":6.3,"area":1,"mu_1":0,"mu_2":0,"theta_1":null,"theta_2":null}' 
printf 'cell x y\na 0 0\na 1 0\n' > in
run --json --max-rank 1 --directions
check "JSON of a refused polygon" "$(sed 's/null/-/g' out)" \
    '{"id":"a","n":2,"status":"too_few_corners","L":-,"S":-,"area":-,"mu_1":-,"theta_1":-,"e_1_x":-,"e_1_y":-}'
has "undefined is null" out '"L":null,'
printf 'cell\tx\ty\n"\\\001\303\266\377/\t0\t0\n\340\200\257\t0\t0\n' > in
run --json --max-rank 1
has "JSON: quotes, backslashes, control characters, UTF-8, and what is not" out \
    "$(printf '{"id":"\\"\\\\\\u0001\303\266\357\277\275/",')"
has "JSON: an overlong slash is no UTF-8" out "$(printf '{"id":"\357\277\275\357\277\275\357\277\275",')"

# --- summary, quiet ---------------------------------------------------------------------------------------------------

{
    square
    printf 't 0 0\nt 4 0\nt 0 3\nu 0 0\nu 8 0\nu 0 6\nr 0 0\nr 3 0\nr 3 1\nr 0 1\nx 0 0\nx 1 0\n'
} > in
run --summary --quiet
check "summary: exit status" "$status" 2
check "summary" "$(cat err)" "4 measured, 1 refused
              mean        sd       25%       50%       75%
mu_1      0.000000  0.000000  0.000000  0.000000  0.000000
mu_2      0.348607  0.233733  0.335410  0.447214  0.460410
mu_3      0.400000  0.461880  0.000000  0.400000  0.800000
mu_4      0.661245  0.391160  0.322490  0.661245  1.000000
mu_5      0.400000  0.461880  0.000000  0.400000  0.800000
mu_6      0.304109  0.213472  0.268663  0.358218  0.393663
dominant rank (the p >= 2 with the largest mu_p):  p=2: 0  p=3: 2  p=4: 2  p=5: 0  p=6: 0"
check "standard output does not change" "$(cat out)" "$("$surfmink" in 2> /dev/null)"
run --quiet
check "quiet" "$status $(cat err)" "2 "
square > in
run --summary --max-rank 12
has "mu_4, mu_8 and mu_12 of a square are equal: the smallest is the dominant one" err \
    "p=4: 1  p=5: 0  p=6: 0  p=7: 0  p=8: 0"
cat > in << 'END'
cell x y
a 7.9734389939780144 6.0352523235827409
a -1.2399623334827061 9.9228268861017686
a -9.2134013274607209 3.8875745625190299
a -7.9734389939780144 -6.0352523235827391
a 1.2399623334827026 -9.9228268861017686
a 9.2134013274607227 -3.8875745625190272
END
run --summary --max-rank 12
has "and of a hexagon, even where rounding sees a difference" err "p=6: 1  p=7: 0"
printf 'cell lon lat\na 50 10\na 140 20\na 210 10\na 270 50\na 330 10\n' > in
run --summary --max-rank 2
has "dominant is p >= 2, though mu_1 = 0.23 is larger here" err "p=2: 1"
printf 'cell x y\nx 0 0\n' > in
run --summary --quiet
check "summary of nothing" "$(cat err)" "0 measured, 1 refused"

# --- pictures ---------------------------------------------------------------------------------------------------------

{
    square
    printf '<&>"%s 2 0\n<&>"%s 3 0\n<&>"%s 2.5 1\n' \' \' \'
    printf 'bad 0 2\nbad 0 3\nbad 1 3\n'
} > in
run --svg a.svg --color-by mu_3 --quiet
run --svg b.svg --color-by=3 --quiet
check "picture: exit status" "$status" 2
check "the same input gives the same bytes" "$(cmp a.svg b.svg && echo same)" same
has "picture: begins" a.svg '<svg xmlns="http://www.w3.org/2000/svg" '
check "picture: ends" "$(tail -n 1 a.svg)" "</svg>"
has "picture: ids are escaped" a.svg "<title>&#60;&#38;&#62;&#34;': mu_3 = "
has "picture: mu_3 of the square is the dark end" a.svg '" fill="#2b2161"><title>a: mu_3 = 0.0000</title>'
has "picture: what is refused is hatched" a.svg 'fill="url(#refused)" stroke="#8a8a8a"><title>bad: clockwise</title>'
has "picture: legend of the hatching" a.svg ">refused</text>"
check "picture: three strokes in the triangle, none in the square" \
    "$(grep -c stroke-linecap a.svg) $(grep stroke-linecap a.svg | tr -cd L)" "1 LLL"
run --svg a.svg --quiet
has "picture: mu_2 by default" a.svg "<title>a: mu_2 = 0.0000</title>"
run --svg a.svg --quiet --max-rank 1
has "picture: mu_1 where there is no mu_2" a.svg "<title>a: mu_1 = 0.0000</title>"
run --svg none/a.svg --quiet
stopped "picture: nowhere to put it" "none/a.svg: "
run --svg a.svg --view 1,0,0
stopped "picture: a plane is seen from above" "-: --view is for surfaces in space"
run --svg a.svg in one.tsv octant.tsv
stopped "picture: two kinds of surfaces" "octant.tsv: another kind of surface"

printf 'ring lon lat\n' > in
for lon in 0 60 120 180 240 300; do
    printf "c$lon $((lon - 5)) -5\nc$lon $((lon + 5)) -5\nc$lon $((lon + 5)) 5\nc$lon $((lon - 5)) 5\n"
done >> in
seen() {
    sed -n 's/.*<title>\([^:]*\):.*/\1/p' a.svg | tr '\n' ' '
}
# The path of an outline in the picture.
path() {
    sed -n "s/<path d=\"\([^\"]*\)\".*<title>$1:.*/\1/p" a.svg
}
run --svg a.svg --view 10,0
check "the far side of a sphere is hidden" "$(seen)" "c0 c60 c300 "
run --svg a.svg --view=-1,0,0
check "a direction, and --view=-1" "$(seen)" "c120 c180 c240 "
run --svg a.svg --view 33,0
check "cut by the horizon" "$(seen)" "c0 c60 c120 c300 "
check "the cut ends at the rim" "$(path c300 | tr 'MLZ' '\n\n\n' | awk '
    NF == 2 { r = sqrt(($1 - 380) ^ 2 + ($2 - 380) ^ 2); if (r > most) most = r }
    END { print (most > 358 && most < 358.6) }')" 1
run --svg a.svg --view 0,0
check "east is right" "$(path c60 | tr 'MLZ' '   ' | awk '{ print ($1 > 600) }')" 1
printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --svg a.svg --view 45,30
check "edges are great circles, not chords: a point every 2 degrees" \
    "$(path o | tr -cd L | wc -c | awk '{ print ($1 >= 134) }')" 1
check "north is up" "$(path o | tr 'MLZ' '\n\n\n' | awk '
    NF == 2 && (n++ == 0 || $2 < top) { top = $2 }
    END { print (top < 100) }')" 1
# A letter C, its arms to the east; what is seen of it is one ring from the west and two from the east.
cat > in << 'END'
ring lon lat
C -40 -40
C 40 -40
C 40 -20
C -20 -20
C -20 20
C 40 20
C 40 40
C -40 40
END
run --svg a.svg --view -70,0
check "an outline that goes behind the horizon and comes back: one ring" "$(path C | tr -cd M)" M
run --svg a.svg --view 80,0
check "two rings" "$(path C | tr -cd M)" MM
# Refused as clockwise, and cut by the horizon: the smaller side is drawn, not the rest of the sphere.
printf 'ring lon lat\nr 80 0\nr 80 10\nr 100 10\nr 100 0\nm 40 0\nm -40 20\nm -40 0\n' > in
run --svg a.svg --view 0,0 --quiet
check "clockwise at the rim" "$(path r | tr -cd L | wc -c | awk '{ print ($1 < 25) }')" 1
printf 'ring lon lat\no 40 0\no 41 0\no 41 1\n' > in
run --svg a.svg --view 30,0
has "a few small outlines fill the picture, and the middle of the sphere lies outside" a.svg '<circle cx="-'
printf 'ring lon lat\no 200 0\no 201 0\no 201 1\n' > in
run --svg a.svg
check "without --view the eye is where the outlines face" "$(seen)" "o "
# The strokes of a large triangle do not depend on where its outline begins.
glyph() {
    { echo 'ring lon lat'; printf 'o %s %s\n' $1; } > in
    run --svg a.svg --view 30,20 --color-by mu_3
    sed -n 's/.*stroke-linecap="round" d="\([^"]*\)".*/\1/p' a.svg | tr M '\n' | sort
}
check "strokes: wherever the outline begins" "$(glyph '0 0 70 10 0 50')" "$(glyph '70 10 0 50 0 0')"
run cube.off --svg a.svg --view 1,2,3
check "three faces of a cube" "$(seen)" "3 4 1 "
run cube.off --svg a.svg --view 1,2,3 --color-by mu_4
check "with four strokes each" "$(grep stroke-linecap a.svg | tr -cd 'L\n' | tr '\n' ' ')" "LLLL LLLL LLLL "
run cube.off --svg a.svg --view 0,0,1
check "one face of a cube" "$(seen)" "1 "

# --- smooth curves ----------------------------------------------------------------------------------------------------

# ellipse N: x = 3 cos t, y = 2 sin t at uneven t. (At even ones mu of the polygon happens to be that of the curve.)
ellipse() {
    awk -v n="$1" 'BEGIN { print "x y"; for (i = 0; i < n; ++i) {
        t = 8 * atan2(1, 1) * i / n; t += 0.3 * sin(t + 1); printf "%.17g %.17g\n", 3 * cos(t), 2 * sin(t) } }'
}
length=$(awk 'BEGIN { for (i = 0; i < 1000; ++i) { t = 8 * atan2(1, 1) * i / 1000
    sum += sqrt(9 * sin(t) * sin(t) + 4 * cos(t) * cos(t)) }
    printf "%.17g", sum * 8 * atan2(1, 1) / 1000 }')
ellipse 200 > in
run --error
check "estimates: exit status" "$status $(cat err)" "0 "
check "estimates: columns" "$(head -n 1 out | cut -f 12-20 | tr '\t' ' ')" \
    "mu_6 error_L error_1 error_2 error_3 error_4 error_5 error_6 theta_1"
# bounded: the error of L is at most what is said about it, and not a tenth of that.
bounded() {
    awk -v want="$length" -v got="$(field 1 L)" -v said="$(field 1 error_L)" '
        BEGIN { error = got > want ? got / want - 1 : 1 - got / want; print (error <= said && said < 10 * error) }'
}
check "order 2: the estimate bounds the error of L" "$(bounded)" 1
rough=$(field 1 mu_2)
run
near "order 2: what is measured is the polygon" "$(field 1 mu_2)" "$rough" 1e-15
run --order 4 --error
near "order 4: L" "$(field 1 L)" "$length" 1e-7
check "order 4: the estimate bounds the error of L" "$(bounded)" 1
near "order 4: area" "$(field 1 area)" "$(awk 'BEGIN { printf "%.17g", 24 * atan2(1, 1) }')" 1e-6
found=$(field 1 mu_2)
error=$(field 1 error_2)
ellipse 4096 > in
run --order 4
near "order 4: mu_2 within three times its estimate" "$found" "$(field 1 mu_2)" \
    "$(awk -v e="$error" 'BEGIN { print 3 * e }')"
check "order 4 is the nearer one" "$(awk -v a="$rough" -v b="$found" -v c="$(field 1 mu_2)" \
    'BEGIN { print ((a - c) * (a - c) > 50 * (b - c) * (b - c)) }')" 1
run --order 2
check "order 2 is the default" "$(cat out)" "$(run; cat out)"
ellipse 4 > in
run --error --max-rank 2
check "four corners say nothing" "$(field 1 error_L) $(field 1 error_1) $(field 1 error_2)" "1 1 1"
run --error --max-rank 2 --json
has "estimates in JSON" out '"error_L":1,"error_1":1,"error_2":1,"theta_1"'
run --error --max-rank 2 --summary --quiet
has "the largest estimates in the summary" err "75% max error"
check "of mu_2" "$(awk '$1 == "mu_2" { print $7 }' err)" 1.000000

# A square with many corners on each side: its corners count if they are told.
awk 'BEGIN { print "x y"; n = 10; for (i = 0; i < 4 * n; ++i) { s = int(i / n); t = (i % n) / n
    print (s == 0 ? t : s == 1 ? 1 : s == 2 ? 1 - t : 0), (s == 0 ? 0 : s == 1 ? t : s == 2 ? 1 : 1 - t) } }' > in
run --order 4
check "order 4 rounds corners off" "$(awk -v mu="$(field 1 mu_4)" 'BEGIN { print (mu < 0.95) }')" 1
run --order 4 --error --sharp 45
near "unless they are sharp" "$(field 1 mu_4)" 1
near "and then knows it" "$(field 1 error_4)" 0
run --order 4 --sharp 95
check "90 degrees are less than 95" "$(awk -v mu="$(field 1 mu_4)" 'BEGIN { print (mu < 0.95) }')" 1

# The same circle on a sphere of radius 2 by great circles and by chords with normals, once clockwise.
awk 'BEGIN { print "x y z nx ny nz"; for (i = 0; i < 48; ++i) { t = 8 * atan2(1, 1) * i / 48
    x = sin(1) * cos(t); y = sin(1) * sin(t); z = cos(1)
    printf "%.17g %.17g %.17g %.17g %.17g %.17g\n", 2 * x, 2 * y, 2 * z, x, y, z } }' > in
exact=$(awk 'BEGIN { printf "%.17g", 16 * atan2(1, 1) * sin(1) }')
run --order 4
near "a circle on a sphere by chords" "$(field 1 L)" "$exact" 1e-4
run --order 4 --surface sphere --radius 2
near "by great circles" "$(field 1 L)" "$exact" 1e-4
near "its area" "$(field 1 area)" "$(awk 'BEGIN { printf "%.17g", 32 * atan2(1, 1) * (1 - cos(1)) }')" 1e-3
run --order 4 --reverse always
refused "order 4: clockwise" clockwise 2
run --order 4 --reverse always --surface plane --error
refused "order 4: clockwise in the plane" clockwise 2
awk 'NR == 1 { print; next } { line[NR] = $0 } END { for (i = NR; i > 1; --i) print line[i] }' in > turned
mv turned in
run --order 4 --reverse auto
near "turned round" "$(field 1 L)" "$exact" 1e-4
sed '4s/.*/nan 0 0 0 0 1/' in > bad
mv bad in
run --order 4 --error
check "order 4: a corner that is none" "$(field 1 status) $(grep -c ':4: ' err)" "not_finite 1"
run cube.off --order 4
stopped "order 4 of a mesh" "cube.off: --order 4 needs exact normals"
run cube.off --order 4 --surface sphere
check "order 4 of a mesh on a sphere" "$(column status)" "$(run cube.off --surface sphere; column status)"
run cube.off --error
check "estimates of a mesh" "$(field 1 error_4)" 1

# --- usage ------------------------------------------------------------------------------------------------------------

: > in
run --help
check "help: exit status" "$status" 0
check "help leads with examples" "$(sed -n 3p out)" EXAMPLES
for option in surface radius max-rank transport order error sharp smooth reverse merge digits directions json svg \
    color-by view histogram scatter ply title unit summary quiet help version; do
    has "help explains --$option" out "  --$option"
done
run --version
check "version" "$status $(sed 's/[0-9][0-9.]*/N/' out)" "0 surfmink N"

wrong() {
    text=$1
    shift
    run "$@"
    stopped "$*" "surfmink: $text"
    has "$*: hint" err "--help"
    check "$*: nothing printed" "$(cat out)" ""
}
wrong "unknown option '--frobnicate'" --frobnicate
wrong "unknown option '--frobnicate'" --frobnicate=3
wrong "unknown option '-j'" -j
wrong "unknown option '--rad'" --rad 1
wrong "--surface is plane, sphere or embedded, not 'cone'" --surface cone
wrong "--transport is corrected or parallel, not 'none'" --transport=none
wrong "--reverse is auto, always or never, not ''" --reverse=
wrong "--order is 2 or 4, not '3'" --order 3
wrong "--sharp is an angle between 0 and 180 degrees, not '180'" --order 4 --sharp 180
wrong "--sharp is an angle between 0 and 180 degrees, not 'x'" --order 4 --sharp x
wrong "--sharp is for --order 4 and --error" --sharp 30
wrong "--transport parallel has neither --order 4 nor --error" --transport parallel --order 4
wrong "--transport parallel has neither --order 4 nor --error" --transport parallel --error
wrong "--radius needs a value" --radius
wrong "--radius is a positive number, not '0'" --radius 0
wrong "--radius is a positive number, not 'nan'" --radius nan
wrong "--radius is a positive number, not '1m'" --radius 1m
wrong "--max-rank is a whole number from 1 to 1000000, not '0'" --max-rank 0
wrong "--max-rank is a whole number from 1 to 1000000, not '2.5'" --max-rank 2.5
wrong "--smooth is a whole number from 0 to 1000000, not '-1'" --smooth -1
wrong "--digits is a whole number from 1 to 17, not '18'" --digits 18
wrong "--json takes no value" --json=yes
wrong "--color-by is one of mu_1, mu_2, ... or several, not 'mu_0'" --color-by mu_0
wrong "--color-by is one of mu_1, mu_2, ... or several, not '2,,3'" --color-by 2,,3
wrong "--color-by is one of mu_1, mu_2, ... or several, not 'mu_2,'" --color-by mu_2,
wrong "--color-by is one of mu_1, mu_2, ... or several, not ''" --color-by ''
wrong "--color-by is one of mu_1, mu_2, ... or several, not '99999999999999999999'" --color-by 99999999999999999999
wrong "--color-by takes at most 12 ranks" --color-by 1,1,1,1,1,1,1,1,1,1,1,1,1
wrong "--color-by mu_7 needs --max-rank 7" --color-by mu_2,mu_7 --svg a.svg
wrong "--color-by mu_7 needs --max-rank 7" --color-by mu_7 --svg a.svg
wrong "--color-by is for pictures" --color-by mu_2
wrong "--view is for pictures" --view 1,2
wrong "--view is LON,LAT in degrees, a direction X,Y,Z, front or back, not '1'" --svg a.svg --view 1
wrong "--view is LON,LAT in degrees, a direction X,Y,Z, front or back, not '0,0,0'" --svg a.svg --view 0,0,0
wrong "--view can be given 6 times at most" --view 1,2 --view 1,2 --view 1,2 --view 1,2 --view 1,2 --view 1,2 --view 1,2
wrong "--svg draws 12 panels at most" \
    --svg a.svg --view front --view back --view 1,2 --view 1,3 --view 1,4 --color-by 1,2,3
wrong "--view 1,91: a latitude" --svg a.svg --view 1,91
wrong "--svg needs the name of a file" --svg -
wrong "--histogram needs the name of a file" --histogram=
wrong "--scatter needs the name of a file" --scatter -
wrong "--ply needs the name of a file" --ply -
wrong "--svg and --ply would write the same file" --svg a --histogram b --ply a
wrong "--title is for pictures" --title x
wrong "--title is for pictures" --title x --ply a.ply
wrong "--unit is for pictures" --unit um --histogram a.svg
wrong "--view is for pictures" --view 1,2 --ply a.ply
wrong "--scatter needs two ranks" --scatter a.svg --color-by mu_2
wrong "--scatter needs two ranks" --scatter a.svg --max-rank 1
wrong "--directions is edge, center or centre, not 'middle'" --directions=middle
wrong "--title needs a value" --title

totals
