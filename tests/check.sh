#!/bin/sh
# check.sh DIRECTORY [WORD]: what a header is judged by and only other tools can tell: warnings in every dialect, the
# symbols it exports, ways to include it, other compilers, flags and machines, static analysis, sanitizers, layout.
# Works in DIRECTORY; runs only checks whose name has the WORD in it, if there is one; JOBS of them at a time. SLOW=10
# names those that took so many seconds of the processor. Needs what .ci/run installs; a tool that is missing is a check
# that fails. docs/internals/trust.md says more.
. "$(dirname "$0")/pool.sh"
work=$1
word=$2
list=$work/list
rm -rf "$work"
mkdir -p "$list"
here='$here' # in commands: a folder of the check's own

# check NAME COMMAND: passes if the command succeeds and says nothing. It is run later: other checks run beside it.
number=1000
check() {
    case $1 in *"$word"*) ;; *) return ;; esac
    number=$((number + 1))
    printf '# %s\n%s\n' "$1" "$2" > "$list/$number.sh"
}

# quietly COMMAND: the text of a command that says something only if it fails.
quietly() {
    echo "{ $1 > $here/quiet 2>&1 || { tail -n 20 $here/quiet; false; }; }"
}

# short FLAGS: without the warnings that are asked for.
short() {
    echo "$1" | sed 's/ -W[^ ]*//g'
}

wall="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Wundef -Wcast-qual
      -Wcast-align -Wwrite-strings -Wvla -Wfloat-conversion"
wall=$(echo $wall)
wall_c="$wall -Wstrict-prototypes -Wmissing-prototypes"
declared="-DSURFMINK_IMPLEMENTED" # for programs around the header, whose implementation has been looked at by itself
gcc32="gcc -m32 -static -isystem /usr/include/x86_64-linux-gnu" # not gcc-multilib, which drives out the others
arm64="aarch64-linux-gnu-gcc -static"
s390x="s390x-linux-gnu-gcc -static"

# --- the header: silent in every dialect ------------------------------------------------------------------------------
printf '#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n#include "surfmink.h"\n' > "$work/whole.c"
printf '#define SURFMINK_STATIC\n#include "surfmink.h"\n' > "$work/static.c"
printf '#include "surfmink.h"\n' > "$work/public.c"
printf '#define SURFMINK_DISPATCH\n#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n' > "$work/dispatch.c"
printf '#define SURFMINK_NO_SIMD\n#define SURFMINK_IMPLEMENTATION\n#include "surfmink.h"\n' > "$work/plain.c"

# units FILES COMPILER FLAGS...: each of these files.
units() {
    units=$1
    shift
    check "$(short "$*"), silent" "for unit in $units; do $* -I. -c $work/\$unit.c -o $here/unit.o; done"
}
every="whole static public dispatch plain"
for std in c89 c99 c11 c17 c2x; do
    case $std in c99) units=$every ;; *) units="whole public" ;; esac
    units "$units" gcc -std=$std $wall_c -Wc++-compat
    units "$units" clang -std=$std -Weverything -Wno-padded
done
for std in c++98 c++11 c++14 c++17 c++20 c++2b; do
    case $std in c++17) units=$every ;; *) units="whole public" ;; esac
    units "$units" g++ -x c++ -std=$std $wall
    units "$units" clang++ -x c++ -std=$std $wall
done
units "$every" tcc -Wall
units "whole dispatch" gcc -std=c99 $wall_c -O2
units "whole dispatch" clang -std=c99 -Weverything -Wno-padded -O2
for flags in "-O3 -march=haswell" "-O3 -march=skylake-avx512" "-O2 -fopenmp" "-Ofast"; do
    check "gcc $flags" "gcc -std=c99 $wall_c $flags -I. -c $work/whole.c -o $here/unit.o"
    check "g++ $flags" "g++ -x c++ -std=c++11 $wall $flags -I. -c $work/whole.c -o $here/unit.o"
    check "clang $flags" "clang -std=c99 -Weverything -Wno-padded $flags -I. -c $work/whole.c -o $here/unit.o"
done
units whole $gcc32 -std=c99 $wall_c
units whole $arm64 -std=c99 $wall_c -O2
units whole $s390x -std=c99 $wall_c
units whole musl-gcc -std=c99 $wall_c

# --- what it leaves in a program --------------------------------------------------------------------------------------
gcc -std=c99 -O2 -I. -c "$work/whole.c" -o "$work/whole.o"
# each of the public functions, and nothing else
check "only surfmink_ symbols are exported" "
    nm -g --defined-only $work/whole.o | sed -n 's/.* //p' | sort > $here/exported
    sed -n 's/^SURFMINK_DEF [^(]*[ *]\(surfmink_[a-z_]*\)(.*/\1/p' surfmink.h | sort -u | cmp - $here/exported &&
    test -s $here/exported"
check "no writable data" "nm $work/whole.o | awk '\$2 ~ /^[bBdDcC]\$/'"
libm='^(sqrt|memcpy|memset|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail)$'
check "only sqrt is asked for" "nm -u $work/whole.o | awk '{ print \$2 }' | grep -vE '$libm' || true"
check "SURFMINK_STATIC exports nothing" "
    gcc -std=c99 -O2 -I. -c $work/static.c -o $here/static.o && nm -g --defined-only $here/static.o"
check "only SURFMINK_ macros are defined" "
    printf '#include <stddef.h>\n#include <math.h>\n#include <immintrin.h>\n' > $here/libc.c
    gcc -std=c99 -dM -E $here/libc.c | sort > $here/libc.macros
    gcc -std=c99 -dM -E -I. $work/whole.c | sort | comm -13 $here/libc.macros - | grep -v '^#define SURFMINK_' || true"

# --- ways to include it -----------------------------------------------------------------------------------------------
cat > "$work/first.c" << 'C'
#define SURFMINK_STATIC
#include "surfmink.h"
int second(void);
int main(void)
{
    return surfmink_strerror(0)[0] + second() != 'm' + 'm';
}
C
cat > "$work/second.c" << 'C'
#define SURFMINK_STATIC
#include "surfmink.h"
int second(void);
int second(void)
{
    return surfmink_strerror(0)[0];
}
C
check "private copies in two files of a program" \
    "gcc -std=c99 -Wall -Wextra -I. $work/first.c $work/second.c -o $here/two -lm && $here/two"
cat > "$work/late.c" << 'C'
#include "surfmink.h"
#include "surfmink.h"
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
#include "surfmink.h"
int main(void)
{
    return surfmink_strerror(0)[0] != 'm';
}
C
check "declarations first, implementation later, all twice" \
    "gcc -std=c99 -Wall -Wextra -I. $work/late.c -o $here/late -lm && $here/late"

# among HEADERS...: between other headers, and among names that headers of Windows, X11 and others define as macros
cat > "$work/macros.h" << 'C'
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define ERROR 0
#define None 0L
#define Status int
#define Success 0
#define Bool int
#define True 1
#define PI 3.14159265358979323846
#define E 2.718281828459045
#define N 1000
#define PLANE 1
#define OK (-1)
C
among() {
    for header in "$@"; do printf '#include %s\n' "$header"; done > "$work/among$#.c"
    printf 'int main(void)\n{\n    return surfmink_strerror(0)[0] != 109;\n}\n' >> "$work/among$#.c"
    for compiler in gcc clang; do
        check "$compiler, among $*" \
            "$compiler -Wall -Wextra -I. -I$work -DSURFMINK_IMPLEMENTATION $work/among$#.c -o $here/among -lm &&
            $here/among"
    done
}
among '"surfmink.h"' '<math.h>'
among '<math.h>' '<stdlib.h>' '"surfmink.h"'
among '<complex.h>' '<tgmath.h>' '<stdio.h>' '"surfmink.h"'
among '"macros.h"' '<stdlib.h>' '<complex.h>' '<math.h>' '"surfmink.h"'
# The header finds itself, to compile the kernels again: in a folder, under another name, from another header; a copy
# pasted into a program goes without dispatch. With SURFMINK_DISPATCH and without, as C and as C++.
cat > "$work/octant.c" << 'C'
#include <stdio.h>
int main(void)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    static const size_t offset[2] = {0, 3};
    surfmink_outline octant = surfmink_sphere(corner, 3, 1.0);
    surfmink_results out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    double mu[4], batch[4];
    out.mu = batch;
    if (surfmink_measure(&octant, 3, mu, NULL, NULL, NULL)) return 1;
    if (surfmink_batch(&octant, offset, 1, 3, &out, NULL)) return 1;
    printf("%.3f %.3f %.3f %.3f\n", mu[2], mu[3], batch[2], batch[3]);
    return 0;
}
C
mkdir -p "$work/vendor/deep"
cp surfmink.h "$work/vendor/surfmink.h"
cp surfmink.h "$work/vendor/deep/tensors.h"
printf '#ifndef MINE_H\n#define MINE_H\n#include "surfmink.h"\n#endif\n' > "$work/vendor/mine.h"
{ printf '#ifndef PASTED_H\n#define PASTED_H\n' && cat surfmink.h && printf '#endif\n'; } > "$work/vendor/pasted.h"
# found NAME FILE THERE: what includes or is FILE measures the octant; is there (1) dispatch to AVX-512 or not (0)?
found() {
    { echo '#define SURFMINK_IMPLEMENTATION' && cat "$2" "$work/octant.c"; } > "$work/found-$1.c"
    for compiler in "gcc -std=c99" "clang++ -x c++"; do
        for flags in "" -DSURFMINK_DISPATCH; do
            there=$3
            [ -n "$flags" ] || there=0
            check "finds itself, $1, $compiler $flags" "
                $compiler -O0 -Wall -Wextra $flags -I$work/vendor $work/found-$1.c -o $here/octant -lm &&
                $here/octant | grep -qx '0.000 1.000 0.000 1.000' || echo 'the octant is no triangle'
                test \$(nm $here/octant | grep -c window_avx512) = $there || echo 'kernels for AVX-512: not $there'"
        done
    done
}
echo '#include "vendor/surfmink.h"' > "$work/folder.line"
echo '#include "vendor/deep/tensors.h"' > "$work/renamed.line"
echo '#include "mine.h"' > "$work/mine.line"
found folder "$work/folder.line" 1
found renamed "$work/renamed.line" 1
found "another" "$work/mine.line" 1
found pasted surfmink.h 0
check "pasted into a header it says what is missing for dispatch" "
    printf '#define SURFMINK_DISPATCH\n#define SURFMINK_IMPLEMENTATION\n#include \"pasted.h\"\n' > $here/pasted.c
    gcc -std=c99 -I$work/vendor -c $here/pasted.c -o $here/pasted.o 2> $here/errors && echo 'it compiles'
    grep -q 'error.*define SURFMINK_FILE' $here/errors &&
    gcc -std=c99 -Wall -Wextra -DSURFMINK_IMPLEMENTATION -x c -c $work/vendor/pasted.h -o $here/pasted.o"
cat > "$work/freestanding.c" << 'C'
#define SURFMINK_SQRT my_sqrt
double my_sqrt(double x);
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
C
check "freestanding, with sqrt replaced" "
    gcc -std=c99 -ffreestanding -nostdinc -isystem \$(gcc -print-file-name=include) -Wall -Wextra -I. -O1 \
        -c $work/freestanding.c -o $here/freestanding.o &&
    nm -u $here/freestanding.o | awk '\$2 !~ /^(my_|memset|memcpy)/' &&
    nm -u $here/freestanding.o | grep -q my_sqrt"

# --- the programs around it -------------------------------------------------------------------------------------------
for program in examples/*.c examples/paper/*.c examples/image/*.c; do
    check "gcc, $program" "gcc -std=c99 $wall_c -O1 $declared -I. -c $program -o $here/program.o"
    check "clang, $program" "clang -std=c99 $wall_c $declared -I. -c $program -o $here/program.o"
done

# headers to copy, and the library for other languages
for header in examples/beyond/*.h; do
    name=$(basename "$header" .h)
    printf '#include "surfmink.h"\n#include "%s"\n' "$header" > "$work/beyond_$name.c"
    for compiler in "gcc -std=c99 $wall_c" "clang -std=c99 $wall_c" "g++ -x c++ -std=c++11 $wall" \
        "clang++ -x c++ -std=c++11 $wall"; do
        check "$(short "$compiler"), $header" "$compiler -I. -c $work/beyond_$name.c -o $here/unit.o"
    done
done
for compiler in gcc clang; do
    check "$compiler, examples/languages/flat.c" \
        "$compiler -std=c99 $wall_c -Wc++-compat -I. -c examples/languages/flat.c -o $here/unit.o"
done
check "examples/beyond: outputs of what fails are untouched" "
    clang -std=c99 $wall_c -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -I. tests/check/beyond.c \
        -o $here/beyond -lm && $(quietly "$here/beyond")"

# object FLAGS...: $object is what a program needs that these flags compile: the implementation, compiled once for all
# of them. using PROGRAM: $using is that, or nothing for a program that looks inside.
objects=$work/objects
mkdir -p "$objects"
inside=$(grep -l 'surfmink__' tests/test_*.c tests/fuzz/*.c)
object() {
    name=$(echo "$*" | cksum | tr ' ' -)
    object="$declared $objects/$name.o"
    echo "$* -std=c99 -DSURFMINK_IMPLEMENTATION -I. -x c -c surfmink.h -o $objects/$name.o" > "$objects/$name.sh"
}
using() {
    case " $(echo $inside) " in *" $1 "*) using= ;; *) using=$object ;; esac
}

# theorems PROGRAMS FEWER RUNNER COMPILER FLAGS...: the test programs, built by another compiler, with other flags or
# for another machine; of batches a part. The machines that round like x86-64 (see "determinism") run $some of them.
all=$(echo tests/test_*.c)
some="tests/test_batch.c tests/test_errors.c tests/test_measure.c tests/test_properties.c tests/test_reference.c"
singles=$(echo "$some" | sed 's|tests/test_batch.c ||')
# what valgrind takes too long for, or whose long double has not the digits: test_gradient
slow='batch|convergence|curve|field|gradient|grey|long|measure|mesh|outlines|paper|patic|statements|surfaces'
quick=$(echo "$all" | tr ' ' '\n' | grep -vE "test_($slow)" | tr '\n' ' ')
theorems() {
    programs=$1 fewer=$2 runner=$3
    shift 3
    object "$@"
    for program in $programs; do
        using "$program"
        check "$(short "$*"), $program" "$* -std=c99 -DFEWER=$fewer -I. $program $using -o $here/theorem -lm &&
            $(quietly "$runner $here/theorem")"
    done
}
sanitize="-fsanitize=address,undefined,float-divide-by-zero,float-cast-overflow -fno-sanitize-recover=all"
theorems "$all" 200 "" gcc -O0 $wall_c
# gcc 12 fuses for its vectors (vfmaddsub) even where -std=c99 says not to; test_gradient compares bits
theorems "$some tests/test_curve.c tests/test_gradient.c tests/test_long.c" 200 "" \
    gcc -O3 -march=native -fno-math-errno -fno-tree-slp-vectorize
theorems "$all" 200 "" clang -O2 $wall_c
theorems "$all" 200 "" tcc
theorems "$some" 1000 "" musl-gcc -O1
theorems "$some tests/test_grey.c tests/test_mesh.c tests/test_number.c tests/test_outlines.c" 1000 \
    qemu-s390x $s390x -O1 # the other order of bytes: besides numbers, whatever reads files
theorems "$singles" 1000 qemu-i386 $gcc32 -O1 -msse2 -mfpmath=sse
theorems "tests/test_properties.c tests/test_reference.c" 1000 qemu-i386 $gcc32 -O1 -mno-sse
theorems "$some" 1000 qemu-aarch64 $arm64 -O2
theorems "$all" 1000 "" clang -O1 -g $sanitize
theorems "$all" 1000 "" clang -O1 -g -fsanitize=memory -DSURFMINK_NO_SIMD
check "clang -fsanitize=memory, batches in vector instructions" "
    clang -std=c99 -O1 -g -fsanitize=memory -I. tests/check/outputs.c -o $here/outputs -lm &&
    $(quietly "$here/outputs")"
theorems "$quick" 200 "valgrind -q --error-exitcode=9" gcc -O1 -g

# batches: what threads, other instructions and plain C make of them
for flags in "gcc -O2 -fopenmp" "gcc -O2 -DSURFMINK_NO_SIMD"; do
    check "$flags, batches" "$flags -std=c99 -DFEWER=40 -I. tests/test_batch.c -o $here/theorem -lm &&
        $(quietly "$here/theorem")"
done
for flags in "-O2" "-Ofast -march=native"; do
    check "gcc $flags, the benchmark: what it compares agrees" "
        gcc -std=c99 $wall_c $flags -I. tests/bench/bench.c -o $here/bench -lm &&
        $(quietly "$here/bench --quick --rounds 1 --place cache")"
done

# --- determinism: the same bits, or nearly the same numbers -----------------------------------------------------------
# outlines TEXT: $outlines, how many that run takes.
outlines() {
    case $1 in *qemu*) outlines=500 ;; *) outlines=1500 ;; esac
}

# same NAME LINES BUILD...: builds whose outputs are the same to the bit; a build is a runner (or none), a colon and a
# compiler. Of their lines those that match a pattern. Where a machine is emulated a third of the outlines.
same() {
    name=$1 lines=$2
    shift 2
    outlines "$*"
    for build in "$@"; do
        echo "${build#*:} -DOUTLINES=$outlines -I. tests/check/outputs.c -o \$here/outputs -lm &&"
        echo "${build%%:*} \$here/outputs > \$here/said.bits"
        echo "grep '$lines' \$here/said.bits > \$here/bits; [ -f \$here/first ] || cp \$here/bits \$here/first"
        echo "test -s \$here/bits && cmp \$here/bits \$here/first || echo '$build'; rm -f \$here/outputs \$here/bits"
    done > "$work/same"
    check "the same bits, $name" "$(cat "$work/same")"
}
same "in SSE2" . ":gcc -std=c99 -O2" ":gcc -std=c89 -O0 -D_GNU_SOURCE" ":gcc -O3" ":g++ -x c++ -O2" ":clang -O0" \
    ":clang -O3 -ffp-contract=off" ":gcc -std=c99 -O2 -fno-math-errno" ":musl-gcc -std=c99 -O1" \
    "qemu-i386:$gcc32 -std=c99 -O2 -msse2 -mfpmath=sse"
same "in AVX2, AVX-512 and NEON" . "qemu-aarch64:$arm64 -std=c99 -O2" ":gcc -std=c99 -O2 -DSURFMINK_DISPATCH" \
    "qemu-x86_64 -cpu max:gcc -std=c99 -O3 -march=haswell -fno-tree-slp-vectorize" ":gcc -std=c99 -O1 -march=native" \
    "qemu-x86_64 -cpu max:clang -std=c99 -O2 -march=haswell -ffp-contract=off"
same "in plain C" . ":tcc" ":gcc -std=c99 -O2 -DSURFMINK_NO_SIMD" "qemu-s390x:$s390x -std=c99 -O2" \
    "qemu-aarch64:$arm64 -DSURFMINK_NO_SIMD -std=c99 -O2"
same "of single calls and steps, whatever the instructions" '^[^b]' ":gcc -std=c99 -O1" \
    ":gcc -std=c99 -O1 -DSURFMINK_NO_SIMD" ":gcc -std=c99 -O1 -march=native" "qemu-s390x:$s390x -std=c99 -O1"

# near WITHIN OPTIONS RUNNER COMPILER...: where bits differ, the same statuses, and numbers within WITHIN (1 + c)
for outlines in 500 1500; do
    echo "gcc -std=c99 -O2 -DOUTLINES=$outlines -I. tests/check/outputs.c -o $here/outputs -lm &&
        $here/outputs --write $here/numbers > /dev/null" > "$objects/numbers-$outlines.sh"
done
near() {
    within=$1 options=$2 runner=$3
    shift 3
    outlines "$runner"
    check "within $within, $* $options" "$* -DOUTLINES=$outlines -I. tests/check/outputs.c -o $here/outputs -lm &&
        $(quietly "$runner $here/outputs --compare $objects/numbers-$outlines/numbers $within $options")"
}
near 1e-14 "" "" gcc -std=c99 -O2 -DSURFMINK_NO_SIMD
near 1e-14 --doubles "" gcc -Ofast
near 1e-14 --doubles "" gcc -Ofast -march=native
near 1e-14 --doubles "" clang -O2 -ffast-math
near 1e-14 --doubles "" clang -Ofast -march=native
near 1e-14 --doubles qemu-i386 $gcc32 -O2 -mno-sse
near 1e-14 "" qemu-i386 $gcc32 -O2 -mno-sse -std=c99
near 1e-14 "" "" musl-gcc -O2
near 1e-14 "" qemu-aarch64 $arm64 -O2
near 1e-14 "" qemu-s390x $s390x -O2 -march=z13
rounding="--rounding up --rounding down --rounding zero"
near 2e-14 "$rounding" "" gcc -O2 -frounding-math -DSURFMINK_NO_SIMD
near 1e-6 "$rounding" "" gcc -O2 -frounding-math
near 1e-6 "$rounding" "" clang -O2 -march=native

# --- the command in a country with a decimal comma, and on a big-endian machine ---------------------------------------
# comma.c makes it speak the language of the country, which it never does by itself
check "a locale with a comma changes no byte" "
    localedef --no-archive -i de_DE -f UTF-8 $here/de_DE.UTF-8 &&
    export LOCPATH=\$PWD/$here COMMA_LOCALE=de_DE.UTF-8 &&
    gcc -std=c99 -O1 -I. examples/surfmink.c tests/check/comma.c -o $here/surfmink -lm &&
    tissue=\"--digits 17 --directions center examples/data/tissue.tsv\" &&
    for kind in svg histogram scatter ply; do tissue=\"\$tissue --\$kind $here/\$kind\"; done &&
    LC_ALL=C .build/surfmink \$tissue > $here/1 &&
    for kind in svg histogram scatter ply; do mv $here/\$kind $here/1.\$kind; done &&
    LC_ALL=de_DE.UTF-8 .build/surfmink \$tissue | cmp - $here/1 &&
    for kind in svg histogram scatter ply; do cmp $here/\$kind $here/1.\$kind; done &&
    $here/surfmink \$tissue | cmp - $here/1 &&
    for kind in svg histogram scatter ply; do cmp $here/\$kind $here/1.\$kind; done &&
    LC_ALL=de_DE.UTF-8 .build/tissue | cmp - examples/data/tissue.tsv"
check "big-endian, the command: the same bytes as on arm64" "
    $s390x -std=c99 -O2 -I. examples/surfmink.c -o $here/big -lm &&
    $arm64 -std=c99 -O2 -DSURFMINK_NO_SIMD -I. examples/surfmink.c -o $here/little -lm &&
    for table in examples/data/tissue.tsv examples/data/countries.tsv; do
        qemu-s390x $here/big --digits 17 \$table > $here/1 2> $here/3
        qemu-aarch64 $here/little --digits 17 \$table > $here/2 2> $here/4
        test -s $here/1 && cmp $here/1 $here/2 && cmp $here/3 $here/4 || echo \$table
    done"

# --- static analysis --------------------------------------------------------------------------------------------------
for unit in "$work/whole.c" examples/*.c; do
    case $unit in examples/*) only=$declared configurations=--max-configs=4 ;; *) only= configurations=--force ;; esac
    check "clang-tidy, ${unit##*/}" "$(quietly "clang-tidy-14 --quiet $unit -- -std=c99 $only -I.")"
    check "cppcheck, ${unit##*/}" "
        cppcheck -q --std=c99 --enable=warning,performance,portability --error-exitcode=1 $configurations \
            --suppressions-list=.cppcheck $only -I. $unit"
done
check "gcc -fanalyzer, the header" "gcc -std=c99 -O1 -fanalyzer -I. -c $work/whole.c -o $here/unit.o"
for unit in examples/outlines.c examples/tissue.c; do
    check "gcc -fanalyzer, ${unit##*/}" "gcc -std=c99 -O1 -fanalyzer $declared -I. -c $unit -o $here/unit.o"
done

# --- fuzzing, for a moment: the corpus, and random strings made from it -----------------------------------------------
object clang -O1 -g $sanitize
for harness in tests/fuzz/*.c; do
    name=$(basename "$harness" .c)
    using "$harness"
    check "fuzz $name" "clang -std=c99 -O1 -g $sanitize -I. $harness $using \
        -o $here/fuzz -lm && $(quietly "$here/fuzz --random 1000 tests/fuzz/corpus/$name/*")"
done

# --- accuracy, on few polygons ----------------------------------------------------------------------------------------
check "worst errors of the kernels against quadruple precision" "
    gcc -std=c99 -O2 -I. tests/accuracy/kernels.c -o $here/kernels -lquadmath -lm && $(quietly "$here/kernels")"
check "worst errors against quadruple precision" "
    gcc -O2 -I. tests/accuracy/accuracy.c -o $here/accuracy -lquadmath -lm &&
    $(quietly "$here/accuracy --polygons 1000")"
check "worst errors of smooth curves against quadruple precision" "
    gcc -O2 -I. tests/accuracy/curve.c -o $here/curve -lquadmath -lm && $(quietly "$here/curve 20")"

# --- the reference values: a random sample, made again in 50 digits ---------------------------------------------------
check "the reference values, a sample" "$(quietly "/usr/bin/python3 tests/reference/reference.py --sample")"

# --- the commands under sanitizers ------------------------------------------------------------------------------------
gcc_sanitize="gcc -std=c99 -O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -I."
object $gcc_sanitize
for command in surfmink levelset outlines patic tissue relax; do
    echo "$gcc_sanitize $declared -c examples/$command.c -o $objects/sanitized-$command.o" \
        > "$objects/sanitized-$command.sh"
done
# sanitized COMMAND [FILE]: the text that links it, with another file or without, in a folder of the check's own.
sanitized() {
    echo "$gcc_sanitize $objects/sanitized-$1.o $2 $object -o $here/$1 -lm"
}
check "the command's contract, with sanitizers and a decimal comma" "
    localedef --no-archive -i de_DE -f UTF-8 $here/de_DE.UTF-8 &&
    export LOCPATH=\$PWD/$here COMMA_LOCALE=de_DE.UTF-8 &&
    $(sanitized surfmink tests/check/comma.c) &&
    $(quietly "ASAN_OPTIONS=detect_leaks=0 sh tests/test_pictures.sh $here/surfmink") &&
    $(quietly "ASAN_OPTIONS=detect_leaks=0 sh tests/test_command.sh $here/surfmink")" # abuse looks for leaks
check "levelset's contract, with sanitizers" "$(sanitized levelset) &&
    $(quietly "sh tests/test_levelset.sh $here/levelset .build/surfmink")"
check "outlines' contract, with sanitizers" "$(sanitized outlines) && mkdir -p $here/image &&
    $gcc_sanitize $object examples/image/rasterise.c -o $here/image/rasterise -lm &&
    cp .build/test_outlines .build/surfmink $here && $(quietly "sh tests/test_outlines.sh $here")"
check "relax's contract, with sanitizers" "$(sanitized relax) &&
    $(quietly "sh tests/test_relax.sh $here/relax .build/tissue .build/surfmink")"
check "the commands under abuse, with sanitizers" "$(sanitized surfmink) && $(sanitized levelset) &&
    $(sanitized outlines) && $(sanitized patic) && $(sanitized tissue) && $(quietly "sh tests/test_abuse.sh $here")"
check "the tissue is what its generator makes, with sanitizers" "$(sanitized tissue) &&
    $here/tissue | cmp - examples/data/tissue.tsv"
check "valgrind finds nothing in the demo's tissue" "valgrind -q --leak-check=full --error-exitcode=9 .build/surfmink \
    --svg $here/tissue.svg examples/data/tissue.tsv > $here/tissue.out"

# --- the playground: what clang makes of its sources; its numbers; its hands ------------------------------------------
check "the playground is what make playground makes" "
    $(quietly "make -s BUILD=$here $here/playground.html") && cmp $here/playground.html docs/playground.html"
check "the playground, functions in place of libm" "gcc -std=c99 -O2 -I. tests/check/playground.c -o $here/native -lm &&
    $(quietly "$here/native --functions")"
check "the playground, numbers in node" "gcc -std=c99 -O2 -I. tests/check/playground.c -o $here/native -lm &&
    $(quietly "node tests/check/playground.mjs docs/playground.html $here/native .build/surfmink")"
check "the playground, in chromium" "
    $(quietly "node tests/check/playground_page.mjs docs/playground.html .build/surfmink .build/node")"
check "the playground, silent" "gcc -std=c99 $wall_c -I. -c tests/check/playground.c -o $here/unit.o &&
    clang --target=wasm32 -std=c99 $wall -O2 -ffreestanding -fno-math-errno -nostdlibinc -I. \
        -Iexamples/playground/freestanding -c examples/playground/playground.c -o $here/unit.o"

# --- what users see ---------------------------------------------------------------------------------------------------
check "make demo: valid pictures, those of docs/pictures among them" "$(quietly "make -s demo") &&
    xmllint --noout .build/demo/*.svg &&
    for picture in countries h3_mu tissue tissue_ranks tissue_mu tissue_scatter; do
        cmp .build/demo/\$picture.svg docs/pictures/\$picture.svg
    done"
check "the polygons of make demo, as another program reads them" "$(quietly "make -s demo") &&
    assimp info .build/demo/tissue.ply -r | grep -E '^(Faces: *400|Vertices: *2388|    0 \(\):.*polygon)' |
    wc -l | grep -qx 3"
check "make paper: every printed digit, and the pictures of docs/internals/paper.md" "$(quietly "make -s paper") &&
    xmllint --noout .build/paper/*.svg &&
    for picture in docs/paper/*.svg; do cmp .build/paper/\${picture##*/} \$picture; done"
check "make pictures: those of docs/internals/theory.md, to the byte" "$(quietly "make -s pictures") &&
    xmllint --noout .build/pictures/*.svg &&
    for picture in .build/pictures/*.svg; do cmp \$picture docs/pictures/\${picture##*/}; done"
check "the programs of docs/internals/theory.md: silent" "for program in examples/theory/*.c; do
        gcc -std=c99 $wall_c $declared -I. -c \$program -o $here/program.o
        clang -std=c99 $wall_c $declared -I. -c \$program -o $here/program.o
    done"
check "every block of the documentation, with the programs it needs" "
    $(quietly "sh tests/test_docs.sh .build gcc --tools")"
check "man pages: mandoc and groff find nothing" "mandoc -T lint -W warning docs/*.1 &&
    for page in docs/*.1; do groff -mandoc -Tutf8 -ww -z \$page; done"
check "CITATION.cff is YAML" "/usr/bin/python3 -c 'import yaml; yaml.safe_load(open(\"docs/CITATION.cff\"))'"
check "make install, and programs that find it: pkg-config, CMake, Meson" \
    "$(quietly "sh tests/test_install.sh .build cc make --tools")"
check "other languages: docs/languages.md, and the same story in each" \
    "$(quietly "sh tests/test_languages.sh .build/surfmink")"
check "many machines: Open MPI and GNU parallel give the bytes of one run" "
    gcc -std=c99 $wall_c -Wno-unused-function -O2 -I. \$(mpicc -showme:compile | sed 's/-I/-isystem /g') \
        examples/scaling/mpi_cells.c -o $here/mpi_cells \$(mpicc -showme:link) -lm &&
    $(quietly "sh tests/test_scaling.sh .build/surfmink $here/mpi_cells")"
check "layout" "clang-format-14 --dry-run --Werror surfmink.h \$(find examples tests -name '*.[ch]')"
check "lines of at most 120 columns" "awk 'length > 120 { print FILENAME \":\" FNR }' surfmink.h Makefile \
    \$(find examples tests -name '*.[ch]' -o -name '*.sh')"
check "nothing else lies at the top" "
    ls | grep -vxE 'surfmink.h|tests|examples|docs|Makefile|LICENSE|README.md' || true"
check "the version stands on line 1 and in the macros" "v=\$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)
    grep -q \"#define SURFMINK_VERSION  *\\\"\$v\\\"\" surfmink.h"

# --- all of them ------------------------------------------------------------------------------------------------------
for script in "$objects"/*.sh; do
    grep -qF "${script%.sh}" "$list"/*.sh || rm "$script" # no check needs it
done
pool "$objects"
pool "$list"
passed=0 failed=0
for script in "$list"/*.sh; do
    here=${script%.sh}
    name=$(sed -n '1s/^# //p' "$script")
    if [ "$(cat "$here/status")" = 0 ] && [ ! -s "$here/said" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        { echo "FAILED $name" && sed 1d "$script" && cat "$here/said"; } | head -n 30
    fi
    sed 's/[ms]/ /g' "$here/times" | awk -v slow="${SLOW:-0}" -v name="$name" '
        NR == 2 { seconds = 60 * $1 + $2 + 60 * $3 + $4 }
        END { if (slow && seconds >= slow) printf "%.1f s %s\n", seconds, name }'
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
