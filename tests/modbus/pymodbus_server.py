#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A controller as pymodbus makes it: pymodbus_server.py tcp PORT | serial DEVICE

Its registers hold lawful messages, renewed every 2 ms."""
import asyncio
import sys

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartAsyncSerialServer, StartAsyncTcpServer
from pymodbus.transaction import ModbusRtuFramer

import lawful

registers = ModbusSequentialDataBlock(1000, [0] * 300)
context = ModbusServerContext(slaves=ModbusSlaveContext(hr=registers, zero_mode=True), single=True)


async def renew(period):
    counter = 0
    while True:
        counter = (counter + 1) % 65536
        for first, size in lawful.MESSAGES.values():
            registers.setValues(first, lawful.block(first, size, counter))
        await asyncio.sleep(period)


async def main():
    kind, where = sys.argv[1:3]
    asyncio.get_running_loop().create_task(renew(0.002 if kind == "tcp" else 0.02))
    if kind == "tcp":
        # Started again after a kill it finds its old connection in TIME-WAIT; without this it would not listen.
        await StartAsyncTcpServer(context=context, address=("127.0.0.1", int(where)), allow_reuse_address=True)
    else:
        await StartAsyncSerialServer(context=context, framer=ModbusRtuFramer, port=where, baudrate=115200, timeout=0.005)


asyncio.run(main())
