#!/bin/sh
# Installs what building and packaging for Android without Google's SDK and NDK needs and a Debian with rustup lacks: a
# rustc that has the sources of std, and Debian's own packaging tools; and the packages that are named. Safe to run twice.
set -eu

packages="rustc-web rust-web-src aapt zipalign apksigner android-framework-res default-jre-headless python3 binutils unzip"
missing=""
for package in $packages "$@"; do
    if ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
        missing="$missing $package"
    fi
done
if [ -z "$missing" ]; then
    exit 0
fi
echo "setup: installing$missing"
if [ "$(id -u)" -eq 0 ]; then
    as_root=""
else
    as_root=sudo
fi
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get -q update
# shellcheck disable=SC2086 # names without spaces
$as_root apt-get -q install -y --no-install-recommends $missing
