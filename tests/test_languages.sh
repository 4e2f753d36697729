#!/bin/sh
# test_languages.sh COMMAND: does docs/languages.md tell the truth, and do the examples for other languages say what the
# command says? Needs a C++ compiler, gfortran, R, and python3 with numpy.
. "$(dirname "$0")/harness.sh"
surfmink=$(absolute "$1")
root=$PWD

# A copy of what the page speaks of, to build in.
mkdir -p "$work/examples" "$work/bin"
cp -R Makefile surfmink.h examples/languages examples/beyond tests "$work"
mv "$work/languages" "$work/beyond" "$work/examples"
cp -R examples/data "$work/examples"
cp docs/languages.md "$work/page.md"
cd "$work" || exit 1
PATH=$work/bin:$PATH
for python in python3 /usr/bin/python3; do # a python3 of the user's may have no numpy
    "$python" -c 'import numpy' 2> /dev/null && ln -sf "$(command -v "$python")" bin/python3 && break
done
hash -r
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$work/examples/languages SURFMINK_LIBRARY=$work/.build/libsurfmink.so
export PYTHONDONTWRITEBYTECODE PYTHONPATH SURFMINK_LIBRARY

# program FILE: compiles and runs it, as the page says.
linked="-L.build -lsurfmink -Wl,-rpath,$work/.build"
program() {
    case $1 in
    *.sh) sh "$1" ;;
    *.python) python3 "$1" ;;
    *.fortran)
        cp "$1" program.f90
        gfortran -J. examples/languages/surfmink.f90 program.f90 $linked -o program && ./program ;;
    esac
}

# The blocks of the page in order; what each prints is the text block that follows, or nothing.
awk '
    /^```[a-z]+$/ {
        kind = substr($0, 4)
        if (kind != "text") number++
        file = sprintf("block.%02d.%s", number, kind)
        printf "" > file
        next
    }
    /^```$/ { if (file) close(file); file = ""; next }
    file { print > file }' page.md
for block in block.*; do
    case $block in *.text) continue ;; esac
    program "$block" > got 2>&1
    status=$?
    want=${block%.*}.text
    check "$block: exit status" "$status" 0
    check "$block: prints" "$(cat got)" "$(cat "$want" 2> /dev/null)"
done
check "blocks on the page" "$(ls block.* | grep -cv text)" 8

# C programs may link the library instead of having the implementation in them; C++ may include a private copy.
sed '/SURFMINK_IMPLEMENTATION/d; s,../surfmink.h,surfmink.h,' "$root/examples/octant.c" > octant.c
sed 's/SURFMINK_IMPLEMENTATION/SURFMINK_STATIC/; s,../surfmink.h,surfmink.h,' "$root/examples/octant.c" > octant.cpp
${CC:-cc} -std=c99 -I. octant.c $linked -o octant && ./octant > linked
check "C with the library" "$(sed -n 3p linked)" "mu_3 = 1.000000"
${CXX:-c++} -std=c++11 -Wall -Wextra -I. octant.cpp -o octant > warned 2>&1 && ./octant > included
check "C++ with SURFMINK_STATIC" "$(cat warned included)" "$(cat linked)"

# The story of the tissue: each language, and the command, say the same.
"$surfmink" examples/data/tissue.tsv > table
awk -F '\t' '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { cells++; corners += $2; n[$2]++; five[$2] += $at["mu_5"]; six[$2] += $at["mu_6"] }
    $at["mu_2"] > most { most = $at["mu_2"]; id = $1; theta = $at["theta_2"] }
    END {
        printf "%d cells, %d corners\n", cells, corners
        for (k = 4; k <= 9; ++k)
            printf "%d corners: %3d cells, mean mu_5 %.4f, mean mu_6 %.4f\n", k, n[k], five[k] / n[k], six[k] / n[k]
        printf "cell %s is the most elongated: mu_2 %.4f, theta_2 %.4f\n", id, most, theta
    }' table > story
check "the story by awk" "$(wc -l < story | tr -d ' ')" 8
check "cells.py" "$(python3 examples/languages/cells.py examples/data/tissue.tsv 2>&1)" "$(cat story)"
check "cells.f90" "$(./a.out examples/data/tissue.tsv 2>&1)" "$(cat story)"
check "cells.R" "$(Rscript examples/languages/cells.R examples/languages/surfmink_r.so examples/data/tissue.tsv 2>&1)" \
    "$(cat story)"

# What the modules promise, and the places where surfmink.py looks.
check "surfmink.py" "$(python3 tests/check/languages.py "$surfmink" "${surfmink%/*}/patic" examples/data/tissue.tsv \
    examples/data/h3_res2.tsv)" "43 passed, 0 failed"
check "surfmink_r.c" "$(Rscript tests/check/languages.R examples/languages/surfmink_r.so 2>&1)" "18 passed, 0 failed"
gfortran -std=f2018 -Wall -Wextra -Werror -J. examples/languages/surfmink.f90 tests/check/languages.f90 $linked \
    -o modules 2>&1
check "surfmink.f90" "$(./modules 2>&1)" "43 passed, 0 failed"
gfortran -std=f2018 -Wall -Wextra -Werror -J. examples/languages/surfmink.f90 examples/languages/cells.f90 $linked \
    -o cells > warned 2>&1
check "gfortran has nothing to say" "$(cat warned)" ""
unset SURFMINK_LIBRARY
check "in a clone, what make shared builds is found" \
    "$(python3 -c 'import surfmink; print(surfmink.STATUS_NAMES[0])')" ok
mkdir alone
cp examples/languages/surfmink.py alone
PYTHONPATH=$work/alone python3 -c 'import surfmink' 2> err
check "without the library: exit status" "$?" 1
has "without the library it says what to do" err "\`make shared\` builds it"
cp -L .build/libsurfmink.so alone
check "a library beside surfmink.py is found" \
    "$(PYTHONPATH=$work/alone python3 -c 'import surfmink; print(surfmink.STATUS_NAMES[0])')" ok
SURFMINK_LIBRARY=$surfmink python3 -c 'import surfmink' 2> err
check "not another than SURFMINK_LIBRARY names" "$?" 1

# The library itself.
cc='gcc -std=c99 -E -P -DSURFMINK_DEF=extern examples/languages/flat.h'
check "the library exports what surfmink.h and flat.h declare, and nothing else" \
    "$(nm -D --defined-only .build/libsurfmink.so | awk '{ print $3 }' | sort)" \
    "$($cc | grep -o 'surfmink_[a-z_]*(' | tr -d '(' | sort -u)"
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)
check "programs ask for the version that fits" \
    "$(readelf -d .build/libsurfmink.so | sed -n 's/.*soname: \[\(.*\)\]/\1/p')" "libsurfmink.so.${version%.*}"
check "which surfmink.py asks for, too" "$(sed -n 's/^ABI = "\(.*\)".*/\1/p' examples/languages/surfmink.py)" \
    "${version%.*}"
make -s install-shared DESTDIR="$work/installed" PREFIX=/usr > said 2>&1
check "make install-shared" "$(cat said; cd installed/usr/lib && ls)" "$(printf '%s\n' libsurfmink.so \
    "libsurfmink.so.${version%.*}" "libsurfmink.so.$version")"
cd "$root" || exit 1

totals
