#!/usr/bin/env bash
# run.sh APP.apk [SCENARIO...]: plays the scenarios (all of them by default) with the x86_64 library of a package.
# GLIMPSE: the command-line program that renders what is expected; EVENTS: of the storm; KEEP: a folder for pictures.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,3p "$0" >&2; exit 2; }
apk=$(realpath "$1"); shift
here=$(cd "$(dirname "$0")" && pwd)
glimpse=${GLIMPSE:-$here/../../target/release/glimpse}
scenarios=("$@")
if [ ${#scenarios[@]} -eq 0 ]; then
    scenarios=(start start:qhd life rotate touch back again view thermal thermal:28
        errors:no-vulkan errors:no-device errors:small-limits errors:lost-device storm)
fi

cargo build --release --quiet --manifest-path "$here/Cargo.toml"
run=${CARGO_TARGET_DIR:-$here/target}/release/android-run

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m zipfile -e "$apk" "$work/apk"
app=$work/apk/lib/x86_64/libglimpse_android.so
[ -f "$app" ] || { echo "$apk: expected lib/x86_64/libglimpse_android.so, found none" >&2; exit 1; }

# Small, for a processor draws it, yet messages need room; the file that another app shares is a scene of the package.
pixels=160x90
roomy=640x360
shared=$(find "$work/apk/assets" -name '*.glb' | sort | head -n 1)
"$glimpse" render --size $pixels --output "$work/room.png" builtin:room > "$work/render.log"
"$glimpse" render --size $roomy --output "$work/room-roomy.png" builtin:room > "$work/render.log"
"$glimpse" render --size $roomy --output "$work/shared.png" "$shared" > "$work/render.log"

if [[ " ${scenarios[*]} " == *" start:qhd "* ]]; then
    "$glimpse" render --output "$work/qhd.png" builtin:room > "$work/render.log"
fi

for scenario in "${scenarios[@]}"; do
    options=(--assets "$work/apk/assets" --files "$work/files-$scenario" --size $pixels --view $pixels
        --scene builtin:room --set 'overlay hidden; governor off' --expect "$work/room.png")
    # What follows the colon of these is how they are played, not what is.
    name=${scenario%:28}
    name=${name%:qhd}
    [ -z "${KEEP:-}" ] || options+=(--keep "$KEEP/$scenario")
    case $scenario in
        start:qhd) options+=(--view 2560x1440 --size 2560x1440 --expect "$work/qhd.png") ;;
        view) options+=(--content "$shared" --expect "$work/shared.png" --size $roomy --view $roomy) ;;
        storm) options+=(--events "${EVENTS:-1000}") ;;
        *:28) options+=(--api 28) ;;
        errors:*) options+=(--size $roomy --view $roomy --expect "$work/room-roomy.png") ;;
    esac
    if ! "$run" "$app" "$name" "${options[@]}" > "$work/out" 2> "$work/log"; then
        cat "$work/log" "$work/out" >&2
        exit 1
    fi
    grep '^      ' "$work/out" || true
    echo "$scenario: $(tail -n 1 "$work/out")"
done
