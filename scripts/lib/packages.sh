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

# What the live page is tested in; its screenshots have these fonts.
BROWSER_PACKAGES=(chromium fonts-inter fonts-urw-base35)

# install_by_npm FOLDER WHY: the npm packages of the versions that FOLDER's lock file names.
install_by_npm() {
  local folder=$1 why=$2
  if [ "$folder/node_modules/.package-lock.json" -nt "$folder/package-lock.json" ]; then
    return 0
  fi
  echo "Installing what $folder/package-lock.json names by npm: needed $why."
  npm --prefix "$folder" ci --no-audit --no-fund --silent
}

# install_emulator: the RP2040's.
install_emulator() {
  install_by_npm tests/firmware "to run the firmware without a board"
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
