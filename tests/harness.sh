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

# drawn_strokes FILE: how many strokes a picture of outlines has, how many of their points at quarters of the way lie
# outside of the outline before them, and the least contrast with its colour, in tenths.
drawn_strokes() {
    awk '
        function part(color, k,    digits) {
            digits = "0123456789abcdef"
            if (length(color) == 4) return 17 * (index(digits, substr(color, 1 + k, 1)) - 1)
            return 16 * (index(digits, substr(color, 2 * k, 1)) - 1) + index(digits, substr(color, 2 * k + 1, 1)) - 1
        }
        function light(color,    k, share, sum) {
            for (k = 1; k <= 3; ++k) {
                share = part(color, k) / 255
                share = share <= 0.04045 ? share / 12.92 : exp(2.4 * log((share + 0.055) / 1.055))
                sum += share * (k == 1 ? 0.2126 : k == 2 ? 0.7152 : 0.0722)
            }
            return sum + 0.05
        }
        function attribute(name,    text) {
            text = $0
            if (!sub(".* " name "=\"", "", text)) return ""
            sub(/".*/, "", text)
            return text
        }
        function is_inside(x, y,    i, odd) {
            for (i = 1; i <= sides; ++i)
                if ((ay[i] > y) != (by[i] > y) && x < ax[i] + (y - ay[i]) * (bx[i] - ax[i]) / (by[i] - ay[i]))
                    odd = !odd
            return odd
        }
        /^<path d="M.*Z" fill="#/ {
            fill = attribute("fill")
            sides = 0
            rings = split(substr(attribute("d"), 2), ring, "ZM*")
            for (r = 1; r <= rings; ++r) {
                n = split(ring[r], point, "L")
                for (i = 1; i <= n; ++i) {
                    split(point[i], a, " ")
                    split(point[i < n ? i + 1 : 1], b, " ")
                    ax[++sides] = a[1]
                    ay[sides] = a[2]
                    bx[sides] = b[1]
                    by[sides] = b[2]
                }
            }
        }
        /^<path d="M.*Z" fill="url/ { sides = 0 }
        /^<path fill="none" stroke-linecap="round"/ {
            a1 = light(fill)
            b1 = light(attribute("stroke"))
            contrast = a1 > b1 ? a1 / b1 : b1 / a1
            if (least == "" || contrast < least) least = contrast
            n = split(substr(attribute("d"), 2), stroke, "M")
            for (i = 1; i <= n; ++i) {
                split(stroke[i], at, "[ L]")
                ++count
                for (q = 0; q <= 4; ++q)
                    if (!is_inside(at[1] + q * (at[3] - at[1]) / 4, at[2] + q * (at[4] - at[2]) / 4)) ++outside
            }
        }
        END { print count + 0, outside + 0, int(10 * least) }' "$1"
}
