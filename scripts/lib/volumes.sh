# SPDX-License-Identifier: Apache-2.0
# Finds and mounts the volumes by which boards take an image. To be sourced; needs `fail`.

# find_volumes LABEL...: one line a volume, its device, a tab, where it is mounted (or nothing).
find_volumes() {
  local line label device
  local pattern='^PATH="(.*)" LABEL="(.*)" MOUNTPOINT="(.*)"$'
  lsblk --pairs --output PATH,LABEL,MOUNTPOINT 2>/dev/null | while IFS= read -r line; do
    [[ $line =~ $pattern ]] || continue
    device=${BASH_REMATCH[1]}
    for label in "$@"; do
      # lsblk writes a blank as \x20.
      [ "${BASH_REMATCH[2]}" != "$label" ] || printf '%s\t%b\n' "$device" "${BASH_REMATCH[3]}"
    done
  done
}

# wait_for_volume SECONDS LABEL...: waits until there is one; false where none comes.
wait_for_volume() {
  local until=$((SECONDS + $1))
  shift
  while [ -z "$(find_volumes "$@")" ]; do
    [ "$SECONDS" -lt "$until" ] || return 1
    sleep 0.2
  done
}

# mounted_at DEVICE LABEL...: prints where DEVICE is mounted, and mounts it where it is not.
mounted_at() {
  local device=$1 said place
  shift
  place=$(find_volumes "$@" | awk -F '\t' -v device="$device" '$1 == device { print $2 }')
  if [ -z "$place" ]; then
    command -v udisksctl >/dev/null ||
      fail "$device is not mounted, and udisksctl (package udisks2) is not here to do it." \
        "Mount it yourself and name the folder: sudo mount $device /mnt; then --volume /mnt"
    said=$(udisksctl mount --no-user-interaction --block-device "$device" 2>&1) || true
    # Asked again rather than taken from the answer: the desktop may have been quicker.
    place=$(find_volumes "$@" | awk -F '\t' -v device="$device" '$1 == device { print $2 }')
    [ -n "$place" ] || fail "could not mount $device: $said"
  fi
  printf '%s\n' "$place"
}
