#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An independent end of the bus, on python-can: knows the default layout of six joints by heart.

  can_peer.py frames classic|fd COUNT            what candump -L shows of `can_end tell`
  can_peer.py commands classic|fd COUNT          what cansend takes for the controller's messages
  can_peer.py messages classic|fd COUNT          what `can_end hear` prints of them
  can_peer.py hear INTERFACE classic|fd COUNT    receives `can_end tell`, and checks every byte
  can_peer.py tell INTERFACE classic|fd COUNT    sends the controller's messages
"""
import struct
import sys
import time

OURS = [("corrected", 0x130, 6), ("status", 0x140, 7), ("signature", 0x160, 2)]
THEIRS = [("controller", 0x110, 4), ("target", 0x118, 6), ("joints", 0x120, 6), ("actual", 0x148, 6),
          ("robot", 0x150, 1), ("context", 0x158, 5)]
LENGTHS = [*range(9), 12, 16, 20, 24, 32, 48, 64]


def crc(data, polynomial, bits):
    """Bit by bit; 8 bits: highest first; 32 bits: lowest first. Begins with ones, ends inverted."""
    ones = (1 << bits) - 1
    reflected = bits == 32
    if reflected:
        polynomial = int(f"{polynomial:032b}"[::-1], 2)
    value = ones
    for byte in data:
        value ^= byte
        for _ in range(8):
            out = value & 1 if reflected else value >> 7
            value = value >> 1 if reflected else value << 1 & ones
            value ^= polynomial if out else 0
    return value ^ ones


assert crc(b"123456789", 0x2F, 8) == 0xDF  # check values of AUTOSAR's specification
assert crc(b"123456789", 0xF4ACFB13, 32) == 0x1697D06A


def counts(k, i):
    """Value i of message k; None is no number. The ends of 24 bits are within 32."""
    if k == 0:
        return [8388607, -8388607, None, 0, 1, -1, 2][i]
    return (k * 1000003 + i * 7919) % 8000001 - 4000000


def number(value, size):
    low = -(1 << 8 * size - 1)
    return (low if value is None else value).to_bytes(size, "little", signed=True)


def encoded(k, can_id, size, form):
    """[(identifier, data)] of a message."""
    if form == "fd":
        data = b"".join(number(counts(k, i), 4) for i in range(size)) + struct.pack("<H", k & 0xFFFF)
        data += struct.pack("<I", crc(struct.pack("<I", can_id) + data, 0xF4ACFB13, 32))
        return [(can_id, data.ljust(next(n for n in LENGTHS if n >= len(data)), b"\0"))]
    out = []
    for first in range(0, size, 2):
        data = b"".join(number(counts(k, i), 3) for i in range(first, min(first + 2, size)))
        data = data.ljust(6, b"\0") + bytes([k & 0xFF])
        out.append((can_id, data + bytes([crc(struct.pack("<I", can_id) + data, 0x2F, 8)])))
        can_id += 1
    return out


def all_frames(table, form, count):
    for k in range(count):
        for _, can_id, size in table:
            yield from encoded(k, can_id, size, form)


def text(can_id, data, separator):
    return f"{can_id:03X}{separator}{data.hex().upper()}"


def frames(form, count):
    for can_id, data in all_frames(OURS, form, count):
        print(text(can_id, data, "#" if form == "classic" else "##5"))  # the kernel adds 4: FD


def commands(form, count):
    for can_id, data in all_frames(THEIRS, form, count):
        print(text(can_id, data, "#" if form == "classic" else "##1"))


def messages(form, count):
    for k in range(count):
        for name, _, size in THEIRS:
            values = (counts(k, i) for i in range(size))
            print(name, k & (0xFF if form == "classic" else 0xFFFF),
                  *("nan" if value is None else value for value in values))


def bus_on(interface, form):
    import can
    return can, can.Bus(interface="socketcan", channel=interface, fd=form == "fd")


def hear(interface, form, count):
    _, bus = bus_on(interface, form)
    print("ready", flush=True)
    for can_id, data in all_frames(OURS, form, count):
        message = bus.recv(20)
        assert message is not None, "nothing came"
        seen = (message.arbitration_id, bytes(message.data), message.is_fd, message.is_extended_id)
        assert seen == (can_id, data, form == "fd", False), f"{seen} instead of {can_id:03X} {data.hex()}"
        assert message.bitrate_switch == (form == "fd")


def tell(interface, form, count):
    can, bus = bus_on(interface, form)
    for n, (can_id, data) in enumerate(all_frames(THEIRS, form, count)):
        bus.send(can.Message(arbitration_id=can_id, data=data, is_extended_id=False, is_fd=form == "fd",
                             bitrate_switch=form == "fd"))
        if n % 8 == 7:
            time.sleep(0.005)
    bus.shutdown()


if __name__ == "__main__":
    verb, *rest, how_many = sys.argv[1:]
    {"frames": frames, "commands": commands, "messages": messages, "hear": hear, "tell": tell}[verb](*rest, int(how_many))
