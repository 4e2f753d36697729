#!/bin/sh
# test_docs.sh BUILD CC [--tools]: do README.md and docs/*.md tell the truth? Every block of code in them is compiled or
# run, with the commands in BUILD; what it prints must be the ```text block that follows it. The quick start of the
# header and examples/octant.c are compiled too.
#
#   ```c              a program
#   ```sh             commands, in a folder with examples/, tests/, surfmink.h and what earlier blocks have written
#   ```sh jq          commands that need more than a shell: run only with --tools, where everything is installed
#   ```python skimage the same for Python
#   ```sh untested    not run at all; the page says so, too
#
# A page with a line <!-- run by tests/NAME.sh --> is left to that test.
. "$(dirname "$0")/harness.sh"
build=$(absolute "$1") cc=$2 tools=$3
root=$PWD
PATH=$build:$PATH
python=/usr/bin/python3 # that of the packages, if there are several
[ -x "$python" ] || python=python3

verdict() { # verdict NAME STATUS: with the outputs in $work/want and $work/got
    if [ "$2" -eq 0 ] && cmp -s "$work/want" "$work/got"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED $1"
        diff "$work/want" "$work/got"
    fi
}

# Cuts a page into blocks: block.101.c, block.101.want, block.102.sh, ... and lists them as "number kind words".
cut_blocks() {
    awk -v at="$work/block" '
        /^```/ && !inside {
            inside = 1
            file = ""
            kind = substr($1, 4)
            if (kind == "text" && number && !answered) {
                answered = 1
                file = at "." 100 + number ".want"
            } else if (kind != "text" && kind != "") {
                number++
                answered = 0
                file = at "." 100 + number "." kind
                $1 = kind
                print 100 + number, $0
            }
            if (file) printf "" > file
            next
        }
        /^```$/ { if (file) close(file); inside = 0; next }
        inside && file { print > file }
        END { if (inside) print 0, "a block without an end" }' "$1"
}

# run_block KIND FILE: in the folder of the page
run_block() {
    cd "$work/page" || return 1
    case $1 in
    c) $cc -std=c99 -I. "$2" -o "$work/program" -lm && "$work/program" ;;
    sh) sh "$2" ;;
    python) "$python" "$2" ;;
    gnuplot) gnuplot "$2" ;;
    r) Rscript --vanilla "$2" ;;
    esac
}

for page in README.md docs/*.md docs/internals/*.md; do
    other=$(sed -n 's/^<!-- run by \(tests\/[a-z_]*\.sh\) -->$/\1/p' "$page")
    if [ "$other" ]; then
        has "$page is run by $other" "$other" "$page"
        continue
    fi
    rm -rf "$work"/block.* "$work/page"
    mkdir "$work/page"
    ln -s "$root/examples" "$root/tests" "$root/surfmink.h" "$work/page"
    cut_blocks "$page" > "$work/list"
    while read -r number kind words; do
        block=$work/block.$number
        name="$page, block $((number - 100)), $kind $words"
        case $kind in
        c | sh | python) ;;
        gnuplot | r) words="$kind $words" ;; # tools themselves
        bibtex | yaml | json | java) continue ;; # for reading; a page says of programs that they are not tested
        *)
            check "$name: a kind that is known" "$kind" "c, sh, ..."
            continue ;;
        esac
        [ "$words" = untested ] && continue
        if [ ! -f "$block.want" ]; then
            check "$name: has its output below it, or the word untested" no yes
            continue
        fi
        [ "$words" ] && [ "$tools" != --tools ] && continue
        cp "$block.want" "$work/want"
        (run_block "$kind" "$block.$kind") > "$work/got" 2>&1 < /dev/null
        verdict "$name" $?
    done < "$work/list"
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

# examples/octant.c is the first program of docs/guide.md
sed 's,"../surfmink.h","surfmink.h",' examples/octant.c > "$work/want"
awk '/^```c$/ { on = 1; next } /^```/ && on { exit } on' docs/guide.md > "$work/got"
verdict "examples/octant.c is the program in docs/guide.md" $?
awk '/^```c$/ { after = 1 } /^```$/ && on { exit }
    on { print } /^```text$/ && after { on = 1 }' docs/guide.md > "$work/want"
$cc -std=c99 examples/octant.c -o "$work/octant" -lm > "$work/got" 2>&1 && "$work/octant" > "$work/got" 2>&1
verdict "examples/octant.c" $?

totals
