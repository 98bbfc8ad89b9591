"""A reader of binary glTF by the words of its specification: nodes, meshes, sparse and normalized accessors."""
import array
import json
import math
import struct

CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}


class Glb:
    def __init__(self, file):
        data = open(file, "rb").read()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert magic == b"glTF" and version == 2 and length == len(data), file
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON"
        self.document = json.loads(data[20:20 + size])
        self.buffer = data[28 + size:]
        self.nodes = self.document["nodes"]
        self.parent = {child: n for n, node in enumerate(self.nodes) for child in node.get("children", [])}

    def _dense(self, view, offset, kind, count, width):
        begin = self.document["bufferViews"][view].get("byteOffset", 0) + offset
        values = array.array(CODES[kind])
        values.frombytes(self.buffer[begin:begin + count * width * values.itemsize])
        assert len(values) == count * width
        return list(values)

    def numbers(self, index):
        """Rows of an accessor."""
        a = self.document["accessors"][index]
        kind, width, count = a["componentType"], WIDTHS[a["type"]], a["count"]
        values = self._dense(a["bufferView"], a.get("byteOffset", 0), kind, count, width) if "bufferView" in a \
            else [0] * (count * width)
        if "sparse" in a:
            s = a["sparse"]
            at = self._dense(s["indices"]["bufferView"], 0, s["indices"]["componentType"], s["count"], 1)
            new = self._dense(s["values"]["bufferView"], 0, kind, s["count"], width)
            assert all(p < q for p, q in zip(at, at[1:])), "sparse indices rise"
            for i, v in enumerate(at): values[v * width:(v + 1) * width] = new[i * width:(i + 1) * width]
        if "min" in a and count:
            for k in range(width):
                assert min(values[k::width]) == a["min"][k] and max(values[k::width]) == a["max"][k], "bounds"
        if a.get("normalized"): values = [max(v / LARGEST[kind], -1) for v in values]
        return [values[i:i + width] for i in range(0, len(values), width)]

    def find(self, name):
        return next(i for i, node in enumerate(self.nodes) if node.get("name") == name)

    def local(self, node, changed=None):
        n = dict(self.nodes[node], **(changed or {}))
        x, y, z, w = n.get("rotation", [0, 0, 0, 1])
        s, t = n.get("scale", [1, 1, 1]), n.get("translation", [0, 0, 0])
        turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
        return [[turn[r][c] * s[c] for c in range(3)] + [t[r]] for r in range(3)]

    def world(self, node, changed=None):
        map_ = self.local(node, changed)
        while node in self.parent:
            node = self.parent[node]
            up = self.local(node)
            map_ = [[sum(up[r][k] * map_[k][c] for k in range(3)) + (up[r][3] if c == 3 else 0) for c in range(4)]
                    for r in range(3)]
        return map_

    def primitive(self, name):
        return self.document["meshes"][self.nodes[self.find(name)]["mesh"]]["primitives"][0]

    def points(self, name, frame=None):
        """World positions of a mesh, moved by one of its morph targets."""
        primitive, map_ = self.primitive(name), self.world(self.find(name))
        at = self.numbers(primitive["attributes"]["POSITION"])
        if frame is not None:
            moved = self.numbers(primitive["targets"][frame]["POSITION"])
            at = [[p + d for p, d in zip(a, b)] for a, b in zip(at, moved)]
        return [apply(map_, p) for p in at]


def apply(map_, p):
    return [row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3] for row in map_]


def most_apart(a, b):
    assert len(a) == len(b) > 0
    return max(math.dist(p, q) for p, q in zip(a, b))
