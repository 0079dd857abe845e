# SPDX-License-Identifier: Apache-2.0
"""Blocks of registers as Plumb's default layout for six joints has them, written anew from the
description of the layout. Signal i is 7 * counter + i, so that any other value is seen to be wrong."""

MESSAGES = {  # the controller's: first register, number of values
    "joints": (1000, 6), "target": (1048, 6), "actual": (1072, 6), "controller": (1096, 4),
    "robot": (1112, 1), "context": (1128, 5),
}
OURS = {"corrected": (1200, 6), "status": (1248, 7), "signature": (1272, 2)}


def crc32p4(data):
    """Bit by bit: polynomial 0xF4ACFB13, reflected in and out, start and final xor 0xFFFFFFFF."""
    crc = 0xFFFFFFFF
    for byte in data:
        for bit in range(8):
            carry = (crc >> 31) ^ (byte >> bit & 1)
            crc = (crc << 1 & 0xFFFFFFFF) ^ (0xF4ACFB13 if carry else 0)
    crc ^= 0xFFFFFFFF
    return int(f"{crc:032b}"[::-1], 2)


assert crc32p4(b"123456789") == 0x1697D06A  # the check value AUTOSAR gives


def sealed(first, words):
    covered = first.to_bytes(4, "little") + b"".join(word.to_bytes(2, "big") for word in words)
    crc = crc32p4(covered)
    return words + [crc >> 16, crc & 0xFFFF]


def block(first, size, counter):
    words = []
    for i in range(size):
        value = 7 * counter + i
        words += [value >> 16 & 0xFFFF, value & 0xFFFF]
    return sealed(first, words + [counter])


def is_lawful(first, words):
    """None: no message yet, or its check sum is gone; else whether its values are right."""
    if sealed(first, words[:-2]) != words:
        return None
    counter = words[-3]
    return words == block(first, (len(words) - 3) // 2, counter)
