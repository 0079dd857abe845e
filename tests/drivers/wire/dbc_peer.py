#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads our DBC files with programs that are not ours and decodes frames whose values are known.

usage: dbc_peer.py PRINT_DBC

The frames are those of can_bytes_test.cpp; the values beside them were written by hand. Two readers: canmatrix (Debian
python3-canmatrix), and a strict one below that knows the grammar only as far as its specification goes. Without canmatrix
the strict one runs alone."""

import re
import subprocess
import sys

UNKNOWN24 = -(1 << 23)
TARGET = {
    "target_1": ("87D612E05EF8A7A9", {"x": 1234567, "y": -500000, "counter": 0xA7, "crc": 0xA9}),
    "target_2": ("B0710BA08601A768", {"z": 750000, "rx": 100000, "counter": 0xA7}),
    "target_3": ("4039D2000080A731", {"ry": -3000000, "rz": UNKNOWN24, "counter": 0xA7}),
    "robot": ("563412000000" "01B9", {"serial": 0x123456, "counter": 1, "crc": 0xB9}),
}
CASES = [
    (["classic"], TARGET),
    (["classic", "extended"], TARGET),
    (["classic", "big"], {"target_1": ("12D687F85EE0A74D", {"x": 1234567, "y": -500000, "crc": 0x4D})}),
    (["classic", "offset"], {
        "offset_1": ("D20478EC0180076D", {"dx": 123.4, "dy": -500.0, "dz": -3276.7, "counter": 7}),
        "offset_2": ("0100FEFF008007CB", {"drx": 1, "dry": -2, "drz": -32768}),
    }),
    (["fd"], {"target": (
        "87D61200E05EF8FFB0710B00A08601004039D2FF00000080A701A958BDF60000",
        {"x": 1234567, "y": -500000, "z": 750000, "rx": 100000, "ry": -3000000, "rz": -(1 << 31),
         "counter": 0x1A7, "crc": 0xF6BD58A9})}),
]
IDS = {"target_1": 0x118, "target_2": 0x119, "target_3": 0x11A, "robot": 0x150, "offset_1": 0x138,
       "offset_2": 0x139, "target": 0x118}

MESSAGE = re.compile(r"BO_ (\d+) ([A-Za-z_]\w{0,31}): (\d+) ([A-Za-z_]\w*)$")
NUMBER = r"(-?\d+(?:\.\d+)?)"
SIGNAL = re.compile(
    r" SG_ ([A-Za-z_]\w{0,31}) : (\d+)\|(\d+)@([01])([+-]) \(" + NUMBER + "," + NUMBER + r"\) \[" + NUMBER +
    r"\|" + NUMBER + r"\] \"([^\"]*)\" ([A-Za-z_]\w*)$")
OTHERS = [
    r"", r'VERSION ""', r"NS_ :", r"BS_:", r"BU_: controller plumb_rt", r'CM_ "[^"]*";', r'CM_ BO_ \d+ "[^"]*";',
    r'CM_ SG_ \d+ \w+ "[^"]*";', r'BA_DEF_ "\w+" STRING ;', r'BA_DEF_ BO_ "\w+" INT 0 65535;',
    r'BA_DEF_ BO_ "\w+" ENUM "\w+"(,"\w+")*;', r'BA_DEF_DEF_ "\w+" ("\w+"|\d+);', r'BA_ "BusType" "CAN( FD)?";',
    r'BA_ "\w+" BO_ \d+ \d+;', r'VAL_ \d+ \w+( -?\d+ "[^"]*")+ ;']


def strict(text):
    """{name: (id, extended, length, {signal: (bits from the lowest, signed, factor, offset)})}"""
    out, message = {}, None
    for line in text.split("\n"):
        if found := MESSAGE.match(line):
            number = int(found[1])
            message = found[2]
            assert message not in out, f"{message} twice"
            out[message] = (number & 0x7FFFFFFF, bool(number >> 31), int(found[3]), {})
        elif found := SIGNAL.match(line):
            start, size, little = int(found[2]), int(found[3]), found[4] == "1"
            bits = list(range(start, start + size)) if little else motorola(start, size)
            signals = out[message][3]
            assert found[1] not in signals, f"{found[1]} twice"
            for name, (other, *_) in signals.items():
                assert not set(other) & set(bits), f"{name} and {found[1]} overlap"
            assert max(bits) < 8 * out[message][2], f"{found[1]} beyond its frame"
            signals[found[1]] = (bits, found[5] == "-", float(found[6]), float(found[7]))
        else:
            assert any(re.fullmatch(form, line) for form in OTHERS), f"no line of a DBC file: {line!r}"
    return out


def motorola(start, size):
    """Bits from the lowest: down a byte from its bit 7, then on at bit 7 of the next."""
    bits, bit = [], start
    for _ in range(size):
        bits.append(bit)
        bit = bit - 1 if bit % 8 else bit + 15
    return bits[::-1]


def decode(data, signals):
    out = {}
    for name, (bits, signed, factor, offset) in signals.items():
        raw = sum((data[bit // 8] >> bit % 8 & 1) << place for place, bit in enumerate(bits))
        if signed and raw >> (len(bits) - 1):
            raw -= 1 << len(bits)
        out[name] = raw * factor + offset
    return out


def compare(who, words, name, got, wanted):
    for signal, value in wanted.items():
        assert abs(float(got[signal]) - value) < 1e-6, f"{who} {words} {name}.{signal}: {got[signal]}, not {value}"


def with_strict(words, text, frames):
    messages = strict(text)
    for name, (data, wanted) in frames.items():
        number, extended, length, signals = messages[name]
        assert number == IDS[name] and extended == ("extended" in words), f"{name}: {number:#x}"
        data = bytes.fromhex(data)
        assert length == len(data)
        compare("strict", words, name, decode(data, signals), wanted)


def with_canmatrix(words, text, frames):
    import canmatrix.formats
    matrix = canmatrix.formats.loads_flat(text.encode(), import_type="dbc")
    assert not matrix.load_errors, matrix.load_errors
    for name, (data, wanted) in frames.items():
        frame = matrix.frame_by_name(name)
        assert frame.arbitration_id.id == IDS[name]
        assert frame.arbitration_id.extended == ("extended" in words)
        assert bool(frame.is_fd) == ("fd" in words), f"{name}: is_fd {frame.is_fd}"
        got = {key: value.phys_value for key, value in frame.decode(bytes.fromhex(data)).items()}
        compare("canmatrix", words, name, got, wanted)


def main():
    readers = [with_strict]
    try:
        import canmatrix.formats  # noqa: F401
        readers.append(with_canmatrix)
    except ImportError:
        print("canmatrix is not there: the strict reader alone")
    for words, frames in CASES:
        text = subprocess.run([sys.argv[1], *words], check=True, capture_output=True, text=True).stdout
        for reader in readers:
            reader(words, text, frames)
            print(f"{reader.__name__} {' '.join(words)}: {len(frames)} frames as written by hand")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main()
