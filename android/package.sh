#!/usr/bin/env bash
# Builds, packages, signs and checks the Android app: android/README.md.
#
#   bash android/package.sh [-o APK] [ABI...]       target/glimpse.apk; ABI: arm64-v8a, x86_64 (both)
#
# With ANDROID_NDK_HOME and ANDROID_HOME set, Google's NDK and build tools are used; else none of them is needed.
set -euo pipefail
cd "$(dirname "$0")/.."

out=target/glimpse.apk
if [ "${1-}" = -o ]; then
    out=${2:?expected a file after -o}
    shift 2
fi
[ $# -gt 0 ] || set -- arm64-v8a x86_64
min_api=28
target_api=36
library=libglimpse_android.so

arch_of() {
    case $1 in
    arm64-v8a) echo aarch64 ;;
    x86_64) echo x86_64 ;;
    *)
        echo "package.sh: expected arm64-v8a or x86_64, found $1" >&2
        return 2
        ;;
    esac
}

# Every step for Google's tools and for Debian's.
if [ -n "${ANDROID_NDK_HOME-}" ]; then
    tools=$(find "${ANDROID_HOME:?expected the SDK\'s folder beside ANDROID_NDK_HOME}/build-tools" -mindepth 1 -maxdepth 1 | sort -V | tail -n 1)
    PATH=$tools:$PATH
    frameworks=(-I "$ANDROID_HOME/platforms/android-$target_api/android.jar")
    bin=$(echo "$ANDROID_NDK_HOME"/toolchains/llvm/prebuilt/*/bin)
    build() {
        local arch=$1 name=CARGO_TARGET_${1^^}_LINUX_ANDROID
        rustup target add "$arch-linux-android"
        env "${name}_LINKER=$bin/$arch-linux-android$min_api-clang" \
            "${name}_RUSTFLAGS=-Clink-arg=-Wl,-z,max-page-size=16384 -Clink-arg=-Wl,--build-id=sha1" \
            CARGO_TARGET_DIR=target/android \
            cargo build --profile android --target "$arch-linux-android" -p glimpse-android
    }
    strip() { "$bin/llvm-strip" --strip-all -o "$2" "$1"; }
else
    sh android/ndk-free/setup.sh
    frameworks=(-I /usr/share/android-framework-res/framework-res.apk -I target/android/framework.apk)
    build() { bash android/ndk-free/build.sh "$1"; }
    strip() {
        local root
        root=$(rustc --print sysroot)
        LD_LIBRARY_PATH=$root/lib "$(find "$root/lib/rustlib" -name rust-objcopy | head -n 1)" --strip-all "$1" "$2"
    }
    mkdir -p target/android
    aapt package -f -x -M android/ndk-free/framework/AndroidManifest.xml -S android/ndk-free/framework/res \
        -F target/android/framework.apk
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
aapt package -f -M android/AndroidManifest.xml -S android/res -A android/assets "${frameworks[@]}" \
    --min-sdk-version "$min_api" --target-sdk-version "$target_api" -F "$work/base.apk" \
    2> >(grep -v -e '^ResourceType' -e 'Package not found for resource' >&2 || true)
for abi; do
    arch=$(arch_of "$abi")
    build "$arch"
    mkdir -p "$work/lib/$abi"
    strip "target/android/$arch-linux-android/android/$library" "$work/lib/$abi/$library"
    # Stored, not deflated: the system maps it from the package.
    python3 - "$work/base.apk" "$work" "lib/$abi/$library" <<'PY'
import sys, zipfile
package, folder, name = sys.argv[1:]
entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
with zipfile.ZipFile(package, "a") as archive, open(f"{folder}/{name}", "rb") as library:
    archive.writestr(entry, library.read())
PY
done
# 16 KiB for every entry: libraries are mapped where pages are that large.
zipalign -f 16384 "$work/base.apk" "$work/aligned.apk"

keystore=${KEYSTORE:-$HOME/.android/debug.keystore}
if [ ! -f "$keystore" ]; then
    mkdir -p "$(dirname "$keystore")"
    keytool -genkeypair -keystore "$keystore" -storepass android -alias androiddebugkey -keyalg RSA -keysize 2048 \
        -validity 10000 -dname "CN=Android Debug,O=Android,C=US" 2>/dev/null
fi
mkdir -p "$(dirname "$out")"
# Both schemes: v2 for what reads no v3.
apksigner sign --ks "$keystore" --ks-pass "pass:${KEYSTORE_PASSWORD:-android}" --min-sdk-version 24 \
    --v1-signing-enabled false --v4-signing-enabled false --out "$out" "$work/aligned.apk"
python3 android/verify.py "$out" "$@"
