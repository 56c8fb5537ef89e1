#!/usr/bin/env bash
# Whether one compilation of the dependencies serves both commands of the README: the program and the documentation select
# each third-party crate with the features that the tests select.
set -euo pipefail
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')

# crates SELECTION...: third-party crates, each with its version and features. Those of the workspace have a path.
crates() {
    cargo tree --locked --target "$host" --prefix none --format '{p} [{f}]' "$@" |
        sed -e 's/ (\*)$//' -e 's/ (proc-macro)//' | grep -v ' (/' | sort -u
}

tests=$(crates --workspace --edges normal,build,dev)
differs=""
compare() {
    local other
    other=$(comm -23 <(crates "$@") <(printf '%s\n' "$tests"))
    if [ -n "$other" ]; then
        echo "cargo tree $*: expected the features that \`cargo test --workspace\` selects, found" >&2
        printf '  %s\n' "${other//$'\n'/$'\n  '}" >&2
        differs=yes
    fi
}
compare --edges normal,build
compare --edges normal,build --workspace --exclude glimpse-android
if [ -n "$differs" ]; then
    echo "name them in [workspace.dependencies] of Cargo.toml, so that every package selects the same" >&2
    exit 1
fi
echo "$(printf '%s\n' "$tests" | wc -l) crates, compiled once"
