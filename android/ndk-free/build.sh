#!/usr/bin/env bash
# Builds the library for Android without Google's SDK and NDK, on Debian or Ubuntu with rustup.
#
#   build.sh ARCH...        target/android/ARCH-linux-android/android/libglimpse_android.so; ARCH: aarch64, x86_64
#
# NDK_FREE_SYSROOT=DIR keeps what it links against there (below target/android): cargo compiles everything again for another.
#
# rustup's cargo drives Debian's rustc, which brings the sources of std; nothing of rustup changes. The linker is rustup's
# rust-lld. What it links against are shared objects that hold the names of Android's symbols up to the oldest API level
# (symbols.txt: library, symbol, level) and nothing else, so that a symbol which Android lacks is an error here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
project=$(cd "$here/../.." && pwd)
min_api=28

export CARGO_TARGET_DIR=$project/target/android
rustup_root=$(rustc --print sysroot)
# A nightly feature of cargo's: std is built from source. Fixed here, for this target alone.
export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
sysroots=${NDK_FREE_SYSROOT:-$CARGO_TARGET_DIR/sysroot-$min_api}
RUST_LLD=$(find "$rustup_root/lib/rustlib" -name rust-lld -path '*/bin/*' | head -n 1)
export RUST_LLD

# Shared objects with the symbols of Android, and std's unwinder, which only newer systems have in libc.
sysroot() {
    local arch=$1 folder=$2 emulation library
    case $arch in
    aarch64) emulation=aarch64linux ;;
    x86_64) emulation=elf_x86_64 ;;
    *)
        echo "build.sh: expected aarch64 or x86_64, found $arch" >&2
        return 2
        ;;
    esac
    mkdir -p "$folder"
    cp "$here/lld-cc" "$folder/"
    : >"$folder/nothing.ld"
    for library in libc libm libdl liblog libandroid; do
        awk -v library="$library" -v api="$min_api" \
            '$1 == library && $3 <= api { print "--defsym=" $2 "=0" }' "$here/symbols.txt" >"$folder/$library.names"
        "$RUST_LLD" -flavor gnu -m "$emulation" -shared -soname "$library.so" -o "$folder/$library.so" \
            "@$folder/$library.names" "$folder/nothing.ld"
    done
    if [ ! -f "$folder/libunwind.a" ]; then
        (cd "$here/unwind-static" && CARGO_TARGET_DIR=$folder/unwind \
            cargo build --quiet --release -Zbuild-std=core --target "$arch-linux-android")
        cp "$folder/unwind/$arch-linux-android/release/libunwind.a" "$folder/"
    fi
}

for arch; do
    folder=$sysroots/$arch
    sysroot "$arch" "$folder"
    # The same flags and linker in every call: others rebuild std.
    flags="-Lnative=$folder -Clink-arg=-Wl,-z,max-page-size=16384 -Clink-arg=-Wl,-z,defs -Clink-arg=-Wl,--build-id=sha1"
    name=CARGO_TARGET_${arch^^}_LINUX_ANDROID
    (cd "$project" && env "${name}_LINKER=$folder/lld-cc" "${name}_RUSTFLAGS=$flags" \
        cargo build --profile android -Zbuild-std=std,panic_abort --target "$arch-linux-android" -p glimpse-android)
done
