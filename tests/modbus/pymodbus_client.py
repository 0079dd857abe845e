#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A controller that polls, as pymodbus makes it: pymodbus_client.py tcp PORT SECONDS | serial DEVICE SECONDS

Writes lawful messages, reads ours and checks every value. Exits with 1 on a wrong one or on none."""
import sys
import time

from pymodbus.client import ModbusSerialClient, ModbusTcpClient

import lawful

kind, where, seconds = sys.argv[1], sys.argv[2], float(sys.argv[3])
if kind == "tcp":
    client = ModbusTcpClient("127.0.0.1", port=int(where))
else:
    client = ModbusSerialClient(where, baudrate=115200, timeout=1)  # it takes 0.5 for 0
while not client.connect():
    time.sleep(0.05)
end = time.monotonic() + seconds
counter = right = wrong = void = 0
while time.monotonic() < end:
    counter = (counter + 1) % 65536
    for first, size in lawful.MESSAGES.values():
        answer = client.write_registers(first, lawful.block(first, size, counter), slave=1)
        assert not answer.isError(), answer
    for first, size in lawful.OURS.values():
        answer = client.read_holding_registers(first, 2 * size + 3, slave=1)
        assert not answer.isError(), answer
        good = lawful.is_lawful(first, answer.registers)
        right += good is True
        wrong += good is False
        void += good is None
assert client.read_holding_registers(0, 1, slave=1).isError(), "a register that is not there"
assert client.write_registers(1200, [1], slave=1).isError(), "a register that is not theirs"
print(f"{right} right, {wrong} wrong, {void} without check sum, {counter} cycles")
sys.exit(0 if right > 10 and wrong == 0 and void <= 10 else 1)
