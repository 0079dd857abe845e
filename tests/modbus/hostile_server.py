#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A Modbus TCP server that misbehaves: hostile_server.py MODE UNTIL

Prints its port. Until CLOCK_MONOTONIC reaches UNTIL seconds it misbehaves as MODE says, now and
then or always; afterwards it is sound."""
import random
import socket
import struct
import sys
import threading
import time

import lawful

MODES = ("sound late unit transaction protocol length echo value_echo forget drip cut reset again extra hole half "
         "refuse flip zeros shifted wrong_function exception garbage huge deaf").split()


class Server:
    def __init__(self, mode, until):
        self.mode, self.until = mode, until
        self.registers = {}
        self.counter = 0
        self.begin = time.monotonic()
        self.open_until = 0.0

    def hostile(self, share=1.0):
        # The first moments are sound, so that there is something to lose.
        now = time.monotonic()
        return self.begin + 0.1 < now < self.until and random.random() < share

    def on(self, mode, share=1.0):
        return self.mode == mode and self.hostile(share)

    def read(self, first, count):
        self.counter = (self.counter + 1) % 65536
        for start, size in lawful.MESSAGES.values():
            for i, word in enumerate(lawful.block(start, size, self.counter)):
                self.registers[start + i] = word
        words = [self.registers.get(first + i, 0) for i in range(count)]
        if self.on("flip", 0.2):
            for _ in range(random.randint(1, 3)):
                words[random.randrange(count)] ^= 1 << random.randrange(16)
        if self.on("zeros", 0.5):
            words = [0] * count
        if self.on("shifted", 0.2):
            words = words[24:] + words[:24]
        return struct.pack(f">{count}H", *words)

    def answer(self, unit, pdu):
        function = pdu[0]
        if self.on("exception", 0.3):
            return unit, bytes([function | 0x80, random.choice([1, 2, 3, 4, 6, 11])])
        if function == 3:
            first, count = struct.unpack(">HH", pdu[1:5])
            data = self.read(first, count)
            reply = bytes([3, len(data)]) + data
        elif function == 16:
            first, count = struct.unpack(">HH", pdu[1:5])
            if not self.on("forget"):
                for i, word in enumerate(struct.unpack(f">{count}H", pdu[6:])):
                    self.registers[first + i] = word
            reply = pdu[:5]
            if self.on("echo", 0.2):
                reply = struct.pack(">BHH", 16, 0x7777, count)
            if self.on("value_echo", 0.2):
                reply = struct.pack(">BHH", 16, first, count - 1)
        else:
            reply = bytes([function | 0x80, 1])
        if self.on("wrong_function", 0.1):
            reply = bytes([4]) + reply[1:]
        if self.on("unit", 0.2):
            unit = 99
        return unit, reply

    def frame(self, transaction, unit, reply):
        protocol, length = 0, len(reply) + 1
        if self.on("transaction", 0.2):
            transaction = transaction + 1 & 0xFFFF
        if self.on("protocol", 0.2):
            protocol = 5
        if self.on("length", 0.2):
            length = 3
        if self.on("huge", 0.2):
            length = 0xFFFF
        out = struct.pack(">HHHB", transaction, protocol, length, unit) + reply
        if self.on("garbage", 0.2):
            out = random.randbytes(random.randint(1, 300))
        return out

    def send(self, connection, out):
        """False: the connection is over."""
        if self.on("late", 0.05):
            time.sleep(random.uniform(0.05, 0.3))
        if self.on("drip", 0.05):
            for byte in out:
                connection.sendall(bytes([byte]))
                time.sleep(0.02)
            return True
        if self.on("cut", 0.1):
            connection.sendall(out[: random.randrange(len(out))])
            return random.random() < 0.5
        if self.on("reset", 0.1):
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            return False
        if self.on("again", 0.1):
            out = out + out
        if self.on("extra", 0.1):
            out = out + bytes(7)
        connection.sendall(out)
        return True

    def serve(self, connection):
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        begin = time.monotonic()
        try:
            while True:
                if self.on("deaf") and time.monotonic() > begin + 0.05:
                    time.sleep(0.3)  # takes nothing any more
                    return
                head = connection.recv(7, socket.MSG_WAITALL)
                if len(head) < 7:
                    return
                transaction, _, length, unit = struct.unpack(">HHHB", head)
                pdu = connection.recv(length - 1, socket.MSG_WAITALL)
                if self.on("hole"):
                    continue
                if self.on("half") and time.monotonic() > begin + 0.05:
                    time.sleep(1.0)  # neither answers nor closes: the cable is out
                    return
                if self.on("refuse"):
                    return
                if not self.send(connection, self.frame(transaction, *self.answer(unit, pdu))):
                    return
        except OSError:
            pass
        finally:
            connection.close()

    def run(self):
        port = 0
        while True:
            listener = socket.socket()
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(("127.0.0.1", port))
            listener.listen(5)
            if port == 0:
                port = listener.getsockname()[1]
                print(port, flush=True)
            listener.settimeout(0.02)
            while time.monotonic() < self.open_until or not self.on("refuse"):
                try:
                    connection, _ = listener.accept()
                except TimeoutError:
                    continue
                connection.settimeout(None)
                threading.Thread(target=self.serve, args=(connection,), daemon=True).start()
            listener.close()
            time.sleep(random.uniform(0, 0.4))
            # Now and then it takes a connection, and drops it with the first request.
            self.open_until = time.monotonic() + random.uniform(0, 0.1)


if len(sys.argv) != 3 or sys.argv[1] not in MODES:
    sys.exit(f"usage: hostile_server.py {'|'.join(MODES)} UNTIL_S")
random.seed(1)
Server(sys.argv[1], float(sys.argv[2])).run()
