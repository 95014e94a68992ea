#!/usr/bin/env python3
"""Writes small logs of every kind of message as seeds for the fuzzers: make_seeds.py FOLDER."""
import pathlib
import sqlite3
import struct
import sys
import tempfile
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


def blackbox() -> bytes:
    names = ['loopIteration', 'time', 'vbatLatest', 'amperageLatest', 'motor[0]', 'motor[1]', 'gyroADC[0]', 'gyroADC[1]',
             'gyroADC[2]', 'rcCommand[0]', 'rcCommand[1]', 'rcCommand[2]', 'rcCommand[3]', 'a', 'b', 'c']
    groups = '1,1,3,0,0,0,7,7,7,8,8,8,8,10,10,10'
    log = b'H Product:Blackbox flight data recorder by Nicholas Sherlock\nH Data version:2\n'
    for line in (f"Field I name:{','.join(names)}", 'Field I signed:0,0,0,1,0,0,1,1,1,1,1,1,1,1,1,1',
                 'Field I predictor:0,0,9,0,11,5,4,8,0,0,0,0,0,0,0,0', f'Field I encoding:{groups}',
                 'Field P predictor:6,2,1,1,3,3,1,1,1,1,1,1,1,1,1,1', 'Field P encoding:9,0,6,6,6,6,7,7,7,8,8,8,8,10,10,10',
                 'Field S name:flightModeFlags,stateFlags', 'Field S encoding:1,1', 'Field H name:GPS_home[0],GPS_home[1]',
                 'Field H encoding:0,0', 'Field G name:time,GPS_numSat,GPS_coord[0],GPS_coord[1]',
                 'Field G predictor:10,0,7,7', 'Field G encoding:1,1,0,0', 'I interval:4', 'P interval:1/2', 'minthrottle:1070',
                 'motorOutput:48,2047', 'vbatref:1600', 'gyro_scale:0x3f800000', 'Firmware revision:Betaflight 4.5.1 (a) X'):
        log += f'H {line}\n'.encode()
    intra = bytes([ord('I'), 0, 100, 1, 2, 3, 4, 0x07, 0b01100100, 1, 2, 0x50, 0x77])
    inter = bytes([ord('P'), 2, 0x03, 1, 2, 0x15, 0x00, 0xC0, 1, 2, 3])
    frames = intra + inter + inter + b'S\x01\x02' + b'H\x10\x20' + b'G\x07\x09\x02\x03' + b'E\x0e\x08\x10' + b'E\x00\x10'
    return (log + frames + intra + b'\x99' + inter + b'E\xffEnd of log\0') * 2


BLACKBOX_CSV = b"""loopIteration, time (us), gyroADC[0], vbatLatest (V), flightModeFlags (flags)
0, 100, -3, 16.51, ANGLE_MODE
1, 1100, 4, 16.50, 0
"""

EXPLORER_CSV = b'"Product","Blackbox flight data"\n"acc_1G","2048"\n"loopIteration","time","a"\n0,100,2048\n1,NaN,2\n'

HEADER = 'builtin_interfaces/Time stamp\nstring frame_id\n====\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n'
MSG = f'std_msgs/Header header\nfloat64[3] v\nIn[] items\nstring s\n====\nMSG: a/In\nint8 i\n====\nMSG: std_msgs/Header\n{HEADER}'
IDL = 'module a { module msg { typedef double d__3[3]; @x(y="z") struct T { long l; d__3 v; sequence<octet> o; string<4> s; }; }; };'


def mcap() -> bytes:
    def text(value: str) -> bytes:
        return struct.pack('<I', len(value)) + value.encode()

    def record(op: int, content: bytes) -> bytes:
        return struct.pack('<BQ', op, len(content)) + content

    body = struct.pack('<iI', 5, 6) + text('map\0') + struct.pack('<3d', 1, 2, 3) + struct.pack('<Ibb', 2, 1, 2)
    idl_body = struct.pack('<i4x3d', 1, 1, 2, 3) + struct.pack('<I', 1) + b'x' + bytes(3) + text('a\0')
    records = record(3, struct.pack('<H', 1) + text('a/msg/T') + text('ros2msg') + text(MSG))
    records += record(3, struct.pack('<H', 2) + text('a/msg/T') + text('ros2idl') + text(IDL))
    for channel in (1, 2):
        records += record(4, struct.pack('<HH', channel, channel) + text('/t%d' % channel) + text('cdr') + bytes(4))
    for i in range(3):
        records += record(5, struct.pack('<HIQQ', 1, i, 1000 + i, 1000) + b'\0\1\0\0' + body + bytes(2) + text('s\0'))
        records += record(5, struct.pack('<HIQQ', 2, i, 1000 + i, 1000) + b'\0\1\0\0' + idl_body)
    chunk = record(6, struct.pack('<QQQI', 0, 9, len(records), zlib.crc32(records)) + text('') + struct.pack('<Q', len(records)) + records)
    return b'\x89MCAP0\r\n' + record(1, text('ros2') + text('x')) + chunk + records + record(15, bytes(4)) + record(2, bytes(20))


def rosbag2() -> bytes:
    bag = sqlite3.connect(':memory:')
    bag.execute('PRAGMA page_size = 512')
    bag.executescript("""
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);
        CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT, encoding TEXT, encoded_message_definition TEXT);
        INSERT INTO topics VALUES(1, '/p', 'geometry_msgs/msg/Point', 'cdr'), (2, '/o', 'own/msg/T', 'cdr');
        INSERT INTO message_definitions VALUES(1, 'own/msg/T', 'ros2msg', 'float32[] x')""")
    for i in range(4):
        bag.execute('INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)', (i, b'\0\1\0\0' + struct.pack('<3d', 1, 2, i)))
        bag.execute('INSERT INTO messages(topic_id, timestamp, data) VALUES(2, ?, ?)', (i, b'\0\1\0\0' + struct.pack('<I2f', 2, 1, i)))
    bag.commit()
    with tempfile.NamedTemporaryFile() as file:
        bag.execute('VACUUM INTO ?', (file.name + '.db3',))
        path = pathlib.Path(file.name + '.db3')
        content = path.read_bytes()
        path.unlink()
    return content


folder = pathlib.Path(sys.argv[1])
for name, bytes_ in {
    'ulog/plain': ulog(False), 'ulog/flags': ulog(True), 'dataflash/small': dataflash(), 'dataflash_text/small': TEXT,
    'crazyflie/v1': crazyflie(1), 'crazyflie/v2': crazyflie(2), 'blackbox/small': blackbox(),
    'blackbox_csv/decoded': BLACKBOX_CSV, 'blackbox_csv/explorer': EXPLORER_CSV, 'mcap/small': mcap(), 'rosbag2/small': rosbag2(),
}.items():
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(bytes_)
