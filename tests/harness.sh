# harness.sh - what the shell tests share; to be sourced. $work is an empty directory that goes away at the end.
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

absolute() {
    case $1 in
    /*) echo "$1" ;;
    *) echo "$PWD/$1" ;;
    esac
}

# count WHETHER NAME GOT WANT: 0 has passed.
count() {
    if [ "$1" -eq 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED %s\n  got  %s\n  want %s\n' "$2" "$3" "$4"
    fi
}

# check NAME GOT WANT
check() {
    [ "$2" = "$3" ]
    count $? "$1" "$2" "$3"
}

# near NAME GOT WANT [WITHIN]: equal to 1e-12, or so.
near() {
    awk -v got="$2" -v want="$3" -v within="${4-1e-12}" '
        BEGIN { d = got - want; exit !(got != "" && d <= within && d >= -within) }'
    count $? "$1" "$2" "$3"
}

# has NAME FILE TEXT: a line of the file contains the text.
has() {
    grep -F -e "$3" "$2" > /dev/null
    count $? "$1" "$(head -n 5 "$2")" "$3"
}

# totals: the last line, and the exit status, which is 1 also if nothing was checked.
totals() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
}
