// SPDX-License-Identifier: Apache-2.0
// The RP2040's second boot stage: lets the flash be read as memory and goes on to the program (2.8.1).
  .syntax unified
  .cpu cortex-m0plus
  .thumb
  .section .boot2, "ax"
  .global boot2
  .thumb_func
boot2:
  ldr r3, =0x18000000      // the flash's interface, SSI (4.10)
  movs r1, #0
  str r1, [r3, #0x08]      // SSIENR: off while it is changed
  movs r1, #4
  str r1, [r3, #0x14]      // BAUDR: a quarter of the system's clock
  ldr r1, =0x001f0300      // CTRLR0: one wire, command then data, 32-bit frames
  str r1, [r3, #0x00]
  ldr r1, =0x03000218      // SPI_CTRLR0: command 0x03, 8 bits, 24 bits of address
  movs r2, #0xf4
  str r1, [r3, r2]
  movs r1, #0
  str r1, [r3, #0x04]      // CTRLR1: one word a transfer
  movs r1, #1
  str r1, [r3, #0x08]      // SSIENR: on
  ldr r0, =0x10000100      // the program's vectors
  ldr r1, =0xe000ed08
  str r0, [r1]             // VTOR
  ldr r1, [r0]
  msr msp, r1
  ldr r1, [r0, #4]
  bx r1
  .ltorg
