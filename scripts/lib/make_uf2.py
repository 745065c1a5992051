#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Finishes a Pico's image: make_uf2.py IMAGE.elf IMAGE.uf2 puts the CRC of the second boot stage into the
ELF file, for the chip's ROM checks it, and writes the same image as UF2."""
import struct
import sys

FLASH = 0x10000000
FLASH_END = 0x11000000
BOOT2_BYTES = 252  # without its CRC
PAGE_BYTES = 256
LOAD = 1
# UF2's format, github.com/microsoft/uf2.
UF2_START = (0x0A324655, 0x9E5D5157)
UF2_END = 0x0AB16F30
UF2_HAS_FAMILY = 0x2000
RP2040_FAMILY = 0xE48BFF56


def crc32_mpeg2(data):
    """RP2040 data sheet 2.8.1.3.1: polynomial 0x04c11db7, from all ones, not reflected."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04C11DB7 if crc & 0x80000000 else 0)) & 0xFFFFFFFF
    return crc


def flash_segments(elf):
    """Of each loaded segment: its place in the file, its address in flash, its bytes."""
    header, = struct.unpack_from("<I", elf, 28)
    size, count = struct.unpack_from("<HH", elf, 42)
    for i in range(count):
        kind, offset, _, address, in_file = struct.unpack_from("<5I", elf, header + i * size)
        if kind == LOAD and in_file > 0:
            if not FLASH <= address < FLASH_END:
                raise SystemExit(f"error: found a segment at {address:#x}, expected all in flash")
            yield offset, address, bytes(elf[offset:offset + in_file])


def put_boot2_crc(elf):
    for offset, address, data in flash_segments(elf):
        if address == FLASH:
            struct.pack_into("<I", elf, offset + BOOT2_BYTES, crc32_mpeg2(data[:BOOT2_BYTES]))
            return
    raise SystemExit(f"error: found no segment at {FLASH:#x}, expected the second boot stage")


def pages(elf):
    """The flash's pages that hold something, by address."""
    found = {}
    for _, address, data in flash_segments(elf):
        for i, byte in enumerate(data, address):
            page = found.setdefault(i - i % PAGE_BYTES, bytearray(PAGE_BYTES))
            page[i % PAGE_BYTES] = byte
    return sorted(found.items())


def uf2(elf):
    blocks = pages(elf)
    for number, (address, page) in enumerate(blocks):
        head = struct.pack("<8I", *UF2_START, UF2_HAS_FAMILY, address, PAGE_BYTES, number, len(blocks),
                           RP2040_FAMILY)
        yield head + bytes(page).ljust(476, b"\0") + struct.pack("<I", UF2_END)


def main():
    elf_path, uf2_path = sys.argv[1:]
    with open(elf_path, "rb") as file:
        elf = bytearray(file.read())
    put_boot2_crc(elf)
    with open(elf_path, "wb") as file:
        file.write(elf)
    with open(uf2_path, "wb") as file:
        file.writelines(uf2(elf))


if __name__ == "__main__":
    main()
