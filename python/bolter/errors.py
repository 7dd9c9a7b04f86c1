"""Errors: exceptions that carry what the library said, with its place in the file."""

from __future__ import annotations

import re
from typing import NamedTuple, Optional, Sequence


class Message(NamedTuple):
    """One thing that the library said."""

    severity: str  #: "error", "warning" or "note"
    file: Optional[str]
    line: Optional[int]  #: from 1
    column: Optional[int]  #: from 1
    text: str  #: without the place

    @classmethod
    def parse(cls, line: str) -> "Message":
        """Reads ``FILE:LINE:COLUMN: SEVERITY: TEXT``; file and place may be missing."""
        match = _PLACED.match(line)
        if not match:
            return cls("error", None, None, None, line)
        file, row, column, severity, text = match.groups()
        return cls(severity, file, int(row) if row else None, int(column) if column else None, text)

    def __str__(self) -> str:
        place = self.file or ""
        if self.line is not None:
            place += f":{self.line}:{self.column}"
        return f"{place}: {self.severity}: {self.text}" if place else f"{self.severity}: {self.text}"


_PLACED = re.compile(
    r"(?:(.*?)(?::(\d+):(\d+))?: )?(note|warning|error): (.*)", re.DOTALL
)


class BolterWarning(UserWarning):
    """What the library remarks on a call that succeeded."""


class BolterError(Exception):
    """Base of every error of the library.

    ``messages`` holds what it said, each with its place; ``status`` the name of the C status.
    """

    status = "BT_ERR_INTERNAL"

    def __init__(self, summary: str, messages: Sequence[Message] = ()) -> None:
        self.messages = list(messages)
        super().__init__("\n".join(str(m) for m in self.messages) or summary)


class ArgumentError(BolterError, ValueError):
    """A name that does not exist, or a value outside its range."""

    status = "BT_ERR_ARG"


class InputError(BolterError, ValueError):
    """A study, or numbers set in it, that cannot be accepted."""

    status = "BT_ERR_INPUT"


class NumericError(BolterError, ArithmeticError):
    """The computation diverged."""

    status = "BT_ERR_NUMERIC"


class FileError(BolterError, OSError):
    """A file that cannot be read or written."""

    status = "BT_ERR_IO"


class OutOfMemoryError(BolterError, MemoryError):
    """The memory does not suffice."""

    status = "BT_ERR_MEMORY"


class InterruptedRunError(BolterError):
    """The call was stopped by its progress function; what was finished is kept."""

    status = "BT_ERR_INTERRUPTED"


class FailedRunsError(BolterError):
    """More landings failed than the study allows; all of them are done."""

    status = "BT_ERR_FAILED_RUNS"


class InternalError(BolterError):
    """A mistake of the library itself."""


#: by the number of the C status; 0 is success
BY_STATUS = (
    None,
    ArgumentError,
    InputError,
    NumericError,
    FileError,
    OutOfMemoryError,
    InterruptedRunError,
    FailedRunsError,
    InternalError,
)
