# SPDX-License-Identifier: Apache-2.0
# Frames of docs/protocol.md, written a second time, for the tests in Python.
import struct
import zlib

# Payloads by type byte: the whole of short ones, the beginning of long ones.
HELLO, SAMPLE, STATUS, REPLY = 0x01, 0x02, 0x03, 0x06
ASK_HELLO, ASK_STATUS, REBOOT, ERASE_RIG = 0x42, 0x43, 0x47, 0x4B


def decode_cobs(block):
    """The bytes in a block without its zero."""
    out = bytearray()
    at = 0
    while at < len(block):
        code = block[at]
        if code == 0 or at + code > len(block):
            raise ValueError(f"damaged block {block.hex()}")
        out += block[at + 1:at + code]
        at += code
        if code != 0xFF and at < len(block):
            out.append(0)
    return bytes(out)


def encode_cobs(data):
    """The block of up to 254 bytes."""
    block = bytearray()
    for part in data.split(b"\0"):
        block.append(len(part) + 1)
        block += part
    return bytes(block)


def frame(kind, payload):
    """A whole frame, with a zero on either side."""
    body = bytes([kind]) + payload
    return b"\0" + encode_cobs(body + struct.pack("<I", zlib.crc32(body))) + b"\0"


def frames(stream):
    """All frames in a stream as (type, payload); what follows the last zero is left out."""
    found = []
    for block in stream.split(b"\0")[:-1]:
        if block:
            data = decode_cobs(block)
            body, crc = data[:-4], struct.unpack("<I", data[-4:])[0]
            if zlib.crc32(body) != crc:
                raise ValueError(f"damaged frame {block.hex()}")
            found.append((body[0], body[1:]))
    return found
