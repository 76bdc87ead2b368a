"""A viewer of web_node: a WebSocket (RFC 6455) of the standard library alone, so that a test can also send what no browser would."""

import base64
import hashlib
import json
import os
import socket
import struct
import time

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
GUID = b'258EAFA5-E914-47DA-95CA-C5AB0DC85B11'


class Refused(Exception):
    """The server answered the handshake with another status than 101."""


def http(port, path, method='GET', host=None, timeout=20, **headers):
    """One request; its status, headers in lower case, and body."""
    lines = [f'{method} {path} HTTP/1.1']
    if host != '':
        lines.append(f'Host: {host or f"localhost:{port}"}')
    lines += [f'{name.replace("_", "-")}: {value}' for name, value in headers.items()]
    with socket.create_connection(('127.0.0.1', port), timeout=timeout) as wire:
        wire.sendall(('\r\n'.join(lines) + '\r\n\r\n').encode('latin-1'))
        answer = b''
        while True:
            part = wire.recv(65536)
            if not part:
                break
            answer += part
    return split_head(answer)


def split_head(answer):
    head, _, body = answer.partition(b'\r\n\r\n')
    first, *fields = head.decode('latin-1').split('\r\n')
    headers = {name.lower(): value for name, value in (field.split(': ', 1) for field in fields)}
    return int(first.split()[1]) if first else None, headers, body


class Viewer:
    def __init__(self, port, path='/socket', host=None, origin=None, receive_buffer=None):
        self.wire = socket.socket()
        if receive_buffer:
            self.wire.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.wire.settimeout(20)
        self.wire.connect(('127.0.0.1', port))
        self.buffer = b''
        self.closed = None  # the code of the server's close, or 0 where the connection ended without one
        self.last = {}  # the last message of each type
        key = base64.b64encode(os.urandom(16))
        lines = [f'GET {path} HTTP/1.1', f'Host: {host or f"localhost:{port}"}', 'Upgrade: websocket', 'Connection: Upgrade',
                 f'Sec-WebSocket-Key: {key.decode()}', 'Sec-WebSocket-Version: 13']
        if origin is not None:
            lines.append(f'Origin: {origin}')
        self.wire.sendall(('\r\n'.join(lines) + '\r\n\r\n').encode('latin-1'))
        while b'\r\n\r\n' not in self.buffer:
            part = self.wire.recv(4096)
            if not part:
                raise Refused('the connection ended')
            self.buffer += part
        status, headers, _ = split_head(self.buffer)
        if status != 101:
            self.wire.close()
            raise Refused(status)
        self.buffer = self.buffer.partition(b'\r\n\r\n')[2]
        if headers['sec-websocket-accept'] != base64.b64encode(hashlib.sha1(key + GUID).digest()).decode():
            raise AssertionError(headers)

    def send_frame(self, payload, kind=TEXT, final=True, masked=True):
        size = len(payload)
        head = bytes([kind | (0x80 if final else 0)])
        mark = 0x80 if masked else 0
        if size < 126:
            head += bytes([mark | size])
        elif size < 65536:
            head += bytes([mark | 126]) + struct.pack('>H', size)
        else:
            head += bytes([mark | 127]) + struct.pack('>Q', size)
        mask = os.urandom(4) if masked else b''
        body = bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload)) if masked else payload
        self.wire.sendall(head + mask + body)

    def send(self, op, **fields):
        self.send_frame(json.dumps({'op': op, **fields}).encode())

    def take(self, count):
        while len(self.buffer) < count:
            part = self.wire.recv(65536)
            if not part:
                raise ConnectionError('the server closed')
            self.buffer += part
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def frame(self):
        first, second = self.take(2)
        size = second & 0x7f
        if size == 126:
            size = struct.unpack('>H', self.take(2))[0]
        elif size == 127:
            size = struct.unpack('>Q', self.take(8))[0]
        return first & 0x0f, self.take(size)

    def message(self):
        """The next one; None where the server has closed."""
        try:
            while True:
                kind, payload = self.frame()
                if kind == TEXT:
                    message = json.loads(payload.decode())
                    self.last[message['type']] = message
                    return message
                if kind == PING:
                    self.send_frame(payload, PONG)
                if kind == CLOSE:
                    self.closed = struct.unpack('>H', payload[:2])[0] if payload else 0
                    return None
        except (ConnectionError, BrokenPipeError):
            self.closed = self.closed or 0
            return None

    def wait(self, kind, holds=lambda message: True, deadline=60):
        """The next message of a kind that holds."""
        end = time.monotonic() + deadline
        while time.monotonic() < end:
            message = self.message()
            if message is None:
                raise AssertionError(f'closed ({self.closed}) while waiting for {kind}')
            if message['type'] == kind and holds(message):
                return message
        raise AssertionError(f'no {kind} in {deadline} s that holds; the last one: {self.last.get(kind)}')

    def wait_for_close(self, deadline=60):
        end = time.monotonic() + deadline
        while time.monotonic() < end:
            if self.message() is None:
                return self.closed
        raise AssertionError('the server did not close')

    def close(self):
        self.wire.close()
