#!/bin/sh
# test_pictures.sh COMMAND: holds the pictures, charts and polygons in space that `surfmink` draws, and the
# directions at the centre, to its table and to its --help. Needs only a POSIX shell. Run it from the root of the
# repository.
. "$(dirname "$0")/harness.sh"
surfmink=$(absolute "$1")
data=$(absolute examples/data)
cd "$work" || exit 1

# run ARGUMENT...: the command, with the file `in` as its standard input; leaves out, err and $status.
run() {
    "$surfmink" "$@" < in > out 2> err
    status=$?
}

# A column (by name) of all rows, one a line; undefined values as -.
column() {
    awk -F '\t' -v name="$1" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
        NR > 1 { print $column == "" ? "-" : $column }' "${2-out}"
}

# near_lists NAME GOT WANT WITHIN: two lists of numbers, one a line, that agree.
near_lists() {
    printf '%s\n' "$2" > got
    printf '%s\n' "$3" > want
    worst=$(paste got want | awk '
        NF != 2 { print "another number of lines"; exit }
        { d = $1 - $2; if (d < 0) d = -d; if (d > worst) worst = d }
        END { print worst + 0 }')
    awk -v worst="$worst" -v within="$4" 'BEGIN { exit !(worst ~ /^[0-9.e-]+$/ && worst <= within) }'
    count $? "$1" "$worst apart" "within $4"
}

# stopped NAME TEXT
stopped() {
    check "$1: exit status" "$status" 1
    has "$1: message" err "$2"
}

cat > shapes.tsv << 'END'
cell	x	y
box	0	0
box	3	0
box	3	1
box	0	1
tri	4	0
tri	6	0
tri	5	1.7320508075688772
kite	7	0
kite	9	1
kite	8	1.2
kite	7	3
END
printf 'bad\t0\t5\nbad\t0\t6\nbad\t1\t6\n' | cat shapes.tsv - > four.tsv
: > in

# --- directions at the centre -----------------------------------------------------------------------------------------

run shapes.tsv --directions center --max-rank 3
check "names of the columns" "$(head -n 1 out | cut -f 13- | tr '\t' ' ')" \
    "center_x center_y e_1_x e_1_y e_2_x e_2_y e_3_x e_3_y coherence_1 coherence_2 coherence_3"
near_lists "the middle of a box" "$(column center_x | head -n 1)" 1.5 1e-15
near_lists "the direction of a box crosses its long side" "$(column e_2_y | head -n 1 | tr -d -)" 1 1e-15
check "what has no mu_p has no direction" "$(column e_3_x | head -n 1)" -
near_lists "in the plane all edges agree" "$(column coherence_2)" "1
1
1" 1e-14
cp out center
run shapes.tsv --directions --max-rank 3
check "at the edge: no centre" "$(head -n 1 out | cut -f 13- | tr '\t' ' ')" "e_1_x e_1_y e_2_x e_2_y e_3_x e_3_y"
for column in e_2_x e_2_y e_3_x e_3_y; do
    near_lists "in the plane it is the same direction: $column" "$(column $column | tail -n 1)" \
        "$(column $column center | tail -n 1)" 1e-14
done
run --directions edge --max-rank 3 shapes.tsv
cp out edge
run --directions --max-rank 3 shapes.tsv
check "edge is what --directions means" "$(cmp out edge)" ""
run --directions=centre --max-rank 3 shapes.tsv
check "in both spellings" "$(cmp out center)" ""
run --max-rank 3 --directions shapes.tsv
check "--directions before a file" "$(cmp out edge)" ""
run four.tsv --directions center --max-rank 2 --json
check "JSON" "$(tail -n 1 out | sed 's/null/-/g; s/.*theta_2":-,//')" \
    '"center_x":-,"center_y":-,"e_1_x":-,"e_1_y":-,"e_2_x":-,"e_2_y":-,"coherence_1":-,"coherence_2":-}'
has "JSON: a direction" out '"center_x":1.5,"center_y":0.5,"e_1_x":null,"e_1_y":null,"e_2_x":'

printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --directions center --radius 3
near_lists "an octant: the centre lies on the sphere" "$(column center_x; column center_y; column center_z)" \
    "1.7320508075688772
1.7320508075688772
1.7320508075688772" 1e-15
# Three corners, at least one of them in every direction of rank 3; the first edge lies opposite to the pole.
near_lists "an octant: the direction leads away from a corner" "$(
    awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i }
        NR == 2 { x = $at["e_3_x"]; y = $at["e_3_y"]; z = $at["e_3_z"]
                  print (x < y ? (x < z ? x : z) : (y < z ? y : z)) }' out)" -0.81649658092772603 1e-15
near_lists "an octant: all edges agree" "$(column coherence_3)" 1 1e-15
run --directions center --transport parallel
near_lists "but not by the classical transport" "$(column coherence_4)" 0 1e-15
run "$data/tissue.tsv" --directions center
check "400 cells: directions are unit, tangent to no less than the mean normal, and the edges of a cell agree" "$(
    awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
        { for (p = 1; p <= 6; ++p) {
            if ($at["coherence_" p] < 0.98 || $at["coherence_" p] > 1) ++bad
            d = $at["e_" p "_x"] ^ 2 + $at["e_" p "_y"] ^ 2 + $at["e_" p "_z"] ^ 2 - 1
            if (d * d > 1e-28) ++bad } }
        END { print bad + 0, NR }' out)" "0 401"

# --- outlines ---------------------------------------------------------------------------------------------------------

# strokes FILE WHICH: angles of the strokes of an outline, in degrees, up is 90.
strokes() {
    sed -n 's/.*stroke-linecap.* d="M\([^"]*\)".*/\1/p' "$1" | sed -n "$2p" | tr 'M' '\n' | tr 'L' ' ' |
        awk '{ print atan2($2 - $4, $3 - $1) * 57.29577951308232 }'
}
run four.tsv --svg a.svg --color-by mu_3 --quiet --title 'Cells <& "more">' --unit "a & b"
run four.tsv --svg b.svg --color-by mu_3 --quiet --title 'Cells <& "more">' --unit "a & b"
check "the same bytes again" "$(cmp a.svg b.svg)" ""
has "title, for whoever cannot see" a.svg '<title id="title">Cells &#60;&#38; &#34;more&#34;&#62;</title>'
check "title, for whoever can" "$(grep -c '>Cells &#60;&#38; &#34;more&#34;&#62;</text>' a.svg)" 1
has "unit at the scale bar" a.svg '>2 a &#38; b</text>'
has "description: what is drawn" a.svg \
    '<desc id="description">4 outlines (1 of them refused) filled by mu_3, dark for 0 to'
check "no fonts but the reader's, and nothing from elsewhere" "$(grep -c 'href\|font-face\|url(http' a.svg)" 0
# The scale bar is 2 units long, and so is the lower edge of the triangle.
bar=$(sed -n 's/.*stroke-width="4" d="M[0-9. ]*h\([0-9.]*\)".*/\1/p' a.svg)
side=$(sed -n 's/.*d="M\([0-9.]*\) [0-9.]*L\([0-9.]*\) .*<title>tri:.*/\2 \1/p' a.svg | awk '{ print $1 - $2 }')
near_lists "the scale bar is as long as it says" "$bar" "$side" 0.02
run shapes.tsv --directions center --max-rank 3 --svg a.svg --color-by mu_3 --strokes across
check "three strokes each, of the triangle and the kite" "$(grep -c stroke-linecap a.svg)" 2
for which in 1 2; do
    want=$(awk -F '\t' -v row=$which 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i }
        NR == row + 2 { print atan2($at["e_3_y"], $at["e_3_x"]) * 57.29577951308232 }' out)
    got=$(strokes a.svg $which | head -n 1)
    near_lists "strokes point where the table says: $which" "$got" "$want" 0.1
    near_lists "and a third of a turn on: $which" "$(strokes a.svg $which | sed -n 2p)" \
        "$(echo "$got" | awk '{ a = $1 + 120; print (a > 180 ? a - 360 : a) }')" 0.2
done

strokes a.svg 1 > across
run shapes.tsv --svg a.svg --color-by mu_3
run shapes.tsv --svg b.svg --color-by mu_3 --strokes along
check "along is the default" "$(cmp a.svg b.svg)" ""
near_lists "along lies between across" "$(strokes a.svg 1 | sort -n)" "$(
    awk '{ a = $1 + 60; print (a > 180 ? a - 360 : a) }' across | sort -n)" 0.3
run shapes.tsv --svg a.svg
near_lists "strokes of mu_2 lie along a box" "$(strokes a.svg 1 | awk '{ print ($1 < 0 ? -$1 : $1) % 180 }')" "0
0" 0.1
run shapes.tsv --svg a.svg --strokes across
near_lists "or across it" "$(strokes a.svg 1 | sort -n)" "-90
90" 0.1

# fills FILE ID: the colours of an outline in each panel.
fills() {
    sed -n "s/.* fill=\"\(#[0-9a-f]*\)\".*<title>$2: \(mu_[0-9]*\) = .*/\2\1/p" "$1" | tr '\n' ' '
}
run shapes.tsv --svg a.svg --color-by mu_2,mu_3,mu_4
check "a panel for each rank" "$(grep -c '<title>tri: mu_[234] = ' a.svg)" 3
check "with a letter each" "$(grep -o 'bold">[a-z]<' a.svg | tr -cd 'a-z\n' | sed 's/bold//' | tr '\n' ' ')" "a b c "
check "and a bar each" "$(grep -c 'url(#bar_below)' a.svg)" 3
check "the triangle is dark, light, dark" "$(fills a.svg tri)" "mu_2#2b2161 mu_3#f3e890 mu_4#2b2161 "
run shapes.tsv --svg b.svg --color-by mu_3
check "colours do not depend on the panels" "$(fills b.svg kite)" "$(fills a.svg kite | grep -o 'mu_3[^ ]* ')"
strokes b.svg 1 > alone
run shapes.tsv --svg c.svg --color-by mu_1,mu_3
near_lists "strokes of the second panel are those of its rank" "$(strokes c.svg 1)" "$(cat alone)" 0.2
check "one panel has no letter, and its bar at the right" \
    "$(grep -c 'bold">\|bar_below' b.svg) $(grep -c 'url(#bar)' b.svg)" "0 1"
printf 'bad\t0\t5\nbad\t0\t6\nbad\t1\t6\n' | cat shapes.tsv - | grep 'cell\|tri\|bad' > in
run --svg a.svg --quiet --color-by mu_2
has "what is refused does not count for the colours" a.svg ">0.8</text>"
run "$data/tissue.tsv" --svg a.svg --unit um
has "a round number at the scale bar" a.svg ">50 um</text>"
printf 'ring lon lat\n' > in
for lon in 0 60 120 180 240 300; do
    printf "c$lon $((lon - 5)) -5\nc$lon $((lon + 5)) -5\nc$lon $((lon + 5)) 5\nc$lon $((lon - 5)) 5\n"
done >> in
seen() {
    sed -n 's/.*<title>\([^:]*\):.*/\1/p' a.svg | tr '\n' ' '
}
run --svg a.svg --view 10,0 --view back --view back
check "front, behind that, and behind that again" "$(seen)" "c0 c60 c300 c120 c180 c240 c0 c60 c300 "
# The left end of an outline in the last panel.
left_end() {
    sed -n "s/<path d=\"M\([0-9.]*\).*<title>$1:.*/\1/p" a.svg | tail -n 1
}
run --svg a.svg --view 10,0 --view back
check "seen from behind, east is right, too" "$(echo "$(left_end c120) $(left_end c180) $(left_end c240)" |
    awk '{ print ($1 < $2 && $2 < $3) }')" 1
has "views are named" a.svg '<tspan>from above 10° E, 0° N</tspan>'
has "and what is behind one" a.svg '<tspan>from the other side</tspan>'
check "a sphere without a radius: the grid is the scale" "$(grep -c '>grid: 30' a.svg)" 1
check "which needs no unit" "$(grep -c 'units of' a.svg)" 0
run --svg a.svg --view 10,0 --radius 6371
has "with one: a length" a.svg '>2000 (units of the radius)</text>'
run --svg a.svg --view 10,0 --radius 6371 --unit km
has "with a unit, too" a.svg '>2000 km</text>'
near_lists "2000 of 6371, where the radius has 720 / 2.01 pixels" \
    "$(sed -n 's/.*stroke-width="4" d="M[0-9. ]*h\([0-9.]*\)".*/\1/p' a.svg)" 112.448 0.01
run --svg a.svg --view back
cp a.svg b.svg
run --svg a.svg
check "back alone is behind where most can be seen from" "$(cmp -s a.svg b.svg; echo $?)" 1
run --svg a.svg --view front
sed 's/front//' a.svg > b.svg
run --svg a.svg
check "front is the default" "$(cmp a.svg b.svg)" ""
run --svg a.svg --view front --color-by 2,4 --view back --title T
check "two ranks from two sides" "$(seen | wc -w | tr -d ' ')" 12
check "each outline of a side twice" "$(seen | tr ' ' '\n' | sort | uniq -c | awk 'NF == 2 { print $1 }' | sort -u)" 2

# view_name VIEW: of the first of two panels.
view_name() {
    run --svg a.svg --view "$1" --view front --color-by 2
    sed -n 's/.*<tspan>\(from [^<]*\)<.*/\1/p' a.svg | head -n 1
}
check "west and south" "$(view_name -85,-15.5)" "from above 85° W, 15.5° S"
check "more than half way round is the other way" "$(view_name 200,1)" "from above 160° W, 1° N"
check "a direction" "$(view_name 1,-2,0.5)" "from x, y, z = 1, -2, 0.5"
check "the front" "$(view_name front)" "from the front"
check "what is behind the front" "$(view_name back)" "from behind"
run --svg a.svg --view 1,2
check "one view needs no name" "$(grep -c 'from above' a.svg)" 0

# --- strokes stay in their outlines -----------------------------------------------------------------------------------

# stays NAME STROKES: as many strokes as that, none leaves its outline, and each shows on its colour.
stays() {
    drawn_strokes a.svg > drawn
    check "$1: strokes, and what lies outside" "$(cut -d ' ' -f 1,2 drawn)" "$2 0"
    check "$1: a contrast of 3.7 at least" "$(awk '{ print ($3 >= 37 || $1 == 0) }' drawn)" 1
}
# Stars by chance, with arms of all lengths: most of their centres are close to an edge, or outside.
stars() {
    awk -v seed=$1 'BEGIN { srand(seed); print "c x y"
        for (i = 0; i < 60; ++i) {
            n = 3 + int(30 * rand()); turn = 6.283185307179586 * rand(); arm = 0.02 + rand()
            for (k = 0; k < n; ++k) {
                r = arm + (1 - arm) * rand() ^ 3
                print "s" i, 2.2 * (i % 10) + r * cos(turn + k / n * 6.283185307179586), \
                    2.2 * int(i / 10) + r * sin(turn + k / n * 6.283185307179586) } } }'
}
for way in along across; do
    for p in 2 3 6; do
        for seed in 1 2 3; do
            stars $seed > in
            run --svg a.svg --color-by mu_$p --strokes $way --quiet
            stays "stars by chance, p = $p, $way" "$((p * $(grep -c '^<path fill="none" stroke-linecap' a.svg)))"
            check "stars have strokes, p = $p, $way" "$(awk -v p=$p '{ print ($1 > 20 * p) }' drawn)" 1
        done
    done
done
run "$data/tissue.tsv" --svg a.svg --color-by mu_6 --view front --view back
stays "a tissue" "$((6 * $(grep -c '^<path fill="none" stroke-linecap' a.svg)))"
check "all over it" "$(awk '{ print ($1 > 6 * 300) }' drawn)" 1
run "$data/tissue.tsv" --svg a.svg --color-by mu_1
stays "a tissue, p = 1" "$(grep -c '^<path fill="none" stroke-linecap' a.svg)"
run "$data/countries.tsv" --svg a.svg --view 20,25 --view -85,15 --quiet
stays "countries, some cut by the horizon" "$((2 * $(grep -c '^<path fill="none" stroke-linecap' a.svg)))"
# A crescent, whose centre lies outside.
awk 'BEGIN { print "c x y"; for (k = -20; k <= 20; ++k) print "moon", cos(k / 8), sin(k / 8)
    for (k = 20; k >= -20; --k) print "moon", 0.9 * cos(k / 8.5) , 0.9 * sin(k / 8.5) }' > in
run --svg a.svg --strokes across
stays "a crescent" 2
# Of one length: half of a cell of the same size does not depend on its mu_4.
printf 'c x y\na 0 0\na 1 0\na 1 1\na 0 1\nb 2 0\nb 3.2 -.2\nb 3 1\nb 2 .8\n' > in
run --svg a.svg --color-by mu_4
check "strokes do not tell how large mu is" "$(column mu_4 | awk '{ printf "%d ", 10 * $1 + .5 }')$(
    sed -n 's/.*stroke-linecap.* d="M\([^M]*\)M.*/\1/p' a.svg | tr L ' ' |
        awk '{ l[NR] = sqrt(($1 - $3) ^ 2 + ($2 - $4) ^ 2) } END { d = l[1] / l[2]; print NR, (d > .95 && d < 1.06) }'
    )" "10 8 2 1"
# mu_2 from 0.02 to 0.4: rectangles of 10 to 15, and one that sets the end of the bar.
awk 'BEGIN { print "c x y"; for (i = 0; i <= 20; ++i) { w = 10 + i / 10; x = 20 * i
    printf "r%02d %g 0\nr%02d %g 0\nr%02d %g 10\nr%02d %g 10\n", i, x, i, x + w, i, x + w, i, x }
    print "end 500 0\nend 530 0\nend 530 10\nend 500 10" }' > in
run --svg a.svg
check "no strokes below a twentieth of the bar" "$(grep -c 'stroke-linecap' a.svg)" "$(
    column mu_2 | awk '{ n += $1 >= 0.05 * 0.5 } END { print n }')"

# --- the key of the strokes -------------------------------------------------------------------------------------------

# key FILE: how many strokes each sample of it has.
key() {
    sed -n '/<g id="strokes"/,/<\/g>/s/.*stroke-width="2.2" d="\([^"]*\)".*/\1/p' "$1" | tr -cd 'M\n' |
        awk '{ print length($0) }' | tr '\n' ' '
}
# told FILE: what it says, without markup.
told() {
    sed 's/<[^>]*>//g' "$1" | awk '/^directions? of/ { printf "%s", $0 }'
}
run shapes.tsv --svg a.svg --unit um
check "two strokes and their key" "$(grep -c stroke-linecap a.svg) $(key a.svg)" "2 2 "
check "what they are" "$(told a.svg)" "direction of μ2: along the long axis"
has "in the description, too" a.svg "Strokes: eigenvectors of the negative eigenvalue"
check "in one row with the scale" "$(sed -n 's/.* y="\([0-9.]*\)".*>\(2 um\|direction\).*/\1/p' a.svg | uniq | wc -l |
    tr -d ' ')" 1
# sample FILE: of the first sample of the key, width and height of the outline and of its stroke.
sample() {
    sed -n '/<g id="strokes"/,/<\/g>/p' "$1" | tr 'MLZ"' '\n\n\n\n' |
        awk '/^[0-9.]+ [0-9.]+$/ { x[++n] = $1; y[n] = $2 }
        END { print x[1] - x[2], y[2] - y[3], x[8] - x[6], y[6] - y[8] }' | tr -d -
}
check "the sample: a rectangle that lies, and its stroke" "$(sample a.svg)" "28 12 21 0"
run shapes.tsv --svg a.svg --unit um --strokes across
check "across: an upright stroke in the same rectangle" "$(sample a.svg)" "28 12 0 9"
check "across: what they are" "$(told a.svg)" "direction of μ2: across the long axis"
has "across: in the description, too" a.svg "Strokes: eigenvectors of the positive eigenvalue"
head -n 5 shapes.tsv > in
run --svg a.svg --color-by mu_3
check "no strokes, no key" "$(grep -c stroke-linecap a.svg) $(key a.svg)$(told a.svg)$(grep -c Strokes: a.svg)" "0 0"
run --svg a.svg --color-by mu_2,mu_3,mu_4
check "ranks without strokes are not in the key" "$(key a.svg)" "2 4 "
check "several ranks" "$(told a.svg)" "directions of μp: along the long axis, towards corners"
run --svg a.svg --color-by mu_3,mu_4
check "one of two ranks" "$(key a.svg)$(told a.svg)" "4 directions of μ4: towards corners"
run --svg a.svg --color-by mu_3,mu_4 --strokes across
check "across" "$(key a.svg)$(told a.svg)" "4 directions of μ4: across the sides"
run "$data/tissue.tsv" --svg a.svg --color-by mu_6,mu_5 --view front --view back
check "two views of two ranks" "$(key a.svg)" "6 5 "
printf 'c x y\na 0 0\na 3 0\na 3 1\na 0 1\nb 4000 0\nb 4003 0\nb 4003 1\nb 4000 1\n' > in
run --svg a.svg
check "strokes too short to be drawn" "$(grep -c stroke-linecap a.svg) $(key a.svg)" "0 "
printf 'c x y\na 0 0\na 0 1\na 1 1\n' > in
run --svg a.svg --quiet
check "nothing but what is refused" "$(key a.svg)$(grep -c '>refused<' a.svg)" 1
# A page that is too narrow for one row: items stand below each other, each in one piece, and none leaves the page.
printf 'c x y\na 0 0\na 1 0\na 1 20\na 0 20\nb 0 1\nb 0 2\nb 1 2\n' > in
run --svg a.svg --quiet
# Where the texts of the foot begin, and what they say.
foot() {
    sed -n 's/^\(<g fill="#222">\)*<text x="\([0-9.]*\)" y="\([0-9.]*\)">\([0-9(rd].*\)<\/text>.*/\2 \3 \4/p' a.svg |
        sed 's/<[^>]*>//g' | awk -v page="$(sed -n '1s/.* height="\([0-9]*\)".*/\1/p' a.svg)" '$2 > page - 130'
}
check "narrow: every item of the legend is in one piece" "$(foot | cut -d ' ' -f 3-)" "0.2 (units of the corners)
refused
direction of μ2: along the long axis"
check "narrow: the longest in a row of its own" "$(
    foot | awk 'NR > 1 { printf "%g ", $2 - last } { last = $2 }')" "0 34 "
check "narrow: the first of them lies below the outlines" "$(
    { sed -n 's/<path d="M\([^"]*\)Z".*<title>a:.*/\1/p' a.svg | tr 'L' '\n'; foot | sed '1s/$/ first/;2,$d'; } |
        awk '!/first/ && $2 > lowest { lowest = $2 } /first/ { print ($2 - lowest > 30 && $2 - lowest < 60) }')" 1
check "narrow: the page has room for the widest" "$(foot |
    awk -v page="$(sed -n '1s/.* width="\([0-9]*\)".*/\1/p' a.svg)" '
        { right = $1; $1 = $2 = ""; right += 10.5 * (length($0) - 2)
          if (right > page - 20) ++bad; if (right > most) most = right }
        END { print bad + 0, (page < most + 60) }')" "0 1"

# --- every column of the results --------------------------------------------------------------------------------------

columns="n L S area mu_3 error_L theta_5 sigma_6 center_z e_2_x coherence_4"
run "$data/tissue.tsv" --error --noise 2% --directions center --svg a.svg --color-by "$(echo "$columns" | tr ' ' ,)"
for name in $columns; do
    # Of each cell that is seen: its value in the table, in the picture, and how light it is there.
    awk -F '\t' -v name=$name '
        FNR == 1 && NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i; next }
        NR == FNR { value[$1] = $column; next }
        match($0, "<title>[^:]*: " name " = [^<]*") {
            split(substr($0, RSTART + 7, RLENGTH - 7), part, ": " name " = ")
            sub(/.*" fill="#/, "")
            light = 0
            for (k = 1; k <= 5; k += 2)
                light += (k == 3 ? 6 : k == 1 ? 3 : 1) * \
                    (16 * index("0123456789abcdef", substr($0, k, 1)) + index("0123456789abcdef", substr($0, k + 1, 1)))
            print value[part[1]], part[2], light }' out a.svg | sort -g > drawn
    check "--color-by $name: the values of the table" "$(awk '
        { d = $1 - $2; if (d * d > 1e-8 + 1e-8 * $1 * $1) ++bad } END { print (NR > 120), bad + 0 }' drawn)" "1 0"
    [ $name = theta_5 ] || check "--color-by $name: lighter is more" "$(awk '
        $3 < last - 20 { ++bad } { last = $3 } END { print bad + 0 }' drawn)" 0
    [ $name != theta_5 ] || check "--color-by $name: darker is farther from 0" "$(awk '
        { print ($1 < 0 ? -$1 : $1), $3 }' drawn | sort -g | awk '$2 > last + 45 && NR > 1 { ++bad } { last = $2 }
        END { print bad + 0 }')" 0
done
check "a panel, a name and a bar for each" \
    "$(grep -c '<text x=.*bold">[a-k]<' a.svg) $(grep -c '_below)"' a.svg)" "11 11"
has "names of columns" a.svg ">coherence_4</tspan>"
has "Greek letters where they are formulas" a.svg '>θ</tspan><tspan font-size="70%" dy="5">5</tspan>'
has "what the colours mean" a.svg "filled by n, dark for 4 to light for 9; by L, dark for 20 to light for 70; by S, "
check "the angles from -pi/5 to pi/5" "$(grep -c '>−π/5</text>\|>π/5</text>' a.svg)" 2
check "the ends of the map for angles are one colour" "$(
    sed -n '/id="turn_below"/,/Gradient>/s/.*color="\(#[0-9a-f]*\)".*/\1/p' a.svg | sed -n '1p;$p' |
        uniq | wc -l | tr -d ' ')" 1
printf 'c x y\na 0 0\na 1 0\na 1 1\na 0 1\nb 2 0\nb 4 0\nb 4 1\nb 2 1\n' > in
run --svg a.svg --color-by theta_2 --ply a.ply
has "what is undefined is grey" a.svg 'fill="#c8c8c8"><title>a: theta_2 = undefined</title>'
check "and in the legend" "$(grep -c '>undefined</text>' a.svg)" 1
check "0 is pale" "$(fills a.svg b | grep -c . ; grep -c 'fill="#eeeeee"><title>b: theta_2 = 0<' a.svg)" "0
1"
run --svg a.svg --color-by area
check "all is defined: nothing of it in the legend" "$(grep -c 'undefined' a.svg)" 0
check "a column without a rank has no strokes" "$(grep -c stroke-linecap a.svg) $(key a.svg)" "0 "
run --svg a.svg --color-by mu_2,theta_2,area
check "two columns of one rank: one sample" "$(key a.svg)" "2 "
run --svg a.svg --color-by e_2_z --directions --quiet
check "a plane has no z: undefined" "$(grep -c 'e_2_z = undefined' a.svg)" 2

# --- histograms -------------------------------------------------------------------------------------------------------

# counts FILE: sum of the counts in each panel, in the order of the panels.
counts() {
    awk '/<g fill="#5b7fa6"/ { ++panel } /<\/title><\/rect>/ { sub(/.*: /, ""); sub(/<.*/, ""); sum[panel] += $0 }
        END { for (i = 1; i <= panel; ++i) printf "%s ", sum[i] }' "$1"
}
run "$data/tissue.tsv" --histogram a.svg
check "every cell is counted once, in every panel" "$(counts a.svg)" "400 400 400 400 400 400 "
check "the axis says what is counted" "$(grep -c '>number of outlines, n = 400</text>' a.svg)" 6
# Upright texts: as many letters as fit along the axis, which is 290 long with what is above it.
check "and has room for it" "$(
    sed -n 's/^<g font-size="\([0-9.]*\)"><g transform.*>number of \([^<]*\)<.*/\1 \2/p' a.svg |
        awk '{ if ($1 * .54 * (length($0) - length($1) + 9) > 290.1) ++bad } END { print NR, bad + 0 }')" "6 0"
cp a.svg b.svg
run "$data/tissue.tsv" --histogram a.svg --svg c.svg --color-by area,mu_4
check "whatever fills the outlines" "$(cmp a.svg b.svg)" ""
for p in 2 6; do
    awk '/<g fill="#5b7fa6"/ { ++panel } /<\/title><\/rect>/ {
        sub(/.*<title>/, ""); sub(/<.*/, ""); print panel, $0 }' a.svg |
        awk -v p=$p '$1 == p { print $2, $5 }' | sed 's/://' > bins
    check "mu_$p: as many as the table has, bin by bin" "$(cat bins)" "$(
        column mu_$p | awk '{ k = int(20 * $1); if (k > 19) k = 19; ++n[k] }
            END { for (k = 0; k < 20; ++k) if (n[k]) printf "%.2f %d\n", k / 20, n[k] }')"
    check "mu_$p: median" "$(sed -n 's/.*>median \([0-9.]*\)<.*/\1/p' a.svg | sed -n ${p}p)" "$(
        column mu_$p | sort -g | awk '{ v[NR] = $1 } END { printf "%.2f", (v[200] + v[201]) / 2 }')"
done
check "bars are as high as their counts, mu_3 for example" "$(
    awk '/<g fill="#5b7fa6"/ { ++panel } panel == 3 && /<\/title><\/rect>/ { print }' a.svg |
        sed -n 's/.* height="\([0-9.]*\)"><title>.*: \([0-9]*\)<.*/\1 \2/p' |
        awk '{ d = $1 - 260 / 80 * $2; if (d * d > 1e-4) ++bad } END { print NR, bad + 0 }')" "$(
    column mu_3 | awk '{ n[int(20 * $1)] } END { for (k in n) ++bins; print bins, 0 }')"
# Of each panel: is every bar as high as its count on the axis, whose last number is 260 above the first?
scaled() {
    awk '/<g fill="#5b7fa6"/ { panel++ } /<\/title><\/rect>/ {
            height = $0; sub(/.* height="/, "", height); sub(/.*: /, "")
            ++bars[panel]; bar[panel, bars[panel]] = height + 0; count[panel, bars[panel]] = $0 + 0 }
        /^<text .*text-anchor="end">[0-9]*<\/text>/ { sub(/.*">/, ""); if ($0 + 0 > top[panel]) top[panel] = $0 + 0 }
        END { for (p = 1; p <= panel; ++p) for (i = 1; i <= bars[p]; ++i) {
                  d = bar[p, i] - 260 * count[p, i] / top[p]; if (d * d > 1e-4) ++bad }
              print panel, bad + 0 }' a.svg
}
check "bars are as high as their counts, against the numbers of the axis" "$(scaled)" "6 0"
# marks FILE: where they are, and of which count.
marks() {
    sed -n 's/.* d="M\([0-9.]*\) [0-9.]*l-4 -8h8Z.*>\([0-9]*\)<\/text>.*/\1 \2/p' "$1"
}
check "bars too low to be seen are marked with their count, and no others" "$(marks a.svg | awk '{ print $2 }')" "$(
    awk '/<g fill="#5b7fa6"/ { ++panel } /<\/title><\/rect>/ {
        h = $0; sub(/.* height="/, "", h); sub(/".*/, "", h)
        sub(/.*: /, ""); sub(/<.*/, ""); if (h + 0 < 3) print }' a.svg)"
awk 'BEGIN { print "c x y"
    for (i = 0; i < 400; ++i) printf "b%d 0 0\nb%d 1 0\nb%d 1 1\nb%d 0 1\n", i, i, i, i
    print "t 0 0\nt 2 0\nt 1 1.7320508075688772" }' > in
run --histogram a.svg --histogram-of 3
check "one triangle among 400 squares is found" "$(marks a.svg)" "439.75 1"
run --histogram a.svg --histogram-of 3,4
check "in both panels" "$(marks a.svg | wc -l | tr -d ' ')" 2
# Twelve triangles of two kinds, in bins that touch: counts of two digits read upwards, not into each other.
awk 'BEGIN { print "c x y"
    for (i = 0; i < 4000; ++i) printf "b%d 0 0\nb%d 1 0\nb%d 1 1\nb%d 0 1\n", i, i, i, i
    for (i = 0; i < 24; ++i) printf "t%d 0 0\nt%d 2 0\nt%d 1 %s\n", i, i, i, i < 12 ? "1.7320508" : "1.25" }' > in
run --histogram a.svg --histogram-of 3
check "counts side by side read upwards" "$(marks a.svg | awk '{ print $2 }' | tr '\n' ' ')$(
    grep -A 1 'l-4 -8h8Z' a.svg | grep -c 'rotate(-90)')" "12 12 2"
run four.tsv --histogram a.svg --histogram-of 3,2 --quiet
check "the columns that were asked for; what is refused is not counted" "$(counts a.svg)" "3 3 "
has "but told" a.svg "1 outlines were refused"
run four.tsv --histogram a.svg --max-rank 20 --quiet
check "no more than twelve" "$(counts a.svg | wc -w | tr -d ' ')" 12
printf 'cell x y\nx 0 0\n' > in
run --histogram a.svg --scatter b.svg --svg c.svg --ply d.ply --quiet
check "nothing measured: exit status" "$status" 2
check "nothing measured: no bars, no median, no points, no outlines" \
    "$(grep -c 'rect x=\|median ' a.svg) $(grep -c '<circle' b.svg) $(grep -c '<title>x' c.svg) $(tail -n 1 d.ply)" \
    "0 0 0 end_header"

run "$data/tissue.tsv" --histogram a.svg --histogram-of n,area,theta_4,L
check "every cell is counted once, whatever the column" "$(counts a.svg)" "400 400 400 400 "
bars() {
    awk -v panel=$1 '/<g fill="#5b7fa6"/ { ++p }
        p == panel && /<\/title><\/rect>/ { sub(/.*<title>/, ""); sub(/<.*/, ""); print }' a.svg
}
check "and its bar is as high as its count" "$(scaled)" "4 0"
check "a bar for each number of corners" "$(bars 1)" "$(column n | sort -n | uniq -c |
    awk '{ printf "%g to %g: %d\n", $2 - .5, $2 + .5, $1 }')"
check "and its number below the middle of it" "$(
    awk '/<rect x=.*3.5 to 4.5/ { gsub(/[^0-9.]+/, " "); split($0, a, " "); print a[1] + a[3] / 2 }' a.svg)" "$(
    sed -n 's/<text x="\([0-9.]*\)".*>4<.*/\1/p' a.svg | head -n 1)"
check "bars of areas, bin by bin" "$(bars 2 | sed 's/to.*:/ /' | awk '{ print $1, $2 }')" "$(
    column area | awk '{ ++n[25 * int($1 / 25)] } END { for (k in n) print k, n[k] }' | sort -n)"
check "angles have no median" "$(grep -c '>median' a.svg)" 3
printf 'c x y\na 0 0\na 1 0\na 1 1\na 0 1\nb 2 0\nb 4 0\nb 4 1\nb 2 1\n' > in
run --histogram a.svg --histogram-of theta_2,n,area --scatter b.svg --scatter-of theta_2,area
check "n is the number of defined values" "$(grep -o 'outlines, n = [0-9]*' a.svg | tr '\n' ' ')" \
    "outlines, n = 1 outlines, n = 2 outlines, n = 2 "
check "of one value, too" "$(counts a.svg)" "1 2 2 "
check "points whose values are defined" "$(grep -c '<circle' b.svg)" 1

# --- one column over another ------------------------------------------------------------------------------------------

# points FILE: what the tooltips say, and where the points are, in units of the axes.
points() {
    number='\([0-9.]*\)'
    sed -n "s/<circle cx=\"$number\" cy=\"$number\".*<title>\(.*\): $number, $number<.*/\1 \2 \3 \4 \5/p" "$1"
}
run "$data/tissue.tsv" --scatter a.svg
check "a point for each cell" "$(points a.svg | wc -l | tr -d ' ')" 400
near_lists "mu_2 to the right" "$(points a.svg | awk '{ print ($1 - 110) / 560 }')" "$(column mu_2)" 2e-5
near_lists "mu_6 upwards" "$(points a.svg | awk '{ print (610 - $2) / 560 }')" "$(column mu_6)" 2e-5
near_lists "and in words" "$(points a.svg | awk '{ print $5 }')" "$(column mu_6)" 6e-5
want=$(awk -F '\t' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { ++n; x = $at["mu_2"]; y = $at["mu_6"]; sx += x; sy += y; sxx += x * x; sxy += x * y; syy += y * y }
    END { printf "%.2f", (n * sxy - sx * sy) / sqrt((n * sxx - sx * sx) * (n * syy - sy * sy)) }' out)
has "correlation" a.svg " = $want</text>"
run "$data/tissue.tsv" --scatter a.svg --scatter-of mu_5,mu_3
near_lists "other columns" "$(points a.svg | awk '{ print ($1 - 110) / 560 }')" "$(column mu_5)" 2e-5
near_lists "other columns, upwards" "$(points a.svg | awk '{ print (610 - $2) / 560 }')" "$(column mu_3)" 2e-5
run "$data/tissue.tsv" --scatter a.svg --scatter-of area,L
near_lists "areas to 300" "$(points a.svg | awk '{ print ($1 - 110) / 560 * 300 }')" "$(column area)" 0.01
near_lists "lengths from 20 to 70" "$(points a.svg | awk '{ print 20 + (610 - $2) / 560 * 50 }')" "$(column L)" 0.001
has "their correlation" a.svg "= 0.98</text>"
cp a.svg b.svg
run "$data/tissue.tsv" --scatter a.svg --scatter-of area,L --svg c.svg --color-by mu_5
check "the same whatever fills the outlines" "$(cmp a.svg b.svg)" ""
run shapes.tsv --scatter a.svg --max-rank 2
near_lists "two ranks are enough" "$(points a.svg | awk '{ print (610 - $2) / 560 }')" "$(column mu_2)" 2e-5
printf 'c,x,y\n"<&>",0,0\n"<&>",1,0\n"<&>",0,1\n' > in
run --scatter a.svg
has "ids are escaped" a.svg '<title>&#60;&#38;&#62;: '

# --- polygons in space ------------------------------------------------------------------------------------------------

# A reader of PLY of its own: prints the values of a property of all vertices or all faces.
ply() {
    awk -v element="$2" -v name="$3" '
        NR == 1 && $0 != "ply" { print "no ply"; exit }
        NR == 2 && $0 != "format ascii 1.0" { print "no ascii"; exit }
        body { ++line
               if (line <= count["vertex"]) kind = "vertex"; else kind = "face"
               if (kind != element) next
               start = kind == "face" ? $1 + 1 : 0
               print name == "list" ? $0 : $(start + at[kind, name] - (kind == "face")) ; next }
        $1 == "element" { last = $2; count[$2] = $3; properties = 0 }
        $1 == "property" { at[last, $NF] = ++properties }
        $1 == "end_header" { body = 1 }
        END { if (line != count["vertex"] + count["face"]) print "another number of lines" }' "$1"
}
run "$data/tissue.tsv" --ply a.ply
check "a face for each cell" "$(ply a.ply face mu_1 | wc -l | tr -d ' ')" 400
check "a vertex for each corner" \
    "$(ply a.ply vertex x | wc -l | tr -d ' ')" "$(column n | awk '{ s += $1 } END { print s }')"
for p in 1 2 3 4 5 6; do
    check "mu_$p of the faces: to the last digit" "$(ply a.ply face mu_$p | cksum)" "$(column mu_$p | cksum)"
done
near_lists "corners as they came in" \
    "$(ply a.ply vertex z)" "$(awk -F '\t' '!/^#/ && $1 != "cell" { print $4 }' "$data/tissue.tsv")" 0
near_lists "and their normals, unit" \
    "$(ply a.ply vertex nz)" "$(awk -F '\t' '!/^#/ && $1 != "cell" { print $7 }' "$data/tissue.tsv")" 1e-8
ply a.ply face mu_2 > mu
ply a.ply face list | cut -d ' ' -f 1 > n
check "vertices carry what their face does" "$(ply a.ply vertex mu_2 | cksum)" "$(
    paste n mu | awk '{ for (i = 0; i < $1; ++i) print $2 }' | cksum)"
check "faces have their corners in order, each its own" "$(
    ply a.ply face list |
        awk '{ for (i = 2; i <= $1 + 1; ++i) if ($i != next_corner++) ++bad } END { print bad + 0 }')" 0
run four.tsv --ply a.ply --svg a.svg --color-by mu_3 --quiet
check "refused outlines have -1" "$(ply a.ply face mu_2 | tail -n 1)" -1
check "and are grey" "$(for c in red green blue; do ply a.ply face $c | tail -n 1; done | tr '\n' ' ')" "150 150 150 "
check "colours are those of the picture" "$(for c in red green blue; do ply a.ply face $c > $c; done
    paste -d ' ' red green blue | head -n 3 | awk '{ printf "#%02x%02x%02x\n", $1, $2, $3 }')" \
    "$(sed -n 's/.* fill="\(#[0-9a-f]*\)"><title>.*mu_3 = .*/\1/p' a.svg)"
check "the plane lies at z = 0, its normals upwards" \
    "$(ply a.ply vertex z | sort -u) $(ply a.ply vertex nz | sort -u)" "0 1"
printf 'ring lon lat\no 0 0\no 90 0\no 0 90\n' > in
run --ply a.ply --radius 6371
check "on a sphere corners lie at its radius" \
    "$(ply a.ply vertex x | head -n 1) $(ply a.ply vertex nx | head -n 1)" "6371 1"
for n in 255 256; do
    awk -v n=$n 'BEGIN { print "c x y";
            for (k = 0; k < n; ++k) print "o", cos(k / n * 6.283185), sin(k / n * 6.283185) }' > in
    run --ply $n.ply
    check "a polygon of $n corners" "$(ply $n.ply face list | cut -d ' ' -f 1,$((n + 1)))" "$n $((n - 1))"
done
has "up to 255 corners fit a byte" 255.ply "property list uchar int vertex_indices"
has "more do not" 256.ply "property list int int vertex_indices"

# --- files that cannot be written -------------------------------------------------------------------------------------

cp shapes.tsv in
for kind in svg histogram scatter ply; do
    run --$kind none/a
    stopped "$kind, nowhere to put it" "none/a: "
    run shapes.tsv --$kind ./shapes.tsv
    stopped "$kind would overwrite its input" "shapes.tsv: --$kind would overwrite it"
    if [ -w /dev/full ]; then
        run shapes.tsv --$kind /dev/full
        stopped "$kind, a full disk" "/dev/full: cannot write"
    fi
    run --$kind a.$kind
    cp a.$kind b.$kind
    run --$kind a.$kind
    check "$kind: the same bytes again" "$(cmp a.$kind b.$kind)" ""
    check "$kind: standard output does not change" "$(cksum < out)" "$("$surfmink" in | cksum)"
    [ $kind = ply ] || check "$kind: begins and ends" "$(head -c 5 a.$kind)$(tail -n 1 a.$kind)" "<svg </svg>"
done
check "and the input is as before" "$(cksum < shapes.tsv)" "$(cksum < in)"
run shapes.tsv --ply a.ply "$data/tissue.tsv"
stopped "two kinds of surfaces" "another kind of surface in the same picture"

totals
