# What outlives a clone: compiled dependencies and lavapipe's kernels. Both are only faster than nothing: cargo and Mesa
# ask for what they find by what it was made from, and make what they do not find.
#
#   dependencies-*/  of the workspace, as cargo compiled them; by the versions of the compilers and the settings of profiles
#   kernels-*/       of the tests; by Mesa's version and by the setting that Mesa's own key lacks
#   ndk-free-*/      what the Android library links against: its path is among the settings by which cargo knows crates
#   android          a hash of what the Android package is made from, as of the last run that passed

cache=${GLIMPSE_CI_CACHE-${XDG_CACHE_HOME:-$HOME/.cache}/glimpse-ci}
# Kernels of all tests take 0.3 GB, dependencies 2 to 3 GB.
dependencies_limit_mib=6000
export MESA_SHADER_CACHE_MAX_SIZE=1G
# The one that is played.
abis=(x86_64)

hash_of() { sha256sum | cut -c1-16; }

# What the Android package is made from, besides the packages that the tests try as well.
android_hash() {
    { git ls-files -z -- android ':!*.md' Cargo.lock rust-toolchain.toml 2>/dev/null | xargs -0 sha256sum; } | hash_of
}

# What the dependencies follow from; cargo finds by itself what else has changed.
dependencies_hash() { git ls-files -z -- '*Cargo.toml' '*Cargo.lock' | xargs -0 sha256sum | hash_of; }

cache_open() {
    local mesa compilers
    if [ -z "$cache" ]; then
        export MESA_SHADER_CACHE_DIR="$PWD/target/lavapipe-$LP_NATIVE_VECTOR_WIDTH"
        echo "nothing is kept"
    else
        mesa=$(dpkg-query -W -f '${Version}' mesa-vulkan-drivers 2>/dev/null || echo unknown)
        compilers=$({ rustc -vV; /usr/bin/rustc -vV; env | grep ^CARGO_PROFILE | sort; } 2>/dev/null)
        dependencies="$cache/dependencies-$(hash_of <<<"$compilers")"
        export MESA_SHADER_CACHE_DIR="$cache/kernels-$mesa-$LP_NATIVE_VECTOR_WIDTH"
        NDK_FREE_SYSROOT="$cache/ndk-free-$({ echo "$compilers"; cat android/ndk-free/build.sh android/ndk-free/symbols.txt \
            android/ndk-free/unwind-static/Cargo.lock android/ndk-free/unwind-static/src/*; } | hash_of)"
        export NDK_FREE_SYSROOT
        mkdir -p "$MESA_SHADER_CACHE_DIR"
        # One of each kind.
        find "$cache" -mindepth 1 -maxdepth 1 -type d ! -path "$MESA_SHADER_CACHE_DIR" ! -path "$dependencies" \
            ! -path "$NDK_FREE_SYSROOT" -exec rm -rf {} +
        if [ -d "$dependencies" ] && [ ! -e target/release ]; then
            mkdir -p target
            cp -a --reflink=auto "$dependencies/target/." target/
        fi
        du -sh "$cache"/*/
        if [ -f "$cache/android" ] && [ "$(cat "$cache/android")" != "$(android_hash)" ]; then
            echo "what the Android package is made from has changed"
            abis=(arm64-v8a x86_64)
        fi
    fi
    if [ -n "${ANDROID_ABIS-}" ]; then
        read -ra abis <<<"$ANDROID_ABIS"
    fi
}

# Keeps what this run compiled, where it compiled any dependency. To be called after everything passed.
cache_keep() {
    local size new
    [ -n "$cache" ] || return 0
    android_hash >"$cache/android"
    if [ "$(cat "$dependencies/hash" 2>/dev/null)" = "$(dependencies_hash)" ]; then
        return 0
    fi
    new=$dependencies.$$
    mkdir -p "$new/target"
    for part in target/release target/android; do
        [ ! -d "$part" ] || cp -a --reflink=auto "$part" "$new/target/"
    done
    # Those of the workspace are compiled again in another folder anyway.
    cargo clean --quiet --workspace --release --target-dir "$new/target"
    for triple in "$new"/target/android/*-linux-android; do
        [ ! -d "$triple" ] || cargo clean --quiet --workspace --profile android --target "$(basename "$triple")" --target-dir "$new/target/android"
    done
    size=$(du -sm "$new" | cut -f1)
    rm -rf "$dependencies"
    # Crates that nothing needs any more are in it as well: it begins anew where they are many.
    if [ "$size" -gt "$dependencies_limit_mib" ]; then
        echo "dependencies: $size MiB, of which at most $dependencies_limit_mib are kept: the next run begins from nothing"
        rm -rf "$new"
    else
        dependencies_hash >"$new/hash"
        mv "$new" "$dependencies"
        echo "dependencies: $size MiB"
    fi
}
