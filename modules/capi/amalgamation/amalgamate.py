#!/usr/bin/env python3
"""Writes the frame side of bodice as two files to drop into a program: bodice_frame.h and bodice_frame.cpp.

    python3 amalgamate.py FOLDER [EIGEN]   EIGEN: the folder that has Eigen/Core (default /usr/include/eigen3)

The .cpp needs a C++20 compiler and nothing else. Eigen's headers are in it, under a namespace of its own. Where
<hwy/highway.h> is found, kernels use the instruction set that the compiler is allowed; else they compute one particle
at a time. With -DBODICE_WITH_JSON and <nlohmann/json.hpp>, proxies may also be JSON.
"""

import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
LAYERS = {name: ROOT / ("engine" if name == "engine" else f"modules/{name}")
          for name in ("engine", "geometry", "body", "proxy", "rig", "binding", "collision", "capi")}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">].*$')
HEADERS_OF_C = ["base", "proxy", "collider", "particles", "exact"]
# Sources that are whole layers of the frame side; of the others only what these use.
WHOLE = {"capi": r"/(base|arrays|frame)/(?!highway_runtime)", "collision": r"(?<!kernels_[a-z]{4})\.cpp$",
         "binding": r"/pose/", "proxy": r"/(?!base_pose|proxy_file|proxy_surface|crossed_cells)[a-z_0-9]+\.cpp$"}
# Sources of headers that the frame side includes for their types, and functions that it does not call.
NEVER = (r"/(kernels(_[a-z0-9]+)?|tbb_executor|log_sinks|highway_runtime|proxy_distance|add_things|write_file|"
         r"proxy_file|base_pose_file|table_warp|dual_quaternion|skeleton|skinning)\.cpp$")
# Eigen's own kinds of vectors, processors and back ends: not needed, since nothing here is vectorized by Eigen.
FOREIGN = r"arch/(?!Default)|GPU|CUDA|HIP|SYCL|MKL|BLAS|LAPACK|misc/(blas|lapack)|Accelerate|openmp|omp\.h"


def resolve(name, layer, here):
    """The file that an include of a layer's source means, with its layer; None for one that is not ours."""
    if name.startswith("bodice/c/") or name in ("bodice.h", "bodice.hpp"):
        return LAYERS["capi"] / "include" / name, "capi"
    if name.startswith("bodice/"):
        other = name.split("/")[1]
        return LAYERS[other] / "include" / name, other
    for folder in (LAYERS[layer] / "src", here.parent):
        if (folder / name).exists():
            return folder / name, layer
    return None


def includes_of(file):
    return [match.group(2) for line in file.read_text().splitlines() if (match := INCLUDE.match(line))]


def sources():
    """The .cpp files, layer by layer from below: those of WHOLE, and those that define what their headers declare."""
    files = {file: layer for layer, folder in LAYERS.items() for file in sorted(folder.glob("src/**/*.cpp"))
             if not re.search(NEVER, str(file)) and "/whole/" not in str(file)}
    first = {}
    for file, layer in files.items():
        own = [found[0] for name in includes_of(file) if (found := resolve(name, layer, file)) and found[1] == layer]
        first[file] = own[0] if own else None
    wanted, seen = set(), set()

    def see(file, layer):
        for name in includes_of(file):
            found = resolve(name, layer, file)
            if found and found[0] not in seen:
                seen.add(found[0])
                see(*found)

    pending = [file for file, layer in files.items() if layer in WHOLE and re.search(WHOLE[layer], str(file))]
    while pending:
        file = pending.pop()
        if file in wanted:
            continue
        wanted.add(file)
        see(file, files[file])
        pending += [other for other, header in first.items() if header in seen and other not in wanted]
    return [(file, layer) for file, layer in files.items() if file in wanted]


def hidden_names(text):
    """The names that a source defines for itself, in anonymous namespaces."""
    names = set()
    for block in re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", text, re.M | re.S):
        for line in block.splitlines():
            names.update(re.findall(r"\b(k[A-Z]\w*) =", line) if "constexpr" in line else [])
            if re.match(r"[A-Za-z]", line) and not re.match(r"using (?!\w+ =)|namespace \{|static_assert", line):
                declared = re.match(r"(?:template.*)?(?:struct|class|enum class|enum) (\w+)|using (\w+) =|"
                                    r"namespace (\w+) =|[^=;]*?(\w+)(?:\[[^]]*\])?(?:\(| =|\{|;)", line)
                if declared:
                    names.add(next(name for name in declared.groups() if name))
    return names - {"operator", "if", "for", "return"}


class Writer:
    def __init__(self, eigen):
        self.eigen, self.once, self.out, self.declared = eigen, set(), [], ""

    def add(self, text):
        self.out.append(text if text.endswith("\n") else text + "\n")

    def file(self, file, layer):
        """A file of ours, with what it includes where it is included first."""
        if file in self.once:
            return
        self.once.add(file)
        self.declared += file.read_text()
        for line in file.read_text().splitlines():
            match = INCLUDE.match(line)
            if line.strip() == "#pragma once":
                continue
            if not match:
                self.add(line)
                continue
            name = match.group(2)
            if name in ("bodice.h", "bodice.hpp") or name.startswith("bodice/c/"):
                continue  # the header is there already
            found = resolve(name, layer, file)
            if found:
                self.file(*found)
            elif name.startswith("Eigen/"):
                self.eigen_file(self.eigen / name)
            elif name.startswith(("hwy/", "nlohmann/")):
                continue  # stands at the top, where it is found
            else:
                self.add(line)

    def eigen_file(self, file):
        toggles = file.name in ("DisableStupidWarnings.h", "ReenableStupidWarnings.h")
        if file in self.once and not toggles:
            return
        self.once.add(file)
        for line in file.read_text(encoding="utf8", errors="replace").splitlines():
            match = INCLUDE.match(line)
            if not match:
                self.add(line)
                continue
            if re.search(FOREIGN, match.group(2)):
                continue
            for at in (file.parent / match.group(2), self.eigen / match.group(2)):
                if at.exists() and at.is_file() and not match.group(2).startswith("hip"):
                    self.eigen_file(at)
                    break
            else:
                self.add(line)

    def text(self):
        return "".join(self.out)


def header_text(name):
    text = (LAYERS["capi"] / f"include/bodice/c/{name}.h").read_text()
    return re.sub(r"^#include <bodice/c/.*\n", "", text, flags=re.M)


def header():
    parts = ["/* The frame side of bodice in C: see the functions below. Made by modules/capi/amalgamation. MIT license. */\n"
             "#ifndef BODICE_FRAME_H\n#define BODICE_FRAME_H\n#ifndef BODICE_STATIC\n#define BODICE_STATIC\n#endif\n"]
    return "".join(parts + [header_text(name) for name in HEADERS_OF_C]) + "#endif\n"


def source(eigen):
    writer = Writer(eigen)
    for name in ("top.hpp", "one_lane.hpp", "one_lane_logic.hpp"):
        writer.add((HERE / name).read_text())
    writer.add("#endif")
    for name in ("skin", "fit", "session"):  # their structures are known to the checks of all structures
        writer.add(header_text(name))
    writer.once |= {LAYERS["collision"] / "src/simd/dispatch/kernel_targets.hpp"}
    files = sources()
    texts = {file: file.read_text() for file, _ in files}
    count = {}
    for file, layer in files:
        for name in hidden_names(texts[file]):
            count.setdefault((layer, name), []).append(file)
    for number, (file, layer) in enumerate(files):
        body = len(writer.out)
        # What it includes comes before, so that no name of a header is changed.
        for name in includes_of(file):
            found = resolve(name, layer, file)
            if found and not name.startswith(("bodice/c/", "bodice.h")):
                writer.file(*found)
            elif not found and not name.startswith(("bodice", "hwy/", "nlohmann/")):
                writer.eigen_file(eigen / name) if name.startswith("Eigen/") else writer.add(f"#include <{name}>")
        # Functions that a header declares as well are overloads, and keep their name.
        clashing = sorted(name for name in hidden_names(texts[file])
                          if len(count[layer, name]) > 1 and not re.search(rf"\b{name}\(", writer.declared))
        json = "nlohmann/json.hpp" in texts[file] or "engine/json.hpp" in texts[file]
        writer.add(f"// -- {file.relative_to(ROOT)}")
        if json:
            writer.add("#ifdef BODICE_WITH_JSON")
        for name in clashing:
            writer.add(f"#define {name} {name}_in_{number}")
        writer.add(re.sub(r"^[ \t]*#[ \t]*include.*\n", "", texts[file], flags=re.M))
        for name in clashing:
            writer.add(f"#undef {name}")
        if json:
            writer.add("#endif")
    writer.add("#define BODICE_KERNEL_TARGET HWY_STATIC_TARGET")
    for name in ("kernel-inl.hpp", "kernels.cpp"):
        writer.file(LAYERS["collision"] / "src/simd/dispatch" / name, "collision")
    writer.add((HERE / "bottom.hpp").read_text())
    return writer.text()


def main():
    folder = pathlib.Path(sys.argv[1])
    eigen = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else "/usr/include/eigen3")
    if not (eigen / "Eigen/Core").exists():
        sys.exit(f"amalgamate: {eigen} has no Eigen/Core. Name the folder that has it.")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "bodice_frame.h").write_text(header())
    (folder / "bodice_frame.cpp").write_text(source(eigen))


if __name__ == "__main__":
    main()
