# The steps of .ci/run: a line before each, with the time so far, and all of them with their times at the end.
# A command that fails ends the run; so does one that failed behind the others.

step_name="" step_began=0
steps_done=()
declare -A behind_pid=()
logs=$(mktemp -d)

end_step() {
    if [ -n "$step_name" ]; then
        steps_done+=("$(printf '%6d s  %s' $((SECONDS - step_began)) "$step_name")")
    fi
}

step() {
    end_step
    step_name=$* step_began=$SECONDS
    printf '\n== %s (%d s)\n' "$step_name" "$SECONDS"
}

# behind NAME COMMAND...: runs it at the lowest priority behind the following steps; `await NAME` shows what it printed.
behind() {
    local name=$1
    shift
    # A group of its own, so that it ends as a whole.
    setsid nice -n 19 "$@" >"$logs/$name" 2>&1 </dev/null &
    behind_pid[$name]=$!
}

await() {
    local status=0
    wait "${behind_pid[$1]}" || status=$?
    unset "behind_pid[$1]"
    cat "$logs/$1"
    return "$status"
}

on_exit() {
    local status=$? name
    for name in "${!behind_pid[@]}"; do
        kill -- "-${behind_pid[$name]}" 2>/dev/null || true
    done
    rm -rf "$logs"
    end_step
    printf '\n'
    printf '%s\n' "${steps_done[@]}"
    printf '%6d s  in all\n' "$SECONDS"
    if [ "$status" -ne 0 ]; then
        printf '== failed: %s\n' "$step_name"
    fi
}
trap on_exit EXIT

all_passed() {
    step "all passed"
    step_name=""
}
