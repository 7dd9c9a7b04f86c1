"""The Python blocks of docs/howto-python.md run, in order, as a reader would type them."""

import os
import re
import tempfile
import unittest
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/howto-python.md"


class Page(unittest.TestCase):
    def test_every_block_runs(self):
        blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.M | re.S)
        self.assertGreater(len(blocks), 5)
        names, here = {}, os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for block in blocks:
                    exec(compile(block, str(PAGE), "exec"), names)
            finally:
                os.chdir(here)
        self.assertEqual(names["counts"].done, 32)
        self.assertEqual(len(names["table"]["margin_m"]), 4)


if __name__ == "__main__":
    unittest.main()
