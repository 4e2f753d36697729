#!/bin/sh
# check.sh DIRECTORY: what a header is judged by and only other tools can tell: warnings in every dialect, the symbols
# it exports, ways to include it, other compilers and flags, sanitizers, layout. Works in DIRECTORY. Needs gcc, g++,
# clang, tcc, valgrind, clang-format 14, pkg-config, xmllint; a tool that is missing is a check that fails.
work=$1
mkdir -p "$work"
passed=0 failed=0

# quietly COMMAND: the text of a command that says something only if it fails.
quietly() {
    echo "{ $1 > $work/said 2>&1 || { tail -n 20 $work/said; false; }; }"
}

# check NAME COMMAND: passes if the command succeeds and says nothing.
check() {
    if said=$(sh -c "$2" 2>&1) && [ -z "$said" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s\n  %s\n%s\n' "$1" "$2" "$said" | head -n 30
    fi
}

wall="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Wundef -Wcast-qual
      -Wcast-align -Wwrite-strings -Wvla -Wfloat-conversion"
wall=$(echo $wall)
wall_c="$wall -Wstrict-prototypes -Wmissing-prototypes"

# --- the header: silent in every dialect ------------------------------------------------------------------------------
printf '#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n#include "surfmink.h"\n' > "$work/whole.c"
printf '#define SURFMINK_STATIC\n#include "surfmink.h"\n' > "$work/static.c"
printf '#include "surfmink.h"\n' > "$work/public.c"
printf '#define SURFMINK_DISPATCH\n#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n' > "$work/dispatch.c"
printf '#define SURFMINK_NO_SIMD\n#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n' > "$work/plain.c"
for unit in whole static public dispatch plain; do
    case $unit in
    dispatch | plain) dialects=c99 dialects_cpp=c++17 ;; # the same text as the others, compiled once more or less
    *) dialects="c89 c99 c11 c17 c2x" dialects_cpp="c++98 c++11 c++14 c++17 c++20 c++2b" ;;
    esac
    for std in $dialects; do
        check "gcc -std=$std, $unit" "gcc -std=$std $wall_c -Wc++-compat -O2 -I. -c $work/$unit.c -o $work/unit.o"
        check "clang -std=$std, $unit" "clang -std=$std -Weverything -O2 -I. -c $work/$unit.c -o $work/unit.o"
    done
    for std in $dialects_cpp; do
        check "g++ -std=$std, $unit" "g++ -x c++ -std=$std $wall -O2 -I. -c $work/$unit.c -o $work/unit.o"
        check "clang++ -std=$std, $unit" "clang++ -x c++ -std=$std $wall -O2 -I. -c $work/$unit.c -o $work/unit.o"
    done
    check "tcc, $unit" "tcc -Wall -I. -c $work/$unit.c -o $work/unit.o"
done
for flags in "-O0" "-O3 -march=haswell" "-O3 -march=skylake-avx512" "-O2 -fopenmp" "-Ofast"; do
    check "gcc $flags" "gcc -std=c99 $wall_c $flags -I. -c $work/whole.c -o $work/unit.o"
    check "g++ $flags" "g++ -x c++ -std=c++11 $wall $flags -I. -c $work/whole.c -o $work/unit.o"
    check "clang $flags" "clang -std=c99 -Weverything $flags -I. -c $work/whole.c -o $work/unit.o"
done
check "gcc for arm64" "aarch64-linux-gnu-gcc -std=c99 $wall_c -O2 -I. -c $work/whole.c -o $work/unit.o"

# --- what it leaves in a program --------------------------------------------------------------------------------------
gcc -std=c99 -O2 -I. -c "$work/whole.c" -o "$work/whole.o"
check "only surfmink_ symbols are exported" "nm -g --defined-only $work/whole.o | awk '\$3 !~ /^surfmink_[a-z]/'"
check "no writable data" "nm $work/whole.o | awk '\$2 ~ /^[bBdDcC]\$/'"
libm='^(sin|cos|sincos|atan2|sqrt|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail)$'
check "only libm is asked for" "nm -u $work/whole.o | awk '{ print \$2 }' | grep -vE '$libm' || true"
gcc -std=c99 -O2 -I. -c "$work/static.c" -o "$work/static.o"
check "SURFMINK_STATIC exports nothing" "nm -g --defined-only $work/static.o"
check "only SURFMINK_ macros are defined" "
    printf '#include <stddef.h>\n#include <math.h>\n#include <immintrin.h>\n' > $work/libc.c
    gcc -std=c99 -dM -E $work/libc.c | sort > $work/libc.macros
    gcc -std=c99 -dM -E -I. $work/whole.c | sort | comm -13 $work/libc.macros - | grep -v '^#define SURFMINK_' || true"

# --- ways to include it -----------------------------------------------------------------------------------------------
cat > "$work/first.c" << 'END'
#define SURFMINK_STATIC
#include "surfmink.h"
int second(void);
int main(void)
{
    return surfmink_strerror(0)[0] + second() != 'm' + 'm';
}
END
cat > "$work/second.c" << 'END'
#define SURFMINK_STATIC
#include "surfmink.h"
int second(void);
int second(void)
{
    return surfmink_strerror(0)[0];
}
END
check "private copies in two files of a program" \
    "gcc -std=c99 -Wall -Wextra -I. $work/first.c $work/second.c -o $work/two -lm && $work/two"
cat > "$work/late.c" << 'END'
#include "surfmink.h"
#include "surfmink.h"
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
#include "surfmink.h"
int main(void)
{
    return surfmink_strerror(0)[0] != 'm';
}
END
check "declarations first, implementation later, all twice" \
    "gcc -std=c99 -Wall -Wextra -I. $work/late.c -o $work/late -lm && $work/late"
mkdir -p "$work/vendor"
cp surfmink.h "$work/vendor/surfmink.h"
cp surfmink.h "$work/vendor/tensors.h"
printf '#define SURFMINK_IMPLEMENTATION\n#include "vendor/surfmink.h"\n' > "$work/vendored.c"
printf '#define SURFMINK_IMPLEMENTATION\n#include "vendor/tensors.h"\n' > "$work/renamed.c"
check "in a folder of the program's" "gcc -std=c99 -Wall -Wextra -c $work/vendored.c -o $work/vendored.o"
check "under another name" "gcc -std=c99 -Wall -Wextra -DSURFMINK_DISPATCH -DSURFMINK_FILE='\"tensors.h\"' \
    -c $work/renamed.c -o $work/vendored.o"
cat > "$work/freestanding.c" << 'END'
#define SURFMINK_SIN my_sin
#define SURFMINK_COS my_cos
#define SURFMINK_ATAN2 my_atan2
#define SURFMINK_SQRT my_sqrt
double my_sin(double x), my_cos(double x), my_atan2(double y, double x), my_sqrt(double x);
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
END
check "freestanding, with libm replaced" "
    gcc -std=c99 -ffreestanding -nostdinc -isystem \$(gcc -print-file-name=include) -Wall -Wextra -I. -O1 \
        -c $work/freestanding.c -o $work/freestanding.o &&
    nm -u $work/freestanding.o | awk '\$2 !~ /^(my_|memset|memcpy)/'"

# --- the programs around it -------------------------------------------------------------------------------------------
for program in examples/*.c tests/test_*.c; do
    check "gcc, $program" "gcc -std=c99 $wall_c -O2 -I. $program -o $work/program -lm"
    check "clang, $program" "clang -std=c99 $wall_c -O2 -I. $program -o $work/program -lm"
done

# theorems COMPILER FLAGS...: the whole set of test programs, built by another compiler or with other flags; of batches
# a tenth, for these builds are slow.
theorems() {
    for program in tests/test_*.c; do
        check "$* $program" "$* -std=c99 -DFEWER=10 -I. $program -o $work/theorem -lm && $(quietly "$work/theorem")"
    done
}
theorems gcc -O0
theorems gcc -O3 -march=native
theorems clang -O2
theorems tcc
theorems gcc -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all
theorems clang -O1 -g -fsanitize=undefined,float-divide-by-zero,float-cast-overflow -fno-sanitize-recover=all

# batches: what threads, other instructions and plain C make of them
for flags in "gcc -O2 -fopenmp" "gcc -O2 -DSURFMINK_NO_SIMD"; do
    check "$flags, batches" "$flags -std=c99 -I. tests/test_batch.c -o $work/theorem -lm && $(quietly "$work/theorem")"
done
for program in test_batch test_measure test_reference; do
    check "arm64, $program" "aarch64-linux-gnu-gcc -std=c99 -O2 -static -DFEWER=20 -I. tests/$program.c \
        -o $work/theorem -lm && $(quietly "qemu-aarch64 $work/theorem")"
done
for flags in "-O2" "-Ofast -march=native"; do
    check "gcc $flags, the benchmark: what it compares agrees" "
        gcc -std=c99 $wall_c $flags -I. tests/bench/bench.c -o $work/bench -lm &&
        $(quietly "$work/bench --quick --rounds 1 --place cache")"
done

# --- fuzzing, for a moment: the corpus, and random strings made from it -----------------------------------------------
for harness in tests/fuzz/*.c; do
    name=$(basename "$harness" .c)
    check "gcc, fuzz $name" "gcc -std=c99 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -I. $harness \
        -o $work/fuzz -lm && $(quietly "$work/fuzz --random 2000 tests/fuzz/corpus/$name/*")"
done

# --- accuracy, on few polygons ----------------------------------------------------------------------------------------
check "worst errors of the kernels against quadruple precision" "
    gcc -std=c99 -O2 -I. tests/accuracy/kernels.c -o $work/kernels -lquadmath -lm && $(quietly "$work/kernels")"
check "worst errors against quadruple precision" "
    gcc -O2 -I. tests/accuracy/accuracy.c -o $work/accuracy -lquadmath -lm &&
    $(quietly "$work/accuracy --polygons 1000")"

# --- the commands under sanitizers ------------------------------------------------------------------------------------
sanitize="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all"
for command in surfmink levelset tissue; do
    check "$command with sanitizers" "gcc -std=c99 $sanitize -I. examples/$command.c -o $work/$command -lm"
done
check "the command's contract, with sanitizers" "$(quietly "sh tests/test_command.sh $work/surfmink")"
check "levelset's contract, with sanitizers" "$(quietly "sh tests/test_levelset.sh $work/levelset $work/surfmink")"
check "valgrind finds nothing in the demo's tissue" "valgrind -q --leak-check=full --error-exitcode=9 .build/surfmink \
    --svg $work/tissue.svg examples/data/tissue.tsv > $work/tissue.out"

# --- what users see ---------------------------------------------------------------------------------------------------
check "make demo" "$(quietly "make -s demo")"
check "make paper: every printed digit" "$(quietly "make -s paper")"
check "pictures are valid XML" "xmllint --noout .build/demo/*.svg .build/paper/*.svg"
check "the README shows the picture of the demo" "cmp .build/demo/tissue.svg docs/pictures/tissue.svg"
check "docs/paper.md shows the pictures of make paper" "
    for picture in docs/paper/*.svg; do cmp .build/paper/\${picture##*/} \$picture; done"
check "make install" "$(quietly "make -s install DESTDIR=$work/installed PREFIX=/usr")
    PKG_CONFIG_PATH=$work/installed/usr/share/pkgconfig pkg-config --exists 'surfmink >= 0.1' &&
    test -x $work/installed/usr/bin/surfmink"
check "the tissue is what its generator makes" ".build/tissue | cmp - examples/data/tissue.tsv"
check "layout" "clang-format-14 --dry-run --Werror surfmink.h \$(find examples tests -name '*.[ch]')"
check "lines of at most 120 columns" "awk 'length > 120 { print FILENAME \":\" FNR }' surfmink.h Makefile \
    \$(find examples tests -name '*.[ch]' -o -name '*.sh')"
check "the version stands on line 1 and in the macros" "v=\$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)
    grep -q \"#define SURFMINK_VERSION  *\\\"\$v\\\"\" surfmink.h"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
