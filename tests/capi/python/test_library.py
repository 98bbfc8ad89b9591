"""import bodice where the library is not the right one: one sentence, with what is wrong and what to do."""

import os
import subprocess
import sys
import unittest


def sentence(library: str) -> str:
    """The error of an import with this library."""
    ran = subprocess.run([sys.executable, "-c", "import bodice"], env={**os.environ, "BODICE_LIBRARY": library},
                         capture_output=True, text=True)
    return ran.stderr.strip().splitlines()[-1] if ran.returncode else ""


class OtherLibraries(unittest.TestCase):
    def test_the_library_of_this_version_is_taken(self):
        self.assertEqual(sentence(os.environ["BODICE_LIBRARY"]), "")

    def test_one_of_another_version_is_named_with_what_differs(self):
        old = os.environ["BODICE_OTHER_ABI_1"]
        self.assertRegex(sentence(old), rf"ImportError: {old} \(bodice 0.0.1, ABI 1, .*\).*: bodice_\w+ is missing\. Install")
        self.assertRegex(sentence(os.environ["BODICE_OTHER_ABI_9"]), r"\(ABI 1\): the ABI differs\. Install both")

    def test_what_is_no_library_of_bodice_is_refused(self):
        import _ctypes  # a shared library that is always there
        if getattr(_ctypes, "__file__", None):
            self.assertRegex(sentence(_ctypes.__file__), "is no library of bodice. Name libbodice.so")
        self.assertRegex(sentence("/nowhere/libbodice.so"), "BODICE_LIBRARY names /nowhere/libbodice.so, which cannot")


if __name__ == "__main__":
    unittest.main()
