#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Peers that misbehave towards a Modbus TCP server: hostile_client.py PORT SECONDS

All at once and at random: dripped, cut, oversized, nonsensical requests, floods, connections that
say nothing, that are reset, that never read. Exits with 1 if the server stops taking connections."""
import random
import socket
import struct
import sys
import time

PORT, SECONDS = int(sys.argv[1]), float(sys.argv[2])
END = time.monotonic() + SECONDS


def request(pdu, protocol=0, length=None, unit=1):
    length = len(pdu) + 1 if length is None else length
    return struct.pack(">HHHB", random.randrange(65536), protocol, length & 0xFFFF, unit) + pdu


def random_pdu():
    function = random.choice([1, 2, 3, 4, 5, 6, 15, 16, 22, 23, 43, random.randrange(256)])
    return bytes([function]) + random.randbytes(random.randrange(252))


def read(first, count):
    return struct.pack(">BHH", 3, first, count)


def drip(s):
    for byte in request(read(1000, 10)):
        s.sendall(bytes([byte]))
        time.sleep(0.03)


def cut(s):
    whole = request(read(1000, 10))
    s.sendall(whole[: random.randrange(len(whole))])


def reset(s):
    s.sendall(request(read(1000, 10)))
    s.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))


def never_reads(s):
    s.settimeout(0.2)
    while True:
        s.sendall(request(read(1000, 125)) * 50)


ATTACKS = [
    drip, cut, reset, never_reads,
    lambda s: s.sendall(random.randbytes(random.randrange(1, 2000))),
    lambda s: s.sendall(request(random_pdu())),
    lambda s: s.sendall(b"".join(request(random_pdu()) for _ in range(50))),
    lambda s: s.sendall(request(read(1000, 10), protocol=random.randrange(65536))),
    lambda s: s.sendall(request(read(1000, 10), length=random.randrange(65536))),
    lambda s: s.sendall(request(read(random.randrange(65536), random.randrange(65536)))),
    lambda s: s.sendall(request(struct.pack(">BHHB", 16, 1048, 15, 30) + random.randbytes(30))),
    lambda s: s.sendall(b"GET / HTTP/1.1\r\n\r\n"),
    lambda s: time.sleep(0.1),
]

random.seed(2)
attacks = refused = 0
while time.monotonic() < END:
    sockets = []
    for _ in range(random.randint(1, 6)):
        s = socket.socket()
        s.settimeout(1)
        try:
            s.connect(("127.0.0.1", PORT))
            sockets.append(s)
            random.choice(ATTACKS)(s)
            attacks += 1
        except ConnectionRefusedError:
            refused += 1
        except OSError:
            pass  # it hung up: its right
    for s in sockets:
        s.close()
print(f"{attacks} attacks, {refused} refused")
sys.exit(1 if refused or not attacks else 0)
