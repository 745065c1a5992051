# SPDX-License-Identifier: Apache-2.0
# Installs Debian packages that are missing, saying which and why. To be sourced.

BUILD_PACKAGES=(
  g++ cmake ninja-build ccache libeigen3-dev libboost-dev libfmt-dev libspdlog-dev
  nlohmann-json3-dev libcli11-dev libtomlplusplus-dev libexpected-dev
  libusb-1.0-0-dev libudev-dev libgpiod-dev libmosquitto-dev libsystemd-dev libnlopt-cxx-dev pkgconf
  catch2 librapidcheck-dev libumockdev-dev umockdev python3)
# What the live page is bundled with. A Node.js from elsewhere comes with its own npm and does not go together with
# Debian's.
command -v npm >/dev/null || BUILD_PACKAGES+=(nodejs npm)

# What the boards' firmware is built with.
CROSS_PACKAGES=(gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib)

# What the tests on a real kernel are made of (tests/kernel).
KERNEL_PACKAGES=(qemu-system-x86 busybox-static cpio kmod udev systemd make xz-utils libelf1)

# What installation, package, manual and completion are tested with.
PACKAGING_PACKAGES=(systemd dpkg-dev file mandoc bash-completion zsh fish)

# install_emulator: the RP2040's, an npm package of the version that its lock file names.
install_emulator() {
  local lock=tests/firmware/package-lock.json installed=tests/firmware/node_modules/.package-lock.json
  if [ "$installed" -nt "$lock" ]; then
    return 0
  fi
  echo "Installing rp2040js by npm: needed to run the firmware without a board."
  npm --prefix tests/firmware ci --no-audit --no-fund --silent
}

# install_missing WHY PACKAGE...
install_missing() {
  local why=$1 package
  local -a missing=()
  shift
  for package in "$@"; do
    dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null |
      grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "Installing ${missing[*]}: needed $why."
  local -a as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "error: installing packages needs root; run as root or install sudo" >&2
      return 1
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
