# reference.awk: the public half of surfmink.h as a page of Markdown, docs/reference.md. make reference writes it, and
# tests/test_manual.sh compares.
#
#   awk -f tests/reference.awk surfmink.h
#
# Reads the file twice: first the names, to link them; then the comments. What it knows of a comment, from its layout:
#   /* --- title --- */            a section
#   name   size   text             an argument, if the name begins in column 4; the text goes on below itself
#   plane: ...                     one of a list of surfaces; so are the names of errors
#   Errors: ...   Cost: ...        a paragraph
BEGIN {
    file = ARGV[1]
    while ((getline line < file) > 0) {
        if (line ~ /^   Implementation: /) break
        if (line ~ /^SURFMINK_DEF /) {
            name = name_of(line)
            known[name] = 1
            contents = contents (listed++ ? ", " : "\n  ") "[" substr(name, 10) "](#" name ")"
        }
        if (line ~ /^\/\* --- .* -+ \*\/$/) {
            contents = contents "\n- " title_of(line) ":"
            listed = 0
        }
        if (line ~ /^typedef struct /) { split(line, word, " "); known[word[3]] = 1 }
        if (line ~ /^enum /) { split(line, word, " "); known[word[2]] = 1 }
        if (match(line, /^    SURFMINK_[A-Z_]+ = [0-9]+/)) {
            name = substr(line, 14, RLENGTH - 13)
            sub(/ .*/, "", name)
            constant[name] = 1
        }
        if (line ~ /^#define SURFMINK_VERSION  *"/) {
            split(line, word, "\"")
            version = word[2]
        }
    }
    close(file)
    sub(/^[^-]*/, "- Errors by name: [strerror](#surfmink_strerror), [status_name](#surfmink_status_name)\n", contents)
    print "# Reference\n"
    print "<!-- made from surfmink.h by make reference: edit it there -->"
    print "<!-- run by tests/test_manual.sh -->\n"
    print "Every public function and type of `surfmink.h` " version ", in the order of the file. `n` is the number of"
    print "corners, `P` the highest rank. In the tables of arguments the column *elements* is the size of an array, and"
    print "*out* says that the function writes there. The [guide](guide.md) shows how to begin. The top of the header"
    print "also states how exact results are, and when they are the same to the bit.\n"
    print contents "\n"
}

function name_of(line) {
    sub(/\(.*/, "", line)
    sub(/.*[ *]/, "", line)
    return line
}

function title_of(line) {
    sub(/^\/\* --- /, "", line)
    sub(/ -+ \*\/$/, "", line)
    return toupper(substr(line, 1, 1)) substr(line, 2)
}

function indent_of(line) {
    match(line, /^ */)
    return RLENGTH
}

# Text as Markdown: names become links, constants and expressions that would be taken for Markdown are set as code.
function markdown(text,    done, word, bare) {
    gsub(/</, "\\&lt;", text)
    gsub(/\*/, "\\*", text)
    done = ""
    while (match(text, /[A-Za-z_][A-Za-z_0-9]*/)) {
        word = substr(text, RSTART, RLENGTH)
        bare = word
        sub(/^SURFMINK_/, "", bare)
        done = done substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + RLENGTH)
        if (word in known && word != here) done = done "[`" word "`](#" word ")"
        else if (word in known || word ~ /^SURFMINK_/ || bare in constant && bare != "OK" && bare != "SURFACE")
            done = done "`" word "`"
        else done = done word
    }
    return done text
}

# Words of a text in lines of at most 120 columns, all but the first after some blanks. No line begins with what would
# make it one of a list.
function fill(text, blanks,    n, i, word, line) {
    n = split(text, word, /[ \n]+/)
    line = word[1]
    for (i = 2; i <= n; i++)
        if (length(line) + length(word[i]) < 120 || word[i] ~ /^([-+]|[0-9]+\.)$/) line = line " " word[i]
        else {
            print line
            line = blanks word[i]
        }
    print line
}

function cell(text) {
    text = markdown(text)
    gsub(/\|/, "\\|", text)
    return text
}

# --- what a comment is made of: paragraphs, lists and arguments -------------------------------------------------------
function flush_text() {
    if (kind == "argument") print "| `" argument "` | " (in_type ? "" : cell(size) " | ") cell(text) " |"
    else if (text != "" && kind == "item") fill("- " markdown(text), "  ")
    else if (text != "") {
        text = markdown(text)
        gsub(/Errors:/, "**Errors:**", text)
        gsub(/Cost:/, "**Cost:**", text)
        fill(text, "")
    }
    if (text != "" || kind == "argument") before = kind
    text = ""
}

# begin KIND: the next paragraph, item or argument; before a table its head, and a blank line where one is needed.
function begin(what) {
    flush_text()
    if (before != "" && (what != before || what == "paragraph")) print ""
    if (what == "argument" && before != "argument") {
        print in_type ? "| field | |" : "| argument | elements | |"
        print in_type ? "|---|---|" : "|---|---|---|"
    }
    kind = what
}

function read_comment(line,    indent, rest, gap, word, column) {
    indent = indent_of(line)
    rest = substr(line, indent + 1)
    if (rest == "") return
    gap = match(rest, /  +/)
    word = substr(rest, 1, gap - 1)
    if (indent == 3 && word ~ /^\*?[a-z_]+(, \*?[a-z_]+)*$/) {
        column = gap + RLENGTH + 2
        rest = substr(rest, gap + RLENGTH)
        begin("argument")
        argument = word
        gap = match(rest, /  +/)
        size = ""
        if (column < 22 && gap) {
            size = substr(rest, 1, gap - 1)
            rest = substr(rest, gap + RLENGTH)
        } else if (column < 22 && length(rest) <= 20) {
            size = rest
            rest = ""
        }
        text = rest
        return
    }
    if (kind == "argument" && indent >= 11) {
        text = text (text == "" ? "" : " ") rest
        return
    }
    if (rest ~ /^(plane|sphere|embedded|surface)(, or [a-z ]+)?: / || rest ~ /^[A-Z_]+  /) {
        begin("item")
        item_indent = indent
        sub(/  +/, ": ", rest)
    } else if (rest ~ /^(Errors|Cost|Spikes|Paper) ?/) {
        begin("paragraph")
    } else if (kind == "argument" || kind == "item" && indent < item_indent || kind == "") {
        begin("paragraph")
    } else {
        text = text (text == "" ? "" : " ") rest
        return
    }
    text = rest
}

function write_comment(    i) {
    kind = before = text = ""
    for (i = 1; i <= lines; i++) read_comment(comment[i])
    flush_text()
    if (lines) print ""
    lines = 0
}

# --- declarations -----------------------------------------------------------------------------------------------------
function write_function(declaration,    one) {
    here = name_of(substr(declaration, 1, index(declaration, "(")))
    gsub(/\n             /, "\n", declaration)
    sub(/^SURFMINK_DEF /, "", declaration)
    print "### " here "\n\n```c\n" declaration "\n```\n"
    if (!lines && declaration ~ /^surfmink_outline /) {
        comment[lines = 1] = "   Fills in a surfmink_outline."
    }
    write_comment()
    here = ""
}

# The errors as a table: number, constant, the word that tables show, what it says.
function write_status(body,    n, i, part, row, name) {
    gsub(/ *\n +/, " ", body)
    n = split(body, part, /\*\//)
    print "| | | word | |\n|---|---|---|---|"
    for (i = 1; i <= n; i++) {
        if (!match(part[i], /SURFMINK_[A-Z_]+ = [0-9]+/)) continue
        row = substr(part[i], RSTART, RLENGTH)
        name = row
        sub(/ .*/, "", name)
        sub(/.* /, "", row)
        sub(/.*\/\* */, "", part[i])
        sub(/ +$/, "", part[i])
        print "| " row " | `" name "` | `" tolower(substr(name, 10)) "` | " cell(part[i]) " |"
    }
    print ""
}

function write_type(body,    first, word) {
    first = body
    sub(/\n.*/, "", first)
    split(first, word, " ")
    here = word[1] == "enum" ? word[2] : word[3]
    if (here == "surfmink_status") print "## Status\n"
    print "### " here "\n"
    write_comment()
    if (here == "surfmink_status") {
        sub(/SURFMINK_OK = 0,/, "SURFMINK_OK = 0, /* all is well */", body)
        write_status(body)
    } else print "```c\n" body "\n```\n"
    here = ""
}

# --- the manual at the top: conventions, errors, configuration --------------------------------------------------------
# There a term begins in column 6 and its meaning in a column that the first line of a section shows.
function write_manual(title,    i, line, column, prose, term) {
    print "## " title "\n"
    text = ""
    here = "none"
    prose = !match(substr(comment[1], 6), /   +/)
    column = 5 + RSTART + RLENGTH
    if (!prose) print "| | |\n|---|---|"
    for (i = 1; i <= lines; i++) {
        line = comment[i]
        if (!prose && indent_of(line) == 5 && substr(line, column - 1, 2) ~ /^ [^ ]$/) {
            if (text != "") print "| " cell(term) " | " cell(text) " |"
            term = substr(line, 6, column - 6)
            sub(/ +$/, "", term)
            text = substr(line, column)
        } else if (!prose && indent_of(line) == 5) {
            print "| " cell(term) " | " cell(text) " |\n"
            prose = 1
            text = substr(line, 6)
        } else text = text (text == "" ? "" : " ") substr(line, indent_of(line) + 1)
    }
    if (prose) fill(markdown(text), "")
    else print "| " cell(term) " | " cell(text) " |"
    print ""
    lines = 0
    here = ""
}

# --- the file, line by line -------------------------------------------------------------------------------------------
/^   Implementation: / { exit }

/^#define SURFMINK_H$/ { started = 1 }

!started && /^   [A-Z]/ {
    if (wanted) write_manual(wanted)
    wanted = ""
    if (/^   CONVENTIONS/) wanted = "Conventions"
    if (/^   ERRORS/) wanted = "Errors"
    if (/^   CONFIGURE/) wanted = "Configuration"
    next
}
!started { if (wanted && NF) comment[++lines] = $0; next }

/^\/\* --- .* -+ \*\/$/ {
    print "## " title_of($0) "\n"
    next
}
/^\/\* / && !/^\/\* =/ { reading = 1; sub(/^\/\* /, "   ") }
reading {
    if (/\*\/$/) { reading = 0; ended = 1; sub(/ *\*\/$/, "") }
    comment[++lines] = $0
    next
}
/^SURFMINK_DEF / || (open_function && !/^$/) {
    open_function = 1
    declaration = declaration (declaration == "" ? "" : "\n") $0
    if (/;$/) {
        write_function(declaration)
        declaration = ""
        open_function = 0
    }
    next
}
/^(typedef struct|enum) / { in_type = 1 }
in_type {
    body = body (body == "" ? "" : "\n") $0
    if (/^}/) {
        write_type(body)
        body = ""
        in_type = 0
    }
    next
}
{ lines = 0 }
