#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The first process of a guest with systemd: moves everything into a file system that services can have views
# of, which the kernel's first one is not for, and starts systemd.
# shellcheck shell=dash

export PATH=/usr/bin
mkdir -p /root
mount -t tmpfs -o mode=755 none /root
for folder in /*; do
  case $folder in
  /root) ;;
  *) cp -a "$folder" /root/ ;;
  esac
done
exec switch_root /root /lib/systemd/systemd
