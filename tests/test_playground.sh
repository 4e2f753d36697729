#!/bin/sh
# test_playground.sh: is docs/playground.html what its sources make of it, all but the WebAssembly, and does it ask for
# nothing from anywhere? (Whether the WebAssembly is right takes clang, node and a browser: tests/check.sh.) Run it from
# the root of the repository.
. tests/harness.sh
page=docs/playground.html
wasm=$work/wasm

# between FIRST LAST: lines of the page between two lines.
between() {
    awk -v first="$1" -v last="$2" '$0 == last { on = 0 } on { print } $0 == first { on = 1 }' $page
}

between '<script type="text/plain" id="wasm">' '</script>' > "$wasm"
sh examples/playground/build.sh "$wasm" > "$work/made"
cmp -s "$work/made" $page
count $? "the page is what examples/playground makes" "$(diff "$work/made" $page | head -n 6)" "none; make playground"
check "the page holds a WebAssembly module of version 1" "$(cut -c 1-10 "$wasm" | sed -n 1p)" AGFzbQEAAA
check "of base64 and nothing else" "$(grep -c '[^A-Za-z0-9+/=]' "$wasm")" 0
check "every line of page.html that stands for a file is filled" "$(grep -c '^@@' $page)" 0
check "the page is below 300 kB" "$(($(wc -c < $page) < 300000))" 1

# What would make a browser ask for something: addresses, and all that takes one. (WebAssembly may spell anything.)
awk '/id="wasm"/ { skip = 1 } /<\/script>/ { skip = 0 } !skip' $page > "$work/text"
for pattern in '[a-z]://' '\<src *=' '<link' '@import' 'url(' '\<fetch\>' XMLHttpRequest WebSocket EventSource \
    sendBeacon 'import *(' '\<Worker\>' '<iframe' '<img' '<form' '<a [^>]*href="[^#]' 'new Image' '\<open *(' \
    '\<location\>'; do
    check "nothing like $pattern" "$(grep -v '<link rel="icon" href="data:,">' "$work/text" | grep -e "$pattern")" ""
done
has "a policy that forbids it, too" $page "content=\"default-src 'none';"

# Licences: what examples/data/README.md asks for.
tr '\n' ' ' < $page | sed 's/  */ /g' > "$work/line"
for text in 'Natural Earth 4.1, 1:110m, public domain' 'world-atlas 2.0.2 (ISC)' \
    '&copy; 2017&ndash;2021 Uber Technologies, Inc., Apache License 2.0' 'h3-js 4.5.0'; do
    has "the page names its source: $text" "$work/line" "$text"
done

# A corner of each outline that comes from examples/data, digit by digit.
corner() {
    awk -v id="$1" 'BEGIN { FS = "\t" } $1 == id { print $2 "," $3; exit }' "$2"
}
for country in Botswana Chile Egypt France Madagascar Namibia Somalia; do
    has "$country stands in the page" $page "\"$country\": [$(corner $country examples/data/countries.tsv),"
done
has "the H3 pentagon stands in the page" $page "\"h3\": [$(corner 821c07fffffffff examples/data/h3_res2.tsv),"

totals
