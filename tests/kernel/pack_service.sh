#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pack_service.sh BUILD: adds systemd and what the .deb in BUILD/package holds to the guest of pack_guest.sh: makes
# BUILD/kernel/service.cpio.
set -euo pipefail
sources=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
. "$sources/tests/kernel/guest_files.sh"

# What of systemd a machine needs that runs a service and has devices come and go.
readonly PROGRAMS=(/lib/systemd/systemd /lib/systemd/systemd-journald /bin/systemctl /bin/systemd-sysusers)
readonly UNITS=({sysinit,basic,local-fs,local-fs-pre,swap,sockets,timers,paths,slices,shutdown,umount}.target
  {network,time-sync,sysinit,multi-user,emergency,poweroff}.target
  systemd-journald{.service,.socket,-dev-log.socket} systemd-udevd{.service,-control.socket,-kernel.socket}
  modprobe@.service systemd-poweroff.service)

main() {
  local build guest unit
  build=$(realpath "$1")
  guest=$(mktemp --directory)
  # shellcheck disable=SC2064 # the folder's name now
  trap "rm -rf '$guest'" EXIT
  make_folders
  # With the rule that loads drivers as devices come.
  put "${PROGRAMS[@]}" /lib/udev/rules.d/80-drivers.rules
  for unit in "${UNITS[@]}"; do
    install -D --mode=644 --target-directory="$guest/usr/lib/systemd/system" "/usr/lib/systemd/system/$unit"
  done
  mkdir --parents "$guest"/{etc,penduline} "$guest"/var/{lib,log,tmp} \
    "$guest/usr/lib/systemd/system/sysinit.target.wants"
  ln --symbolic ../run "$guest/var/run"
  ln --symbolic --target-directory="$guest/usr/lib/systemd/system/sysinit.target.wants" \
    ../systemd-{journald,udevd}.service
  ln --symbolic ../../bin/udevadm "$guest/usr/lib/systemd/systemd-udevd"
  # As before the package is configured.
  cp /etc/group "$guest/etc/"
  : >"$guest/etc/gshadow"
  : >"$guest/etc/machine-id"
  echo 'ID=guest' >"$guest/etc/os-release"
  dpkg-deb --extract "$build"/package/penduline_*.deb "$guest"
  dpkg-deb --control "$build"/package/penduline_*.deb "$guest/penduline/deb"
  put_libraries "$guest/usr/bin/penduline"
  install -D --mode=644 --target-directory="$guest/etc/systemd/system" "$sources/tests/kernel/guest/guest-test.service"
  pack "$build/kernel/overlay.cpio"
  # The kernel unpacks one archive after the other.
  cat "$build/kernel/guest.cpio" "$build/kernel/overlay.cpio" >"$build/kernel/service.cpio"
  rm "$build/kernel/overlay.cpio"
}

main "$1"
