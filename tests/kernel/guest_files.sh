# SPDX-License-Identifier: Apache-2.0
# Files for a guest's file system, which is the folder $guest. To be sourced.
# shellcheck shell=bash disable=SC2154

# make_folders: where programs and libraries go, all below usr.
make_folders() {
  mkdir --parents "$guest"/usr/{bin,lib,lib64}
  ln --symbolic usr/bin "$guest/bin"
  ln --symbolic usr/bin "$guest/sbin"
  ln --symbolic bin "$guest/usr/sbin"
  ln --symbolic usr/lib "$guest/lib"
  ln --symbolic usr/lib64 "$guest/lib64"
}

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
    case $file in *.py | *.pyc | *.rules | *.service | *.socket | *.target) ;; *) put_libraries "$file" ;; esac
  done
}

# pack FILE: into an archive as the kernel unpacks it.
pack() {
  (cd "$guest" && find . | cpio --create --format=newc --owner=0:0 --quiet) >"$1.part"
  mv "$1.part" "$1"
}
