#!/bin/sh
# run.sh TOTAL COMMAND...: runs each command, which ends with a line "N passed, N failed", and adds them up.
# A command without that line counts as one failure. The sum is the last line, and all that the file TOTAL holds.
total=$1
shift
passed=0 failed=0
output=$(mktemp) || exit 1
trap 'rm -f "$output"' EXIT
for command in "$@"; do
    sh -c "$command" > "$output" 2>&1 < /dev/null
    status=$?
    last=$(tail -n 1 "$output")
    case $last in
    *[0-9]" passed, "[0-9]*" failed")
        sed '$d' "$output"
        good=${last%% passed*} bad=${last##* passed, } bad=${bad%% failed*}
        [ "$bad" -gt 0 ] || [ "$status" -eq 0 ] || bad=1 ;;
    *)
        cat "$output"
        good=0 bad=1 ;;
    esac
    echo "$command: $good passed, $bad failed"
    passed=$((passed + good)) failed=$((failed + bad))
done
echo "$passed passed, $failed failed" | tee "$total"
[ "$failed" -eq 0 ]
