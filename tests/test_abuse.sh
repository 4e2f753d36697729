#!/bin/sh
# test_abuse.sh BUILD: the commands in BUILD under what should not happen: files that are cut short, binary, of one
# line, huge, inconsistent, missing; outputs that cannot be written. Whatever it is, a command ends soon, with the exit
# status that its --help promises, and says what is wrong and where. Needs only a POSIX shell. Build the commands with
# -fsanitize=address, and they also show that nothing leaks.
. "$(dirname "$0")/harness.sh"
build=$(absolute "$1")
surfmink=$build/surfmink levelset=$build/levelset tissue=$build/tissue patic=$build/patic outlines=$build/outlines
cd "$work" || exit 1

# --- harness ----------------------------------------------------------------------------------------------------------

# run COMMAND ARGUMENT...: with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$@" < in > out 2> err
    status=$?
}

# stopped NAME TEXT: the run ended with exit status 1 and one line, which begins with this.
stopped() {
    check "$1: exit status" "$status" 1
    check "$1: one line" "$(wc -l < err | tr -d ' ')" 1
    case $(cat err) in
    "$2"*) check "$1: message" same same ;;
    *) check "$1: message" "$(head -c 300 err)" "$2" ;;
    esac
}

# told FILE: is the exit status 0, or is there a line that names the file and a line in it, or the whole file?
told() {
    line=
    read -r line < err
    case "$status $line" in
    "0 " | [12]" $1: "?* | [12]" $1:"[0-9]*": "?*) true ;;
    *) false ;;
    esac
}

# repeated TEXT SIZE: so many bytes of it, on one line.
repeated() {
    yes "$1$1$1$1$1$1$1$1$1$1$1$1$1$1$1$1" | tr -d '\n' | head -c "$2"
}

square='cell x y\na 0 0\na 1 0\na 1 1\na 0 1\n'
row=' 0 1 1 1 1 1 2 2 2 2 2 0\n'
labels="P2\\n12 6\\n2\\n0 0 0 0 0 0 0 0 0 0 0 0\\n$row$row$row${row}0 0 0 0 0 0 0 0 0 0 0 0\\n"
octahedron='OFF\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1
3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n'
: > in

# --- files cut short --------------------------------------------------------------------------------------------------

# cut_short NAME FILE WHOLE COMMAND ARGUMENT...: the file up to every seventh of its bytes, with EFFORT up to each. Of
# all cuts only WHOLE may pass unnoticed. To look for leaks takes longer than all the rest: in every 16th run.
step=7
[ "${EFFORT:-1}" -le 1 ] || step=1
cut_short() {
    name=$1 file=$2 whole=$3
    shift 3
    cp "$file" full.tmp
    size=$(wc -c < full.tmp) byte=0 untold='' unnoticed=0
    while [ "$byte" -lt "$size" ]; do
        head -c "$byte" full.tmp > "$file"
        export ASAN_OPTIONS="detect_leaks=$((byte % 16 == 0))"
        run "$@"
        told "$file" || untold="$untold $byte"
        [ "$status" -ne 0 ] || unnoticed=$((unnoticed + 1))
        byte=$((byte + step))
    done
    unset ASAN_OPTIONS
    cp full.tmp "$file"
    check "$name, cut short: told with file and line" "$untold" ""
    check "$name, cut short: no more than $whole unnoticed" $((unnoticed <= whole)) 1
}
printf 'cell,lon,lat\r\n"a ""b""",0,0\r\n"a ""b""",90,0\r\n"a ""b""",0,90' > table.csv
# Nothing can tell the head (in three cuts: its end has two bytes) from a table of no outlines, nor 9 degrees from 90.
cut_short "a table" table.csv 4 "$surfmink" table.csv
printf "$octahedron" > mesh.off
cut_short "a mesh for surfmink" mesh.off 1 "$surfmink" mesh.off
cut_short "a table for patic" table.csv 4 "$patic" --rank 2 table.csv
cut_short "a mesh for patic" mesh.off 1 "$patic" --rank 2 mesh.off
cut_short "a mesh for levelset" mesh.off 1 "$levelset" mesh.off --function z --at 0.5
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z
element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' > mesh.ply
cut_short "a PLY mesh" mesh.ply 1 "$levelset" mesh.ply --function z --at 0.5
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > mesh.obj
cut_short "an OBJ mesh" mesh.obj 1 "$levelset" mesh.obj --function z --at 0.5
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' > mesh.obj
cut_short "an OBJ mesh for surfmink" mesh.obj 1 "$surfmink" mesh.obj
printf 'ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\nproperty char z
element face 1\nproperty list uchar uchar vertex_index\nend_header\n\0\0\0\1\0\0\0\1\0\3\0\1\2' > mesh.ply
cut_short "a binary PLY" mesh.ply 0 "$levelset" mesh.ply --function z --at 0.5
cut_short "a binary PLY for surfmink" mesh.ply 0 "$surfmink" mesh.ply
one='\0\0\200\077' nil='\0\0\0\0'
printf "%80s\1\0\0\0$nil$nil$nil$nil$nil$nil$one$nil$nil$nil$one$nil\0\0" '' > mesh.stl
cut_short "a binary STL" mesh.stl 0 "$levelset" mesh.stl --function z --at 0.5
cut_short "a binary STL for surfmink" mesh.stl 0 "$surfmink" mesh.stl
printf 'solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n' > mesh.stl
cut_short "an STL" mesh.stl 1 "$levelset" mesh.stl --function z --at 0.5
printf '# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0
POLYGONS 1 4\n3 0 1 2\n' > mesh.vtk
cut_short "a VTK mesh" mesh.vtk 1 "$levelset" mesh.vtk --function z --at 0.5
printf '0 # z\n0\n0\n0\n1e0\n-1\n' > field.txt
cut_short "a field" field.txt 1 "$levelset" mesh.off field.txt --at 0.5

# --- what is no table and no mesh -------------------------------------------------------------------------------------

run "$surfmink" "$surfmink"
stopped "a program as a table" "$surfmink:1: a zero byte"
cp "$surfmink" binary.off
run "$surfmink" binary.off
stopped "a program as a mesh" "binary.off:1: a zero byte"
run "$levelset" binary.off --function z
stopped "a program as a mesh for levelset" "binary.off:1: a zero byte"
run "$levelset" mesh.off "$surfmink" --at 0
stopped "a program as a field" "$surfmink:1: a zero byte"
run "$patic" --rank 2 "$surfmink"
stopped "a program as a table for patic" "$surfmink:1: a zero byte"
run "$outlines" "$surfmink"
stopped "a program as an image" "$surfmink: "
printf 'cell x y\na 0 \033[2J\n' > in
run "$surfmink"
stopped "what is quoted does not command the terminal" "-:2: '?[2J' in column 'y' is not a number"
run "$patic" --rank 2
stopped "nor does what patic quotes" "-:2: '?[2J' in column 'y' is not a number"
escape=$(printf '\033')
printf 'cell,x,y\n"\033[2J",0,0\n"\033[2J",1,0\n"\033[2J",1,1\n"a\033c\a",5,0\n"a\033c\a",6,0\n' > in
run "$patic" --rank 2
check "nor do ids in what patic writes and says" "$status $(cat out err | grep -c "[$escape$(printf '\a')]")" "2 0"
check "ids in the table of patic" "$(sed 1d out | cut -f 1 | tr '\n' '|')" " [2J|a c |"
has "ids in what patic says" err "-:5: cell a c : too_few_corners"
printf 'OFF\n1 1\n0 0 \033[2J\n' > in
run "$levelset" - --function z
stopped "nor does what levelset quotes" "-:3: expected a number z, got '?[2J'"
printf '\377\376c\0e\0l\0l\0' > in
run "$surfmink"
stopped "UTF-16" "-:1: a zero byte"
: > in
run "$surfmink"
stopped "nothing" "-: no line names the columns"
for kind in off ply obj; do
    : > "none.$kind"
    run "$levelset" none.$kind --function z
    stopped "an empty file for levelset, $kind" "none.$kind: the file is empty"
done
run "$surfmink" none.off
stopped "an empty mesh" "none.off: the file is empty"
run "$levelset" mesh.off none.off --at 0
stopped "an empty field" "none.off: the file ends after 0 values"

# --- other systems' text files ----------------------------------------------------------------------------------------

printf '\357\273\277%s' "$(printf "$octahedron" | sed 's/$/\r/')" > dos.off # nor has its last line an end
printf '\357\273\2770\r\n0\r\n0\r\n0\r\n1\r\n-1' > dos.txt
run "$surfmink" mesh.off
cp out expected
run "$surfmink" dos.off
check "DOS lines, byte order mark, no last newline: surfmink" "$status $(cat err out)" "0 $(cat expected)"
run "$levelset" mesh.off field.txt --at 0.5
grep -v '^# levelset' out > expected
run "$levelset" dos.off dos.txt --at 0.5
check "DOS lines, byte order mark, no last newline: levelset" "$status $(cat err) $(grep -v '^# levelset' out)" \
    "0  $(cat expected)"
printf "$square" | sed 's/ 1 1/ 0x1p0 0x.8p1/' > in
run "$surfmink" --max-rank 1
check "hexadecimal numbers" "$status $(tail -n 1 out | cut -f 6)" "0 1"

# --- one line, and many corners ---------------------------------------------------------------------------------------

# A GiB without the end of a line: told after 64 MiB. (Not all shells and programs can be limited in memory.)
limited() {
    (ulimit -v 200000 2> /dev/null && exec "$@") 2> err
}
if { limited "$surfmink" --version > /dev/null; } 2> /dev/null; then limit=limited; else limit=; fi
for text in a '1 ' '#' '"' ','; do
    repeated "$text" 1073741824 | $limit "$surfmink" > out 2> err
    status=$?
    stopped "a GiB of '$text' on one line" "-:1: more than 64 MiB without the end of a line"
done
repeated '1 ' 1073741824 | $limit "$levelset" - --function z > out 2> err
status=$?
stopped "a GiB on one line, levelset" "-:1: more than 64 MiB without the end of a line"
{ printf 'OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n#' && repeated comment 60000000 && printf '\n3 0 1 2\n'; } > long.off
run "$surfmink" long.off
check "a comment of 60 MB" "$status $(tail -n 1 out | cut -f 1-3)" "0 $(printf '0\t3\tok')"
rm long.off

awk 'BEGIN { n = 300000; step = 6.283185307179586 / n; print "OFF"; print n, 1
             for (k = 0; k < n; ++k) printf "%.17g %.17g 0\n", cos(step * k), sin(step * k)
             printf "%d", n; for (k = 0; k < n; ++k) printf " %d", k; print "" }' > circle.off
{ echo "cell x y" && awk 'NR > 2 && NF == 3 { print "a", $1, $2 }' circle.off; } > circle.tsv
for file in circle.tsv circle.off; do
    run "$surfmink" $file --svg circle.svg
    check "3e5 corners: $file" "$status $(tail -n 1 out | cut -f 2,3)" "0 $(printf '300000\tok')"
    near "3e5 corners: S" "$(tail -n 1 out | cut -f 5)" 6.283185307179586
done
rm circle.*

# --- meshes that contradict themselves --------------------------------------------------------------------------------

# mesh NAME TEXT FILE WANT: what levelset says of it.
mesh() {
    printf "$2" > "$3"
    run "$levelset" "$3" --function z
    stopped "$1" "$3:$4"
}
corners='0 0 0\n1 0 0\n0 1 0\n'
v='v 0 0 0\nv 1 0 0\nv 0 1 0\n'
for index in 3 4294967295 4294967296 9223372036854775808 99999999999999999999999; do
    mesh "OFF, index $index" "OFF\n3 1\n${corners}3 0 1 $index\n" bad.off "6: there is no vertex"
    run "$surfmink" bad.off
    stopped "the same for surfmink" "bad.off:6: there is no vertex"
done
for index in 4 -4 4294967297 -4294967297 9223372036854775808 -9223372036854775809; do
    mesh "OBJ, index $index" "${v}f 1 2 $index\n" bad.obj "4: there is no vertex"
done
mesh "OBJ, index 0" "${v}f 1 2 0\n" bad.obj "4: OBJ counts vertices from 1"
mesh "OFF, a negative index" "OFF\n3 1\n${corners}3 0 1 -1\n" bad.off "6: there is no vertex -1"
mesh "OFF, a fraction" "OFF\n3 1\n${corners}3 0 1 1.5\n" bad.off "6: expected the number of a vertex, got '1.5'"
mesh "OFF, one corner twice" "OFF\n3 1\n${corners}3 0 1 1\n" bad.off "6: a face has vertex 1 twice"
mesh "OFF, an infinite corner" "OFF\n3 1\n0 0 1\n0 0 inf\n0 1 1\n3 0 1 2\n" bad.off "4: expected finite numbers x y z"
mesh "OFF, a corner too large" "OFF\n3 1\n0 0 1e999\n0 0 1\n0 1 1\n3 0 1 2\n" bad.off "3: expected finite numbers x y z"
mesh "OFF, counts too large" "OFF\n9223372036854775807 1\n" bad.off "2: expected the numbers of vertices and faces"
mesh "OFF, a negative count" "OFF\n3 -1\n" bad.off "2: expected the numbers of vertices and faces"
mesh "OFF, promises" "OFF\n4000000000000000000 4000000000000000000\n" bad.off "2: the file ends after 0 of"
mesh "an edge with three triangles" "OFF\n5 3\n${corners}0 0 1\n0 0 -1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n" bad.off \
    "10: the edge between vertices 0 and 1 (from 0) has 3 faces: not a surface"
mesh "a triangle twice" "OFF\n3 2\n${corners}3 0 1 2\n3 0 1 2\n" bad.off "7: face 1 has the same corners as face 0"
mesh "a Moebius strip" "OFF\n5 5\n0 0 0\n1 0 0\n1 1 1\n0 1 2\n0 0 3\n3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n" \
    bad.off "11: the faces at the edge"
mesh "no area" "OFF\n3 1\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n" bad.off "6: vertex 0 (from 0) has no normal"
mesh "PLY, an index too large" "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y
property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n${corners}3 0 1 3\n" bad.ply \
    "13: there is no vertex 3"
mesh "PLY, of bytes, without a mesh" "ply\nformat binary_little_endian 1.0\n" bad.ply \
    "2: the file ends before end_header"

# --- files that cannot be read ----------------------------------------------------------------------------------------

# unreadable NAME FILE: by each of the commands, as each kind of file.
unreadable() {
    for arguments in "$surfmink $2" "$surfmink mesh.off $2" "$levelset $2 --function z" \
        "$levelset mesh.off $2 --at 0" "$patic --rank 2 $2" "$outlines $2"; do
        run $arguments
        stopped "$1: ${arguments#"$build"/}" "$2: "
    done
}
mkdir folder folder.off
unreadable "a missing file" none.txt
unreadable "a directory" folder
unreadable "a directory as a mesh" folder.off
unreadable "a file as a directory" mesh.off/mesh.off
touch secret.off
chmod 000 secret.off
if ! cat secret.off > /dev/null 2>&1; then # root reads everything
    unreadable "a file that may not be read" secret.off
fi
"$surfmink" <&- > out 2> err
status=$?
stopped "standard input is closed" "-: "
"$levelset" - --function z <&- > out 2> err
status=$?
stopped "standard input is closed, levelset" "-: cannot be read"
"$patic" --rank 2 <&- > out 2> err
status=$?
stopped "standard input is closed, patic" "-: "
"$outlines" - <&- > out 2> err
status=$?
stopped "standard input is closed, outlines" "-: cannot be read"
"$surfmink" mesh.off <&- > out 2> err
check "standard input is closed, and nobody asks for it" "$? $(cat err)" "0 "

# --- outputs that cannot be written -----------------------------------------------------------------------------------

printf "$square" > square.tsv
run "$surfmink" square.tsv --svg none/a.svg
stopped "a picture, nowhere to put it" "none/a.svg: "
run "$surfmink" square.tsv --svg folder
stopped "a directory as a picture" "folder: "
for same in square.tsv ./square.tsv "$work/square.tsv" link.tsv; do
    ln -s square.tsv link.tsv 2> /dev/null
    run "$surfmink" --svg $same square.tsv
    stopped "the picture would overwrite its input: $same" "square.tsv: --svg would overwrite it"
done
"$surfmink" --svg square.tsv < square.tsv > out 2> err
status=$?
stopped "the picture would overwrite standard input" "-: --svg would overwrite it"
"$surfmink" square.tsv >> square.tsv 2> err
status=$?
stopped "the table would follow its input" "square.tsv: it is standard output as well"
for option in --defects --correlation --svg; do
    run "$patic" --rank 2 square.tsv $option ./square.tsv
    stopped "patic $option would overwrite its input" "square.tsv: $option would overwrite it"
done
"$patic" --rank 2 square.tsv >> square.tsv 2> err
status=$?
stopped "the field would follow its input" "square.tsv: it is standard output as well"
check "and the input is as before" "$(cat square.tsv)" "$(printf "$square")"

# to_nowhere NAME COMMAND...: standard output is closed, or a full disk.
to_nowhere() {
    name=$1
    shift
    "$@" 2> err >&-
    status=$?
    stopped "$name, standard output closed" "${1##*/}: "
    [ -w /dev/full ] || return
    "$@" > /dev/full 2> err
    status=$?
    stopped "$name, a full disk" "${1##*/}: "
}
to_nowhere "a table" "$surfmink" square.tsv
to_nowhere "JSON" "$surfmink" square.tsv --json
to_nowhere "a long table" "$surfmink" mesh.off --max-rank 1000
to_nowhere "help" "$surfmink" --help
to_nowhere "version" "$surfmink" --version
to_nowhere "a table and a picture" "$surfmink" square.tsv --svg a.svg
check "no picture of what could not be written" "$(ls a.svg 2> /dev/null)" ""
to_nowhere "outlines" "$levelset" mesh.off --function z
to_nowhere "areas" "$levelset" mesh.off --function z --area
to_nowhere "help of levelset" "$levelset" --help
to_nowhere "a tissue" "$tissue" --cells 12
to_nowhere "help of tissue" "$tissue" --help
printf "$labels" > labels.pgm
to_nowhere "a field" "$patic" --rank 4 square.tsv
to_nowhere "fields of several radii" "$patic" --rank 4 --radius 0,1 square.tsv
to_nowhere "a field and a picture" "$patic" --rank 4 square.tsv --svg a.svg
check "no picture of a field that could not be written" "$(ls a.svg 2> /dev/null)" ""
to_nowhere "help of patic" "$patic" --help
to_nowhere "outlines of an image" "$outlines" labels.pgm
to_nowhere "help of outlines" "$outlines" --help
if [ -w /dev/full ]; then
    for option in --defects --correlation --svg; do
        run "$patic" --rank 4 square.tsv $option /dev/full
        stopped "patic $option, a full disk" "/dev/full: cannot write"
    done
    for option in --off --report; do
        run "$outlines" labels.pgm $option /dev/full
        stopped "outlines $option, a full disk" "/dev/full: cannot be written"
    done
    "$surfmink" square.tsv | sed 's/^a/1/' > painted.tsv
    run "$outlines" labels.pgm --paint painted.tsv --column mu_4 --out /dev/full
    stopped "outlines --paint, a full disk" "/dev/full: cannot be written"
    run "$surfmink" square.tsv --svg /dev/full
    stopped "a picture, a full disk" "/dev/full: cannot write"
    ln -s /dev/full full.svg
    run "$surfmink" square.tsv --svg full.svg
    stopped "a picture, a full disk by another name" "full.svg: cannot write"
fi

# A pipe whose reader has gone: the end by SIGPIPE, without a word. Where whoever started the tests has had it ignored,
# it is an error like others.
if [ "$(sh -c 'kill -PIPE $$; echo ignored')" ]; then gone='1 1'; else gone='141 0'; fi
awk 'BEGIN { print "cell x y"; for (i = 0; i < 20000; ++i) print i, "0 0\n" i, "1 0\n" i, "1 1" }' > many.tsv
# to_head COMMAND...: exit status, and lines of complaint.
to_head() {
    {
        "$@" 2> err
        echo $? > code
    } | head -n 1 > out
    check "${1##*/} to head: ends by SIGPIPE, says nothing" "$(cat code) $(wc -l < err | tr -d ' ')" "$gone"
}
to_head "$surfmink" many.tsv
to_head "$surfmink" many.tsv --json
to_head "$levelset" --subdivide ico:6 --function flower --at 0 --at .1 --at .2 --at .3 --at .4 --at .5
to_head "$tissue" --relax 0
to_head "$patic" --rank 3 --quiet many.tsv
(
    trap '' PIPE
    {
        "$surfmink" many.tsv 2> err
        echo $? > code
    } | head -n 1 > out
)
check "where SIGPIPE is ignored: exit status" "$(cat code)" 1
has "where SIGPIPE is ignored: message" err "surfmink: cannot write to standard output: "

totals
