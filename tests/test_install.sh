#!/bin/sh
# test_install.sh BUILD CC MAKE [--tools]: make install puts down what it should, make uninstall takes away just that.
# With --tools: docs/install.md is followed to the letter, with pkg-config, CMake and Meson. On that page
#
#   ```c program.c    is what the file program.c contains
#   ```sh             is run where these files are; what it prints last must be the ```text block that follows it
. "$(dirname "$0")/harness.sh"
build=$(absolute "$1") cc=$2 make=$3 tools=$4
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)
unset MAKEFLAGS MFLAGS MAKELEVEL PKG_CONFIG_PATH CMAKE_PREFIX_PATH # of the make that runs this test, and of the user

files() {
    (cd "$work/stage" && find . -type f | sort)
}

# others have been here before
mkdir -p "$work/stage/usr/include" "$work/stage/usr/share/cmake/other"
echo > "$work/stage/usr/include/surfmink_other.h"
echo > "$work/stage/usr/share/cmake/other/other-config.cmake"
files > "$work/before"
$make -s install BUILD="$build" DESTDIR="$work/stage" PREFIX=/usr > "$work/said" 2>&1
check "make install says nothing" "$? $(cat "$work/said")" "0 "
files | comm -13 "$work/before" - | tr '\n' ' ' > "$work/new"
check "make install: header, commands, man pages, CMake and pkg-config files" "$(cat "$work/new")" "$(echo \
    ./usr/bin/levelset ./usr/bin/outlines ./usr/bin/patic ./usr/bin/surfmink ./usr/include/surfmink.h \
    ./usr/share/cmake/surfmink/surfmink-config-version.cmake ./usr/share/cmake/surfmink/surfmink-config.cmake \
    ./usr/share/man/man1/levelset.1 ./usr/share/man/man1/outlines.1 ./usr/share/man/man1/patic.1 \
    ./usr/share/man/man1/surfmink.1 ./usr/share/pkgconfig/surfmink.pc) "
for command in levelset outlines patic surfmink; do
    "$work/stage/usr/bin/$command" --help > "$work/said" 2>&1
    check "the installed $command runs" $? 0
done
has "the version of the pkg-config file" "$work/stage/usr/share/pkgconfig/surfmink.pc" "Version: $version"
sed 's,"../surfmink.h",<surfmink.h>,' examples/octant.c > "$work/octant.c"
$cc -std=c99 "-I$work/stage/usr/include" "$work/octant.c" -o "$work/octant" -lm && "$work/octant" > "$work/said" 2>&1
has "a program with the installed header" "$work/said" "mu_3 = 1.000000"
for again in "" ", again"; do
    $make -s uninstall BUILD="$build" DESTDIR="$work/stage" PREFIX=/usr > "$work/said" 2>&1
    check "make uninstall says nothing$again" "$? $(cat "$work/said")" "0 "
    check "make uninstall leaves the files of others$again" "$(files)" "$(cat "$work/before")"
done
check "make uninstall removes its folder" "$(find "$work/stage" -name surfmink)" ""

# --- docs/install.md, with a repository as its readers have cloned it -------------------------------------------------
[ "$tools" = --tools ] || { totals; exit; }
page=$work/page
mkdir -p "$page/surfmink/.build"
cp -Rp surfmink.h Makefile LICENSE README.md docs examples .gitignore "$page/surfmink"
cp -p "$build/levelset" "$build/outlines" "$build/patic" "$build/surfmink" "$page/surfmink/.build"
(cd "$page/surfmink" && git init -q && git add . &&
    git -c user.name=x -c user.email=x@example.org commit -q -m "a release" && git tag "v$version") > "$work/said" 2>&1
check "a repository with a tag" "$?" 0
awk -v page="$page" '
    /^```/ && !inside {
        inside = 1
        file = ""
        kind = substr($1, 4)
        if (kind == "text") file = page "/block." number ".want"
        else if (kind == "sh") {
            number = ++blocks + 100
            file = page "/block." number ".sh"
            print "block", number
        } else if ($2) {
            file = page "/" $2
            print "file", $2
            folder = file
            sub(/[^\/]*$/, "", folder)
            system("mkdir -p " folder)
        }
        next
    }
    /^```$/ { if (file) close(file); inside = 0; next }
    inside && file { print > file }' docs/install.md > "$work/list"
check "docs/install.md has files and blocks to run" "$(grep -c file "$work/list") $(grep -c block "$work/list")" "6 4"
while read -r kind number; do
    [ "$kind" = block ] || continue
    (cd "$page" && sh -e "block.$number.sh") > "$work/got" 2>&1 < /dev/null
    status=$?
    tail -n "$(wc -l < "$page/block.$number.want")" "$work/got" > "$work/end"
    [ "$status" -eq 0 ] && cmp -s "$work/end" "$page/block.$number.want"
    count $? "docs/install.md, block $((number - 100))" "$(tail -n 20 "$work/got")" "$(cat "$page/block.$number.want")"
done < "$work/list"

# the installed folder may be moved; find_package takes the versions that have the interface of this one
interface=$(echo "$version" | sed 's/^\(0\.[0-9]*\).*/\1/; t
    s/\..*//')
mv "$page/local" "$page/moved"
wanted() { # wanted VERSION FOUND
    mkdir -p "$work/wanted"
    printf '%s\n' 'cmake_minimum_required(VERSION 3.14)' 'project(wanted NONE)' "find_package(surfmink $1 QUIET)" \
        'message(STATUS "found ${surfmink_FOUND} ${surfmink_VERSION}")' > "$work/wanted/CMakeLists.txt"
    cmake -S "$work/wanted" -B "$work/wanted/$1" "-DCMAKE_PREFIX_PATH=$page/moved" > "$work/said" 2>&1
    check "find_package(surfmink $1)" "$(sed -n 's/^-- found //p' "$work/said")" "$2"
}
wanted "" "1 $version"
wanted "$interface" "1 $version"
wanted "$version" "1 $version"
wanted "$version EXACT" "1 $version"
wanted "$interface.999" "0 "
wanted 0.3 "0 "
wanted 99 "0 "
wanted "0.3...$version" "1 $version"
wanted "0.1...<$version" "0 "
totals
