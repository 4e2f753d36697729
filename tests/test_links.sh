#!/bin/sh
# test_links.sh [--list]: every link in README.md, docs/*.md and the other pages leads somewhere: to a file that is
# there, and to a heading that is in it. Links to other places are only listed, if asked for. And every page of docs/
# can be reached from README.md.
. "$(dirname "$0")/harness.sh"
pages="README.md $(echo docs/*.md docs/internals/*.md) $(find examples tests -name '*.md' | sort)"

# links PAGE: the targets of [text](target) and ![text](target), outside of code.
links() {
    awk '/^```/ { code = !code; next }
        code || /^    / { next }
        {
            gsub(/`[^`]*`/, "")
            while (match($0, /\]\([^) ]+\)/)) {
                print substr($0, RSTART + 2, RLENGTH - 3)
                $0 = substr($0, RSTART + RLENGTH)
            }
        }' "$1"
}

# anchors PAGE: the names that headings have, as GitHub makes them: lower case, blanks to hyphens, no punctuation.
anchors() {
    awk '/^```/ { code = !code; next }
        !code && /^#+ / {
            sub(/^#+ /, "")
            gsub(/[`*]/, "")
            name = tolower($0)
            gsub(/[^a-z0-9 _-]/, "", name)
            gsub(/ /, "-", name)
            print seen[name]++ ? name "-" seen[name] - 1 : name
        }' "$1"
}

for page in $pages; do
    links "$page" > "$work/links"
    while read -r link; do
        case $link in
        http://* | https://* | mailto:*)
            [ "$1" = --list ] && echo "$page: $link"
            continue ;;
        esac
        file=${link%%#*} anchor=
        case $link in *\#*) anchor=${link#*#} ;; esac
        [ "$file" ] && file=$(dirname "$page")/$file || file=$page
        [ -e "$file" ]
        count $? "$page links to $link" "no such file" "$file"
        case $anchor in
        "") ;;
        *)
            anchors "$file" | grep -x -F -e "$anchor" > /dev/null
            count $? "$page links to $link" "no such heading" "$anchor" ;;
        esac
        echo "$page ${file#./}" | sed 's|docs/\.\./||g; s|[a-z]*/\.\./||g' >> "$work/edges"
    done < "$work/links"
done

# From README.md on, link by link.
awk '{ to[$1] = to[$1] " " $2 }
    END {
        queue[n = 1] = "README.md"
        for (i = 1; i <= n; i++) {
            print queue[i]
            many = split(to[queue[i]], next_page, " ")
            for (k = 1; k <= many; k++)
                if (!seen[next_page[k]]++) queue[++n] = next_page[k]
        }
    }' "$work/edges" > "$work/reached"
for page in docs/*.md docs/internals/*.md; do
    has "$page can be reached from README.md" "$work/reached" "$page"
done
totals
