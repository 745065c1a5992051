#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# The guest's first process: makes its devices, runs the program named by `test=` on the kernel's command
# line and ends the machine with the outcome. The kernel hands words like NAME=VALUE on as environment.
# shellcheck shell=dash

export PATH=/usr/bin:/usr/sbin
export PENDULINE=/penduline/build/penduline PYTHONPATH=/penduline/tests/program
export PYTHONDONTWRITEBYTECODE=1 LSAN_OPTIONS=exitcode=99
# What was freed is kept for a while; the default, 256 MB and more, is more than a guest has.
export ASAN_OPTIONS=exitcode=99:quarantine_size_mb=32

# shellcheck source=tests/kernel/guest/machine.sh
. /penduline/tests/kernel/guest/machine.sh

mount_all() {
  mount -t devtmpfs none /dev
  mount -t proc none /proc
  mount -t sysfs none /sys
  mkdir -p /dev/pts /dev/shm
  mount -t devpts none /dev/pts
  mount -t tmpfs none /dev/shm
  mount -t tmpfs none /tmp
}

mount_all
modprobe -a gpio-sim dummy_hcd libcomposite usb_f_acm cdc-acm xhci-pci || give_up "load the modules"
mount -t configfs none /sys/kernel/config
# libusb hears of plugging from udevd, not from the kernel.
systemd-udevd --daemon || give_up "start systemd-udevd"
make_gpio_chip
make_gadget
cd /tmp || give_up "enter /tmp"
case ${test:?} in
*.py*) interpreter=python3 ;;
*) interpreter= ;;
esac
# shellcheck disable=SC2086 # words
run_test $interpreter /penduline/$test
