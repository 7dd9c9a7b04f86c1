"""The bill of materials names what the program is linked with and what the page is made of."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["BOLTER"]


@unittest.skipUnless(shutil.which("dpkg-query"), "no Debian")
class Bill(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        command = [sys.executable, ROOT / "scripts/sbom.py", PROGRAM]
        env = dict(os.environ, SOURCE_DATE_EPOCH="86400")
        first, again = (subprocess.run(command, check=True, capture_output=True, env=env).stdout
                        for _ in range(2))
        cls.same, cls.bill = first == again, json.loads(first)

    def named(self, kind):
        return {p["name"]: p for p in self.bill["packages"] if f"-{kind}-" in p["SPDXID"]}

    def test_the_same_build_gives_the_same_file(self):
        self.assertTrue(self.same)
        self.assertEqual(self.bill["creationInfo"]["created"], "1970-01-02T00:00:00Z")

    def test_every_library_that_the_program_names_has_its_package(self):
        dynamic = subprocess.run(["readelf", "-d", PROGRAM], capture_output=True, text=True).stdout
        needed = re.findall(r"\(NEEDED\).*\[lib(\w+)", dynamic)
        self.assertIn("yaml", needed)
        packages = " ".join(self.named("deb"))
        for library in set(needed) - {"c", "m"}:
            self.assertIn(library.split("_")[0], packages)
        self.assertIn("libc6", packages)

    def test_the_page_s_packages_are_those_of_the_lock_file(self):
        lock = json.loads((ROOT / "web/package-lock.json").read_text())["packages"]
        wanted = {k.removeprefix("node_modules/"): v["version"]
                  for k, v in lock.items() if k and not v.get("dev")}
        found = {name: p["versionInfo"] for name, p in self.named("npm").items()}
        self.assertEqual(found, wanted)
        self.assertEqual(len(self.named("npm")["three"]["checksums"][0]["checksumValue"]), 128)

    def test_every_element_is_named_once_and_related(self):
        names = [p["SPDXID"] for p in self.bill["packages"]]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual({r["relatedSpdxElement"] for r in self.bill["relationships"]}, set(names))
        for name in names:
            self.assertRegex(name, r"^SPDXRef-[A-Za-z0-9.-]+$")


if __name__ == "__main__":
    unittest.main()
