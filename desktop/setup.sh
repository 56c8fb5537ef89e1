#!/bin/sh
# Installs what Glimpse needs and a fresh Debian or Ubuntu with rustup and git lacks:
#
#   - a C and a C++ compiler (linking Rust; the FLIP metric is C++),
#   - the Vulkan loader (libvulkan.so.1),
#   - a Vulkan driver where there is none: Mesa's lavapipe, which renders on the CPU,
#   - the libraries that a window loads when it opens (keyboards, pointers, X11),
#   - Xvfb, an X server without a screen, in which the tests open windows.
#
# It prints what it will install, add and replace before it changes anything, and changes nothing else: where nothing is
# missing it does nothing, so it is safe to run twice. Without root it uses sudo, which may ask for a password.
#
# A driver counts as present when a manifest (ICD, *.json) lies where the loader looks, and stays as it is. Debian bookworm
# gets its driver from bookworm-backports: the Mesa 22.3 of bookworm itself has no headless surface and renders other
# pixels than the golden frames of the tests.
#
#   sh desktop/setup.sh --golden-driver     the driver of the golden frames, in place of an older one of bookworm
#
# GLIMPSE_SETUP_ROOT=DIR looks for the system's files below DIR (the test of this script).
set -eu

mesa_version="25.0.7-2~bpo12+1"
golden_driver=""
case ${1-} in
"") ;;
--golden-driver) golden_driver=yes ;;
*)
    echo "setup: expected nothing or --golden-driver, found $1" >&2
    exit 2
    ;;
esac
root=${GLIMPSE_SETUP_ROOT-}
if [ -z "$root" ]; then
    PATH=$PATH:/usr/sbin:/sbin # ldconfig, for users
fi

say() { echo "setup: $*"; }
fail() {
    echo "setup: $*" >&2
    exit 1
}

if [ "$(uname -s)" != Linux ]; then
    say "on $(uname -s) the system's own compiler and graphics driver are used"
    exit 0
fi

codename=""
if [ -r "$root/etc/os-release" ]; then
    codename=$(. "$root/etc/os-release" && echo "${VERSION_CODENAME-}")
fi

# Whether a driver manifest lies where the Vulkan loader looks.
has_manifest() {
    for list in "${VK_DRIVER_FILES-}" "${VK_ICD_FILENAMES-}"; do
        old_ifs=$IFS
        IFS=:
        for entry in $list; do
            if [ -f "$entry" ]; then
                IFS=$old_ifs
                return 0
            fi
        done
        IFS=$old_ifs
    done
    for folder in \
        "${XDG_CONFIG_HOME:-$root${HOME-}/.config}" "$root/etc/xdg" "$root/etc" "$root/usr/local/etc" \
        "${XDG_DATA_HOME:-$root${HOME-}/.local/share}" "$root/usr/local/share" "$root/usr/share"; do
        for manifest in "$folder"/vulkan/icd.d/*.json; do
            if [ -f "$manifest" ]; then
                return 0
            fi
        done
    done
    return 1
}

has_gpu() {
    for node in "$root"/dev/dri/renderD* "$root"/dev/nvidia[0-9]* "$root"/dev/dxg; do
        if [ -e "$node" ]; then
            return 0
        fi
    done
    return 1
}

installed_version() { dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true; }

packages=""
reasons=""
if ! command -v cc >/dev/null; then
    packages="$packages gcc libc6-dev"
    reasons="$reasons, a C compiler"
fi
if ! command -v c++ >/dev/null; then
    packages="$packages g++"
    reasons="$reasons, a C++ compiler"
fi
libraries=$(ldconfig -p 2>/dev/null || true)
has_library() { echo "$libraries" | grep -qF "$1"; }
if ! has_library libvulkan.so.1; then
    packages="$packages libvulkan1"
    reasons="$reasons, the Vulkan loader"
fi
window=""
for pair in libxkbcommon.so.0:libxkbcommon0 libxkbcommon-x11.so.0:libxkbcommon-x11-0 \
    libX11-xcb.so.1:libx11-xcb1 libXcursor.so.1:libxcursor1 libXi.so.6:libxi6; do
    if ! has_library "${pair%%:*}"; then
        window="$window ${pair#*:}"
    fi
done
if [ -n "$window" ]; then
    packages="$packages$window"
    reasons="$reasons, libraries of windows"
fi
if ! command -v Xvfb >/dev/null; then
    packages="$packages xvfb"
    reasons="$reasons, Xvfb for the tests"
fi
driver=""
replaced=""
if ! has_manifest; then
    driver=mesa-vulkan-drivers
    reasons="$reasons, a Vulkan driver"
elif [ "$codename" = bookworm ]; then
    mesa=$(installed_version mesa-vulkan-drivers)
    case $mesa in
    22.*)
        if [ -n "$golden_driver" ]; then
            driver=mesa-vulkan-drivers
            replaced=$mesa
            reasons="$reasons, the driver of the golden frames"
        elif [ -z "${VK_DRIVER_FILES-}${VK_ICD_FILENAMES-}" ] && ! has_gpu; then
            say "keeping Mesa $mesa: tests of golden frames and of windows may fail with it, and" \
                "'sh desktop/setup.sh --golden-driver' replaces it by $mesa_version"
        fi
        ;;
    esac
elif [ -n "$golden_driver" ]; then
    say "keeping the driver: the one of the golden frames is packaged for Debian bookworm alone"
fi

if [ -z "$packages$driver" ]; then
    exit 0
fi
say "missing: ${reasons#, }"

if ! command -v apt-get >/dev/null; then
    fail "there is no apt-get here: install these with your system's package manager and run this again:${reasons#,}"
fi
sudo=""
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "installing needs root, and there is no sudo: run 'sh desktop/setup.sh' as root"
    sudo=sudo
fi

from_backports=""
source=""
if [ -n "$driver" ] && [ "$codename" = bookworm ]; then
    from_backports=yes
    if ! grep -qs '^[^#]*bookworm-backports' "$root/etc/apt/sources.list" "$root"/etc/apt/sources.list.d/*; then
        source="$root/etc/apt/sources.list.d/glimpse-backports.sources"
    fi
else
    packages="$packages${driver:+ $driver}"
fi

say "this changes the system:"
if [ -n "$source" ]; then
    say "  adds the apt source $source (Debian's bookworm-backports)"
fi
if [ -n "$packages" ]; then
    say "  installs$packages"
fi
if [ -n "$replaced" ]; then
    say "  replaces $driver $replaced by $mesa_version of bookworm-backports"
elif [ -n "$from_backports" ]; then
    say "  installs $driver $mesa_version of bookworm-backports"
fi
if [ -n "$sudo" ]; then
    say "  by sudo, which may ask for your password"
fi

as_root() {
    say "running: $*"
    # shellcheck disable=SC2086 # empty when we are root
    $sudo env DEBIAN_FRONTEND=noninteractive "$@" || fail "that failed: $*"
}

# Installs packages, and says before which installed ones apt replaces for them.
install() {
    apt-get -s install --no-install-recommends "$@" 2>/dev/null |
        while read -r word package old new _; do
            case $word$old in
            Inst\[*)
                old=${old#[}
                say "  replaces $package ${old%]} by ${new#(}"
                ;;
            esac
        done
    as_root apt-get install -y -qq --no-install-recommends "$@"
}

if [ -n "$source" ]; then
    $sudo tee "$source" >/dev/null <<'SOURCE' || fail "cannot write $source"
# Added by Glimpse's desktop/setup.sh, for mesa-vulkan-drivers.
Types: deb
URIs: http://deb.debian.org/debian
Suites: bookworm-backports
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
SOURCE
fi
as_root apt-get update -qq
if [ -n "$packages" ]; then
    # shellcheck disable=SC2086 # a list
    install $packages
fi
if [ -n "$from_backports" ]; then
    if apt-cache madison "$driver" | grep -qF " $mesa_version "; then
        driver="$driver=$mesa_version"
    else
        say "Mesa $mesa_version is no longer in bookworm-backports: taking its newest (golden frames may differ)"
    fi
    install -t bookworm-backports "$driver"
fi
say "done"
