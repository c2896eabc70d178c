"""What filpost says, as plain values that can be compared, printed and pickled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from . import _filpost

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = [
    "Deviation",
    "Diagnostic",
    "Difference",
    "Error",
    "Finding",
    "Path",
    "Report",
    "Result",
    "Unverified",
    "Verification",
]


@dataclass(frozen=True)
class Diagnostic:
    """An error or a warning."""

    code: str
    """``E0501`` or ``W0151``; ``filpost.explain(code)`` tells more."""
    severity: Literal["error", "warning"]
    title: str
    """What the code means, in a few words."""
    message: str
    """What is wrong here, with the names and numbers of this case."""
    file: str | None
    """The CL, FIL or machine file, as it was named."""
    line: int | None
    """Line of the file, from 1."""
    column: int | None
    """Column of the line in characters, from 1."""
    hint: str
    """What can be done."""
    notes: tuple[str, ...]
    """Further lines: the FIL call stack, the record with its words."""

    def __str__(self) -> str:
        place = "" if self.file is None else f" {self.file}:{self.line}:{self.column}"
        return f"{self.code}{place}: {self.message}"


class Error(Exception):
    """A program, a CL file or an NC program was refused.

    Where a callable of the program has raised an exception, that is ``__cause__``.
    """

    def __init__(
        self, message: str, diags: tuple[Diagnostic, ...] = (), cancelled: bool = False
    ) -> None:
        super().__init__(message, diags, cancelled)
        self.diags = diags
        """All that is wrong; of a CL file each kind of error once."""
        self.cancelled = cancelled
        """True for a run that a ``Cancel`` has stopped."""

    def __str__(self) -> str:
        return str(self.args[0])

    @property
    def code(self) -> str | None:
        """Code of the first diagnostic, ``E0501``."""
        return self.diags[0].code if self.diags else None

    @property
    def file(self) -> str | None:
        """File of the first diagnostic."""
        return self.diags[0].file if self.diags else None

    @property
    def line(self) -> int | None:
        """Line of the first diagnostic, from 1."""
        return self.diags[0].line if self.diags else None


Point = tuple[float, float, float]


@dataclass(frozen=True)
class Report:
    """Counts, warnings and extents of a run."""

    records: int
    """CL records read."""
    blocks: int
    """Blocks written."""
    bytes: int
    """Bytes written."""
    warnings: tuple[Diagnostic, ...]
    """Warnings in the order they were found."""
    dialect: str | None
    """Dialect of the CL text, as recognized or chosen."""
    unit: Literal["mm", "inch"] | None
    """Unit of CL file and program; None where there is no motion."""
    extents: tuple[Point, Point] | None
    """Smallest and largest x, y, z of the CL points, in that unit."""


@dataclass(frozen=True)
class Result:
    """An NC program and what its run has to tell."""

    nc: bytes
    """The NC program as it goes to the machine."""
    report: Report
    """Counts, warnings and extents."""
    encoding: str = "UTF-8"
    """What the bytes of ``nc`` are in, ``tape.encoding`` of the machine."""

    @property
    def text(self) -> str:
        """The NC program as text."""
        return _filpost.decode(self.nc, self.encoding)

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """Warnings of the run."""
        return self.report.warnings


@dataclass(frozen=True)
class Finding:
    """Something in an NC program that is not as its CL file asks for."""

    kind: str
    """``position``, ``feed``, ``missing`` …, as ``filpost verify --report json`` says."""
    nc_line: int | None
    """Line of the NC program, from 1."""
    cl_line: int | None
    """Line of the CL file, from 1."""
    message: str
    """What is wrong, in a machinist's words."""


@dataclass(frozen=True)
class Unverified:
    """Something that the CL file does not determine, so that it was not compared."""

    cl_line: int | None
    """Line of the CL file, from 1."""
    what: str
    """What was not compared."""


@dataclass(frozen=True)
class Deviation:
    """How far the program is from the path."""

    max: float
    """The largest, mm or degrees."""
    rms: float
    """Root of the mean square, mm or degrees."""
    nc_line: int | None
    """Line of the NC program where it is the largest."""


@dataclass(frozen=True)
class Verification:
    """How far an NC program does what its CL file asks for."""

    verdict: Literal["agrees", "partly", "differs"]
    """``partly``: what was compared agrees, something could not be compared."""
    reference: Literal["cl-file", "second-run"]
    """What it was compared with: a program with FIL is posted a second time."""
    findings: tuple[Finding, ...]
    """Differences in the order of the program, 50 at most."""
    more: int
    """Further differences that are not listed."""
    not_compared: tuple[Unverified, ...]
    """What was not compared, 50 at most."""
    more_not_compared: int
    """What further was not compared."""
    compared: int
    """Motions and holes that were compared."""
    matched: int
    """Those of them that the program makes."""
    position: Deviation
    """Of the tool tip, mm."""
    axis: Deviation
    """Of the tool axis, degrees."""


@dataclass(frozen=True)
class Difference:
    """A difference between two NC programs."""

    lines: tuple[int | None, int | None]
    """Lines in both, from 1; None where that program has no such block."""
    message: str
    """What differs, in a machinist's words."""


STROKES = ("rapid", "feed", "arc", "thread")


@dataclass(frozen=True, eq=False)
class Path:
    """A path of the tool tip in the part frame, as numpy arrays.

    Piece ``i`` of the path runs through ``points[starts[i]:ends[i]]``.
    """

    points: NDArray[np.float64]
    """Points in order, shape (n, 3), mm whatever the program's unit."""
    strokes: NDArray[np.uint8]
    """How each piece is driven, shape (m,): an index of ``filpost.STROKES``."""
    lines: NDArray[np.uint32]
    """Line of the program or CL file that makes each piece, shape (m,), from 1."""
    starts: NDArray[np.uint64]
    """Index of the first point of each piece, shape (m,)."""
    ends: NDArray[np.uint64]
    """One past the index of its last point, shape (m,)."""
    unit: Literal["mm", "inch"]
    """The unit in which the program itself counts."""
