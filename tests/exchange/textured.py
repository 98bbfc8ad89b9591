"""A garment with materials and an image, as OBJ with its library."""
import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_textured(source, target):
    """The garment with two materials, one of them with an image, and texture coordinates that differ in every triangle."""
    pixels = b"".join(b"\0" + bytes((40 * x, 40 * y, 90)[k] for x in range(4) for k in range(3)) for y in range(4))
    with open("checks.png", "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 2, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))
    with open("checks.mtl", "w") as out: out.write("newmtl Checks\nmap_Kd checks.png\nnewmtl Band\nKd 0.6 0.1 0.1\n")
    lines = open(source).read().splitlines()
    faces = [line.split()[1:4] for line in lines if line.startswith("f ")]
    with open(target, "w") as out:
        print("mtllib checks.mtl", "o Skirt", *[line for line in lines if line.startswith("v ")], sep="\n", file=out)
        for t in range(len(faces)):
            print(f"vt {t / 100} 0", f"vt {t / 100} 1", f"vt {t / 100 + 0.01} 1", sep="\n", file=out)
        for t, face in enumerate(faces):
            if t in (0, len(faces) // 2): print("usemtl", "Checks" if t else "Band", file=out)
            print("f", *[f"{v.split('/')[0]}/{3 * t + k + 1}" for k, v in enumerate(face)], file=out)
