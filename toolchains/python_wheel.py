#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the wheel of the Python package: scripts/python-wheel [FOLDER]

The same sources give the same bytes. Inside is Python alone: the program plumb and libplumb.so.0 are installed apart.
"""
import base64
import hashlib
import pathlib
import re
import sys
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[1]
PACKAGE = SOURCE / "offline/python/plumb"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the first date that a zip file can hold
VERSION = re.search(r'VERSION = "([^"]+)"', (PACKAGE / "results.py").read_text())[1]
INFO = f"plumb-{VERSION}.dist-info"
METADATA = f"""Metadata-Version: 2.1
Name: plumb
Version: {VERSION}
Summary: Calibration of robot arms: the program plumb and its models in Python
License: Apache-2.0
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

"""
WHEEL = """Wheel-Version: 1.0
Generator: python_wheel
Root-Is-Purelib: true
Tag: py3-none-any
"""


def contents():
    for path in sorted(PACKAGE.iterdir()):
        if path.suffix == ".py" or path.name == "py.typed":
            yield f"plumb/{path.name}", path.read_bytes()
    yield f"{INFO}/LICENSE", (SOURCE / "LICENSE").read_bytes()
    yield f"{INFO}/METADATA", (METADATA + (SOURCE / "docs/python.md").read_text(encoding="utf-8")).encode()
    yield f"{INFO}/WHEEL", WHEEL.encode()


def record(files):
    digests = ((name, base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode(), len(data)) for name, data in files)
    return "".join(f"{name},sha256={digest},{size}\n" for name, digest, size in digests) + f"{INFO}/RECORD,,\n"


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else SOURCE / "build"
    folder.mkdir(parents=True, exist_ok=True)
    wheel, files = folder / f"plumb-{VERSION}-py3-none-any.whl", list(contents())
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in [*files, (f"{INFO}/RECORD", record(files).encode())]:
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = 0o644 << 16
            out.writestr(entry, data, zipfile.ZIP_DEFLATED)
    print(wheel)


if __name__ == "__main__":
    main()
