#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pack_guest.sh BUILD: makes BUILD/kernel/guest.cpio, a file system in memory with busybox, udevd, Python,
# the kernel's modules and what BUILD has of Penduline, and BUILD/kernel/vmlinux beside it.
#
# Status 77: something is missing here, said in one line.
set -euo pipefail
readonly SKIP=77

# put_libraries PROGRAM: those that it is linked with.
put_libraries() {
  local library
  { ldd "$1" 2>/dev/null || true; } | sed -n 's,[^/]*\(/[^ ]*\).*,\1,p' | while read -r library; do
    [ -e "$guest$library" ] || install -D "$library" "$guest$library"
  done
}

# put FILE...: to the same place in the guest, with libraries.
put() {
  local file
  for file in "$@"; do
    install -D --preserve-timestamps "$file" "$guest$file"
    case $file in *.py | *.pyc | *.rules) ;; *) put_libraries "$file" ;; esac
  done
}

make_tree() {
  local applet
  mkdir --parents "$guest"/{dev,proc,sys,run,tmp,etc,usr/bin,usr/lib,usr/lib64}
  ln --symbolic usr/bin "$guest/bin"
  ln --symbolic usr/bin "$guest/sbin"
  ln --symbolic bin "$guest/usr/sbin"
  ln --symbolic usr/lib "$guest/lib"
  ln --symbolic usr/lib64 "$guest/lib64"
  put /bin/busybox
  for applet in $(busybox --list); do
    ln --symbolic busybox "$guest/usr/bin/$applet" 2>/dev/null || true
  done
}

put_udev() {
  put /bin/udevadm /lib/udev/rules.d/{50-udev-default,60-serial}.rules
  ln --symbolic udevadm "$guest/usr/bin/systemd-udevd"
  # The rules name groups.
  cp /etc/group "$guest/etc/"
  grep '^root:' /etc/passwd >"$guest/etc/passwd"
}

# Python and those of its modules that the guest's tests load.
put_python() {
  put /usr/bin/python3
  PYTHONPATH=$sources/tests/program PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 \
    "$sources/tests/kernel/loaded_modules.py" "$sources"/tests/kernel/guest/*.py |
    while read -r file; do put "$file"; done
}

put_penduline() {
  local program
  mkdir --parents "$guest/penduline/build"
  for program in penduline penduline-sim-board kernel_libraries_test; do
    strip --strip-debug -o "$guest/penduline/build/$program" "$build/$program"
    put_libraries "$build/$program"
  done
  (cd "$sources" && cp --parents tests/program/{live_run,program,source_suite,wire}.py docs/rigs/*.toml \
    tests/kernel/guest/* "$guest/penduline/")
  mv "$guest/penduline/tests/kernel/guest/init.sh" "$guest/init"
  chmod +x "$guest/init"
}

main() {
  local sources build guest kernel tool
  sources=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
  build=$(realpath "$1")
  rm --force "$build/kernel/guest.cpio"
  for tool in qemu-system-x86_64 busybox cpio udevadm; do
    type -P $tool >/dev/null || {
      echo "found no $tool" >&2
      exit $SKIP
    }
  done
  kernel=$("$sources/tests/kernel/fetch_kernel.sh")
  guest=$(mktemp --directory)
  # shellcheck disable=SC2064 # the folder's name now
  trap "rm -rf '$guest'" EXIT
  make_tree
  cp --recursive "$kernel/lib/modules" "$guest/lib/"
  put_udev
  put_python
  put_penduline
  mkdir --parents "$build/kernel"
  ln --symbolic --force "$kernel/vmlinux" "$build/kernel/vmlinux"
  (cd "$guest" && find . | cpio --create --format=newc --owner=0:0 --quiet) >"$build/kernel/packing"
  mv "$build/kernel/packing" "$build/kernel/guest.cpio"
}

main "$1"
