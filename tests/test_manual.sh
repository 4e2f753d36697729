#!/bin/sh
# test_manual.sh BUILD: the man pages say what --help says, docs/reference.md and CITATION.cff say what the header says,
# and the pictures in docs/pictures are those that the programs of today draw.
. "$(dirname "$0")/harness.sh"
build=$(absolute "$1")
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)

# --- man pages --------------------------------------------------------------------------------------------------------
for command in surfmink levelset outlines; do
    page=docs/$command.1
    "$build/$command" --help > "$work/help"
    # in mdoc an option is .It Fl -name, or .It Fl -name Ar VALUE; in --help one blank goes before VALUE
    awk '/^  --/ { print substr($1, 3) (/^  --[a-z-]+ [^ ]/ ? " " $2 : "") }' "$work/help" | sort > "$work/options"
    sed -n 's/^\.It Fl -//p' "$page" | sed 's/ Ar / /; s/ Cm / /; s/ | /|/g' | sort > "$work/described"
    check "$page has the options and values of --help" "$(cat "$work/described")" "$(cat "$work/options")"
    check "$command has options" "$(($(wc -l < "$work/options") > 5))" 1
    for section in NAME SYNOPSIS DESCRIPTION EXAMPLES "EXIT STATUS"; do
        has "$page has a section $section" "$page" ".Sh $section"
    done
    for status in 0 1 2; do
        has "$page has the exit status $status" "$page" ".It $status"
    done
done

# --- docs/reference.md ------------------------------------------------------------------------------------------------
awk -f tests/reference.awk surfmink.h > "$work/reference.md"
cmp -s "$work/reference.md" docs/reference.md
count $? "docs/reference.md is up to date (make reference)" \
    "$(diff "$work/reference.md" docs/reference.md | head -n 4)" "no difference"
# what the header declares: one heading for each function and type, and a row for each error
sed '/^   Implementation: /q' surfmink.h > "$work/public.h"
sed -n 's/^SURFMINK_DEF [^(]*[ *]\(surfmink_[a-z_]*\)(.*/\1/p; s/^typedef struct \([a-z_]*\).*/\1/p
    s/^enum \([a-z_]*\).*/\1/p' "$work/public.h" | sort > "$work/declared"
sed -n 's/^### //p' docs/reference.md | sort > "$work/headings"
check "docs/reference.md has every function and type" "$(cat "$work/headings")" "$(cat "$work/declared")"
sed -n '/^enum surfmink_status/,/^}/s/^    \(SURFMINK_[A-Z_]*\) = \([0-9]*\).*/\2 \1/p' "$work/public.h" \
    > "$work/declared"
sed -n 's/^| \([0-9]*\) | `\(SURFMINK_[A-Z_]*\)`.*/\1 \2/p' docs/reference.md > "$work/rows"
check "docs/reference.md has every error" "$(cat "$work/rows")" "$(cat "$work/declared")"

# --- how to cite ------------------------------------------------------------------------------------------------------
for key in cff-version message type title abstract version date-released license authors keywords \
    preferred-citation; do
    check "CITATION.cff has one $key" "$(grep -c "^$key:" docs/CITATION.cff)" 1
done
check "CITATION.cff is of version 1.2.0" "$(sed -n 's/^cff-version: *//p' docs/CITATION.cff)" 1.2.0
check "the version in CITATION.cff" "$(sed -n 's/^version: *//p' docs/CITATION.cff)" "$version"
check "the version in README.md" "$(sed -n 's/.*surfmink, version \([0-9.]*[0-9]\).*/\1/p' README.md)" "$version"
paper=$(sed -n 's/.*value: arXiv:\([0-9.]*\).*/\1/p' docs/CITATION.cff)
has "README.md cites the paper of CITATION.cff" README.md "${paper:-nothing}"
has "the DOI of the paper" docs/CITATION.cff "doi: 10.48550/arXiv.${paper:-nothing}"
released=$(sed -n 's/^date-released: *//p' docs/CITATION.cff)
has "docs/CHANGELOG.md has the version and the day of CITATION.cff" docs/CHANGELOG.md "## $version ($released)"
has "docs/install.md asks CMake for the version" docs/install.md "GIT_TAG v$version"
has "docs/install.md asks Meson for the version" docs/install.md "revision = v$version"

check "docs/guide.md is one page" "$(($(wc -w < docs/guide.md) < 1200))" 1

# --- docs/ARCHITECTURE.md: what it names is there ---------------------------------------------------------------------
tr '`' '\n' < docs/ARCHITECTURE.md | grep -E '^(surfmink_[a-z_0-9]+|[a-z]+_[a-z_0-9]+)$' | sort -u > "$work/named"
check "docs/ARCHITECTURE.md names functions" "$(($(wc -l < "$work/named") > 25))" 1
while read -r name; do
    kernel=${name%_sse2} kernel=${kernel%_avx2}
    grep -E "(^|[^a-z_0-9])($name|SURFMINK__\($kernel\))\(" surfmink.h examples/command/*.h > "$work/found"
    count $? "docs/ARCHITECTURE.md: $name" "nowhere" "in the header"
done < "$work/named"
tr '`' '\n' < docs/ARCHITECTURE.md | grep -E '^(examples|tests|docs)/[a-z_/.A-Z]*$' | sort -u > "$work/named"
while read -r name; do
    [ -e "$name" ]
    count $? "docs/ARCHITECTURE.md: $name" "nowhere" "a file or folder"
done < "$work/named"

# --- pictures ---------------------------------------------------------------------------------------------------------
# alike NAME GOT WANT: the same but for the last digit of numbers, which may depend on compiler and libm, and but for
# the angle by which a circle is turned.
alike() {
    awk -v other="$3" '
        function plain(text,    part) {
            split(text, part, "\"")
            if (text ~ /^<ellipse/ && part[2] == part[4]) gsub(/rotate[^"]*/, "", text)
            return text
        }
        {
            if ((getline line < other) <= 0) bad = 1
            $0 = plain($0)
            line = plain(line)
            mine = $0
            yours = line
            gsub(/-?[0-9]+\.?[0-9]*/, "", mine)
            gsub(/-?[0-9]+\.?[0-9]*/, "", yours)
            if (mine != yours) bad = 1
            while (!bad && match($0, /-?[0-9]+\.?[0-9]*/)) {
                mine = substr($0, RSTART, RLENGTH)
                $0 = substr($0, RSTART + RLENGTH)
                match(line, /-?[0-9]+\.?[0-9]*/)
                yours = substr(line, RSTART, RLENGTH)
                line = substr(line, RSTART + RLENGTH)
                if (mine - yours > 0.11 || yours - mine > 0.11) bad = 1
            }
            if (bad) exit
        }
        END { exit bad || (getline line < other) > 0 }' "$2"
    count $? "$1" "another picture" "$3"
}
for program in "$build"/theory_*; do
    name=${program##*_}
    "$program" "$work" > "$work/said"
    check "$name says what it draws" "$? $(($(wc -l < "$work/said") > 8))" "0 1"
    alike "docs/pictures/$name.svg is up to date (make pictures)" "$work/$name.svg" "docs/pictures/$name.svg"
    check "$name.svg is small" "$(($(wc -c < "$work/$name.svg") < 200000))" 1
    grep -F "pictures/$name.svg" docs/internals/theory.md docs/field.md > /dev/null
    count $? "docs/internals/theory.md or field.md shows $name.svg" "nowhere" "somewhere"
done
# hidden FILE: curves that lie on the frame of their plot, and labels "order n" that a curve runs through.
hidden() {
    awk '
        function points(    k) {
            split($0, part, "\"")
            n = split(substr(part[2], 2), number, " ")
            for (k = 1; k < n; k += 2) { x[++sides] = number[k]; y[sides] = number[k + 1]; first[sides] = k == 1 }
        }
        /^<rect x=.*fill="none" stroke="#000000"/ { split($0, part, "\""); top = part[4]; bottom = top + part[8] }
        /^<g clip-path/ { clipped = 1; next }
        clipped && /^<path d="M/ {
            before = sides
            points()
            clear = 0
            for (k = before + 1; k <= sides; ++k)
                if (y[k] > top + 3 && y[k] < bottom - 3) clear = 1
            if (!clear) ++on_the_frame
        }
        { clipped = 0 }
        /^<text .*>order/ {
            split($0, part, "\"")
            gsub(/<[^>]*>/, "")
            width = 4.6 * length($0)
            label_x[++labels] = part[2] - (part[5] ~ /anchor/ ? (part[6] == "end" ? width : width / 2) : 0)
            label_y[labels] = part[4] - 3
            label_width[labels] = width
        }
        END {
            for (i = 1; i <= labels; ++i)
                for (k = 2; k <= sides; ++k)
                    for (t = 0; t <= 1 && !first[k]; t += 1 / 64) {
                        at = x[k - 1] + t * (x[k] - x[k - 1]) - label_x[i]
                        up = y[k - 1] + t * (y[k] - y[k - 1]) - label_y[i]
                        if (at > 0 && at < label_width[i] && up < 3 && up > -3) crossed[i] = 1
                    }
            for (i in crossed) ++through
            print (sides > 0), on_the_frame + 0, through + 0
        }' "$1"
}
for picture in pictures/transport pictures/pixels paper/tables paper/levelset; do
    check "$picture.svg: no curve on the frame, no label in a curve" "$(hidden docs/$picture.svg)" "1 0 0"
done
check "tables.svg: what lies on another curve is narrower" "$(
    grep -o 'stroke="#9bd5c4" stroke-width="5"\|stroke="#cc79a7" stroke-width="1.4"' docs/paper/tables.svg | sort | uniq -c |
        awk '{ printf "%d ", ($1 > 1) }')" "1 1 "
"$build/tissue" --cells 60 --relax 1 --axes 90,60,50 > "$work/wild.tsv"
"$build/surfmink" --color-by 6 --unit µm --svg "$work/relax_before.svg" "$work/wild.tsv" > "$work/said"
alike "docs/pictures/relax_before.svg is up to date (docs/internals/beyond.md)" "$work/relax_before.svg" \
    docs/pictures/relax_before.svg
sh examples/demo.sh "$build/surfmink" "$work/demo" > "$work/said" 2> "$work/err"
for name in countries h3_mu tissue tissue_ranks tissue_mu tissue_scatter; do
    alike "docs/pictures/$name.svg is up to date (make demo)" "$work/demo/$name.svg" docs/pictures/$name.svg
    check "$name.svg is small" "$(($(wc -c < "docs/pictures/$name.svg") < 300000))" 1
done
totals
