#!/bin/sh
# test_fuzzed.sh: is every public function of surfmink.h fuzzed, and every command, by the harness that
# tests/fuzz/README.md names? And has every harness a corpus, and a row there? Run it from the root of the repository.
. tests/harness.sh
table=tests/fuzz/README.md

for function in $(sed -n 's/^SURFMINK_DEF [^(]*[ *]\(surfmink_[a-z_]*\)(.*/\1/p' surfmink.h | sort -u); do
    row=$(grep "^|.*\<$function\>" $table)
    named='' calling=''
    for harness in $(echo "$row" | cut -d '|' -f 3- | tr -cs 'a-z_' ' '); do
        [ -f "tests/fuzz/$harness.c" ] || continue
        named=$harness
        shared=$(sed -n 's/^#include "\([a-z]*\.h\)".*/\1/p' "tests/fuzz/$harness.c")
        (cd tests/fuzz && grep -q "\<$function\>" "$harness.c" $shared) && calling=$harness
    done
    check "$function stands in the table" "${row:+yes}" yes
    check "$function: the table names a harness" "${named:+yes}" yes
    check "$function: a harness that the table names calls it" "${calling:+yes}" yes
done
for command in examples/*.c; do
    grep -q "^int main(void)" "$command" && continue # reads nothing
    calling=''
    for harness in $(grep -F "| $command" $table | cut -d '|' -f 3 | tr -cs 'a-z_' ' '); do
        grep -qF "\"$command\"" "tests/fuzz/$harness.c" && calling=$harness
    done
    check "$command: a harness that the table names runs it" "${calling:+yes}" yes
done
for harness in tests/fuzz/*.c; do
    name=$(basename "$harness" .c)
    check "$name stands in the table" "$(sed -n "/|.*|.*\<$name\>/s/.*/yes/p" $table | head -n 1)" yes
    check "$name has a corpus" "$(find tests/fuzz/corpus/$name -type f | sed -n '1s/.*/yes/p')" yes
    check "$name: no input above 1 KiB" "$(find tests/fuzz/corpus/$name -type f -size +2)" ""
done

totals
