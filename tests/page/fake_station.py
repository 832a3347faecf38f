"""A station that says what a test wants: the hub's local socket protocol (firmware/handover/message.cpp)."""
import json
import socket
import struct

MAGIC = b"TGM1"
KINDS = ["hello", "scan", "state", "shape", "picture", "stored", "set_aside", "refused"]


class FakeStation:
    def __init__(self, socket_path, name="kitchen"):
        self.name = name
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.settimeout(5)
        self.socket.connect(str(socket_path))
        self.send("hello", {"station": name, "program": "9.9.9"})

    def send(self, kind, text, body=b""):
        data = json.dumps(text).encode()
        head = MAGIC + bytes([KINDS.index(kind)]) + struct.pack("<II", len(data), len(body))
        self.socket.sendall(head + data + body)

    def tell_state(self, state="waiting", **more):
        self.send("state", {"state": state, "waiting_results": 0, "disk": None, "faults": [], **more})

    def tell_shape(self, shape):
        self.send("shape", {"id": shape["id"]}, json.dumps(shape).encode())

    def hand_over(self, document):
        """Returns once the hub has stored it."""
        self.send("scan", {"id": document["id"]}, json.dumps(document).encode())
        head = self._read(13)
        text_bytes, body_bytes = struct.unpack("<II", head[5:])
        answer = self._read(text_bytes + body_bytes)
        if KINDS[head[4]] != "stored":
            raise AssertionError(f"the hub did not store {document['id']}: {answer!r}")

    def _read(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise AssertionError("the hub closed the connection of the station")
            data += part
        return data

    def close(self):
        self.socket.close()
