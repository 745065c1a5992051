# SPDX-License-Identifier: Apache-2.0
# The wire protocol in Python (docs/protocol.md), written apart from common/wire.
import struct
import zlib
from collections import namedtuple

# Name, type byte, struct's format (little-endian) and fields of each message from the board.
FROM_BOARD = (
    ("Hello", 0x01, "B16s16s8sIIIHIBBHH",
     "protocol board firmware unique_id boot_id tick_hz rate_millihz full_scale_counts "
     "reference_uv sensor_count emitter_mode window_us conversions"),
    ("Sample", 0x02, "QQHHHHB", "seq t_us x_on x_off y_on y_off flags"),
    ("Status", 0x03, "QQIIIHHhHBHIH16sBIB",
     "t_us samples dropped_frames bad_frames overruns late_max_us load_permille temperature_cdeg "
     "stack_free_bytes reset_cause resets fault_pc fault_line fault_file store rate_millihz "
     "emitter_mode"),
    ("Angles", 0x04, "QqfffIffff",
     "seq t_us theta1_rad theta2_rad residual_m flags omega1_rad_s omega2_rad_s sigma1_rad sigma2_rad"),
    ("Pong", 0x05, "IQ", "token t_us"),
    ("Reply", 0x06, "BBB", "command token result"),
)
TYPES = {kind: (namedtuple(name, fields), struct.Struct("<" + layout))
         for name, kind, layout, fields in FROM_BOARD}

# Type byte and format of each command.
COMMANDS = {
    "Ping": (0x41, "I"), "AskHello": (0x42, "B"), "AskStatus": (0x43, "B"), "SetRate": (0x44, "BI"),
    "SetEmitter": (0x45, "BB"), "Identify": (0x46, "BB"), "Reboot": (0x47, "BB"),
    "BeginRig": (0x48, "BHI"), "RigPart": (0x49, "BHB48s"), "EndRig": (0x4A, "B"),
    "EraseRig": (0x4B, "B"),
}
RESULTS = ("done unknown_command wrong_length out_of_range not_supported busy store_failed "
           "no_upload incomplete damaged invalid_rig").split()


def cobs_encode(data):
    """COBS of up to 254 bytes, which are one block."""
    return b"".join(bytes([len(run) + 1]) + run for run in data.split(b"\0"))


def cobs_decode(data):
    """What was encoded; None where it cannot be."""
    out, at = bytearray(), 0
    while at < len(data):
        run = data[at + 1:at + data[at]]
        if len(run) != data[at] - 1:
            return None
        out += run
        at += data[at]
        if at < len(data):
            out.append(0)
    return bytes(out)


def encode_body(body):
    """The frame of a type byte and a payload."""
    return cobs_encode(body + struct.pack("<I", zlib.crc32(body))) + b"\0"


def encode(command, *fields):
    """The frame of a command."""
    kind, layout = COMMANDS[command]
    return encode_body(bytes([kind]) + struct.pack("<" + layout, *fields))


def encode_from_board(message):
    """The frame of a message from the board, a tuple as `Splitter` gives it."""
    kind = next(kind for kind, (record, _) in TYPES.items() if isinstance(message, record))
    return encode_body(bytes([kind]) + TYPES[kind][1].pack(*message))


class Splitter:
    """Cuts a stream into messages; what is not one is kept in `damaged`."""

    def __init__(self):
        self.rest = b""
        self.damaged = []

    def messages(self, data):
        *frames, self.rest = (self.rest + data).split(b"\0")
        return [message for frame in frames if frame and (message := self.decode(frame))]

    def decode(self, frame):
        whole = cobs_decode(frame)
        if whole is None or len(whole) < 5 or whole[-4:] != struct.pack("<I", zlib.crc32(whole[:-4])):
            self.damaged.append(frame)
            return None
        record, layout = TYPES[whole[0]]
        return record._make(layout.unpack(whole[1:-4]))


# What `Status` says of the store, and the store's head (firmware/rig_store.hpp).
STORE_VALID, STORE_DAMAGED = 1, 2


# How a board finds the angles, and what the program believes where a rig file says nothing (common/filter_trust.hpp).
GAUSS_NEWTON, KALMAN = 0, 1
NOISE_V, NOISE_M = 0.0005, 10e-6
TRUST = (0.02, 0.3, 0, 0.002, 0.005, 0)


def rig_image(gap_at_zero_m, slope_m_per_v, offset_m, arm_m, estimator=GAUSS_NEWTON):
    """The image of a rig with two linear sensors, `arm_m` from the pivot along X and Y."""
    image = struct.pack("<BffffffBB", 2, 0.3, 0.1, 9.8, 0.01, offset_m, 0.12, 0, 2)
    for position in ((arm_m, 0, 0), (0, arm_m, 0)):
        image += struct.pack("<ffffffBff", *position, 0, 0.1, 0, 0, gap_at_zero_m, slope_m_per_v)
    return image + struct.pack("<B4f6f", estimator, *(2 * (NOISE_V, NOISE_M)), *TRUST)


def stored(image):
    """The bytes of a store that holds the image."""
    return b"RIG1" + struct.pack("<HI", len(image), zlib.crc32(image)) + image
