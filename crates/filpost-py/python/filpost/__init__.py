"""CL file, FIL macros and machine settings in, NC program out.

>>> import filpost
>>> program = filpost.Program(ready="fanuc-mill")
>>> cl = "UNITS / MM\\nLOADTL / 1\\nFEDRAT / 200, MMPM\\nGOTO / 1, 2, 3\\nFINI\\n"
>>> "X1. Y2. Z3. F200." in program.run(cl).text
True

An NC program moves a machine: what is wrong raises ``filpost.Error``, and there is no
program then.
"""

from ._data import (
    STROKES,
    Deviation,
    Diagnostic,
    Difference,
    Error,
    Finding,
    Path,
    Report,
    Result,
    Unverified,
    Verification,
)
from ._filpost import Block, Blocks, Cancel, Word, __version__, ready_posts
from ._program import Program
from ._texts import check, cl_path, diff, explain, plot_cl

__all__ = [
    "STROKES",
    "Block",
    "Blocks",
    "Cancel",
    "Deviation",
    "Diagnostic",
    "Difference",
    "Error",
    "Finding",
    "Path",
    "Program",
    "Report",
    "Result",
    "Unverified",
    "Verification",
    "Word",
    "__version__",
    "check",
    "cl_path",
    "diff",
    "explain",
    "plot_cl",
    "ready_posts",
]
