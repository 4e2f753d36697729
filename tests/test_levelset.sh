#!/bin/sh
# test_levelset.sh LEVELSET SURFMINK: holds the command `levelset` to what its --help promises, and pipes it into
# `surfmink`. Needs only a POSIX shell. Run it from the root of the repository.
. "$(dirname "$0")/harness.sh"
levelset=$(absolute "$1")
surfmink=$(absolute "$2")
data=$PWD/tests/data
cd "$work" || exit 1
tab=$(printf '\t')

# --- harness ----------------------------------------------------------------------------------------------------------

# run ARGUMENT...: the command, with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$levelset" "$@" < in > out 2> err
    status=$?
}

# measure ARGUMENT...: pipes `out` into surfmink; leaves mu and $measured.
measure() {
    "$surfmink" "$@" < out > mu 2> mu.err
    measured=$?
}

# field FILE ROW NAME: of the table in a file; row 1 is the first below the names.
field() {
    awk -F '\t' -v row="$2" -v name="$3" '
        /^#/ { next }
        !names { names = 1; for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
        ++k == row { print column ? $column : "no such column" }' "$1"
}

rows() {
    awk '!/^#/ { ++n } END { print n - 1 }' "$1"
}

# refuses STATUS MESSAGE ARGUMENT...: that status, exactly that on standard error, nothing on standard output.
refuses() {
    want_status=$1 want=$2
    shift 2
    run "$@"
    check "status of levelset $*" $status "$want_status"
    check "complaint of levelset $*" "$(cat err)" "$want"
    check "output of levelset $*" "$(cat out)" ""
}

: > in
cat > oct.off << 'END'
OFF
6 8 12
1 0 0
-1 0 0
0 1 0
0 -1 0
0 0 1
0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
END
printf '0\n0\n0\n0\n1\n-1\n' > z.txt
cat > oct.ply << 'END'
ply
format ascii 1.0
element vertex 6
property double x
property double y
property double z
element face 8
property list uchar int vertex_indices
end_header
END
sed 1,2d oct.off >> oct.ply
awk 'NR > 2 && NR < 9 { print "v", $0 } NR > 8 { print "f", $2 + 1, $3 + 1, $4 + 1 }' oct.off > oct.obj

# --- what comes out ---------------------------------------------------------------------------------------------------

run --help
check "help succeeds" $status 0
check "help leads with examples" "$(sed -n 3p out)" "EXAMPLES"
check "help is no complaint" "$(cat err)" ""

run oct.off z.txt --at 0.5
check "status" $status 0
check "nothing to complain" "$(cat err)" ""
check "a note on the mesh" "$(sed -n 1p out)" \
    "# levelset of z.txt on oct.off (6 vertices, 8 triangles, 0 boundary edges, longest edge 1.41421), inside below"
check "a note on the level" "$(sed -n 2p out | sed 's/area [0-9.]*/area/')" \
    "# level 0.5: loops 1, area, open curves left out 0"
near "the area in it" "$(sed -n 2p out | sed 's/.*area \([0-9.]*\),.*/\1/')" 6.06217782649107 1e-12
check "the names of the columns" "$(sed -n 3p out)" "$(printf 'loop\tlevel\tx\ty\tz\tnx\tny\tnz')"
check "a square" "$(rows out)" 4
near "at its height" "$(field out 3 z)" 0.5 1e-15
near "with unit normals" "$(awk '/^0/ { s += $6 * $6 + $7 * $7 + $8 * $8 } END { printf "%.15f", s }' out)" 4 1e-12
cp out expected

for mesh in oct.ply oct.obj; do
    run $mesh z.txt --at 0.5
    check "the same from $mesh" "$(grep -v '^# levelset' out)" "$(grep -v '^# levelset' expected)"
done
cp oct.ply in
run - z.txt --at 0.5
check "the same from standard input" "$(grep -v '^# levelset' out)" "$(grep -v '^# levelset' expected)"
printf '# z\r\n0\r\n0\r\n\r\n0\r\n0\r\n1\r\n-1' > in
run oct.off - --at=0.5
check "the same from a field on standard input" "$(grep -v '^# levelset' out)" "$(grep -v '^# levelset' expected)"
: > in
run oct.off --function z --at 0.5
check "the same from a function" "$(grep -v '^# levelset' out)" "$(grep -v '^# levelset' expected)"
run --subdivide oct:0 --function z --at 0.5
check "the same from a built mesh" "$(grep -v '^#' out | sort)" "$(grep -v '^#' expected | sort)"
run oct.off z.txt --at 0.5
check "the same bytes again" "$(cat out)" "$(cat expected)"

run oct.off z.txt --at 0.5 --at -0.25
check "two levels" "$(awk '!/^#/ && NR > 4 { print $1, $2 }' out | uniq -c | awk '{ print $1, $2, $3 }')" "4 0 0.5
4 1 -0.25"
run oct.off z.txt --at 0
check "a level at four vertices" "$(awk '/^0/ { print $3 + 0, $4 + 0, $5 + 0 }' out | sort)" "-1 0 0
0 -1 0
0 1 0
1 0 0"
run oct.off z.txt --at 1 --inside above
check "a level at the top" "$status $(cat err) $(rows out)" "0  0"
check "a note on it" "$(sed -n 2p out)" "# level 1: loops 0, area 0, open curves left out 0, collapsed loops left out 1"
run oct.off z.txt --at 0.1 --at 0.1234567890123456 --at 1e-300
check "levels come back as they went in, without noise" "$(awk '/^[0-9]/ { print $2 }' out | uniq | tr '\n' ' ')" \
    "0.1 0.1234567890123456 1e-300 "
odd=$(printf 'two\nlines.txt')
cp z.txt "$odd"
run oct.off "$odd" --at 0.5
check "a file name cannot break the table" "$(grep -v '^#' out)" "$(grep -v '^#' expected)"
run oct.off z.txt --at 5
check "a level above all" "$status $(rows out)" "0 0"
measure
check "an empty table can be measured" "$measured $(rows mu)" "0 0"
run oct.off z.txt --at 0.1 --digits 3
check "three digits" "$(awk '/^0/ && (length($3) > 6 || length($6) > 6)' out)" ""

run oct.off z.txt --at 0.5 --area
below=$(field out 1 area)
check "a table of areas" "$(rows out) $(grep -v '^#' out | cut -f 1,2,3,5,6 | tr '\n\t' '  ')" \
    "1 level loops corners open collapsed 0.5 1 4 0 0 "
run oct.off z.txt --at 0.5 --area --inside above
above=$(field out 1 area)
whole=$(echo "$below $above" | awk '{ printf "%.15f", $1 + $2 }')
near "the two parts make up the whole" "$whole" 6.92820323027551 1e-12

# --- into surfmink ----------------------------------------------------------------------------------------------------

run --subdivide ico:4 --function flower
measure --max-rank 8
check "the flower is measured" "$status $measured $(field mu 1 status) $(field mu 1 n)" "0 0 ok 99"
near "its mu_2" "$(field mu 1 mu_2)" 0.0398569744 6e-11
near "its mu_4" "$(field mu 1 mu_4)" 0.1890006023 6e-11
near "its mu_6" "$(field mu 1 mu_6)" 0.0766159711 6e-11
near "its mu_8" "$(field mu 1 mu_8)" 0.3080727536 6e-11
cp out expected
run --subdivide ico:4 --function flower:0.5,0.1,4,1.5707963267948966,0.78539816339744831 --at 0
check "its parameters" "$(grep -v '^# levelset' out)" "$(grep -v '^# levelset' expected)"
run --subdivide oct:7 --function flower:0.5,0.2,3
near "the tip of an odd petal lies where the curve has it, not opposite" \
    "$(awk '/^0/ { phi = atan2($4, $3); if (phi > most) most = phi } END { print most }' out)" 1.48539816339745 1e-3

run "$data/sphere_geodesic16.mesh.off" "$data/sphere_grf_seed1.field.txt" --at 0.5 --at 1 --at 1.5 --inside above
check "contours of a random field" "$status $(tail -n 1 out | cut -f 1)" "0 16"
measure
check "one is a hole" "$measured $(grep -c "${tab}ok$tab" mu) $(grep -c "${tab}clockwise$tab" mu)" "2 16 1"
measure --reverse auto
check "it can be measured reversed" "$measured $(grep -c "${tab}ok$tab" mu)" "0 17"
digest() {
    awk -F '\t' '
        NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i; next }
        { printf "%d %.7f %.6f %.6f %.6f\n", $c["n"], $c["L"], $c["mu_2"], $c["mu_5"], $c["mu_6"] }' "$1" | sort
}
digest mu > ours
digest "$data/sphere_grf_seed1.contours.ref.tsv" > theirs
check "all are those found elsewhere" "$(cat ours)" "$(cat theirs)"

# --- boundaries and other defects that are no errors ------------------------------------------------------------------

cat > flat.obj << 'END'
v 0 0 0
v 1 0 0
v 2 0 0
v 0 1 0
v 1 1 0
v 2 1 0
v 0 2 0
v 1 2 0
v 2 2 0
f 1 2 5
f 1 5 4
f 2 3 6
f 2 6 5
f 4 5 8
f 4 8 7
f 5 6 9
f 5 9 8
END
printf '0\n0\n0\n0\n1\n0\n0\n0\n0\n' > hill.txt
run flat.obj hill.txt --at 0.5
check "a closed curve on an open mesh" "$status $(cat err) $(rows out)" "0  6"
run flat.obj --function x --at 0.5 --at 1.5
check "open curves: status 2" $status 2
said="1 curve ends at the boundary of the mesh: left out"
check "open curves: a word for each level" "$(cat err)" "flat.obj: level 0.5: $said
flat.obj: level 1.5: $said"
check "open curves: left out" "$(rows out)" 0
check "open curves: the area counts" "$(grep '^# level ' out)" "# level 0.5: loops 0, area 1, open curves left out 1
# level 1.5: loops 0, area 3, open curves left out 1"

sed 's/^3 \([0-9]\) \([0-9]\) \([0-9]\)$/3 \1 \3 \2/' oct.off > inward.off
run inward.off z.txt --at 0.5
check "inside out" "$status $(cat err)" "0 inward.off: inside out, its normals point inwards: --flip turns it round"
sed '$d; s/^6 8 /6 7 /' inward.off > cup.off
run cup.off z.txt --at 0.5
check "an open mesh has no inside" "$status $(cat err)" "0 "
run inward.off z.txt --at 0.5 --flip
check "turned round" "$status $(cat err)" "0 "
run oct.off z.txt --at 0.5
grep '^0' out | sort > expected
run inward.off z.txt --at 0.5 --flip
check "turned round it is the same" "$(grep '^0' out | sort)" "$(cat expected)"
printf 'OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n3 0 1 2\n3 0 3 4\n' > bow.off
run bow.off --function z --at 1
check "a pinched vertex" "$status $(cat err)" \
    "0 bow.off: vertices where sheets touch that share no edge: 1 (normals there are a mean)"

# --- complaints -------------------------------------------------------------------------------------------------------

hint="(levelset --help shows examples)"
refuses 1 "levelset: there is neither a mesh nor an image $hint"
refuses 1 "levelset: there is no FIELD, no --field and no --function $hint" --subdivide ico:1 --at 1
refuses 1 "levelset: there is no --at $hint" oct.off z.txt
refuses 1 "levelset: one mesh and one field, this is one file more: more $hint" oct.off z.txt more --at 1
both="FIELD, --field and --function, or MESH and --subdivide, exclude each other"
refuses 1 "levelset: $both: z.txt $hint" oct.off z.txt --function x
refuses 1 "levelset: $both: oct.off $hint" --subdivide ico:1 oct.off --function x
refuses 1 "levelset: standard input is either MESH or FIELD $hint" - - --at 1
refuses 1 "levelset: unknown option: --levels $hint" oct.off z.txt --levels 1
refuses 1 "levelset: a value is missing behind: --at $hint" oct.off z.txt --at
refuses 1 "levelset: --at wants a finite number, got: half $hint" oct.off z.txt --at half
refuses 1 "levelset: --at wants a finite number, got: nan $hint" oct.off z.txt --at nan
refuses 1 "levelset: --inside wants below or above, got: out $hint" oct.off z.txt --at 1 --inside out
refuses 1 "levelset: --digits wants 1 to 17, got: 0 $hint" oct.off z.txt --at 1 --digits 0
for bad in cube:3 ico:99 ico: ico:2x; do
    refuses 1 "levelset: --subdivide wants ico:N or oct:N with N from 0 to 12, got: $bad $hint" \
        --subdivide $bad --function x
done
for bad in w flower:1,2,x flower:1,2,3,4,5,6 flower:.5,.1,2.5 flowers; do
    refuses 1 "levelset: --function wants x, y, z or flower:R0,A,OMEGA,X0,Y0 (a whole OMEGA), got: $bad $hint" \
        oct.off --function $bad
done
refuses 1 "none.off: cannot be opened" none.off z.txt --at 1
refuses 1 "none.txt: cannot be opened" oct.off none.txt --at 1
printf '0\n0\n# two of six\n\n0\nO\n1\n-1\n' > bad.txt
refuses 1 "bad.txt:6: expected one finite number a line, got 'O'" oct.off bad.txt --at 1
printf '0\n0\n' > bad.txt
refuses 1 "bad.txt:2: the file ends after 2 values: the mesh has 6 vertices" oct.off bad.txt --at 1
sed 's/^3 2 0 5$/2 2 0/' oct.off > bad.off
refuses 1 "bad.off:13: a face of 2 corners" bad.off z.txt --at 1
refuses 1 "levelset: --field is of a MESH in a file, without --function: f $hint" oct.off --field f --function x
refuses 1 "oct.off: the vertices have no scalar 'f'; they have: none" oct.off --field f --at 0

# --- other meshes: other formats, polygons, soups, fields in the mesh, holes ------------------------------------------

# loops NAME [LINE]: the outline of the octahedron at z = 0.5, in any order; standard error says this.
run oct.off z.txt --at 0.5
grep '^0' out | cut -f 3-5 | sort > expected
same_square() {
    check "$1: status, complaint" "$status $(cat err)" "0 ${2-}"
    check "$1: the same square" "$(grep '^0' out | cut -f 3-5 | sort)" "$(cat expected)"
}
awk 'NR > 2 && NR < 9 { x[NR - 3] = $0 } NR == 1 { print "solid o" }
     NR > 8 { print "facet normal 0 0 0\n outer loop"
              for (k = 2; k < 5; ++k) print "  vertex " x[$k]
              print " endloop\nendfacet" } END { print "endsolid" }' oct.off > oct.stl
run oct.stl --function z --at 0.5
same_square "STL" "oct.stl: 18 vertices are copies of others: joined"
# bytes TYPE NUMBER...: little-endian, from small whole numbers; f: 4 bytes of a float that is 0, 1 or -1.
bytes() {
    type=$1
    shift
    for number in "$@"; do
        case $type$number in
        f0) printf '\0\0\0\0' ;;
        f1) printf '\0\0\200\077' ;;
        f-1) printf '\0\0\200\277' ;;
        F0) printf '\0\0\0\0' ;;
        F1) printf '\077\200\0\0' ;;
        F-1) printf '\277\200\0\0' ;;
        i*) printf "\\$(printf %o "$number")\\0\\0\\0" ;;
        I*) printf "\\0\\0\\0\\$(printf %o "$number")" ;;
        *) printf "\\$(printf %o "$number")" ;;
        esac
    done
}
{
    printf '%-80s' "solid, says the header of this binary file"
    bytes i 8
    awk 'NR > 2 && NR < 9 { x[NR - 3] = $0 } NR > 8 { print x[$2], x[$3], x[$4] }' oct.off |
        while read -r facet; do bytes f 0 0 0 $facet; printf '\0\0'; done
} > binary.stl
run binary.stl --function z --at 0.5
same_square "binary STL" "binary.stl: 18 vertices are copies of others: joined"
cat binary.stl > in
run - --function z --at 0.5
same_square "binary STL through a pipe" "-: 18 vertices are copies of others: joined"
head -c 200 binary.stl > short.stl
refuses 1 "short.stl: the file ends within its numbers" short.stl --function z
{ cat binary.stl && echo more; } > long.stl
refuses 1 "long.stl: bytes after the last of 8 facets of a binary STL" long.stl --function z
: > in
for endian in little big; do
    case $endian in
    little) float=f int=i ;;
    big) float=F int=I ;;
    esac
    {
        printf 'ply\nformat binary_%s_endian 1.0\nelement vertex 6\nproperty float x\nproperty float y\n' $endian
        printf 'property uchar red\nproperty float z\nproperty float height\nelement face 8\nproperty uchar group\n'
        printf 'property list uchar int vertex_indices\nend_header\n'
        awk 'NR > 2 && NR < 9' oct.off | while read -r x y z; do
            bytes $float "$x" "$y"; bytes c 13; bytes $float "$z" "$z"
        done
        awk 'NR > 8' oct.off | while read -r n a b c; do bytes c 10 "$n"; bytes $int "$a" "$b" "$c"; done
    } > $endian.ply
    run $endian.ply --field height --at 0.5
    same_square "binary PLY, $endian"
    has "a field of the mesh: its name in the note" out "# levelset of height on $endian.ply "
    head -c $(($(wc -c < $endian.ply) - 1)) $endian.ply > short.ply
    refuses 1 "short.ply: the file ends within its numbers" short.ply --function z
done
refuses 1 "big.ply: the vertices have no scalar 'depth'; they have: red height" big.ply --field depth --at 0
{
    printf '# vtk DataFile Version 3.0\nno title\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n'
    awk 'NR > 2 && NR < 9' oct.off
    printf 'POLYGONS 8 32\n'
    awk 'NR > 8' oct.off
    printf 'POINT_DATA 6\nSCALARS other int\nLOOKUP_TABLE default\n1 2 3 4 5 6\nFIELD f 2\nh 1 6 float\n0 0 0 0 1 -1\n'
    printf 'v 2 6 float\n1 2 3 4 5 6 7 8 9 10 11 12\nNORMALS n float\n1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1\n'
} > oct.vtk
run oct.vtk --field h --at 0.5
same_square "VTK, a field of the mesh"
near "normals of the file are used, made unit" "$(awk '/^0/ && $3 > 0.4 { print $6 }' out)" 0.7071067811865476
refuses 1 "oct.vtk:28: 'v' has 2 components, not 1" oct.vtk --field v --at 0
sed 's/^1 0 0 -1 0 0 0 1 0 0 -1 .*/0 0 1 0 0 1 0 0 1 0 0 1 0 0 1 0 0 1/' oct.vtk > flat.vtk
run flat.vtk --field h --at 0.5
same_square "normals that contradict the faces" \
    "flat.vtk: its normals contradict its faces, or each other: not used; means over the faces are"
sed 's/POLYDATA/UNSTRUCTURED_GRID/' oct.vtk > bad.vtk
is="is no surface: ParaView's filter Extract Surface makes one; save it as PLY"
refuses 1 "bad.vtk:4: DATASET UNSTRUCTURED_GRID $is" bad.vtk --function z
sed 's/ASCII/BINARY/' oct.vtk > bad.vtk
refuses 1 "bad.vtk:3: binary VTK is not read: ParaView saves it as ascii, or as PLY" bad.vtk --function z
# foreign TEXT WHAT: files of other programs are named.
foreign() {
    printf "$1" > foreign
    refuses 1 "foreign: $2" foreign --function z
}
foreign 'glTF\002' "binary glTF is not read: Blender or MeshLab saves it as PLY"
foreign '<?xml version="1.0"?>\n<VTKFile type="PolyData">' \
    "XML of VTK is not read: ParaView saves it as PLY, or meshio convert IN OUT.ply"
foreign '$MeshFormat\n4.1 0 8\n' \
    "a Gmsh mesh is not read: gmsh IN -save -o OUT.stl, or meshio convert IN OUT.ply"
foreign '\037\213\010' "compressed (gzip) is not read: gzip -dc FILE | ... - reads it"
foreign '\377\377\376' "a FreeSurfer surface is not read: mris_convert IN OUT.stl"

# A box of quads and one hexagon's worth of corners on its top: cut half-way up.
cat > box.obj << 'END'
o box
v 0 0 0
v 3 0 0
v 3 1 0
v 0 1 0
v 0 0 2
v 3 0 2
v 3 1 2
v 0 1 2
v 1 0 2
v 2 1 2
f 4 3 2 1
f 5 9 6 7 10 8
f 1 2 6 9 5
f 2 3 7 6
f 3 4 8 10 7
f 4 1 5 8
END
run box.obj --function z --at 1.25 --inside above
check "polygons are split" "$status $(cat err) $(rows out)" "0  10"
check "their area" "$(grep -o 'area [0-9.]*' out)" "area 9"
near "the cut of a box: its perimeter" "$(awk '/^0/ { x[++n] = $3; y[n] = $4 } END { for (i = 1; i <= n; ++i) {
    j = i % n + 1; l += sqrt((x[i] - x[j]) ^ 2 + (y[i] - y[j]) ^ 2) } printf "%.15g", l }' out)" 8

sed 's/^3 2 0 5$/3 0 2 5/' oct.off > turned.off
run turned.off z.txt --at 0.5
same_square "a face that runs the wrong way" "turned.off:13: runs against its neighbours; 1 such face is turned round"
printf 'OFF\n5 5\n0 0 0\n1 0 0\n1 1 1\n0 1 2\n0 0 3\n3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n' > strip.off
run strip.off --function z
check "a surface with one side" "$status $(sed 's/:[0-9]*: .* run/: run/; s/ if.*//' err)" \
    "1 strip.off: run opposite ways, and so do others"

printf '0\n0\n0\nNaN\n1\n-1\n' > hole.txt
run oct.off hole.txt --at 0.5
check "a NaN is a hole: status 2, the curve ends there" "$status $(rows out)" "2 0"
check "it is told, with its line" "$(cat err)" \
    "hole.txt:4: vertex 3 (from 0) is the first without a value; a hole of 4 triangles
oct.off: level 0.5: 1 curve ends at the boundary of the mesh: left out"
printf '0\n0\n0\n0\n1\nnan\n' > hole.txt
run oct.off hole.txt --at 0.5
same_square "a hole elsewhere" "hole.txt:6: vertex 5 (from 0) is the first without a value; a hole of 4 triangles"
near "and what is measured is the rest" "$(grep -o 'area [0-9.]*' out | cut -d ' ' -f 2)" 2.598076211353316
awk 'BEGIN { for (i = 0; i < 24; ++i) print (i == 23 ? 7 : 0) }' > copies.txt
refuses 1 "oct.stl: vertices 14 and 23 (from 0) are one point with two values: 0 and 7" oct.stl copies.txt --at 1

odd=$(printf 'q\033[31m\302\233m.off')
cp oct.off "$odd"
run "$odd" z.txt --at 0.5
check "a name does not command the terminal" "$(sed -n 1p out | cut -c 1-36)" "# levelset of z.txt on q?[31m?m.off "
run "$odd" none.txt --at 0.5
check "nor in a complaint" "$(cat err)" "none.txt: cannot be opened"
run "$(printf 'n\233o')" z.txt --at 0.5
check "nor a single byte" "$(cat err)" "n?o: cannot be opened"
run -h
check "-h is --help" "$status $(sed -n 3p out)" "0 EXAMPLES"
if [ -w /dev/full ]; then
    "$levelset" oct.off z.txt --at 0.5 > /dev/full 2> err
    check "a full disk" "$? $(sed 's/written.*/written/' err)" "1 levelset: standard output cannot be written"
fi

# --- grey images ------------------------------------------------------------------------------------------------------

# A cone about column 5, row 4 of 12 x 9 pixels: value = 20 - 2 (|column - 5| + |row - 4|); its level sets are squares.
# image WHAT: its numbers, one a line, row by row; WHAT is an awk expression of r, c and the value v.
image() {
    awk "BEGIN { for (r = 0; r < 9; ++r) for (c = 0; c < 12; ++c) {
        x = c < 5 ? 5 - c : c - 5; y = r < 4 ? 4 - r : r - 4; v = 20 - 2 * (x + y); if (v < 0) v = 0; print $1 } }"
}
# words FORMAT...: bytes from the numbers on standard input: u1, u2 and u2be, and f4 (whole numbers up to 20, or nan).
words() {
    awk -v kind="$1" '
        function byte(n) { printf "\\%03o", n }
        function four(n,    e, m, bits) {
            if (n == "nan") { byte(0); byte(0); byte(192); byte(127); return }
            for (e = 0; n > 0 && 2 ^ (e + 1) <= n; ++e) ;
            m = n > 0 ? n / 2 ^ e - 1 : 0
            bits = n > 0 ? (127 + e) * 128 + int(m * 128) : 0
            byte(0); byte(0); byte(bits % 256); byte(int(bits / 256))
        }
        kind == "u1" { byte($1) }
        kind == "u2" { byte($1 % 256); byte(int($1 / 256)) }
        kind == "u2be" { byte(int($1 / 256)); byte($1 % 256) }
        kind == "f4" { four($1) }' > octal
    printf "$(cat octal)"
}
# npy DESCR SHAPE: the head of an NPY.
npy() {
    printf '\223NUMPY\001\000v\000'
    printf "%-117s\n" "{'descr': '$1', 'fortran_order': False, 'shape': ($2), }"
}

{ echo 'P2 12 9 255'; image v; } > cone.pgm
run cone.pgm --at 13 --inside above
check "an image: status, complaint" "$status $(cat err)" "0 "
check "where it comes from" "$(sed -n 1p out)" "# levelset of cone.pgm (12 x 9 pixels), inside above"
check "its level" "$(sed -n 2p out)" "# level 13: loops 1, area 24.5, open curves left out 0"
check "its columns" "$(sed -n 3p out)" "$(printf 'loop\tlevel\tx\ty')"
check "x is the column, y minus the row" \
    "$(awk '/^0/ { x += $3; y += $4 } END { print x / 28, y / 28, NR - 3 }' out)" "5 -4 28"
check "on the sides between pixels: |x - 5| + |y + 4| = 3.5" "$(awk '/^0/ { x = $3 - 5; y = $4 + 4
    d = (x < 0 ? -x : x) + (y < 0 ? -y : y) - 3.5; if (d > 1e-12 || d < -1e-12) print }' out | wc -l | tr -d ' ')" 0
grep '^0' out | sort > expected
measure
check "it is measured" "$measured $(field mu 1 status)" "0 ok"
near "its area" "$(field mu 1 area)" 24.5
near "its length" "$(field mu 1 L)" "$(awk 'BEGIN { print 14 * sqrt(2) }')" 1e-4
near "it is a square" "$(field mu 1 mu_4)" 1

# same_cone NAME [COMPLAINT]: the outline of the cone again, in any order.
same_cone() {
    check "$1: status, complaint" "$status $(cat err)" "0 ${2-}"
    check "$1: the same outline" "$(grep '^0' out | sort)" "$(cat expected)"
}
cat cone.pgm > in
run - --at 13 --inside above
same_cone "PGM from standard input"
: > in
{ printf 'P5 12 9 255\n'; image v | words u1; } > bytes.pgm
run bytes.pgm --at 13 --inside above
same_cone "binary PGM"
{ printf 'P5 12 9 300\n'; image v | words u2be; } > words.pgm
run words.pgm --at 13 --inside above
same_cone "binary PGM of 16 bits"
{ npy '|u1' '9, 12'; image v | words u1; } > bytes.npy
run bytes.npy --at 13 --inside above
same_cone "NPY"
{ npy '<f4' '9, 12'; image v | words f4; } > floats.npy
run floats.npy --at 13 --inside above
same_cone "NPY of floats"
{ npy '>u2' '9, 12'; image v | words u2be; } > big.npy
run big.npy --at 13 --inside above
same_cone "NPY, the other byte order"
# an entry of a TIFF has a tag, a type (3: 16 bits, 4: 32 bits), a count and a value
entry() {
    printf "\\$(printf %o $(($1 % 256)))\\$(printf %o $(($1 / 256)))\\003\\000\\001\\000\\000\\000"
    printf "\\$(printf %o $(($2 % 256)))\\$(printf %o $(($2 / 256)))\\000\\000"
}
tiff() { # tiff BITS FORMAT BYTES
    printf 'II*\0\010\0\0\0\012\0'
    entry 256 12; entry 257 9; entry 258 "$1"; entry 259 1; entry 262 1; entry 273 134; entry 277 1
    entry 278 9; entry 279 "$3"; entry 339 "$2"
    printf '\0\0\0\0'
}
{ tiff 32 3 432; image v | words f4; } > cone.tif
run cone.tif --at 13 --inside above
same_cone "TIFF of floats"
{ tiff 16 1 216; image v | words u2; } > words.tif
run words.tif --at 13 --inside above
same_cone "TIFF of 16 bits"

run cone.pgm --at 13
measure
check "below the level: the same curve the other way round" "$measured $(field mu 1 status)" "2 clockwise"
check "and the rest of the area" "$(field out 1 loop) $(grep -o 'area [0-9.]*' out)" "0 area 63.5"
run cone.pgm --at 13 --inside above --spacing 3,0.5
measure
near "pixels of 3 x 0.5" "$(field mu 1 area)" $(awk 'BEGIN { print 24.5 * 1.5 }')
check "and their area in the note" "$(grep -o 'area [0-9.]*' out)" "area 36.75"
run cone.pgm --at 13 --inside above --spacing=2
check "pixels of 2 x 2" "$(grep -o 'area [0-9.]*' out)" "area 98"

# Turned and mirrored images have turned and mirrored outlines: the eight symmetries of the grid, on an image of no
# symmetry (wx, wy: where pixel (c, r) goes). Numbers of 3 digits, for sums may differ in the last.
odd='20 * (((r * 7 + c * 3 + r * c) % 11) > 6 && r > 0 && c > 0 && r < 8 && c < 11) + (r * c) % 5'
image "$odd" > numbers
outline_of() { # outline_of: of each loop its area, mu_2 and mu_3, sorted
    "$surfmink" --reverse auto < out 2> /dev/null | awk -F '\t' '
        NR == 1 { for (i = 1; i <= NF; ++i) c[$i] = i; next }
        { printf "%.6f %.6f %.6f %.6f\n", $c["L"], $c["area"], $c["mu_2"], $c["mu_3"] }' | sort
}
{ echo 'P2 12 9 99'; cat numbers; } > odd.pgm
run odd.pgm --at 11.5 --inside above
check "an image without symmetry" "$status $(outline_of | wc -l | tr -d ' ')" "0 9"
outline_of > expected_odd
head -n 2 out | tail -n 1 | sed 's/\(area [0-9.]*[0-9]\{6\}\)[0-9]*/\1/' > level_odd
turned=0
for swap in 0 1; do for fx in 0 1; do for fy in 0 1; do
    awk -v swap=$swap -v fx=$fx -v fy=$fy '
        { z[NR - 1] = $1 }
        END {
            w = swap ? 9 : 12; h = swap ? 12 : 9
            print "P2", w, h, 99
            for (r = 0; r < h; ++r) for (c = 0; c < w; ++c) {
                a = fx ? w - 1 - c : c; b = fy ? h - 1 - r : r
                print swap ? z[a * 12 + b] : z[b * 12 + a]
            }
        }' numbers > turned.pgm
    run turned.pgm --at 11.5 --inside above
    check "equivariance: $swap $fx $fy" "$status $(outline_of)" "0 $(cat expected_odd)"
    turned=$((turned + 1))
done; done; done
check "all eight were tried" $turned 8

# --- holes and borders ------------------------------------------------------------------------------------------------

{ npy '<f4' '9, 12'; image 'r == 4 && c == 6 ? "nan" : v' | words f4; } > hole.npy
run hole.npy --at 13 --inside above
check "a NaN inside: status, complaint" "$status $(cat err)" "0 hole.npy: 1 pixels have no value: holes"
check "its squares are not measured, the curve does not care" "$(grep '^0' out | sort) $(grep -o 'area [0-9.]*' out)" \
    "$(cat expected) area 20.5"
run hole.npy --at 13 --inside above --close --loops
check "closed, the hole has a loop as well" "$(grep -v '^#' out | cut -f 1-6 | tr '\n\t' '; ')" \
    "loop level part kind of corners;0 13 0 outer - 28;1 13 0 hole 0 8;"
check "areas: of the polygon; of the hole" "$(grep -v '^#' out | cut -f 7 | tr '\n' ' ')" "area 24.5 4 "
{ npy '<f4' '9, 12'; image 'r == 4 && c == 8 ? "nan" : v' | words f4; } > hole.npy
run hole.npy --at 13 --inside above
check "a NaN at the curve: status 2" "$status $(rows out)" "2 0"
check "it is told" "$(cat err)" "hole.npy: 1 pixels have no value: holes
hole.npy: level 13: 1 curve ends at the border or at a hole: left out"
run hole.npy --at 13 --inside above --close
measure
check "closed it is measured" "$status $measured $(field mu 1 status) $(rows mu)" "0 0 ok 1"
near "and has the area of the inside" "$(field mu 1 area)" \
    "$(grep -o 'area [0-9.]*' out | cut -d ' ' -f 2)"
{ npy '<f4' '9, 12'; image '"nan"' | words f4; } > hole.npy
run hole.npy --at 13 --close
check "nothing but NaN" "$status $(cat err) $(rows out)" "0 hole.npy: 108 pixels have no value: holes 0"

run cone.pgm --at 3 --inside above
check "a curve at the border: status 2" "$status $(cat err)" \
    "2 cone.pgm: level 3: 4 curves end at the border or at a hole: left out"
run cone.pgm --at 3 --inside above --close
check "closed: status, complaint" "$status $(cat err)" "0 "
check "closed: the note" "$(sed -n 2p out | sed 's/area [0-9.]*/area/')" \
    "# level 3: loops 1, area, open curves left out 0, closed along the boundary 4"
measure
near "closed: its area" "$(field mu 1 area)" "$(grep -o 'area [0-9.]*' out | cut -d ' ' -f 2)"
run cone.pgm --at -1 --inside above --close
check "all of an image: its border" "$status $(awk '/^0/ { print ($3 < 0 || $3 > 11 || $4 > 0 || $4 < -8) }' out |
    uniq -c | tr -s ' ')" "0  38 0"
run cone.pgm --at 13 --at 15 --close --loops
check "loops of two levels: outer ones and holes" "$(grep -v '^#' out | cut -f 1-5 | tr '\n\t' '; ')" \
    "loop level part kind of;0 13 0 hole 1;1 13 0 outer -;2 15 1 hole 3;3 15 1 outer -;"
run cone.pgm --at 13 --at 15 --loops
check "without the border a hole has no outer loop" "$(grep -v '^#' out | cut -f 1-5 | tr '\n\t' '; ')" \
    "loop level part kind of;0 13 0 hole -;1 15 1 hole -;"

# --- meshes: closed curves, loops -------------------------------------------------------------------------------------

strip="0 0;0 1;0 2;0.5 0;0.5 0.5;0.5 1;0.5 1.5;0.5 2;"
run flat.obj --function x --at 0.5 --close
check "a mesh, closed: status, complaint" "$status $(cat err)" "0 "
check "a mesh, closed: a strip" "$(sed -n 2p out) $(awk '/^0/ { print $3, $4 }' out | sort | tr '\n' ';')" \
    "# level 0.5: loops 1, area 1, open curves left out 0, closed along the boundary 1 $strip"
run flat.obj --function x --at 0.5 --close --inside above --loops
check "the other side" "$(tail -n 1 out | cut -f 3-7)" "$(printf '0\touter\t-\t10\t3')"
run flat.obj hill.txt --at 0.5 --close --loops
check "a mesh with a hill: its border and the hill" "$(grep -v '^#' out | tail -n 2 | tr '\n\t' '; ')" \
    "0 0.5 0 hole 1 6 0.75;1 0.5 0 outer - 8 4;"
run "$data/sphere_geodesic16.mesh.off" "$data/sphere_grf_seed1.field.txt" --at 0.5 --at 1 --at 1.5 --inside above \
    --loops
check "contours of a random field: outer ones, holes" \
    "$(grep -c "${tab}outer$tab" out) $(grep -c "${tab}hole$tab" out)" "16 1"
check "of an outer loop of its part" "$(awk '$4 == "hole" { hole = $5; part = $3 } $4 == "outer" { p[$1] = $3 }
    END { print (p[hole] == part) }' out)" 1
near "areas of the parts make up that of the inside" \
    "$(awk '/^[0-9]/ { s += $4 == "hole" ? -$7 : $7 } END { printf "%.12g", s }' out)" \
    "$(sed -n 's/.*, area \([0-9.]*\),.*/\1/p' out | awk '{ s += $1 } END { printf "%.12g", s }')" 1e-9
run --subdivide ico:3 --function z --at 0.3 --inside above --loops
check "a cap is outer" "$(tail -n 1 out | cut -f 3-5)" "$(printf '0\touter\t-')"
run --subdivide ico:3 --function z --at 0.3 --loops
check "what is left of the sphere has a hole, and no outer loop" "$(tail -n 1 out | cut -f 3-5)" \
    "$(printf '0\thole\t-')"
printf 'OFF\n8 8\n1 1 0\n-1 1 0\n-1 -1 0\n1 -1 0\n1 1 1\n-1 1 1\n-1 -1 1\n1 -1 1\n' > belt.off
printf '3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n' >> belt.off
run belt.off --function z --at 0.5 --loops
check "a belt encloses nothing" "$(tail -n 1 out | cut -f 4-5,7)" "$(printf -- '-\t-\tnan')"

# --- a chart ----------------------------------------------------------------------------------------------------------

# x = column, y = 8 - row, z = 7, of bytes; the normals point up
{ npy '|u1' '3, 9, 12'; { image c; image '8 - r'; image 7; } | words u1; } > xyz.npy
{ npy '|u1' '3, 9, 12'; { image 0; image 0; image 5; } | words u1; } > n.npy
for normals in "" "--normals n.npy"; do
    run cone.pgm --positions xyz.npy $normals --at 13 --inside above
    check "on a chart $normals" "$status $(cat err) $(sed -n 3p out)" "0  $(printf 'loop\tlevel\tx\ty\tz\tnx\tny\tnz')"
    check "on a chart $normals: the same outline" \
        "$(awk '/^0/ { printf "%s\t%s\t%.17g\t%.17g\n", $1, $2, $3, $4 - 8 }' out | sort)" "$(cat expected)"
    check "on a chart $normals: place and normal" "$(awk '/^0/ { print $5, $6, $7, $8 }' out | sort -u)" "7 0 0 1"
done
run cone.pgm --positions xyz.npy --flip --at 13 --inside above
measure
check "with normals the other way it is still outer" "$measured $(field mu 1 status) $(awk '/^0/ { print $8 }' out |
    sort -u)" "0 ok -1"
{ npy '<f4' '3, 9, 12'; { image c; image '8 - r'; image 'r == 4 && c == 8 ? "nan" : 7'; } | words f4; } > rim.npy
run cone.pgm --positions rim.npy --normals n.npy --at 13 --inside above
check "a pixel without a place is a hole" "$status $(sed -n 1p err)" \
    "2 cone.pgm: 1 pixels have no value, position or normal: holes"

# --- planted faults ---------------------------------------------------------------------------------------------------

refuses 1 "levelset: this is for an IMAGE, not for a mesh: --spacing $hint" oct.off z.txt --at 1 --spacing 2
refuses 1 "levelset: this is for an IMAGE, not for a mesh: --positions $hint" oct.off --function z --positions xyz.npy
refuses 1 "levelset: --normals without --positions: n.npy $hint" cone.pgm --at 1 --normals n.npy
refuses 1 "levelset: --flip is for normals: an image has none without --positions $hint" cone.pgm --at 1 --flip
refuses 1 "levelset: --spacing is for the plane: with --positions, these tell where a pixel is $hint" \
    cone.pgm --at 1 --positions xyz.npy --spacing 2
refuses 1 "levelset: standard input is one file $hint" - --positions - --at 1
refuses 1 "levelset: --area and --loops are two tables: one at a time $hint" cone.pgm --at 1 --area --loops
refuses 1 "levelset: no value is wanted behind: --close $hint" cone.pgm --at 1 --close=1
refuses 1 "levelset: there is no --at $hint" cone.pgm
for bad in 0 -1 1,0 1, 1,2,3 x nan inf; do
    refuses 1 "levelset: --spacing wants one positive number, or two with a comma, got: $bad $hint" \
        cone.pgm --at 1 --spacing=$bad
done
no_image="no image (TIFF without compression, NPY or PGM); if it is a mesh, it wants a FIELD, a --field or a --function"
refuses 1 "oct.off: $no_image" oct.off --at 1
refuses 1 "nowhere.tif: No such file or directory" nowhere.tif --at 1
head -c 200 floats.npy > short.npy
run short.npy --at 1
has "a truncated NPY is called that" err "short.npy: truncated"
head -c 300 cone.tif > short.tif
run short.tif --at 1
has "a truncated TIFF is called that" err "short.tif: truncated"
printf 'P6 1 1 255\nabc' > colours.ppm
run colours.ppm --at 1
has "a PPM" err "colours.ppm: this is a PPM, an image in colours"
printf '\211PNG\r\n\032\n' > new.png
run new.png --at 1
has "a PNG is named, with what to do" err "new.png: this is a PNG: save it as TIFF without compression, NPY or PGM"
refuses 1 "xyz.npy: 3 pages or colours: a grey image has one number for each pixel" xyz.npy --at 1
refuses 1 "cone.pgm: 1 numbers for each pixel: a map has three, x, y and z" cone.pgm --positions cone.pgm --at 1
{ npy '|u1' '3, 9, 11'; { image c; image r; image 7; } | words u1; } | head -c $((128 + 297)) > narrow.npy
refuses 1 "narrow.npy: 11 x 9 pixels, and the image has 12 x 9" cone.pgm --positions narrow.npy --at 1

totals
