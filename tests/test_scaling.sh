#!/bin/sh
# test_scaling.sh COMMAND [MPI_CELLS]: a table that is measured in parts gives the bytes, complaints and exit status of
# one run. Alone with COMMAND it needs a POSIX shell: examples/scaling/part.sh and slurm.sh. With MPI_CELLS, which is
# examples/scaling/mpi_cells.c, it needs mpirun and GNU parallel, and looks at these.
. "$(dirname "$0")/harness.sh"
surfmink=$(absolute "$1")
mpi_cells=${2:+$(absolute "$2")}
scaling=$PWD/examples/scaling data=$PWD/examples/data
export SURFMINK="$surfmink"
cd "$work" || exit 1
tab=$(printf '\t')

# --- tables that are hard to cut --------------------------------------------------------------------------------------

# Squares and others, some refused; comments and blank lines that mean nothing; the same id once more, later; a cell
# of 40 corners, longer than a part.
named() {
    printf '# cells\n\n  # of a tissue\ncell%sx%sy\n' "$1" "$1"
    for cell in a b longer a; do
        for corner in "0 0" "2 0" "2 1" "0 1"; do echo "$cell $corner"; done
        echo "# after $cell"
    done | tr ' ' "$1"
    i=0
    while [ $i -lt 40 ]; do
        echo "bowl$1$i$1$((i * i))"
        i=$((i + 1))
    done
    printf '\nclockwise 0 0\nclockwise 0 1\n\nclockwise 1 0\nd 0 0\nd 1 0\nd 1 0\ne 0 0\ne 1 0\ne 0 1\n' | tr ' ' "$1"
}
unnamed() {
    printf 'x y\n'
    for height in 1 2 3; do
        printf '0 0\n1 0\n1 %s\n# half of it\n0 %s\n\n' $height $height
        printf '   \n\n'
    done
    printf '0 0\n0 1\n1 0\n\n0 0\n1 0\n0 1'
}
named "$tab" > tabs
named "$tab" | sed "s/^d$tab/d $tab/" | awk 'NR % 3 { print; next } { print $0 "\r" }' > windows
named , > commas.csv
printf '\357\273\277' > blanks
named ' ' | awk '{ print "  " $0 "  " }' >> blanks
named "$tab" | awk -F "$tab" -v OFS="$tab" 'NF == 3 { print $2, $3, $1; next } { print }' > last
unnamed > unnamed
printf 'cell\tx\ty' > torn
printf 'cell\tx\ty\na\t0\t0\na\t1\t0\na\t0\t1' > one
named "$tab" | sed "s/^b${tab}2${tab}1/b${tab}2${tab}one/" > no_number
named "$tab" | sed "s/^b${tab}0${tab}1/b${tab}0${tab}1${tab}0/" > too_many
named "$tab" | sed "s/^longer${tab}2${tab}0/longer/" > too_few
named ' ' | awk 'NF == 3 && $1 != "cell" { print $2, $3; next } NR == 4 { print "x y n"; next } { print }' > no_id
# Separators, quotes and ids that are not where a script would look for them.
named , | sed 's/^\([a-z]*\),/"\1,, ""x""",/; s/^"cell,, ""x"""/"the, ""cell"""/' > quoted.csv
named "$tab" | awk -F "$tab" -v OFS="$tab" '/^cell/ { print "X", "k", "Y", "K"; next }
    NF == 3 && !/^#/ { print $2, 7, $3, $1; next } { print }' > capitals
named ' ' | awk '/^cell/ { print $0 "\t"; next } 
    NF == 3 && !/^#/ { print $1 "\v" $2 " \f" $3 "\v"; next } { print }' > feeds
named "$tab" | awk -F "$tab" -v OFS="$tab" '/^cell/ { print "", "x", "y", "cell", "row"; next }
    NF == 3 && !/^#/ { print NR, $2, $3, "  " $1 " ", NR; next } { print }' > numbered
tables="tabs windows commas.csv blanks last unnamed torn one no_number too_many too_few no_id quoted.csv"

# single TABLE OPTION...: one run, to hold the others against.
single() {
    table=$1
    shift
    "$surfmink" "$@" "$table" > want 2> want.err
    want=$?
    refusals want.err
}

# refusals FILE: without the notes about what a run sees of its table, of which a part sees less, and without the ids of
# outlines that have none but their number, which in a part counts from 0.
refusals() {
    sed 's/^\(unnamed:[0-9]*: \)[0-9]*: /\1/' "$1" | grep -v -e ': id: ' -e ' comes again: only lines' \
        -e '^surfmink: [0-9]* measured' -e "^[^:]*:[0-9]*: column '.*' changes within" > plain.err
    mv plain.err "$1"
}

# same NAME STATUS: what is in got and got.err.
same() {
    check "$1: exit status" "$2" "$want"
    cmp want got > said 2>&1
    count $? "$1: results" "$(cat said)" ""
    refusals got.err
    cmp want.err got.err > said 2>&1
    count $? "$1: complaints" "$(cat said; head -n 3 got.err)" "$(head -n 3 want.err)"
}

if [ ! "$mpi_cells" ]; then

    # --- part.sh ------------------------------------------------------------------------------------------------------

    # Wherever it is cut: the parts are the table, line by line, and no outline is in two of them.
    parts() {
        LC_ALL=C awk '{ print } NR == 1 { sub(/^\357\273\277/, "") } !/^[ \t]*#/ && /[^ \t]/ { exit }' "$1" > names
        lines=$(($(wc -l < names)))
        awk -v lines=$lines 'NR > lines' "$1" > body
        part=0 whole=0 split=0 total=0
        : > joined
        while [ $part -lt "$2" ]; do
            sh "$scaling/part.sh" $part "$2" "$1" counts > piece
            awk -v lines=$lines 'NR > lines' piece > piece.body
            head -n $lines piece | cmp -s - names || whole=$((whole + 1))
            read -r a b c < counts
            [ "$a" -eq $lines ] && [ "$b" -eq $(($(wc -l < piece.body))) ] && [ "$c" -eq "$3" ] || total=$((total + 1))
            "$surfmink" --quiet piece | awk 'NR > 1 { n++ } END { print n + 0 }' >> rows
            cat piece.body >> joined
            part=$((part + 1))
        done
        cmp body joined > said 2>&1
        count $? "$1 in $2 parts: they are the table" "$(cat said)" ""
        check "$1 in $2 parts: each has the names" $whole 0
        check "$1 in $2 parts: each counts itself" $total 0
        check "$1 in $2 parts: no outline is cut" "$(awk '{ n += $1 } END { print n }' rows)" \
            "$("$surfmink" --quiet "$1" | awk 'END { print NR - 1 }')"
        rm -f rows
    }
    parts tabs 9 1
    parts unnamed 7 0
    for table in windows blanks quoted.csv capitals feeds numbered; do parts $table 4 1; done
    sh "$scaling/part.sh" 2 2 tabs > out 2> err
    check "there is no part 2 of 2" $? 1
    tr '\n' '\r' < tabs > mac
    printf 'cell\tx\ty\na\t0\t0\na\t1\t0\na\t1\t1\na\t0\t1\ra\t0\t2\nb\t0\t0\n' > mixed
    for table in mac mixed; do
        sh "$scaling/part.sh" 0 2 $table > out 2> err
        check "$table, lines that end with \\r alone: exit status" $? 1
        has "$table, lines that end with \\r alone: message" err "$table: lines end with \\r alone"
    done

    # --- slurm.sh -----------------------------------------------------------------------------------------------------

    # array PARTS TABLE OPTION...: as Slurm would run it, the last part first.
    array() {
        rm -rf got got.parts
        task=$1
        while [ "$task" -gt 0 ]; do
            task=$((task - 1))
            SLURM_ARRAY_TASK_ID=$task sh "$scaling/slurm.sh" "$1" "$2" got "$3" "$4"
        done
        sh "$scaling/slurm.sh" --join "$1" "$2" got 2> got.err
    }
    for table in $tables; do
        single $table --max-rank 3
        case $table in
        tabs) numbers="1 5" ;;
        windows | unnamed | no_number) numbers=3 ;;
        *) numbers=2 ;;
        esac
        for number in $numbers; do
            array $number $table --max-rank 3 > array.out 2>&1
            same "slurm.sh, $table in $number parts" $?
        done
    done
    for table in tabs unnamed; do
        single $table --json --reverse=auto
        array 2 $table --json --reverse=auto
        same "slurm.sh, $table as JSON" $?
    done
    rm got.parts/0.status got.parts/1.status
    sh "$scaling/slurm.sh" --join 3 tabs got 2> err
    check "parts that are missing: exit status" $? 1
    has "parts that are missing: message" err "not finished: 0 1 2"
else

    # --- GNU parallel -------------------------------------------------------------------------------------------------

    # One line of names, from the first part.
    one_head() {
        awk 'NR == 1 { names = $0; print; next } $0 != names'
    }
    grep -v '^#' "$data/countries.tsv" > countries.tsv
    cp "$data/tissue.tsv" tissue.tsv
    for table in countries.tsv tissue.tsv; do
        single $table --quiet
        seq 0 6 | parallel -k "sh $scaling/part.sh {} 7 $table | $surfmink --quiet" 2> got.err | one_head > got
        same "parallel, parts of $table" "$want"
    done
    single countries.tsv --quiet
    parallel -k --pipe --block 20k --header : --colsep '\t' --group-by country "$surfmink --quiet" < countries.tsv \
        2> got.err | one_head > got
    same "parallel --pipe --group-by an id" "$want"
    awk '{ print } /^x/ { print "" } /^[^x]/ { n++ } n == 4 { n = 0; print "" }' << 'XY' > groups
x y
0 0
1 0
1 1
0 1
0 0
2 0
2 1
0 1
0 0
3 0
3 1
0 1
XY
    single groups --quiet
    parallel -k --pipe -N 1 --header '.*\n\n' --recend '\n\n' "$surfmink --quiet" < groups 2> got.err | one_head |
        awk -F "$tab" -v OFS="$tab" 'NR > 1 { $1 = NR - 2 } { print }' > got
    same "parallel --pipe, outlines without ids" "$want"

    # --- MPI ----------------------------------------------------------------------------------------------------------

    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
    export OMPI_MCA_btl_vader_single_copy_mechanism=none

    # ranks NUMBER ARGUMENT...: leaves got.err and $status.
    ranks() {
        number=$1
        shift
        timeout 60 mpirun -q -n "$number" "$mpi_cells" "$@" > got.out 2> got.err
        status=$?
        check "mpi_cells says nothing on standard output" "$(cat got.out)" ""
    }
    for table in tabs windows last unnamed torn one no_number too_many; do
        single $table --max-rank 3
        ranks 3 --piece 97 got --max-rank 3 $table
        same "3 ranks, $table" $status
    done
    single tabs
    ranks 1 --piece 13 got tabs
    same "1 rank, pieces of 13 bytes" $status
    single unnamed
    ranks 2 --piece 1 got unnamed
    same "2 ranks, pieces of one byte" $status
    { cat tabs; printf 'f\t0\t0\rf\t1\t0\rf\t0\t1\r\r# old\rg\t0\t0\rg\t3\t0\rg\t0\t4\rg\t0\t1'; } > mac
    single mac
    ranks 2 --piece 5 got mac
    same "2 ranks, lines that end in \\r" $status
    named , | sed 's/^\([a-z]*\),/"\1,, ""x""",/' > quoted.csv
    single quoted.csv
    ranks 2 --piece 60 got quoted.csv
    same "2 ranks, quoted ids with commas" $status
    { sed -n 1,30p tabs && printf 'zero\t0\t\0\n' && cat tabs; } > zero
    single zero
    ranks 3 --piece 50 got zero
    same "3 ranks, a zero byte" $status
    single "$data/countries.tsv" --json --reverse auto
    ranks 3 --piece 20000 got --json --reverse auto "$data/countries.tsv"
    same "3 ranks, countries as JSON" $status
    single "$data/tissue.tsv"
    cp "$data/countries.tsv" got # longer than the result: none of it may stay
    ranks 3 got "$data/tissue.tsv"
    same "3 ranks, one piece, into a file that is longer" $status

    single missing.tsv
    ranks 2 got missing.tsv
    check "a table that is missing: exit status" $status 1
    check "a table that is missing: complaint" "$(head -n 1 got.err)" "$(cat want.err)"
    ranks 2 got tabs tabs
    check "two tables: exit status" $status 1
    has "two tables: complaint" got.err "mpi_cells reads one table"
    ranks 2 tabs tabs
    check "the table as its own result: exit status" $status 1
    check "the table as its own result is not lost" "$(named "$tab" | cmp - tabs && echo same)" same
    ranks 2 no/such/folder tabs
    check "a result that cannot be written: exit status" $status 1
    has "a result that cannot be written: complaint" got.err "no/such/folder: "
fi

totals
