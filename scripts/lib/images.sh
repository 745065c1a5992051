# SPDX-License-Identifier: Apache-2.0
# Tells whether a file is an image for a board, before it is written. To be sourced; needs `fail`.

# words FILE COUNT: its first 32-bit words, in hexadecimal.
words() {
  od --address-radix=n --format=x4 --endian=little --read-bytes=$((4 * $2)) "$1"
}

# check_uf2 FILE: fails unless it is UF2 for an RP2040 (github.com/microsoft/uf2).
check_uf2() {
  local -a word
  local size
  size=$(stat --dereference --format=%s "$1")
  read -r -a word < <(words "$1" 8 | tr '\n' ' ') || true
  if [ "${word[0]-}" != 0a324655 ] || [ "${word[1]-}" != 9e5d5157 ]; then
    fail "$1: found no UF2 file, expected penduline-pico.uf2 or the like; an .elf or .bin is not one"
  elif [ $((0x${word[2]} & 0x2000)) -eq 0 ] || [ "${word[7]}" != e48bff56 ]; then
    fail "$1: found family 0x${word[7]}, expected 0xe48bff56 (RP2040): it is for another chip"
  elif [ $((size % 512)) -ne 0 ] || [ $((size / 512)) -ne $((0x${word[6]})) ]; then
    fail "$1: found $size bytes, expected $((512 * 0x${word[6]})): the file is cut short"
  fi
}

# check_bin FILE: fails unless it begins as an STM32F4's image does, with the top of the stack in
# RAM and the place of the first instruction in flash (PM0214 2.3.4).
check_bin() {
  local -a word
  read -r -a word < <(words "$1" 2 | tr '\n' ' ') || true
  if [[ ${word[0]-} != 2000* && ${word[0]-} != 2001* && ${word[0]-} != 20020000 ]] ||
    [[ ${word[1]-} != 080* ]]; then
    fail "$1: found ${word[*]-nothing} at its start, expected a stack in RAM (2000....) and code in" \
      "flash (080.....): it is no .bin for the Nucleo-F446RE; an .elf or .uf2 is not one"
  fi
}
