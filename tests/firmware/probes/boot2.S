// SPDX-License-Identifier: Apache-2.0
// Second-stage boot of the probes: maps the flash with its slow read (03h) and enters the vector table.
  .syntax unified
  .cpu cortex-m0plus
  .thumb
  .section .boot2, "ax"
  ldr r3, =0x18000000     // SSI
  movs r1, #0
  str r1, [r3, #0x08]     // SSIENR: off while its registers change
  movs r1, #4
  str r1, [r3, #0x14]     // BAUDR
  ldr r1, =0x001f0300     // CTRLR0: 32-bit frames, EEPROM read
  str r1, [r3, #0x00]
  ldr r1, =0x03000218     // SPI_CTRLR0: command 03h, 24-bit address
  movs r2, #0xf4
  str r1, [r3, r2]
  movs r1, #0
  str r1, [r3, #0x04]     // CTRLR1: one frame
  movs r1, #1
  str r1, [r3, #0x08]
  ldr r0, =0x10000100
  ldr r1, =0xe000ed08     // VTOR
  str r0, [r1]
  ldr r1, [r0]
  msr msp, r1
  ldr r1, [r0, #4]
  bx r1
  .ltorg
