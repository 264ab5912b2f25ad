#!/usr/bin/env bash
# The whole test suite in one command: `bash tests/run.sh`, from any folder, as root or with sudo.
#
# On Debian it installs what is missing: a linker for Rust, Mesa's lavapipe, the validation layer,
# SwiftShader, which comes with chromium, and ffmpeg. With everything in place it needs no network for that.
# Then format, lints, documentation and tests, GPU tests on both drivers required. It stops at the
# first step that fails, names it, and ends with an exit code other than 0.
set -Eeuo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

step="starting"
trap 'echo "tests/run.sh: failed while $step" >&2' ERR

begin() {
    step=$1
    echo "=== $step (${SECONDS} s)"
}

fail() {
    echo "tests/run.sh: $*" >&2
    exit 1
}

as_root() {
    if [ "$(id -u)" = 0 ]; then
        env DEBIAN_FRONTEND=noninteractive "$@"
    elif command -v sudo >/dev/null; then
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    else
        fail "$step needs root or sudo: $*"
    fi
}

# The first file of that name in the folders; nothing where there is none. The name of lavapipe's
# has the architecture in it.
find_icd() {
    local name=$1
    shift
    find "$@" -name "$name" 2>/dev/null | sort | head -n 1 || true
}

find_icds() {
    lavapipe=$(find_icd 'lvp_icd*.json' /usr/share/vulkan/icd.d)
    swiftshader=$(find_icd vk_swiftshader_icd.json /usr/lib/chromium)
}

install() {
    command -v apt-get >/dev/null || fail "no apt-get here: install what Debian calls $*"
    as_root apt-get install -q -y --no-install-recommends "$@"
}

begin "looking for what the tests need"
command -v cargo >/dev/null ||
    fail "there is no cargo: install Rust first, with rustup or otherwise"
if ! { cargo fmt --version && cargo clippy --version; } >/dev/null 2>&1; then
    # Rust's small profile comes without them.
    begin "installing rustfmt and clippy"
    rustup component add rustfmt clippy
fi
find_icds
missing=()
command -v cc >/dev/null || missing+=(gcc libc6-dev)
[ -n "$lavapipe" ] || missing+=(mesa-vulkan-drivers)
case $(PATH=$PATH:/sbin:/usr/sbin ldconfig -p) in
*libvulkan.so.1*) ;;
*) missing+=(libvulkan1) ;;
esac
[ -e /usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json ] ||
    missing+=(vulkan-validationlayers)
command -v ffmpeg >/dev/null || missing+=(ffmpeg)
# The driver lies in chromium-common, which is a third of chromium.
[ -n "$swiftshader" ] || missing+=(chromium-common)
if [ "${#missing[@]}" -gt 0 ]; then
    begin "installing ${missing[*]}"
    as_root apt-get update -q
    install "${missing[@]}"
    find_icds
    if [ -z "$swiftshader" ]; then
        install chromium
        find_icds
    fi
fi
[ -n "$lavapipe" ] || fail "mesa-vulkan-drivers has brought no lvp_icd*.json"
[ -n "$swiftshader" ] || fail "chromium has brought no vk_swiftshader_icd.json"
export VK_DRIVER_FILES=$lavapipe:$swiftshader
# Loaders before 1.3.207 know the variable by its old name.
export VK_ICD_FILENAMES=$VK_DRIVER_FILES
# Mesa's layer that picks a device would look for a Wayland session and complain that there is none.
export NODEVICE_SELECT=1
# Films are made and looked at, not skipped.
export MOTES_REQUIRE_FFMPEG=1
# Tests say themselves where they run.
unset MOTES_ADAPTER
echo "drivers: $VK_DRIVER_FILES"

begin "cargo fmt --check"
cargo fmt --check
begin "cargo clippy"
cargo clippy --locked --all-targets -- -D warnings
begin "cargo clippy, without a window"
cargo clippy --locked --no-default-features -- -D warnings
begin "cargo doc"
RUSTDOCFLAGS="-D warnings" cargo doc --locked --no-deps
begin "cargo test"
cargo test --locked
begin "done"
