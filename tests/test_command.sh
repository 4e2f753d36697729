#!/bin/sh
# test_command.sh COMMAND: holds the command `surfmink` to what its --help promises. Needs only a POSIX shell.
. "$(dirname "$0")/harness.sh"
surfmink=$(absolute "$1")
data=$(absolute "$(dirname "$0")/../examples/data")
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
 a   1  9  blue    2

 a   0  8  -       2
 b   0  0  -       5
 b   0  1  -       6
 b   1  2  -       6
END
run
check "columns that are not looked at, and one that changes within an outline" "$(cat err)" \
    "-: id: id; not looked at: colour (--id names others)
-:7: column 'colour' changes within outline a; if it tells outlines apart, say so with --id"
run --quiet
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
check "an id that comes again is told" "$(cat err)" \
    "-:8: id a comes again: only lines that follow each other are one outline"
run --quiet
measured "an id that comes again is another polygon" id "a b a"
printf 'x y\n\n0 0\n1 0\n# not an end\n1 1\n\n\n2 0\n3 0\n3 1\n' > in
run
measured "without ids a blank line ends a polygon" id "0 1"
check "without ids: corners" "$(column n)" "3 3"
printf 'cell x y\na 0 0\na 1 0\na 1 1\n>\na 5 5\na 6 5\na 6 6\n' > in
run
has "with ids what parts nothing is told" err "-:5: a blank line, or one with >, within outline a: it goes on"
printf 'sep=;\ncell;x;y\na;0,5;0\na;1;0\na;1;1\n' > in
run --quiet
check "a separator that Excel is told" "$status $(column area)" "0 0.25"
printf 'Unnamed: 0,x,y\n0,0,0\n1,1,0\n2,1,1\n' > in
run
measured "an index of pandas is no id" n 3
for head in 'lon (rad),lat (rad)' 'ra [h],dec (deg)' 'lon,lat(arcsec)'; do
    printf "$head\\n0,0\\n1,0\\n0,1\\n" > in
    run
    stopped "not in degrees: $head" "longitudes and latitudes are read in degrees: convert them"
done
printf 'index,shape-type,vertex-index,axis-0,axis-1,axis-2\n' > in
printf '0,polygon,0,3,0,1\n0,polygon,1,3,10,2\n0,polygon,2,3,12,20\n' >> in
run --quiet
check "napari, a stack" "$(column id) $(column area)" "0/3 89"
printf 'lon lat\n0 0\n1 0\n0 1\n' > in
run --y-down
stopped "--y-down on a sphere" "--y-down is for x y of an image"
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
run --quiet
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
printf 'cell x y\na 2 0\na 2 2\na 0 2\na 0 0\na 3 -1\na 3 3\na -1 3\na -1 -1\na 0 0\n' > in
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
run --quiet --surface sphere --merge
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
check "one line of names" "$(grep -c '^file.id' out)" 1
check "files are told apart" "$(column file)" "one.tsv two.csv two.csv - one.tsv"
run one.tsv one.tsv --json --max-rank 1
has "in JSON as well" out '{"file":"one.tsv","id":"a",'
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

# --- which rows are one outline ---------------------------------------------------------------------------------------

# Two unit squares and a triangle, told apart by two columns.
cat > frames.tsv << 'END'
frame track_id Area x y
1 7 1 0 0
1 7 1 1 0
1 7 1 1 1
1 7 1 0 1
1 8 1 2 0
1 8 1 3 0
1 8 1 3 1
1 8 1 2 1
2 8 6 0 0
2 8 6 4 0
2 8 6 0 3
END
cp frames.tsv in
run
check "columns whose names say so make the id together" "$status $(column id) $(column n)" "0 1/7 1/8 2/8 4 4 3"
check "and that is told" "$(cat err)" "-: id: frame track_id; not looked at: Area (--id names others)"
run --id track_id --quiet
check "--id names others" "$(column id) $(column n)" "7 8 4 7"
run --id track_id,frame --quiet
measured "--id in another order" id "7/1 8/1 8/2"
run --id track_id
has "a column that changes within an outline" err "-:10: column 'frame' changes within outline 8; "
run --id cell
stopped "--id of no column" "-:1: no column 'cell' for --id; the columns are: frame, track_id, Area, x, y"
printf 'Mean x y Cell_ID\n3 0 0 5\n4 1 0 5\n5 1 1 5\n' > in
run --quiet
measured "what is measured is no id" id 5
for rows in '7,0,0 7,1,0 7,1,1 7,0,1 9,0,0 9,1,0 9,1,1' '"7",0,0 "7",1,0 "7",1,1 "9",0,0 "9",1,0 "9",1,1'; do
    { echo ',x,y' && echo "$rows" | tr ' ' '\n'; } > in
    run --quiet
    measured "a first column without a name, in runs: $rows" id "7 9"
done
run
has "what it was taken for" err "-: id: the first column, which has no name but the same in rows that follow each other"
printf ',x,y\n0,0,0\n1,1,0\n2,1,1\n' > in
run
measured "a first column without a name that counts up is none" n 3
printf '"x" "y"\n"1" 0 0\n"2" 2 0\n"3" 2 3\n' > in
run
measured "row names of R" n 3
near "row names of R: area" "$(field 1 area)" 3

# k: an order, if it is one.
awk 'BEGIN { print "cell k x y z nx ny nz"; for (i = 0; i < 7; ++i) { j = 3 * i % 7; t = 6.283185307179586 * j / 7
    printf "h %d %.17g %.17g 1 %.17g %.17g 1\n", 10 + j, cos(t), sin(t), cos(t) / 2, sin(t) / 2 } }' > in
run
measured "k orders the corners" n 7
first=$(sed -n 2p out)
awk 'NR == 1 { print; next } { row[$2] = $0 } END { for (i = 10; i < 17; ++i) print row[i] }' in > sorted
mv sorted in
run
check "as if they had been written so" "$(sed -n 2p out)" "$first"
printf 'cell k x y\na 1 1 0\na 0 0 0\na 2 1 1\na 0 0 0\n' > in
run
refused "k twice" bad_order 5 "-:5: a: k is no order"
printf 'cell k x y\na 0 0 0\na 1 1 0\na 2 1 1\na 0 0 0\nb 0 0 0\nb 1.5 1 0\nb 2 1 1\n' > in
run
check "the first corner may be repeated with its k, fractions are none" "$(column status) $(column n)" \
    "ok bad_order 3 3"

# Separators of others.
printf '> first\n0 0\n1 0\n1 1\n> second\n0 0\n2 0\n2 2\n' > in
run --columns x,y
measured "lines with > of GMT" n "3 3"
printf '0 0\n1 0\n1 1\nNaN NaN\n0 0\n2 0\n2 2\nnan nan\n' > in
run --columns x,y
measured "rows of NaN of MATLAB" area "0.5 2"
printf '10,10,20,10,20,20,10,20\n\n30,30,40,30,40,50\n' > in
run
check "a line x,y,x,y,... an outline" "$status $(column id) $(column n) $(column area)" "0 0 1 4 3 100 100"
has "that is told" err "-: no names, and x,y,x,y,... on each line: each line is an outline"
run --y-down --quiet
check "y down" "$(column status)" "clockwise clockwise"
printf '10,10,20,10,20,20,10\n' > in
run
stopped "an odd number" "-:1: 7 numbers are no pairs x,y"

# Rings under one id.
cat > rings.tsv << 'END'
id x y
A 0 0
A 6 0
A 6 6
A 0 6
A 0 0
A 1 1
A 1 3
A 3 3
A 3 1
A 1 1
A 10 0
A 12 0
A 12 2
A 10 0
B 0 0
B 1 0
B 1 1
END
cp rings.tsv in
run
refused "a ring that closes and goes on" several_rings 6 \
    "-:6: A: a ring closes here, and the outline goes on: a hole, or another part, under the same id; \
--p"
run --parts
measured "--parts: each ring is an outline, holes are marked" id "A/0 A/1/hole A/2 B"
check "--parts: corners" "$(column n) $(column area)" "4 4 3 3 36 4 2 0.5"
awk 'NR == 1 { print "id x y z nx ny nz"; next } { print $1, $2, $3, 5, 0, 0, 1 }' rings.tsv > in
run
refused "the same in space" several_rings 6
run --parts
measured "--parts in space" id "A/0 A/1/hole A/2 B"
sed 's/x y/lon lat/' rings.tsv > in
run --parts
measured "--parts on a sphere" id "A/0 A/1/hole A/2 B"
# A needle comes back to its first corner wherever it begins, and encloses nothing: no ring.
for first in 1 2 3 4 5 6; do
    { echo 'x y' && printf '3 3\n4 3\n5 3\n6 3\n5 3\n4 3\n' | awk -v f="$first" '
        { row[NR] = $0 } END { for (i = 0; i < 6; ++i) print row[(i + f - 1) % 6 + 1] }'; } > in
    run
    check "a needle from corner $first" "$status $(column status)" "0 ok"
    has "a needle from corner $first is told" err ": 0: the outline goes there and back at this corner, a spike, of "
done

# A cut that leads to a hole and back, wherever the outline begins; a line that joins two parts; a ring left open.
keyhole='0 0\n10 0\n10 10\n0 10\n0 0\n1 1\n3 3\n3 6\n6 6\n6 3\n3 3\n1 1\n'
for head in 'x y' 'lon lat'; do
    for first in 1 2 3 4 5 6 7 8 9 10 11 12; do
        { echo "$head" && printf "$keyhole" | awk -v f="$first" '
            { row[NR] = $0 } END { for (i = 0; i < 12; ++i) print row[(i + f - 1) % 12 + 1] }'; } > in
        run
        check "$head, a keyhole from corner $first" "$status" 2
        run --quiet --parts
        check "$head, its rings from corner $first" "$(column id) $(column n)" "0/0 0/1/hole 4 4"
    done
done
printf 'x y\n1 0\n1 .5\n3 .5\n3 0\n4 0\n4 1\n3 1\n3 .5\n1 .5\n1 1\n0 1\n0 0\n' > in
run
refused "two parts joined by a line" seam 9 "a cut that leads to a hole, or to another part; --parts"
run --quiet --parts
check "two parts: taken apart" "$(column id) $(column area)" "0/0 0/1 1 1"
printf 'x y\n0 0\n6 0\n6 6\n0 6\n-1e-13 1e-13\n2 2\n2 4\n4 4\n4 2\n2 2\n' > in
run
refused "a ring that closes but for rounding" several_rings 6
sed /e-13/d in > open && cp open in
run
refused "a hole behind a ring that is left open" several_rings 6
run --quiet --parts
check "and both" "$(column id) $(column area)" "0/0 0/1/hole 36 4"
printf 'x y\n0 0\n6 0\n6 6\n0 6\n0 0\n6 0\n6 6\n0 6\n' > in
run --parts
check "an outline traced twice" "$status $(column status)" "2 ok several_rings"
printf 'x y\n0 0\n1 0\n1 1\n2 1\n2 2\n1 2\n1 1\n0 1\n' > in
run
check "what touches itself is one outline" "$status $(column status)" "0 ok"

# Spikes: along other corners than they came, or not exact.
for whisker in '4 7\n4 5\n4 4' '4 7\n4 4' '4 5\n4 7\n4 4' '4 7\n3.9999999999999 4'; do
    printf "x y\n0 0\n4 0\n4 4\n$whisker\n0 4\n" > in
    run
    check "a spike: $whisker" "$status $(field 1 status) $(wc -l < err | tr -d ' ')" "0 ok 1"
    has "it is told: $whisker" err "a spike, of which both sides count; --repair takes it out"
    run --repair --quiet
    check "it is taken out: $whisker" "$(field 1 n) $(field 1 L)" "4 16"
    run --smooth 1
    check "it is not smoothed: $whisker" "$status $(field 1 status)" "2 spike"
done
printf 'cell x y\na 0 0\na 50 20.00000000001\na 100 40\nb 0 0\nb 100 40\nb 50 20.00000000001\n' > in
run
check "slivers" "$(column status) $(wc -l < err | tr -d ' ')" "clockwise ok 1"
has "a sliver that runs clockwise is no spike" err "; --reverse auto reverses such outlines; if y points down"
for lon in 180 179.99999999999997 179.9999999999 179.99999; do
    printf "lon lat\n$lon -60\n60 -60\n-60 -60\n-180 -60\n-180 -90\n$lon -90\n" > in
    run
    check "a cap with its seam at $lon" "$status" 2
    run --quiet --repair --merge 1e-6L
    near "its L without, $lon" "$(field 1 L)" 2.68699438 1e-7
    [ $lon = 179.99999 ] || run --quiet --repair
    near "without --merge, $lon" "$(field 1 mu_3)" 1 1e-9
done
run --merge
has "a spike that is not exact: with the way to take it out" err "--repair --merge 5e-08L takes it out"

# Corners that almost coincide: a regular pentagon, its first corner again with an error, or a corner twice.
pentagon() {
    awk -v error="$1" -v back="$2" 'BEGIN { print "cell x y z nx ny nz"; pi = 3.141592653589793
        for (i = 0; i < 5; ++i) { t = 2 * pi * i / 5; x = cos(t); y = sin(t)
            printf "p %.17g %.17g 0 0 0 1\n", x, y
            if (i != 2 || !back) continue
            printf "p %.17g %.17g 0 0 0 1\n", x + error * (cos(2 * pi / 5) - x), y + error * (sin(2 * pi / 5) - y) }
        if (!back) printf "p %.17g %.17g 0 0 0 1\n", 1 + error, error }'
}
for surface in plane embedded; do
    for order in 2 4; do
        pentagon 1e-13 > in
        run --surface $surface --order $order
        measured "$surface, order $order: the first corner again, but for rounding" n 5
    done
    pentagon 1e-9 back > in
    run --surface $surface
    has "$surface: a corner all but twice" err "-:5: p: "
    has "$surface: with the edge to blame" err "; the edge that ends here is only 2e-10 of the perimeter long: --merge"
    run --surface $surface --reverse auto
    check "$surface: nor is it turned round" "$status" 2
    run --surface $surface --order 4
    refused "$surface, order 4" short_edge 5 "--merge 1e-6L drops such corners"
    run --surface $surface --merge 1e-8L
    measured "$surface: --merge of a fraction" n 5
    near "$surface: mu_5" "$(field 1 mu_5)" 1
    run --surface $surface --merge 1e-6
    measured "$surface: --merge of a distance" n 5
    run --surface $surface --merge=1e-10
    check "$surface: --merge of too short a distance" "$(field 1 n)" 6
done
printf 'cell lon lat\na 0 0\na 10 0\na 10.00000001 0.00000001\na 0 10\na 0.00000000000001 0\n' > in
run --merge 1e-3 --radius 6371
measured "--merge on a sphere is a length" n 3
run --merge 1e-7 --radius 6371
check "--merge on a sphere, too short" "$(field 1 n)" 4

# Seams and spikes.
{
    echo 'id lon lat'
    awk 'BEGIN { print "c -180 90\nc -180 60"; for (l = -170; l < 180; l += 10) print "c", l, 60
                 print "c 180 60\nc 180 90" }'
} > in
run
check "a polar cap with its seam" "$(field 1 status)" crosses_itself
has "a spike is named" err "a spike: --repair takes it out"
run --merge --smooth 1
check "and not smoothed over" "$(field 1 status)" spike
run --repair
check "--repair" "$status $(field 1 status) $(field 1 n)" "0 ok 36"
near "the cap: area of 36 triangles" "$(field 1 area)" "$(awk 'BEGIN { printf "%.17g", 0.837758 }')" 1e-2
has "what it did" err "-:2: c: 2 corners of spikes or seams are taken out"
printf 'id x y\ns 0 0\ns 4 0\ns 4 4\ns 2 4\ns 2 3\ns 2 4\ns 0 4\n' > in
run
refused "a spike in the plane" crosses_itself 6 "there and back at this corner, a spike: --repair takes it out"
run --repair --quiet
measured "a spike in the plane, repaired" area 16

# Crossings that turning and area do not give away: a loop to the left, and one to the right.
printf 'x y\n0 0\n3 0\n3 1\n2 1\n2 -1\n6 -1\n6 -2\n5 -2\n5 0\n8 0\n8 8\n0 8\n' > in
run
refused "a crossing with turning number one" crosses_itself 2 ": the edges from lines 2 and "
run --crossings never
check "--crossings never: no edges are named" "$(grep -c 'the edges from lines' err)" 0
awk 'BEGIN { print "x y"; n = 3000; for (i = 0; i < n; ++i) { j = i == 10 ? 17 : i == 17 ? 10 : i
    t = 6.283185307179586 * j / n; r = 1 + .1 * cos(9 * t); printf "%.17g %.17g\n", r * cos(t), r * sin(t) } }' > in
run
check "beyond 2,000 corners one has to ask" "$(field 1 status)" ok
run --crossings always
refused "--crossings always" crosses_itself 11 ": the outline crosses itself: the edges from lines 11 and 19 cross"
printf 'lon lat\n1 0\n1 6\n0 6\n6 4\n0 0\n' > in
run
refused "on a sphere" crosses_itself 2 ": the edges from lines 2 and "
printf 'x y z nx ny nz\n1 0 0 0 0 1\n1 6 0 0 0 1\n0 6 0 0 0 1\n6 4 0 0 0 1\n0 0 0 0 0 1\n' > in
run
refused "in space" crosses_itself 2 ": the edges from lines 2 and "
printf 'x y\n0 0\n4 0\n5 -2\n4 -2\n5 0\n10 0\n10 4\n12 5\n12 4\n10 5\n10 10\n0 10\n' > in
run --reverse auto
refused "with turning number minus one: not turned round" crosses_itself 3

printf 'lon lat\n0 0\n0 50\n50 50\n50 0\n' > in
run
has "more than a hemisphere is called that" err "-:2: 0: the left side is more than a hemisphere; --reverse auto "
for side in auto always; do
    run --reverse $side
    check "the other side: --reverse $side" "$status $(column status)" "0 ok"
    check "the other side is told: --reverse $side" "$(cat err)" \
        "-:2: 0: turned round: measured is the side to the right of the corners in the file, less than a hemisphere"
done
run --reverse auto --quiet
measured "the other side: --quiet" n 4

# Where normals differ too much, what seems to cross is told; the crossing edges of a face are counted.
printf 'OFF\n4 1 0\n0 0 0\n4 0 0\n0 4 0\n5 4 0\n4 0 1 2 3\n' > in
run
has "edges of a face that cross" err "-:7: 0: the outline crosses itself: its edges 1 and 3 (from 0) cross"
printf 'x y z nx ny nz\n13 14 3.3 0 1 0\n28 117 5.3 0 0 1\n127 0 7.3 0 0 1\n126 105 2.7 0 0 1\n' > in
run
check "what seems to cross: measured" "$status $(field 1 status)" "0 ok"
check "what seems to cross is told" "$(cat err)" "-:3: 0: the edges from lines 3 and 5 cross as seen from above; the \
normals differ too much to tell whether they do on the surface"

# Files as other programs write them.
printf 'Index,X (microns),Y (microns)\n0,1.5,0.5\n1,2.5,0.5\n2,2.5,1.5\n3,1.5,1.5\n' > in
run
measured "ImageJ: an index that counts rows is no id" n 4
printf 'index,shape-type,vertex-index,axis-0,axis-1\n' > in
printf '%s\n' 0,polygon,0,9,1 0,polygon,1,9,2 0,polygon,2,8,2 1,polygon,0,4,1 1,polygon,1,4,2 1,polygon,2,3,1 >> in
run
check "napari: an index in runs is an id" "$status $(column id) $(column n)" "0 0 1 3 3"
has "napari: and that is told" err "-: id: index, which is the same in rows that follow each other (--id names others)"
printf 'fid,vertex_index,vertex_part,vertex_part_index,x,y\n' > in
printf '1,%s\n' 2,0,2,1,1 0,0,0,0,0 1,0,1,1,0 >> in
run --quiet
measured "QGIS: vertices" id 1/0
near "QGIS: in their order" "$(field 1 area)" 0.5
printf '"Points:0","Points:1","Points:2","Normals:0","Normals:1","Normals:2"\n' > in
printf '%s\n' 0,0,0,0,0,1 1,0,0,0,0,1 1,1,0,0,0,1 >> in
run
measured "ParaView: points and normals" n 3
printf 'WKT,id\n"POLYGON ((0 0,1 0,1 1,0 0))",1\n' > in
run
stopped "geometry in a field" "-:1: column 'WKT': geometry within a field is not read; save the layer as GeoJSON"
printf '> -Z1\n0 0\n1 0\n1 1\n> -Z2\n0 0\n2 0\n0 2\n' > in
run
stopped "GMT: without names" \
    "-:2: this line should name the columns: x y, lon lat, x y z or x y z nx ny nz; --columns x,y"
run --columns x,y
measured "GMT: with names" area "0.5 2"
printf 'cell,x,y\n1,0,0\n2,1,0\n3,1,1\n' > in
run
refused "an id a row" too_few_corners 2 \
    "; if every row has an id of its own, --id names the columns that outlines have in "
printf '\357\273\277Zelle;x [\302\265m];y [\302\265m]\r\n1;0,0;0,0\r\n1;1,5;0,0\r\n1;1,5;1,5\r\n' > in
run
measured "a spreadsheet with decimal commas" area 1.125

# What may be meant otherwise.
printf 'x y z\n2 0 0\n0 3.1 0\n0 0 2\n' > in
run --surface sphere
check "radii that differ: measured" "$status $(field 1 n)" "0 3"
check "radii that differ are told" "$(cat err)" "-:3: corners lie up to 55 % farther from the origin than others: a \
sphere has its middle there, and only the directions of corners count"
sed 's/3.1/2.9/' in > other && mv other in
run --surface sphere
measured "radii that hardly differ" n 3
printf 'x\ty\n1,234\t0\n1,5\t0,5\n0\t7\n' > in
run
check "a comma that may stand between thousands: measured" "$status $(field 1 n)" "0 3"
check "a comma that may stand between thousands" "$(cat err)" \
    "-:2: 1,234 is read as 1.234: a decimal comma, not one between thousands"
printf 'x\ty\n0,234\t0\n1,234\t0,5\n0\t7\n' > in
run
measured "a comma that cannot" n 3

# Warnings of one kind are told once, and counted.
{ echo 'cell x y' && for id in a b c a b; do printf '%s 0 0\n%s 3 0\n%s 4 0\n%s 3 0\n%s 0 5\n' $id $id $id $id $id; done
printf 'd 0 0\nd 0 1\nd 1 0\n'; } > in
run
check "warnings are counted" "$(tail -n 1 err)" \
    "surfmink: 5 measured, 1 refused; 7 warnings, of which the first of each kind are told"
cut -d : -f 2- err | sed 's/; --reverse auto .*//; 4q' > got
check "warnings are told once" "$(cat got)" "$(cut -d : -f 2- << 'END'
-:17: id a comes again: only lines that follow each other are one outline
-:4: a: the outline goes there and back at this corner, a spike, of which both sides count; --repair takes it out
-:27: d: the corners run clockwise (their turning angles add up to less than 0)
 5 measured, 1 refused; 7 warnings, of which the first of each kind are told
END
)"
run --quiet
check "but not with --quiet" "$(cat err)" ""

# --- names and numbers of others --------------------------------------------------------------------------------------

# names HEADER ROW...: reads as the unit square with area 1, or as lon lat.
names() {
    text=$1
    printf "$text" > in
    shift
    run --quiet "$@"
    measured "$text" area 1
}
names 'X (um)\tY (um)\n0\t0\n1\t0\n1\t1\n0\t1\n'
names 'x [\302\265m],y [\302\265m]\n0,0\n1,0\n1,1\n0,1\n'
names 'Position X,Position Y\n0,0\n1,0\n1,1\n0,1\n'
names '"x"\t"y"\n0\t0\n1\t0\n1\t1\n0\t1\n'
names 'id;x;y\na;0,5;0,5\na;1,5;0,5\na;1,5;1,5\na;0,5;1,5\n'
names 'id\tx\ty\na\t0,5\t0,5\na\t1,5\t0,5\na\t1,5\t1,5\na\t0,5\t1,5\n'
names '"a id" "x" "y"\n"New York" 0 0\n"New York" 1 0\n"New York" 1 1\n"New York" 0 1\n'
names 'row,col\n0,0\n0,-1\n1,-1\n1,0\n'
napari='index,shape-type,vertex-index,axis-0,axis-1\n'
printf "${napari}0,polygon,0,0,0\n0,polygon,1,0,5\n0,polygon,2,5,5\n" > in
run
check "rows of an image run down already" "$status $(grep -c 'y-down' err)" "2 0"
names "${napari}0,polygon,0,0,0\n0,polygon,1,0,-1\n0,polygon,2,1,-1\n0,polygon,3,1,0\n"
names 'x y\n0 0\n0 1\n1 1\n1 0\n' --y-down
names '0,0\n1,0\n1,1\n0,1\n' --columns x,y
names '0 0 7\n1 0 7\n1 1 7\n0 1 7\n' --columns x,y,id
names 'x y row col\n0 0 A 1\n1 0 A 1\n1 1 A 1\n0 1 A 1\n'
for pair in 'latitude longitude' 'lat lng' 'DEC RA' 'Lat Long'; do
    printf '%s\n0 0\n0 90\n90 0\n' "$pair" > in
    run --quiet
    near "$pair" "$(field 1 area)" 1.5707963267948966
done
printf 'id;x;y\na;0,5;0,5\na;1.5;0,5\n' > in
run
stopped "decimal commas and points" "-:3: '1.5' has a decimal point, numbers before it a comma"
printf 'id;x;y\na;0.5;0,5\n' > in
run
stopped "points and commas" "-:2: '0,5' has a decimal comma, numbers before it a point"
printf 'easting northing\n0 0\n' > in
run
stopped "names that are not known" "-:1: this line should name the columns"
has "are shown" err "; here they are: easting, northing"
printf '0 0\n1 0\n1 1\n' > in
run
has "no names" err "--columns x,y names them where the file has only numbers, as here: 0, 0"
printf 'x y\n0 0\n1 0\n' > in
run --columns x,y
stopped "--columns and names" "-:1: 'x' in column 'x' is not a number; --columns is for files without a line of names"
printf 'x y\n0 0\n1 0\n1 3\n' > in
run --y-down --reverse auto --directions
check "--y-down mirrors" "$(field 1 area)" 1.5
printf 'x y\n0 0\n4 1\n3 5\n' > in
run --directions
down=$(field 1 e_2_y)
printf 'x y\n0 0\n4 -1\n3 -5\n' > in
run --y-down --directions
near "directions are those of the picture, not mirrored" "$(field 1 e_2_y)" "$down"
run -h
check "-h is --help" "$status $(sed -n 3p out)" "0 EXAMPLES"

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
has "a line of a megabyte, and its successors" err "-:7: b: a polygon"
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
printf 'b %s\n' '-1 -1' '-1 3' '3 3' '3 -1' '0 0' '0 2' '2 2' '2 0' '0 0' >> in
printf 'c 0 0\nc 0 1\nc 1 0\n' >> in
run --reverse auto
check "what is turned round changes nothing for the others" "$(column status) $(cut -d : -f 2 err | tr '\n' ' ')" \
    "coincident_corners crosses_itself ok 4 9 "
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
        "--reverse auto --merge --smooth 1 --transport parallel --json" "--order 4 --error --sharp 40" "--noise 1%"; do
        run --surface $surface $options in
        check "$surface $options, together as alone" "$status $(cat out)" \
            "2 $("$surfmink" --surface $surface $options alone.* 2> err | sed 's/^alone[^	]*	//; s/^file	//
                s/^{"file":"[^"]*",/{/')"
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
sed '5s/1 -1 -1/1 -1 nan/' cube.off > nan.off
run nan.off
check "a vertex that is not finite" "$status $(column status)" "2 not_finite ok not_finite not_finite ok ok"
has "its line" err "nan.off:5: a vertex is not finite: no face with it is measured"

# A strip turns every second triangle round; where strips are sewn together corners come twice, and are no triangle.
printf '# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 8 float
0 0 0 0 1 0 1 0 0 1 1 0 2 0 0 2 1 0 3 0 0 3 1 0\nTRIANGLE_STRIPS 1 11\n10 0 1 2 3 3 4 4 5 6 7\n' > strip.vtk
run strip.vtk
check "a strip of VTK" "$status $(cat err) $(column status)" "0  ok ok ok ok"
# A triangle that is written as a quadrangle weighs as much in the normals of its neighbours.
printf 'OFF\n5 4\n0 0 1\n2 0 0\n0 2 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n' > single.off
sed 's/3 0 1 2/4 0 1 2 2/' single.off > twice.off
run single.off
cp out want
run --merge twice.off
check "a face with a corner twice" "$(cat out)" "$(cat want)"
printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z
element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0\n' > strips.ply
run strips.ply
stopped "strips of PLY" "strips.ply:7: triangle strips of PLY are not read: MeshLab saves faces"
printf 'OFF\n3 2\n0 0 0\n1 0 0\n0 1 0\n0\n3 0 1 2\n' > none.off
run none.off
check "a face without corners" "$status $(column status)" "2 too_few_corners ok"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//2 3//1\n' > missing.obj
run missing.obj
stopped "a normal that is missing" "missing.obj:5: there is no normal 2"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n' > long.obj
run long.obj
stopped "a face on two lines" "long.obj:4: a line that goes on in the next one is not read"
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
stopped "a negative index" "bad.off:6: there is no vertex -1"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n'
stopped "a face cut short" "bad.off:6: 4 corners are announced, 3 follow"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 \n'
stopped "a face cut short, before a blank" "bad.off:6: 4 corners are announced, 3 follow"
mesh 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n'
stopped "a face too few" "bad.off:6: the file ends after 1 of 2 faces"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n'
stopped "a vertex too few" "bad.off:4: the file ends after 2 of 3 vertices"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n'
stopped "a face too many" "bad.off:7: expected the end of the file after its last face"
mesh 'OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n'
stopped "half a vertex" "bad.off:4: expected a number z, the line ends"
mesh 'OFF\n3 1 0\n0 0 0\n1 0 z\n0 1 0\n3 0 1 2\n'
stopped "no number" "bad.off:4: expected a number z, got 'z'"
mesh 'OFF\nmany 1 0\n'
stopped "no count" "bad.off:2: expected the numbers of vertices and faces, got 'many 1 0'"
mesh 'OFF\n99999999999999999999 1 0\n'
stopped "a count too large" "bad.off:2: expected the numbers of vertices and faces"
mesh 'OFF\n4000000000000 1 0\n0 0 0\n'
stopped "a count without vertices takes no memory" "bad.off:3: the file ends after 1 of 4000000000000 vertices"
mesh 'ply\n'
stopped "half a header" "bad.off:1: the file ends before end_header"
mesh 'nothing\n'
stopped "no mesh" "bad.off:1: expected a mesh: OFF, OBJ, PLY, STL or legacy VTK, got 'nothing'"
mesh 'OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 nan\n3 0 1 2\n2 0 1\n'
check "refused faces: exit status" "$status" 2
check "refused faces" "$(column status)" "not_finite too_few_corners"
has "refused faces: line" err "bad.off:7: "

# The cube, from other formats, by any name and through a pipe: the same numbers.
run cube.off
cp out expected
awk 'NR > 3 && NF > 2 && !/^#/ && ++n <= 8 { print "v", $1, $2, $3; next }
     n >= 8 && !/^#/ { print "f", $2 + 1 "//1", $3 + 1 "//1", $4 + 1 "//1", $5 + 1 "//1" }' cube.off > body.obj
{ echo '# made by hand' && cat body.obj && echo 'vn 0 0 1'; } | sed 's|//1||g' > cube.obj
{
    printf '# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n'
    awk '$1 == "v" { print $2, $3, $4 }' cube.obj
    printf 'POLYGONS 6 30\n'
    awk '$1 == "f" { print 4, $2 - 1, $3 - 1, $4 - 1, $5 - 1 }' cube.obj
} > cube.vtk
{
    printf 'ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 6\nproperty list uchar int vertex_indices\nend_header\n'
    sed '1,5d; /^POLYGONS/d' cube.vtk
} > cube.ply
for mesh in cube.obj cube.vtk cube.ply; do
    run $mesh
    check "$mesh is the same cube" "$status $(cat err out)" "0 $(cat expected)"
    cp $mesh in
    run
    check "$mesh through a pipe" "$status $(cat err out)" "0 $(cat expected)"
    cp $mesh body.txt
    run body.txt
    check "$mesh by another name" "$status $(cat err out)" "0 $(cat expected)"
done
cp cube.off in
run
check "cube.off through a pipe" "$status $(cat err out)" "0 $(cat expected)"
dd bs=1 if=cube.off 2> /dev/null | "$surfmink" > out 2> err
check "cube.off byte by byte" "$? $(cat err out)" "0 $(cat expected)"
awk '$1 == "f" { for (k = 2; k < 6; ++k) $k = $k "//" n + 1; ++n } { print }' cube.obj > flat.obj
printf 'vn 0 0 -1\nvn 0 0 1\nvn 0 -2 0\nvn 1 0 0\nvn 0 1 0\nvn -1 0 0\n' | cat - flat.obj > in
run
measured "normals of facets" n "4 4 4 4 4 4"
near "with them each face is a flat square" "$(field 5 S)" 6.283185307179586
run --order 4
check "with normals of its own a mesh may be of order 4" "$status" 0
sed 's|//[0-9]|//1|g' flat.obj | { echo 'vn 0 0 1' && cat -; } > in
run
check "normals that contradict the faces are not used" "$status $(cat out)" "0 $(cat expected)"
check "and that is told" "$(cat err)" \
    "-: normals that point against face 0 are not used; area-weighted means over the faces are"
run --quiet
check "but not with --quiet" "$(cat err)" ""

# Mixed winding: a grid of 4 x 3 unit squares with some of them turned round.
grid() {
    awk -v turned="$1" 'BEGIN {
        print "OFF\n20 12"
        for (j = 0; j < 4; ++j) for (i = 0; i < 5; ++i) print i, j, 0.1 * i
        for (j = 0; j < 3; ++j) for (i = 0; i < 4; ++i) {
            a = 5 * j + i
            if (index(turned, " " 4 * j + i " ")) print 4, a, a + 5, a + 6, a + 1
            else print 4, a, a + 1, a + 6, a + 5
        } }'
}
grid '' > in
run --digits 9
cp out expected
grid ' 5 6 11 ' > in
run --digits 9
check "faces that run against their neighbours are turned round" "$status $(column status)" \
    "0 ok ok ok ok ok ok ok ok ok ok ok ok"
check "and that is told, with the first of them" "$(cat err)" \
    "-:28: face 5 runs against its neighbours; 3 such faces are turned round"
check "their mu is that of the others" "$(cut -f 7-12 out)" "$(cut -f 7-12 expected)"
printf 'OFF\n6 3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 -1 0\n3 0 1 2\n4 1 0 3 4\n3 1 0 5\n' > in
run
stopped "an edge with three faces" "-:11: the edge between vertices 0 and 1 (from 0) has 3 faces: not a surface"
printf 'OFF\n4 3\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2\n3 1 3 2\n3 2 0 1\n' > in
run
stopped "a face twice" "-:9: face 2 has the same corners as face 0 (from 0): not a surface; drop one of them"
printf 'OFF\n6 3\n0 0 0\n2 0 0\n1 1 0\n0 0 1\n2 0 1\n1 1 1\n4 0 1 4 3\n4 1 2 5 4\n4 2 3 5 0\n' |
    sed 's/^4 2 3 5 0/4 2 3 0 5/' > in
run
stopped "one side only" "-:11: the faces at the edge between vertices 2 and 5 (from 0) run opposite ways, and so do "

# Every facet with corners of its own: their normals are those of the whole surface.
run cube.off
near "the normals of a cube's corners" "$(field 1 S)" 4.1887902047863905
awk '$1 == "v" { v[++n] = $2 " " $3 " " $4 }
     $1 == "f" { for (k = 2; k < 6; ++k) print "v", v[$k]; print "f", ++c, ++c, ++c, ++c }' cube.obj > in
run
near "are those of its copies, too" "$(field 1 S)" 4.1887902047863905
check "which are joined" "$status $(cat err)" "0 -: 16 vertices are copies of others: joined"
# Outlines in a PLY with normals of their own are measured with them, as the command itself writes them.
cp octant.tsv in
run --ply octant.ply
cp out expected
run octant.ply --digits 12
check "what --ply wrote is read" "$status $(cat err) $(sed -n 2p out | cut -f 2-12)" \
    "0  $("$surfmink" --digits 12 in | sed -n 2p | cut -f 2-12)"

# Cells in space without normals: from shared corners, or each cell's best plane.
awk 'BEGIN { print "cell x y z" } $1 == "v" { v[++n] = $2 " " $3 " " $4 }
     $1 == "f" { for (k = 2; k < 6; ++k) print "face" c + 0, v[$k]; ++c }' cube.obj > in
run
stopped "normals are not estimated unasked" "-:1: columns nx ny nz are missing, or --surface sphere, or --surface plane"
"$surfmink" cube.obj > expected
run --normals estimate
check "normals from shared corners" "$status $(cut -f 2-12 out)" "0 $(cut -f 2-12 expected)"
has "that is told" err "-: normals are estimated: means over cells that share corners"
printf 'cell x y z\na 0 0 0\na 4 0 4\na 4 3 4\na 0 3 0\n' > in
run --normals estimate --quiet
near "a lone cell: its best plane" "$(field 1 S)" 6.283185307179586
near "a lone cell: L" "$(field 1 L)" 17.31370849898476
check "--normals estimate in the plane" "$("$surfmink" --normals estimate --surface plane in 2>&1 | cut -c 1-41)" \
    "surfmink: --normals estimate is for cells"

# What estimates cost: mu_2 to mu_6 of the tissue against those with its normals, with shared corners and without.
"$surfmink" --quiet "$data/tissue.tsv" > given
for step in 0 1000; do
    grep -v '^#' "$data/tissue.tsv" | awk -v step=$step 'BEGIN { OFS = "\t" }
        NR == 1 { print $1, $2, $3, $4; next } { printf "%s\t%.12g\t%s\t%s\n", $1, $2 + step * $1, $3, $4 }' > in
    run --normals estimate
    awk -F '\t' 'FNR == 1 { ++file; next } $3 != "ok" { next }
        {
            for (p = 2; p <= 6; ++p) {
                d = $(6 + p) - mu[$1, p]
                if (file == 1) mu[$1, p] = $(6 + p)
                else print d < 0 ? -d : d
            }
        }
        ' given out | sort -g | awk '{ e[NR] = $1 } END { printf "%d %.4f %.3f\n", NR, e[int((NR + 1) / 2)], e[NR] }'
done > got
check "--normals estimate of a tissue: values, median and largest error of mu_p" "$(cat got)" "2000 0.0009 0.065
2000 0.0013 0.113"

# --- GeoJSON ----------------------------------------------------------------------------------------------------------

cat > map.geojson << 'END'
{"type": "FeatureCollection", "name": "a \u00e9", "crs": {"type": "name", "properties": {"name": "CRS84"}},
 "features": [
  {"type": "Feature", "id": 17, "properties": {"name": "Octant", "code": "OC"}, "geometry":
   {"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [0, 90], [0, 0]]]}},
  {"geometry": {"coordinates": [[[[10, 50], [14, 50], [14, 51], [10, 51], [10, 50]]],
    [[[20, 50, 7], [20, 55], [25, 55], [25, 50], [20, 50]], [[21, 51], [22, 51], [22, 52], [21, 52], [21, 51]]]],
    "type": "MultiPolygon"}, "properties": {"NAME": "Is\u00e9s \"x\"", "code": null}, "type": "Feature"},
  {"type": "Feature", "properties": {"code": "PT"}, "geometry": {"type": "Point", "coordinates": [1, 2]}},
  {"type": "Feature", "properties": null, "geometry": null},
  {"type": "Feature", "properties": {"code": "Z"}, "geometry": {"type": "GeometryCollection", "geometries": [
    {"type": "Polygon", "coordinates": [[[0, 0], [0, 1], [1, 1], [0, 0]]]}]}}
 ]}
END
run map.geojson
check "GeoJSON" "$status $(column id)" '0 17 Isés "x"/0 Isés "x"/1 Isés "x"/1/hole1 4'
check "GeoJSON: corners" "$(column n) $(column status)" "3 4 4 4 3 ok ok ok ok ok"
near "GeoJSON: area" "$(field 1 area)" 1.5707963267948966
check "what is left out is told" "$(cat err)" "map.geojson: 1 points or lines are left out: they enclose nothing"
cat > metres.geojson << 'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
 "features": [{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]}}]}
END
run metres.geojson
stopped "metres for degrees" "metres.geojson:1: the coordinates are in EPSG:25832, not in degrees: ogr2ogr -t_srs"
run metres.geojson --surface plane
check "metres of a map" "$status $(field 1 area)" "0 40.5"
sed 's/25832/4258/' metres.geojson > degrees.geojson
run degrees.geojson
check "degrees of another ellipsoid" "$status $(field 1 status)" "0 ok"
cp map.geojson in
run --quiet
check "GeoJSON through a pipe" "$(column n)" "3 4 4 4 3"
run map.geojson --id code
stopped "--id of a property that is not everywhere" "map.geojson:7: no property 'code' in this feature"
printf '{"type": "Polygon", "coordinates": [[[0, 0], [90, 0], [0, 90], [0, 0]]]}' > in
run
measured "a single geometry" id 0
printf '{"type": "Feature", "properties": {"code": "OC"}, "geometry": {"type": "Polygon", "coordinates":
    [[[0, 0], [0, 2], [2, 2], [2, 0], [0, 0]]]}}' > in
run --id code --surface plane
measured "a single feature, clockwise, in the plane" area 4
check "its id" "$(column id)" OC
# Pieces that were cut at 180 degrees: an island, once cut where its corners lie, once with more corners on one side.
island() {
    printf '{"type": "MultiPolygon", "coordinates": [[[[170, -10], [180, -10]%s, [180, 10], [170, 10], [170, -10]]],
        [[[-180, -10], [-170, -10], [-170, 10], [-180, 10], [-180, -10]]]]}' "$1"
}
for more in '' ', [180, 0]' ', [180, -5], [180, 2]'; do
    island "$more" > in
    run
    check "an island cut at 180 degrees $more" "$status $(column id) $(column n) $(column status)" "0 0 6 ok"
    has "is joined $more" err "-:2: 0: pieces cut at the antimeridian are joined"
    near "its area $more" "$(field 1 area)" "$(printf 'lon lat
170 -10
180 -10
190 -10
190 10
180 10
170 10
' |
        "$surfmink" - | sed -n 2p | cut -f 6)"
done
printf '{"type": "Polygon", "coordinates": [[[-180, -90], [180, -90], [180, -70]' > in
awk 'BEGIN { for (l = 170; l >= -180; l -= 10) printf ", [%d, -70]", l; print ", [-180, -90]]]}" }' >> in
run
check "a cap with its seam" "$status $(column n) $(column status)" "0 36 ok"
near "its area" "$(field 1 area)" 0.377170928353 1e-11
near "its S" "$(field 1 S)" 5.90601437883 1e-10
printf '{"type": "MultiPolygon", "coordinates": [[[[160, -20], [180, -20], [180, -10], [170, -10], [170, 10], [180, 10],
    [180, 20], [160, 20], [160, -20]]], [[[-180, -20], [-160, -20], [-160, 20], [-180, 20], [-180, 10], [-170, 10],
    [-170, -10], [-180, -10], [-180, -20]]]]}' > in
run --quiet
check "two halves of a ring enclose a hole" "$(column id) $(column status)" "0 0/hole1 ok ok"
for ring in '[48, 120], [49, 120], [49, 121]' '[0, 0], [1, 0], [1, 91]' '[5e5, 2e5], [500010, 2e5], [5e5, 200010]'; do
    printf '{"type": "Polygon", "coordinates": [[%s]]}' "$ring" > in
    run
    refused "GeoJSON off the globe: $ring" bad_argument 1 "a latitude lies between -90 and 90"
done
for ring in '[-180, 60], [180, 60], [180, 90], [-180, 90]' '[-180, -60], [180, -60], [180, 60], [-180, 60]' \
    '[-180, -90], [180, -90], [180, 90], [-180, 90]'; do
    printf '{"type": "Polygon", "coordinates": [[%s]]}' "$ring" > in
    run
    check "GeoJSON, a box round the globe is not lost: $ring" "$status $(grep -c . out)" "2 2"
done
for belt in '60 80' '-80 -60'; do # the part nearer to the pole is a hole
    awk -v belt="$belt" 'BEGIN { split(belt, lat); printf "{\"type\": \"Polygon\", \"coordinates\": [["
        for (lon = -180; lon <= 180; lon += 20) printf "[%d, %d], ", lon, lat[1]
        for (lon = 180; lon >= -180; lon -= 20) printf "[%d, %d], ", lon, lat[2]
        printf "[-180, %d]]]}", lat[1] }' > in
    run --quiet
    sed 1d out | sort > sorted
    check "a belt $belt" "$status $(cut -f 1-3 sorted | tr '\t\n' '  ')" "0 0 18 ok 0/hole1 18 ok "
    near "its area" "$(awk -F '\t' 'NR == 1 { a = $6 } END { print a - $6 }' sorted)" 0.734424 1e-5
done
printf '{"type": "Polygon", "coordinates": [[[-170, 10], [170, 10], [170, 20], [-170, 20]]]}' > in
run
has "GeoJSON, an edge over 180 degrees is told" err ": 0: the edge from longitude -170 to 170 is taken the short"
square='"geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 1]]]}'
printf '{"type": "Feature", %s}\n\036{"type": "Feature", "properties": {"name": "b"}, %s}\n' "$square" "$square" > in
run
measured "GeoJSON, a feature a line" id "0 b"
json() {
    printf "$2" > in
    run
    stopped "GeoJSON, $1" "-:$3"
}
json "an object of another kind" '{"a": 1}' "1: an object that is not GeoJSON"
json "glTF" '{"asset": {"version": "2.0"}, "meshes": []}' "1: glTF is not read: Blender or MeshLab saves it as PLY"
json "TopoJSON" '{"type": "Topology", "arcs": []}' "1: TopoJSON is not read"
json "cut short" '{"type": "Polygon",
 "coordinates": [[[0, 0], [1' "2: no GeoJSON: expected ']'"
json "no number" '{"type": "Polygon", "coordinates": [[[0, "x"]]]}' "1: no GeoJSON: a value is missing"
json "no coordinates" '{"type": "Polygon"}' "1: a polygon without coordinates"
json "more" '{"type": "Polygon", "coordinates": []} x' "1: something follows the end of the GeoJSON"
json "nested" "$(awk 'BEGIN { printf "{\"a\":"; for (i = 0; i < 99; ++i) printf "[" }')" "1: nested too deeply"

# --- pixels -----------------------------------------------------------------------------------------------------------

# A disc of radius 6, traced along the sides of pixels, with corners only at its turns.
awk 'function corner(x, y) { if (n && x == px[n] && y == py[n]) return
         if (n > 1 && ((x == px[n] && x == px[n - 1]) || (y == py[n] && y == py[n - 1]))) --n
         px[++n] = x; py[n] = y }
     function half(i) { return int(sqrt(36 - (i + .5) ^ 2) + .5) }
     BEGIN { for (i = -6; i < 6; ++i) { corner(i, -half(i)); corner(i + 1, -half(i)) }
             for (i = 5; i >= -6; --i) { corner(i + 1, half(i)); corner(i, half(i)) }
             print "x y"; for (i = 1; i <= n; ++i) print px[i], py[i] }' > disc.tsv
cp disc.tsv in
run
check "pixels: measured" "$(field 1 status)" ok
has "pixels are told" err ": all edges run along the axes, as those of pixels do, and mu_4 says just that; --resample 1"
near "mu_4 of pixels" "$(field 1 mu_4)" 1
run --smooth 4
has "--smooth on edges of unlike length is told" err ": --smooth wants edges of like length, and these are not"
rough=$(field 1 mu_4)
run --resample 1 --smooth 4
measured "--resample" status ok
check "--resample 1 --smooth 4 is rounder than --smooth 4, and round" \
    "$(awk -v a="$rough" -v b="$(field 1 mu_4)" 'BEGIN { print (b < a && b < 0.1) }')" 1
printf 'x y\n0 0\n4 0\n4 4\n0 4\n' > in
run --resample .5
measured "--resample of a square" n 32
near "keeps its length" "$(field 1 L)" 16
near "and its mu_4" "$(field 1 mu_4)" 1

# foreign TEXT WHAT: files of other programs are named, with a program that converts them.
foreign() {
    printf "$1" > in
    run
    check "$2: exit status" "$status" 1
    check "$2: message" "$(cat err)" "-: $2"
}
foreign 'PK\003\004\024\000' \
    "a zip archive (xlsx, 3mf, kmz, RoiSet) is not read: unzip it; spreadsheets save CSV, ImageJ XY coordinates"
foreign '\223NUMPY\001' "an array of NumPy is not read: numpy.savetxt writes text"
foreign 'II*\000\010\000' "an image (TIFF) is not read: trace its outlines first: docs/cookbook.md"
foreign '\000\000\047\012\000' "a shapefile is not read: ogr2ogr -f GeoJSON OUT.geojson IN"
for id in o g s f v vn solid; do
    printf '%s x y\n%s 0 0\n%s 1 0\n%s 1 1\n' $id $id $id $id > in
    run
    measured "a table whose id is named $id is no mesh" id $id
done

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
printf 'cell\tx\ty\nq\302\233m\233\t0\t0\n' > c1
"$surfmink" --json --max-rank 1 c1 > got 2> err
has "JSON: C1 controls, and a single such byte" got "$(printf '{"id":"q\\u009bm\357\277\275",')"
check "C1 controls in a refusal" "$(sed 's/: a poly.*//' err)" "c1:2: q?m?"
"$surfmink" --max-rank 1 --quiet c1 > got
check "C1 controls in a table" "$(sed -n 2p got | cut -f 1)" "q m "
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

# --- noise ------------------------------------------------------------------------------------------------------------

# draws SURFACE COUNT DEVIATION EDGE: a cell, and so many copies of it whose corners have been moved along the surface
# by chance. Of seven corners two are EDGE apart, in parts of their way to the next. The sphere has radius 10.
draws() {
    awk -v surface="$1" -v draws="$2" -v s="$3" -v short="$4" '
        function chance() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
        function normal() { return sqrt(-2 * log(chance())) * cos(6.283185307179586 * chance()) }
        BEGIN {
            seed = 20261129
            split("1.3 0.1 0.6 0.9 -0.4 1.1 -1.2 0.2 -0.7 -0.8 0.5 -1", at, " ")
            for (i = 0; i < 6; ++i) { x[i] = at[2 * i + 1]; y[i] = at[2 * i + 2] }
            n = 6 + (short > 0)
            x[6] = x[5] + short * (x[0] - x[5])
            y[6] = y[5] + short * (y[0] - y[5])
            print surface == "plane" ? "cell x y" : surface == "sphere" ? "cell x y z" : "cell x y z nx ny nz"
            for (i = 0; i < n; ++i) {
                if (surface == "plane") { nx[i] = ny[i] = z[i] = 0; nz[i] = 1; continue }
                if (surface == "sphere") {
                    z[i] = sqrt(100 - x[i] * x[i] - y[i] * y[i])
                    nx[i] = x[i]; ny[i] = y[i]; nz[i] = z[i]
                } else { # a saddle
                    z[i] = 0.1 * (x[i] * x[i] - y[i] * y[i])
                    nx[i] = -0.2 * x[i]; ny[i] = 0.2 * y[i]; nz[i] = 1
                }
                size = sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i])
                nx[i] /= size; ny[i] /= size; nz[i] /= size
            }
            for (k = 0; k <= draws; ++k)
                for (i = 0; i < n; ++i) {
                    a = k ? s * normal() : 0; b = k ? s * normal() : 0; c = k ? s * normal() : 0
                    up = a * nx[i] + b * ny[i] + c * nz[i]
                    printf "%d %.17g %.17g", k, x[i] + a - up * nx[i], y[i] + b - up * ny[i]
                    if (surface != "plane") printf " %.17g", z[i] + c - up * nz[i]
                    if (surface == "embedded") printf " %.17g %.17g %.17g", nx[i], ny[i], nz[i]
                    print ""
                }
        }'
}
# The range of sigma_2 ... sigma_6 over the deviations of mu_2 ... mu_6 in the draws that were measured.
sigma_over_draws() {
    awk -F '\t' '
        NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
        NR == 2 { for (p = 2; p <= 6; ++p) { mu[p] = $at["mu_" p]; sigma[p] = $at["sigma_" p] }; next }
        $at["status"] == "ok" { ++n; for (p = 2; p <= 6; ++p) {
            d = $at["mu_" p] - mu[p]; sum[p] += d; square[p] += d * d } }
        END {
            for (p = 2; p <= 6; ++p) {
                ratio = sigma[p] / sqrt(square[p] / n - sum[p] / n * sum[p] / n)
                if (p == 2 || ratio < least) least = ratio
                if (p == 2 || ratio > most) most = ratio
            }
            print least, most
        }' out
}
within() { # within NAME LEAST MOST: all ratios are
    said=$(sigma_over_draws)
    echo "$said" | awk -v least="$2" -v most="$3" '{ exit !($1 > least && $2 < most) }'
    count $? "$1" "$said" "$2 to $3"
}
for surface in plane sphere embedded; do
    radius=; [ $surface = sphere ] && radius="--radius 10"
    draws $surface 1000 0.02 0 > in # 1000 draws tell a deviation to 2.2 %
    run --surface $surface $radius --noise 0.02
    check "noise, $surface: exit status" "$status $(cat err)" "0 "
    within "noise, $surface: sigma is that of 1000 draws" 0.9 1.1
    draws $surface 1000 0.02 1e-6 > in
    run --surface $surface $radius --noise 0.02 --quiet --crossings always
    within "noise, $surface: a short edge does not matter" 0.85 1.6
done
draws sphere 0 0 0 > in
run --surface sphere --radius 10 --noise 0.02
mv out far
run --surface sphere --noise 0.002
near "noise: S is in the unit of the radius" "$(field 1 sigma_3)" \
    "$(awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "sigma_3") at = i } NR == 2 { print $at }' far)"

square > in
run --noise 0.01
check "noise: columns" "$(head -n 1 out | cut -f 18-24 | tr '\t' ' ')" \
    "theta_6 sigma_1 sigma_2 sigma_3 sigma_4 sigma_5 sigma_6"
near "noise: a square has mu_1 = 0 whatever happens" "$(field 1 sigma_1)" 0
# The two parts of g_2 / L vary independently by S / sqrt(2) (lengths) and S sqrt(2) (directions): the modulus varies by
# S sqrt(5 / 2 - 4 E(3/4)^2 / pi), E the complete elliptic integral.
near "noise: sigma_2 of a square" "$(field 1 sigma_2)" 0.007953582140 1e-8
check "noise: which has no direction" "$(field 1 theta_2)" ""
one=$(field 1 sigma_2)
run --noise 1%
check "noise: a part of the mean edge, which is 1 here" "$(field 1 sigma_2)" "$one"
run --noise=1% --directions --max-rank 2
check "noise: before directions" "$(head -n 1 out | cut -f 8- | tr '\t' ' ')" \
    "mu_2 theta_1 theta_2 sigma_1 sigma_2 e_1_x e_1_y e_2_x e_2_y"
run --noise 1% --directions center --error --max-rank 1
check "noise: after estimates" "$(head -n 1 out | cut -f 7- | tr '\t' ' ')" \
    "mu_1 error_L error_1 theta_1 sigma_1 center_x center_y e_1_x e_1_y coherence_1"
run --noise 0
check "no noise: sigma is 0" "$(cut -f 19-24 out | tail -n 1 | tr '\t' ' ')" "0 0 0 0 0 0"
run --noise 0.0999 --max-rank 7 # p S = 0.6 edges at p = 6, and nearly 0.7
check "noise: more than is known is not told" "$([ "$(field 1 sigma_6)" ] && echo told) $(field 1 sigma_7)" "told "
run --noise 1e100
check "noise: nor anything of absurd noise" "$status $(cut -f 19-24 out | tail -n 1 | tr -d '\t')" "0 "
run --noise 1e100 --max-rank 2 --json
has "noise: in JSON" out ',"sigma_1":null,"sigma_2":null}'
run --noise 1% --max-rank 1 --json
has "noise: in JSON, known" out ',"theta_1":null,"sigma_1":'

printf 'cell x y\na 0 0\na 0 1\na 1 1\nb 0 0\nb 1 0\nb 1 1\nc 0 0\nc 1 0\n' > in
run --noise 0.01
refused "noise, and a clockwise outline" clockwise 2
check "noise: all rows have all columns" "$(awk -F '\t' 'NF != 24' out)" ""
check "noise: what is refused has none" "$(awk -F '\t' 'NR > 1 { print ($19 != "") ($24 != "") }' out | tr '\n' ' ')" \
    "00 11 00 "
one=$(field 2 sigma_4)
run --noise 0.01 --reverse auto --quiet
near "noise: turned round" "$(field 1 sigma_4)" "$one"
run --noise 0.01 --json --quiet
check "noise: refused in JSON" "$(grep -c '"sigma_1":null,"sigma_2":null' out)" 2

# --- usage ------------------------------------------------------------------------------------------------------------

: > in
run --help
check "help: exit status" "$status" 0
check "help leads with examples" "$(sed -n 3p out)" EXAMPLES
for option in surface radius max-rank transport order error sharp smooth reverse merge digits directions json svg \
    color-by strokes view histogram histogram-of scatter scatter-of ply title unit id columns y-down \
    normals parts repair crossings resample noise summary quiet help version; do
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
for value in -1 x 1m 2%% % nan inf 1e101 ''; do
    wrong "--noise is a length, or a part of the mean edge as 2%, and not negative, not '$value'" "--noise=$value"
done
wrong "--noise needs a value" --noise
wrong "--noise has neither --order 4 nor --transport parallel" --noise 0.1 --order 4
wrong "--noise has neither --order 4 nor --transport parallel" --noise 0.1 --transport parallel
wrong "--noise is that of corners as measured" --noise 0 --smooth 1
wrong "--noise is that of corners as measured" --noise 0 --resample 1
wrong "--radius needs a value" --radius
wrong "--radius is a positive number, not '0'" --radius 0
wrong "--radius is a positive number, not 'nan'" --radius nan
wrong "--radius is a positive number, not '1m'" --radius 1m
wrong "--max-rank is a whole number from 1 to 1000000, not '0'" --max-rank 0
wrong "--max-rank is a whole number from 1 to 1000000, not '2.5'" --max-rank 2.5
wrong "--smooth is a whole number from 0 to 1000000, not '-1'" --smooth -1
wrong "--digits is a whole number from 1 to 17, not '18'" --digits 18
wrong "--json takes no value" --json=yes
for list in 2,,3 mu_2, '' 9999999999999999999999999; do
    wrong "--color-by takes columns of the results, as mu_2 or mu_2,area, not '$list'" --color-by "$list"
done
for name in mu_0 mu_-1 mu_2x id status x error_L; do
    wrong "--color-by $name: " --svg a.svg --color-by mu_1,$name
done
wrong "--color-by mu: the results have no such column of numbers; they have n, L, S, area, mu_p, theta_p" \
    --svg a.svg --color-by mu
wrong "--color-by error_2: --error adds such columns" --svg a.svg --color-by error_2
wrong "--histogram-of sigma_2: --noise S adds such columns" --histogram a.svg --histogram-of sigma_2
wrong "--scatter-of coherence_2: --directions center adds" --scatter a.svg --scatter-of coherence_2,mu_2
wrong "--color-by takes at most 12 columns" --color-by 1,1,1,1,1,1,1,1,1,1,1,1,1
wrong "--color-by mu_7 needs --max-rank 7" --color-by mu_2,mu_7 --svg a.svg
wrong "--color-by mu_7 needs --max-rank 7" --color-by mu_7 --svg a.svg
wrong "--color-by is for outlines: add --svg FILE" --color-by mu_2
wrong "--color-by is for outlines: add --svg FILE" --color-by mu_2 --histogram a.svg
wrong "--histogram-of is for --histogram FILE" --histogram-of mu_2 --svg a.svg
wrong "--scatter-of is for --scatter FILE" --scatter-of mu_2,mu_3 --svg a.svg
wrong "--histogram-of mu_7 needs --max-rank 7" --histogram-of mu_7 --histogram a.svg
wrong "--scatter-of takes at most 2 columns" --scatter a.svg --scatter-of 1,2,3
wrong "--strokes is for pictures" --strokes across
wrong "--strokes is along or across, not 'up'" --svg a.svg --strokes up
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
wrong "--svg and --ply would write the same file" --svg ./new --ply new
wrong "--svg and --ply would write the same file" --svg "$work/new" --ply new
ln -s one.tsv same.tsv
wrong "--svg and --histogram would write the same file" --svg one.tsv --histogram same.tsv
"$surfmink" --svg both in > both 2> err
check "--svg to standard output by its name: exit status" $? 1
has "--svg to standard output by its name" err "surfmink: --svg would write the file that is standard output"
run --svg /dev/null --ply /dev/null one.tsv --quiet
check "a device bears two" "$status" 0
wrong "unknown option '--?[31mred'" "$(printf -- '--\033[31mred')"
wrong "--normals is estimate or given, not 'guess'" --normals guess
wrong "--resample is a positive length, not '0'" --resample 0
wrong "--crossings is auto, always or never, not 'some'" --crossings some
wrong "--merge takes a distance, or a fraction of the perimeter as 1e-9L, not 'x'" --merge=x
wrong "--merge takes a distance, or a fraction of the perimeter as 1e-9L, not '1L'" --merge=1L
wrong "--title is for pictures" --title x
wrong "--title is for pictures" --title x --ply a.ply
wrong "--unit is for pictures" --unit um --histogram a.svg
wrong "--view is for pictures" --view 1,2 --ply a.ply
wrong "--scatter needs two columns" --scatter a.svg --scatter-of mu_2
wrong "--scatter needs two columns" --scatter a.svg --max-rank 1
wrong "--directions is edge, center or centre, not 'middle'" --directions=middle
wrong "--title needs a value" --title

totals
