# pool.sh - to be sourced. pool DIRECTORY: runs every DIRECTORY/*.sh, JOBS at a time (one a processor), and waits.
# NAME.sh finds a folder of its own in $here = DIRECTORY/NAME, and leaves there what it printed (said), its exit status
# (status) and the time it took (times; the second line is that of the processor).
worker() {
    for script in "$1"/*.sh; do
        here=${script%.sh}
        mkdir "$here" 2> /dev/null || continue # another worker has it
        (
            here=$here sh "$script" > "$here/said" 2>&1 < /dev/null
            echo $? > "$here/status"
            times > "$here/times"
        )
    done
}

pool() {
    jobs=${JOBS:-$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)}
    while [ "$jobs" -gt 1 ]; do
        worker "$1" &
        jobs=$((jobs - 1))
    done
    worker "$1"
    wait
}
