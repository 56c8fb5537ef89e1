#!/usr/bin/env bash
# run.sh [--arm64] APP.apk [SCENARIO...]: plays the scenarios (all of them by default) with the library of a package.
# GLIMPSE: the command-line program that renders what is expected; EVENTS: of the storm; KEEP: a folder for pictures.
# --arm64 plays the arm64 library on an emulated processor, smaller and with more time.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
arm64=""
if [ "${1-}" = --arm64 ]; then
    arm64=yes
    shift
fi
[ $# -ge 1 ] || { sed -n 2,4p "$0" >&2; exit 2; }
apk=$(realpath "$1"); shift
glimpse=${GLIMPSE:-$here/../../target/release/glimpse}

# Small, for a processor draws it, yet messages need room.
if [ -n "$arm64" ]; then
    bash "$here/arm64.sh"
    out=$here/target/arm64
    folder=lib/aarch64-linux-gnu
    run=(qemu-aarch64 -L "$out/prefix" -E "LD_LIBRARY_PATH=$out/libraries:$out/prefix/$folder:$out/prefix/usr/$folder"
        -E "ANDROID_RUN_LIBRARIES=$out/libraries" -E "VK_DRIVER_FILES=$out/driver.json" "$out/android-run")
    abi=arm64-v8a pixels=64x36 roomy=320x180 slow=20
    everything=(start life rotate back again errors:no-vulkan)
else
    cargo build --release --quiet --manifest-path "$here/Cargo.toml"
    run=("${CARGO_TARGET_DIR:-$here/target}/release/android-run")
    abi=x86_64 pixels=160x90 roomy=640x360 slow=1
    everything=(start start:qhd life rotate touch back again view thermal thermal:28
        errors:no-vulkan errors:no-device errors:small-limits errors:lost-device storm)
fi
scenarios=("$@")
[ $# -gt 0 ] || scenarios=("${everything[@]}")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m zipfile -e "$apk" "$work/apk" 2>"$work/log" || { echo "$apk: expected a package, found another file" >&2; exit 1; }
app=$work/apk/lib/$abi/libglimpse_android.so
[ -f "$app" ] || { echo "$apk: expected lib/$abi/libglimpse_android.so, found none" >&2; exit 1; }

# expected NAME SIZE SCENE: a picture of the headless renderer, made once.
expected() {
    [ -f "$work/$1.png" ] || "$glimpse" render --size "$2" --output "$work/$1.png" "$3" >"$work/render.log"
    echo "$work/$1.png"
}
# The file that another app shares is a scene of the package.
shared=$(find "$work/apk/assets" -name '*.glb' | sort | head -n 1)

for scenario in "${scenarios[@]}"; do
    size=$pixels scene=builtin:room
    case $scenario in
    start:qhd) size=2560x1440 ;;
    view) size=$roomy scene=$shared ;;
    errors:*) size=$roomy ;;
    esac
    options=(--assets "$work/apk/assets" --files "$work/files-$scenario" --size "$size" --view "$size"
        --scene builtin:room --set 'overlay hidden; governor off' --slow "$slow"
        --expect "$(expected "$(basename "$scene")-$size" "$size" "$scene")")
    case $scenario in
    view) options+=(--content "$shared") ;;
    storm) options+=(--events "${EVENTS:-1000}") ;;
    *:28) options+=(--api 28) ;;
    esac
    [ -z "${KEEP:-}" ] || options+=(--keep "$KEEP/$scenario")
    # What follows the colon of these is how they are played, not what is.
    name=${scenario%:28}
    name=${name%:qhd}
    if ! "${run[@]}" "$app" "$name" "${options[@]}" >"$work/out" 2>"$work/log"; then
        cat "$work/log" "$work/out" >&2
        exit 1
    fi
    grep '^      ' "$work/out" || true
    echo "$scenario: $(tail -n 1 "$work/out")"
done
