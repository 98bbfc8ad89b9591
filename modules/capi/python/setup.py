"""Builds the shared library with CMake, or takes the one that BODICE_LIBRARY names, and puts it beside the package."""

import os
import pathlib
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


class BuildWithLibrary(build_py):
    def run(self):
        library = os.environ.get("BODICE_LIBRARY") or self.build_library()
        self.copy_file(str(pathlib.Path(library).resolve()), str(HERE / "bodice" / "libbodice_frame.so"))
        super().run()

    def build_library(self):
        build = ROOT / "build" / "python"
        subprocess.check_call(["cmake", "-S", str(ROOT), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                               "-DBODICE_BUILD_TRYON=OFF"])
        subprocess.check_call(["cmake", "--build", str(build), "--target", "bodice_c_frame"])
        return build / "modules" / "capi" / "libbodice_frame.so"


class BinaryDistribution(Distribution):
    def has_ext_modules(self):
        return True


setup(cmdclass={"build_py": BuildWithLibrary}, distclass=BinaryDistribution)
