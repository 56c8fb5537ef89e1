#!/bin/sh
# Takes the pictures of app/README.md, desktop/window.png and desktop/split.png, on an X server without a screen
# (Xvfb, which desktop/setup.sh installs).
set -eu
cd "$(dirname "$0")/.."
if ! command -v Xvfb >/dev/null; then
    echo "screenshots: there is no Xvfb here: run 'sh desktop/setup.sh'" >&2
    exit 1
fi
cargo build --release -p glimpse-desktop

folder=$(mktemp -d)
server=""
finish() {
    [ -z "$server" ] || kill "$server"
    rm -r "$folder"
}
trap finish EXIT
mkfifo "$folder/number"
Xvfb -displayfd 3 -screen 0 1280x720x24 -nolisten tcp -noreset 3>"$folder/number" 2>/dev/null &
server=$!
read -r number <"$folder/number"
DISPLAY=:$number target/release/glimpse view builtin:room --size 1280x720 --script desktop/screenshots.script
