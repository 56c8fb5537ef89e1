#!/usr/bin/env bash
# Makes what run.sh --arm64 needs below android/host/target/arm64, on Debian 12: an arm64 glibc, Mesa and Vulkan loader
# (prefix/), its driver's manifest (driver.json), and the host (libraries/, android-run). qemu-user and a cross compiler are
# installed; nothing else of the system is touched: apt keeps its lists of arm64 in that folder.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
sh "$here/../ndk-free/setup.sh" qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross

out=$here/target/arm64
prefix=$out/prefix
if [ ! -f "$out/driver.json" ]; then
    mkdir -p "$out/lists/partial" "$out/archives/partial" "$prefix"
    : >"$out/status"
    cat >"$out/sources.list" <<'SOURCES'
deb http://deb.debian.org/debian bookworm main
deb http://deb.debian.org/debian bookworm-backports main
SOURCES
    apt() {
        apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::lists="$out/lists" \
            -o Dir::State::status="$out/status" -o Dir::Cache::archives="$out/archives" -o Dir::Cache::pkgcache= \
            -o Dir::Cache::srcpkgcache= -o Dir::Etc::sourcelist="$out/sources.list" -o Dir::Etc::sourceparts=/nonexistent \
            -o APT::Sandbox::User=root -o Debug::NoLocking=1 "$@"
    }
    apt update
    apt -y --download-only --no-install-recommends -t bookworm-backports install \
        mesa-vulkan-drivers libvulkan1 libc6 libgcc-s1
    for package in "$out"/archives/*.deb; do
        dpkg -x "$package" "$prefix"
    done
    sed -E "s#(\"library_path\": \")(.*/)?#\\1$prefix/usr/lib/aarch64-linux-gnu/#" \
        "$prefix/usr/share/vulkan/icd.d/lvp_icd.json" >"$out/driver.json"
fi

# rustup has no std for this target either.
RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    cargo build --release --quiet -Zbuild-std --target aarch64-unknown-linux-gnu --manifest-path "$here/Cargo.toml"
built=$here/target/aarch64-unknown-linux-gnu/release
mkdir -p "$out/libraries"
for name in libc libm libdl liblog libandroid libvulkan; do
    ln -sf "$built/libglimpse_android_host.so" "$out/libraries/$name.so"
done
ln -sf "$built/android-run" "$out/android-run"
