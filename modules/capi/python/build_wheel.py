"""Makes the wheel of `bodice` for pip (PEP 517) with CMake and the standard library alone, so that it works offline."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


def version() -> str:
    return re.search(r"project\(bodice\s+VERSION\s+([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def run(*command: str) -> None:
    """Runs a command. pip shows none of its output without -v, and a build takes minutes: it goes to the terminal."""
    try:
        terminal = open("/dev/tty", "w")
    except OSError:  # started by a program that has none
        subprocess.check_call(command)
        return
    with terminal:
        subprocess.check_call(command, stdout=terminal)


def library() -> pathlib.Path:
    """The shared library: the one that BODICE_LIBRARY names, or libbodice, built where it was built before."""
    if os.environ.get("BODICE_LIBRARY"):
        return pathlib.Path(os.environ["BODICE_LIBRARY"]).resolve()
    build = ROOT / "build" / "release"
    if not (build / "CMakeCache.txt").exists():
        build = ROOT / "build" / "python"
        run("cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", str(build), "--target", "bodice_c")
    return (build / "modules" / "capi" / "libbodice.so").resolve()


def library_name(file: pathlib.Path) -> str:
    return "libbodice_frame.so" if file.name.startswith("libbodice_frame") else "libbodice.so"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None) -> str:
    platform = re.sub("[-.]", "_", sysconfig.get_platform())
    info = f"bodice-{version()}.dist-info"
    built = library()
    files = {f"bodice/{source.name}": source.read_bytes() for source in sorted((HERE / "bodice").iterdir())
             if source.suffix in (".py", ".pyi") or source.name == "py.typed"}
    files[f"bodice/{library_name(built)}"] = built.read_bytes()
    files[f"{info}/METADATA"] = (
        f"Metadata-Version: 2.1\nName: bodice\nVersion: {version()}\nLicense: MIT\nRequires-Python: >=3.9\n"
        "Requires-Dist: numpy\nSummary: Analytic body proxies: fits, signed distances, contacts, poses\n").encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: bodice\nRoot-Is-Purelib: false\n"
                              f"Tag: py3-none-{platform}\n").encode()
    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"bodice-{version()}-py3-none-{platform}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return wheel


def digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_sdist(sdist_directory, config_settings=None) -> str:
    raise NotImplementedError("The sources of the package are the whole repository: clone it, and pip install there.")
