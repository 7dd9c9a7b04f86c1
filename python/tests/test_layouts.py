"""What the package says of C is what the headers say: sizes, offsets, functions."""

import ctypes
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from bolter import _library as lib

ROOT = Path(__file__).resolve().parents[2]
INCLUDE = Path(os.environ.get("BOLTER_INCLUDE", ROOT / "include"))
COMPILER = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc")


def layout_of_python(struct):
    yield f"{struct.__name__} {ctypes.sizeof(struct)}"
    for name, *_ in struct._fields_:
        field = getattr(struct, name)
        yield f"{struct.__name__}.{name} {field.offset} {field.size}"


def program():
    yield "#include <bolter/bolter.h>\n#include <stdio.h>\nint main(void) {"
    for struct in lib.STRUCTS:
        s = struct.__name__
        yield f'printf("{s} %zu\\n", sizeof({s}));'
        for name, *_ in struct._fields_:
            size = f"sizeof((({s}*)0)->{name})"
            yield f'printf("{s}.{name} %zu %zu\\n", offsetof({s}, {name}), {size});'
    yield "return 0; }"


class Layouts(unittest.TestCase):
    @unittest.skipUnless(COMPILER, "no C compiler")
    def test_every_struct_is_laid_out_as_the_compiler_does(self):
        with tempfile.TemporaryDirectory() as folder:
            source, binary = Path(folder, "layout.c"), Path(folder, "layout")
            source.write_text("\n".join(program()))
            subprocess.run([COMPILER, f"-I{INCLUDE}", source, "-o", binary], check=True)
            printed = subprocess.run([binary], check=True, capture_output=True, text=True).stdout
        here = [line for struct in lib.STRUCTS for line in layout_of_python(struct)]
        self.assertEqual(printed.split("\n")[:-1], here)

    def headers(self):
        return "\n".join(path.read_text() for path in sorted(INCLUDE.glob("bolter/*.h")))

    def test_every_struct_of_the_headers_is_known(self):
        in_headers = set(re.findall(r"^typedef struct (bt_\w+) \{", self.headers(), re.M))
        self.assertEqual(in_headers, {struct.__name__ for struct in lib.STRUCTS})

    def test_every_function_of_the_headers_is_bound(self):
        declared = re.findall(r"BT_PUBLIC[^;]*?\b(bt_\w+)\(", self.headers())
        self.assertEqual(set(declared) | {"bt_status_text"}, set(lib.FUNCTIONS))

    def test_every_status_has_its_exception(self):
        from bolter.errors import BY_STATUS

        statuses = re.findall(r"X\((BT_\w+), ", self.headers())
        names = ["BT_OK" if kind is None else kind.status for kind in BY_STATUS]
        self.assertEqual(statuses, names)


if __name__ == "__main__":
    unittest.main()
