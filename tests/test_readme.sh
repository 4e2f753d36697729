#!/bin/sh
# test_readme.sh BUILD CC: does the README tell the truth? Every ```c block is compiled, every ```sh block is run, with
# the commands in BUILD; what they print must be the ```text block that follows. The quick start of the header is
# compiled too.
build=$1 cc=$2
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
passed=0 failed=0
PATH=$(cd "$build" && pwd):$PATH

verdict() { # verdict NAME STATUS: with the outputs in $work/want and $work/got
    if [ "$2" -eq 0 ] && cmp -s "$work/want" "$work/got"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $1"
        diff "$work/want" "$work/got"
    fi
}

# Cuts a page into blocks: block.1.c, block.1.text, block.2.sh, ...
cut_blocks() {
    awk -v at="$work/block" '
        /^```[a-z]+$/ {
            kind = substr($0, 4)
            if (kind != "text") number++
            file = at "." number "." kind
            printf "" > file
            next
        }
        /^```$/ { if (file) close(file); file = ""; next }
        file { print > file }' "$1"
}

for page in README.md; do
    rm -f "$work"/block.*
    cut_blocks "$page"
    for text in "$work"/block.*.text; do
        block=${text%.text}
        cp "$text" "$work/want"
        if [ -f "$block.c" ]; then
            $cc -std=c99 -I. "$block.c" -o "$work/program" -lm > "$work/got" 2>&1 &&
                "$work/program" > "$work/got" 2>&1
            verdict "$page, program ${block##*.}" $?
        else
            sh "$block.sh" > "$work/got" 2>&1
            verdict "$page, command ${block##*.}" $?
        fi
    done
done

{ # the quick start in the header, with a main around it
    echo '#include <stdio.h>'
    awk '/^   QUICK START/ { on = 1; next } /^   DATA FLOW/ { exit } on { sub(/ *\/\/.*/, ""); print }' surfmink.h |
        awk '/[^ ]/ && !/#/ && !main { print "int main(void)\n{"; main = 1 }
             { print }
             END { print "return 0; }" }'
} > "$work/quick.c"
echo "mu_3 = 1.000, mu_4 = 0.000" > "$work/want"
$cc -std=c99 -I. "$work/quick.c" -o "$work/quick" -lm > "$work/got" 2>&1 && "$work/quick" > "$work/got" 2>&1
verdict "the quick start of surfmink.h" $?

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
