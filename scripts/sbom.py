#!/usr/bin/env python3
"""The bill of materials of a build, SPDX 2.3 in JSON: what the program is linked with, as the Debian
packages installed here, and what the report page has in it, as web/package-lock.json names it.

    scripts/sbom.py PROGRAM >bolter.spdx.json

Times come from SOURCE_DATE_EPOCH, so that the same build gives the same file.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
from base64 import b64decode
from datetime import datetime, timezone
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADERS = ["librandom123-dev"]  # compiled in; nothing is left to link with


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def loaded(program):
    """Path of every library that the program names itself."""
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "-d", program))
    paths = dict(re.findall(r"^\s*(\S+) => (\S+)", run("ldd", program), re.M))
    return [os.path.realpath(paths[name]) for name in needed if name in paths]


def owner(path):
    """The Debian package of a file, which dpkg may know under /lib or /usr/lib."""
    for known in (path, path.removeprefix("/usr")):
        found = subprocess.run(["dpkg-query", "-S", known], capture_output=True, text=True).stdout
        if found:
            return found.split(": ")[0].split(",")[0]
    raise SystemExit(f"sbom: no package owns {path}")


def described(name, version, supplier, **more):
    identity = re.sub(r"[^A-Za-z0-9.-]", "-", f"{supplier}-{name}")
    return {
        "SPDXID": f"SPDXRef-{identity}",
        "name": name,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "copyrightText": "NOASSERTION",
        **more,
    }


def purl(text):
    return [
        {
            "referenceCategory": "PACKAGE-MANAGER",
            "referenceType": "purl",
            "referenceLocator": text,
        }
    ]


def debian(package):
    show = "${Package}\t${Version}\t${Architecture}\t${source:Package}"
    name, version, machine, source = run("dpkg-query", "-W", f"-f={show}", package).split("\t")
    reference = purl(f"pkg:deb/debian/{name}@{version}?arch={machine}")
    return described(name, version, "deb", sourceInfo=f"source {source}", externalRefs=reference)


def npm():
    """The packages that the lock file names for the page itself, tools for its making left out."""
    packages = json.loads((ROOT / "web/package-lock.json").read_text())["packages"]
    for place, entry in sorted(packages.items()):
        if not place or entry.get("dev"):
            continue
        name = place.split("node_modules/")[-1]
        algorithm, value = entry["integrity"].split("-", 1)
        yield described(
            name,
            entry["version"],
            "npm",
            licenseDeclared=entry["license"],
            checksums=[
                {"algorithm": algorithm.upper(), "checksumValue": b64decode(value).hex()}
            ],
            externalRefs=purl(f"pkg:npm/{name.replace('@', '%40')}@{entry['version']}"),
        )


def document(program):
    printed = run(program, "--version")
    version = printed.split()[1]
    whole = described("bolter", version, "source", licenseDeclared="GPL-3.0-or-later")
    linked = [debian(name) for name in sorted({owner(path) for path in loaded(program)})]
    inside = [debian(name) for name in HEADERS] + list(npm())
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH") or run("git", "log", "-1", "--format=%ct"))
    links = [("SPDXRef-DOCUMENT", "DESCRIBES", whole)]
    links += [(whole["SPDXID"], "DYNAMIC_LINK", package) for package in linked]
    links += [(whole["SPDXID"], "CONTAINS", package) for package in inside]
    digest = hashlib.sha256(json.dumps([linked, inside]).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"bolter-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/bolter-{version}-{digest[:16]}",
        "creationInfo": {
            "created": datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
            "creators": ["Tool: scripts/sbom.py"],
        },
        "packages": [whole, *linked, *inside],
        "relationships": [
            {
                "spdxElementId": source,
                "relationshipType": kind,
                "relatedSpdxElement": package["SPDXID"],
            }
            for source, kind, package in links
        ],
    }


if __name__ == "__main__":
    json.dump(document(sys.argv[1]), sys.stdout, indent=1)
    print()
