#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs the program named by `test=` on the kernel's command line beside systemd's services.
# shellcheck shell=dash

export PATH=/usr/bin:/usr/sbin
export PENDULINE=/penduline/build/penduline PYTHONPATH=/penduline/tests/program PYTHONDONTWRITEBYTECODE=1
# shellcheck source=tests/kernel/guest/machine.sh
. /penduline/tests/kernel/guest/machine.sh

# The driver of the board's port is for the service to load.
modprobe -a gpio-sim dummy_hcd libcomposite usb_f_acm || give_up "load the modules"
mount -t configfs none /sys/kernel/config
make_gpio_chip
make_gadget
cd /tmp || give_up "enter /tmp"
# shellcheck disable=SC2086 # words
run_test python3 /penduline/${test:?}
