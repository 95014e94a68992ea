#!/usr/bin/env python3
"""Writes small logs of every kind of message as seeds for the fuzzers: make_seeds.py FOLDER."""
import pathlib
import struct
import sys
import zlib


def ulog(flags: bool) -> bytes:
    def message(kind: str, payload: bytes) -> bytes:
        return struct.pack('<HB', len(payload), ord(kind)) + payload

    def keyed(kind: str, key: str, value: bytes) -> bytes:
        return message(kind, bytes([len(key)]) + key.encode() + value)

    sync = b'\x2f\x73\x13\x20\x25\x0c\xbb\x12'
    log = b'ULog\x01\x12\x35' + bytes([1]) + struct.pack('<Q', 1000)
    if flags:
        log += message('B', bytes(8) + bytes([1]) + bytes(7) + struct.pack('<QQQ', 400, 0, 0))
    log += message('F', b'esc:uint64_t timestamp;int32_t rpm;uint8_t[4] _padding0;')
    log += message('F', b'status:uint64_t timestamp;esc[2] esc;float[3] q;bool ok;char[4] name;uint8_t[3] _padding0;')
    log += keyed('I', 'char[5] sys_name', b'PX4v1') + keyed('P', 'float CA_ROTOR0_PX', struct.pack('<f', 0.1))
    log += message('A', b'\x00' + struct.pack('<H', 3) + b'status') + message('A', b'\x01' + struct.pack('<H', 4) + b'esc')
    for i in range(4):
        esc = struct.pack('<Qi4x', 2000 + i, 100 * i)
        log += message('D', struct.pack('<HQ', 3, 2000 + i) + esc + esc + struct.pack('<3f?4s', 1, 2, 3, True, b'abcd'))
        log += message('D', struct.pack('<H', 4) + esc) + message('S', sync) + message('O', struct.pack('<H', 20))
    return log + keyed('P', 'int32_t MC_A', struct.pack('<i', 7)) + message('L', b'6' + bytes(8) + b'text')


def dataflash() -> bytes:
    def fmt(kind: int, length: int, name: str, letters: str, columns: str) -> bytes:
        return b'\xa3\x95\x80' + struct.pack('<BB4s16s64s', kind, length, name.encode(), letters.encode(), columns.encode())

    log = fmt(128, 89, 'FMT', 'BBnNZ', 'Type,Length,Name,Format,Columns')
    log += fmt(1, 31, 'PARM', 'QNf', 'TimeUS,Name,Value') + fmt(2, 23, 'IMU', 'QffI', 'TimeUS,GyrX,GyrY,EG')
    log += fmt(3, 75, 'MSG', 'QZ', 'TimeUS,Message') + fmt(4, 28, 'MIX', 'BbhHcCLgqM', 'A,B,C,D,E,F,G,H,I,J')
    log += fmt(5, 44, 'FMTU', 'QBNN', 'TimeUS,FmtType,UnitIds,MultIds') + fmt(6, 76, 'UNIT', 'QbZ', 'TimeUS,Id,Label')
    log += fmt(7, 20, 'MULT', 'Qbd', 'TimeUS,Id,Mult')
    for i in range(3):
        log += b'\xa3\x95\x01' + struct.pack('<Q16sf', i, b'MOT_PWM_MIN', i)
        log += b'\xa3\x95\x02' + struct.pack('<QffI', i, 1, 2, 3)
        log += b'\xa3\x95\x03' + struct.pack('<Q64s', i, b'ArduCopter V4.3.6')
        log += b'\xa3\x95\x05' + struct.pack('<QB16s16s', i, 2, b'sEE-', b'F---')
        log += b'\xa3\x95\x06' + struct.pack('<Qb64s', i, ord('E'), b'rad/s')
        log += b'\xa3\x95\x07' + struct.pack('<Qbd', i, ord('F'), 1e-6) + b'junk'
    return log


TEXT = b"""
FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns
FMT, 129, 31, PARM, QNf, TimeUS,Name,Value
FMT, 130, 23, IMU, QffM, TimeUS,GyrX,GyrY,Mode
PARM, 12, MOT_PWM_MIN, 1000
MSG, 1, ArduCopter V3.2.1, and more
IMU, 123, 0.5, -1e3, STABILIZE
IMU, 124, 0.5, nan, 3
"""


def crazyflie(version: int) -> bytes:
    log = b'\xbc' + struct.pack('<HH', version, 2)
    log += struct.pack('<H', 0xFFFF) + b'fixedFrequency\0' + struct.pack('<H', 3) + b'acc.x(f)\0motor.m1(H)\0a(e)\0'
    log += struct.pack('<H', 1) + b'estGyroscope\0' + struct.pack('<H', 1) + b'x(d)\0'
    time = '<I' if version == 1 else '<Q'
    for i in range(4):
        log += struct.pack('<H', 0xFFFF) + struct.pack(time, 1000 + i) + struct.pack('<fHe', 1, 2, 3)
        log += struct.pack('<H', 1) + struct.pack(time, 1001 + i) + struct.pack('<d', 4)
    return log + struct.pack('<I', zlib.crc32(log))


folder = pathlib.Path(sys.argv[1])
for name, bytes_ in {
    'ulog/plain': ulog(False), 'ulog/flags': ulog(True), 'dataflash/small': dataflash(), 'dataflash_text/small': TEXT,
    'crazyflie/v1': crazyflie(1), 'crazyflie/v2': crazyflie(2),
}.items():
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(bytes_)
