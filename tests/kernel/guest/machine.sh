# SPDX-License-Identifier: Apache-2.0
# The guest's hardware and its end. To be sourced by its first process or service.
# shellcheck shell=dash

# The machine ends with (outcome << 1) | 1, by QEMU's isa-debug-exit: a panic or a fault of QEMU's own
# looks otherwise.
readonly PASSED=16 FAILED=17
finish() {
  sleep 0.1 # for the console's last lines
  # shellcheck disable=SC2059 # the format is the byte
  printf "\\$(printf %o "$1")" | dd of=/dev/port bs=1 seek=$((0x501)) 2>/dev/null
  poweroff -f
}

# give_up WHAT: ends the machine where it cannot even be made ready.
give_up() {
  echo "init: could not $1"
  finish $FAILED
}

# put TEXT FILE: into a file of sysfs or configfs.
put() {
  echo "$1" >"$2" || give_up "write $1 to $2"
}

# A chip of four named lines, each a folder of $GPIO_SIM with its `value` and its `pull`.
make_gpio_chip() {
  local chip=/sys/kernel/config/gpio-sim/chip offset=0 name
  mkdir -p $chip/bank
  put 4 $chip/bank/num_lines
  for name in reset magnet status-led trigger; do
    mkdir $chip/bank/line$offset
    put "penduline-$name" $chip/bank/line$offset/name
    offset=$((offset + 1))
  done
  put 1 $chip/live
  GPIO_SIM=/sys/devices/platform/$(cat $chip/dev_name)/$(cat $chip/bank/chip_name)
  export GPIO_SIM
}

# A board's USB serial port, identity and all; its firmware's end is /dev/ttyGS0. It is plugged in by
# writing $UDC to $UDC_FILE, and unplugged by writing an empty line.
make_gadget() {
  local gadget=/sys/kernel/config/usb_gadget/board
  UDC=$(ls /sys/class/udc)
  export UDC UDC_FILE=$gadget/UDC
  mkdir $gadget
  put 0x1209 $gadget/idVendor
  put 0x0001 $gadget/idProduct
  mkdir $gadget/strings/0x409
  put Penduline $gadget/strings/0x409/manufacturer
  put Penduline $gadget/strings/0x409/product
  put 0000000000000001 $gadget/strings/0x409/serialnumber
  mkdir $gadget/configs/serial.1 $gadget/functions/acm.0
  ln -s $gadget/functions/acm.0 $gadget/configs/serial.1/
  # Nothing that comes before its firmware listens may be echoed.
  stty -F /dev/ttyGS0 raw -echo
}

# run_test COMMAND...: ends the machine with the command's outcome.
run_test() {
  read -r started _ </proc/uptime
  echo "$(uname -r) is ready after $started s, runs $*"
  if "$@"; then
    outcome=$PASSED
  else
    outcome=$FAILED
    dmesg | tail -n 40
  fi
  read -r ended _ </proc/uptime
  echo "ended after $ended s"
  finish $outcome
}
