#!/bin/sh
# build.sh WASM: puts docs/playground.html together from the files beside this one, data of examples/data, and the
# base64 text WASM, and writes it to standard output. Needs awk only; `make playground` compiles WASM before, with clang
# and lld.
# A line @@NAME@@ of page.html stands for that file, or for what is made here.
here=$(dirname "$0") data=$(dirname "$0")/../data wasm=$1

# numbers WIDTH ID FILE: so many columns behind the id, of all corners of a polygon, as a list for JSON.
numbers() {
    awk -v id="$2" -v width="$1" '
        BEGIN { FS = "\t" }
        $1 == id { for (i = 2; i <= 1 + width; i++) list = list (list == "" ? "" : ",") $i }
        END { printf "[%s]", list }' "$3"
}

presets() {
    printf '{"h3": %s,\n' "$(numbers 2 821c07fffffffff "$data/h3_res2.tsv")"
    printf '"cell": %s,\n"countries": {' "$(numbers 3 8 "$data/tissue.tsv")"
    comma=
    for country in Botswana Chile Egypt France Madagascar Namibia Somalia; do
        printf '%s\n"%s": %s' "$comma" "$country" "$(numbers 2 "$country" "$data/countries.tsv")"
        comma=,
    done
    printf '}}\n'
}

version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' "$here/../../surfmink.h")
presets=$(mktemp) || exit 1
trap 'rm -f "$presets"' EXIT
presets > "$presets"
awk -v here="$here" -v wasm="$wasm" -v presets="$presets" -v version="$version" '
    /^@@[a-z.]*@@$/ {
        name = substr($0, 3, length($0) - 4)
        file = name == "wasm" ? wasm : name == "presets" ? presets : here "/" name
        while ((status = (getline line < file)) > 0) print line
        if (status < 0) { print file ": cannot be read" > "/dev/stderr"; exit 1 }
        close(file)
        next
    }
    { gsub(/@@version@@/, version); print }' "$here/page.html"
