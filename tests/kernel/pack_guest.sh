#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pack_guest.sh BUILD: makes BUILD/kernel/guest.cpio, a file system in memory with busybox, udevd, Python,
# the kernel's modules and what BUILD has of Penduline, and BUILD/kernel/vmlinux beside it.
#
# Status 77: something is missing here, said in one line.
set -euo pipefail
readonly SKIP=77
sources=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
. "$sources/tests/kernel/guest_files.sh"

make_tree() {
  local applet
  chmod 755 "$guest" # for those who are not root
  make_folders
  mkdir --parents "$guest"/{dev,proc,sys,run,tmp,etc}
  put /bin/busybox
  for applet in $(busybox --list); do
    ln --symbolic busybox "$guest/usr/bin/$applet" 2>/dev/null || true
  done
}

put_udev() {
  put /bin/udevadm /lib/udev/rules.d/{50-udev-default,60-serial}.rules
  install -D --target-directory="$guest/usr/lib/udev/rules.d" "$sources/host/packaging/70-penduline.rules"
  ln --symbolic udevadm "$guest/usr/bin/systemd-udevd"
  # The rules name groups, of which some are Penduline's.
  cp /etc/group "$guest/etc/"
  grep '^root:' /etc/passwd >"$guest/etc/passwd"
  systemd-sysusers --root="$guest" "$sources/host/packaging/penduline.sysusers"
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
  local build guest kernel tool
  build=$(realpath "$1")
  rm --force "$build/kernel/guest.cpio"
  for tool in qemu-system-x86_64 busybox cpio udevadm systemd-sysusers; do
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
  pack "$build/kernel/guest.cpio"
}

main "$1"
