#!/bin/sh
# run.sh TOTAL COMMAND...: runs commands, which end with a line "N passed, N failed", several at a time; adds them up.
# A command without that line, or that passed nothing, counts as one failure. The sum is the last line, and all that
# the file TOTAL holds.
. "$(dirname "$0")/pool.sh"
total=$1
shift
commands=$(mktemp -d) || exit 1
trap 'rm -rf "$commands"' EXIT
number=100
for command in "$@"; do
    number=$((number + 1))
    printf '%s\n' "$command" > "$commands/$number.sh"
done
pool "$commands"
passed=0 failed=0
for script in "$commands"/*.sh; do
    output=${script%.sh}/said
    status=$(cat "${script%.sh}/status")
    last=$(tail -n 1 "$output")
    case $last in
    *[0-9]" passed, "[0-9]*" failed")
        sed '$d' "$output"
        good=${last%% passed*} bad=${last##* passed, } bad=${bad%% failed*}
        [ "$bad" -gt 0 ] || { [ "$status" = 0 ] && [ "$good" -gt 0 ]; } || bad=1 ;;
    *)
        cat "$output"
        good=0 bad=1 ;;
    esac
    echo "$(cat "$script"): $good passed, $bad failed"
    passed=$((passed + good)) failed=$((failed + bad))
done
echo "$passed passed, $failed failed" | tee "$total"
[ "$failed" -eq 0 ]
