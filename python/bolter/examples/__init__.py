"""Examples that run: ``python3 -m bolter.examples.drop_test_fit``, ``.misses_pandas``,
``.openturns_form``. One that lacks a package says so and exits with 77."""

import importlib
import sys
from typing import Any

#: exit code of an example that lacks a package: test programs take it as "skipped"
SKIPPED = 77


def needed(package: str, debian: str) -> Any:
    """Imports a package; where it is missing, says what to install and exits."""
    try:
        return importlib.import_module(package)
    except ImportError:
        print(f"skipped: this example needs {package} (Debian: apt install {debian})")
        sys.exit(SKIPPED)
