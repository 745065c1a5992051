#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# fetch_kernel.sh: prints a folder with Debian's newest kernel for amd64 (vmlinux, lib/modules, release),
# gpio-sim built for it. Taken from apt's packages without installing any, and kept in the user's cache.
#
# Status 77: something is missing here, said in one line; 1: what was downloaded could not be built.
set -euo pipefail

# What the guests load and Debian builds; modules that these need come along.
readonly MODULES=(configfs dummy_hcd libcomposite usb_f_acm cdc-acm xhci-pci)
readonly SKIP=77

missing() {
  echo "$*" >&2
  exit $SKIP
}

# depends PACKAGE PATTERN: the packages that PACKAGE depends on, of those whose names match.
depends() {
  apt-cache depends "$1" 2>/dev/null | sed -n "s/^ *Depends: \($2\)$/\1/p"
}

# download PACKAGE...: into the current folder.
download() {
  apt-get -qq download "$@" 2>apt.log >/dev/null ||
    missing "could not download $1: $(grep -m 1 '^E:' apt.log || echo 'apt gave no reason')"
}

# unpack_vmlinux BZIMAGE: its payload, without the code that unpacks it at every boot
# (Documentation/x86/boot.rst: setup_sects, payload_offset and payload_length of the header).
unpack_vmlinux() {
  local sectors offset length
  sectors=$(od --address-radix=n --format=u1 --skip-bytes=497 --read-bytes=1 "$1")
  read -r offset length < <(od --address-radix=n --format=u4 --skip-bytes=584 --read-bytes=8 "$1")
  dd if="$1" bs=1M iflag=skip_bytes,count_bytes skip=$(((sectors + 1) * 512 + offset)) \
    count="$length" status=none | xz --decompress --single-stream
}

# build_gpio_sim RELEASE SOURCE FOLDER: the kernel's own gpio-sim.c and irq_sim.c, which Debian leaves
# out, as modules into FOLDER; headers stand in ./headers.
build_gpio_sim() {
  local release=$1 source=$2 folder=$3
  local headers=$PWD/headers/usr/src/linux-headers-$release
  # The headers name their other half by its place once installed.
  sed -i "s,/usr/src/,$PWD/headers/usr/src/," "$headers/Makefile"
  mkdir modules
  dpkg --fsys-tarfile "$source"_*.deb | tar --extract --to-stdout "./usr/src/$source.tar.xz" |
    tar --extract --xz --directory=modules --transform='s,.*/,,' \
      "$source"/drivers/gpio/{gpio-sim.c,gpiolib.h} "$source/kernel/irq/irq_sim.c"
  # irq_to_desc is not for modules; this does the same by the interrupt's number.
  sed -i 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' modules/irq_sim.c
  printf '#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >>modules/irq_sim.c
  echo 'obj-m := irq_sim.o gpio-sim.o' >modules/Makefile
  make --silent --directory="$headers" M="$PWD/modules" modules >make.log 2>&1 || {
    cat make.log >&2
    return 1
  }
  strip --strip-debug modules/*.ko
  mkdir --parents "$folder"
  cp modules/*.ko "$folder/"
}

# keep_modules RELEASE FROM TO: MODULES and what they need, with the lists that modprobe reads.
keep_modules() {
  local release=$1 from=$2 to=$3 file
  depmod --basedir="$from" "$release"
  for module in "${MODULES[@]}" gpio-sim; do
    modprobe --dirname="$from" --set-version="$release" --show-depends "$module" || return 1
  done | sed -n "s,^insmod $from/\([^ ]*\).*,\1,p" | sort --unique | while read -r file; do
    (cd "$from" && cp --parents "$file" "$to/")
  done
  cp "$from/lib/modules/$release"/modules.{builtin,builtin.modinfo,order} "$to/lib/modules/$release/"
  depmod --basedir="$to" "$release"
}

main() {
  local release image source headers cache folder work tool
  local -a header_packages
  for tool in apt-get dpkg xz make gcc depmod; do
    [ -n "$(PATH=$PATH:/sbin:/usr/sbin type -P $tool)" ] || missing "found no $tool"
  done
  PATH=$PATH:/sbin:/usr/sbin
  [ "$(dpkg --print-architecture)" = amd64 ] || missing "the guest is for amd64, as the programs in it"
  image=$(depends linux-image-amd64 'linux-image-[0-9].*')
  source=$(depends linux-source 'linux-source-[0-9].*')
  if [ -z "$image" ] || [ -z "$source" ]; then
    missing "apt knows no linux-image-amd64 or linux-source; try apt-get update"
  fi
  release=${image#linux-image-}
  cache=${XDG_CACHE_HOME:-$HOME/.cache}/penduline
  # Another kernel or another recipe is another folder.
  folder=$cache/linux-$release-$(sha256sum "${BASH_SOURCE[0]}" | head --bytes=8)
  if [ -d "$folder" ]; then
    echo "$folder"
    return
  fi
  echo "Downloading Debian's kernel $release, 225 MB, to test against it." >&2
  headers=linux-headers-$release
  mapfile -t header_packages < <(depends "$headers" 'linux-\(headers\|kbuild\|compiler\)-.*')
  mkdir --parents "$cache"
  work=$(mktemp --directory "$cache/unpacking-XXXXXX")
  # shellcheck disable=SC2064 # the folder's name now
  trap "rm -rf '$work'" EXIT
  cd "$work"
  download "$image" "$headers" "${header_packages[@]}" "$source"
  dpkg --fsys-tarfile "$image"_*.deb | tar --extract --wildcards "./boot/vmlinuz-$release" \
    "./lib/modules/$release/modules.*" "./lib/modules/$release/kernel/drivers/usb" \
    "./lib/modules/$release/kernel/fs/configfs"
  for package in "$headers" "${header_packages[@]}"; do
    dpkg --extract "$package"_*.deb headers
  done
  build_gpio_sim "$release" "$source" "$work/lib/modules/$release/extra"
  mkdir --parents "kept/lib/modules/$release"
  keep_modules "$release" "$work" "$work/kept"
  unpack_vmlinux "boot/vmlinuz-$release" >kept/vmlinux
  echo "$release" >kept/release
  # Whole or not at all; another who was quicker has made the same.
  mv --no-target-directory kept "$folder" 2>/dev/null || [ -d "$folder" ]
  echo "$folder"
}

main
