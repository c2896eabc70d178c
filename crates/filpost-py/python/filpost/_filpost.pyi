from os import PathLike
from typing import Any, final

from ._data import Diagnostic, Report

__version__: str

_Cl = bytes | PathLike[str]

@final
class Cancel:
    """A switch that stops runs from another thread."""

    def __new__(cls) -> Cancel: ...
    def cancel(self) -> None:
        """Stops the runs that have this switch."""
    @property
    def cancelled(self) -> bool:
        """True once ``cancel`` was called."""

@final
class Word:
    """A word of a block and what made it."""

    @property
    def letter(self) -> str:
        """Its letter; ``_`` for a text, ``/`` for block delete, ``#`` for a sequence number."""
    @property
    def text(self) -> str:
        """The word as it stands in the block."""
    @property
    def record(self) -> int:
        """Number of the CL record that asks for it; 0 where the machine's settings do."""
    @property
    def line(self) -> int:
        """Line of that record in the CL file; 0 where the machine's settings ask for it."""
    @property
    def record_word(self) -> int:
        """The word of that record, as POSTF(7,n) counts; 0 for the record as a whole."""
    @property
    def made_by_fil(self) -> bool:
        """True where a FIL statement made the record that ``record_word`` counts."""
    @property
    def fil(self) -> tuple[tuple[str, int], ...]:
        """FIL file and line of each call, innermost first."""

@final
class Block:
    """A block of an NC program and what made it."""

    @property
    def number(self) -> int:
        """Number of the block in the program, from 1."""
    @property
    def text(self) -> str:
        """The block, without line end."""
    @property
    def record(self) -> int:
        """Number of the CL record that made it; 0 before the first one."""
    @property
    def line(self) -> int:
        """Line of the CL file; 0 before the first record."""
    @property
    def fil(self) -> tuple[tuple[str, int], ...]:
        """FIL file and line of each call, innermost first; empty without FIL."""
    @property
    def words(self) -> list[Word]:
        """The words of the block, each with what made it."""

@final
class Blocks:
    """Lazy iterator over the blocks of a run."""

    def __iter__(self) -> Blocks: ...
    def __next__(self) -> Block: ...
    @property
    def report(self) -> Report:
        """What the run has to tell so far; all of it after the last block."""

@final
class Post:
    def __new__(
        cls, parts: Any, dialect: str | None, raw: bool, unit: str | None
    ) -> Post: ...
    @property
    def warnings(self) -> tuple[Diagnostic, ...]: ...
    @property
    def encoding(self) -> str: ...
    def run(self, cl: _Cl, run: Any) -> tuple[bytes, Report]: ...
    def run_files(self, cl: str, nc: str, run: Any) -> Report: ...
    def blocks(self, cl: _Cl, run: Any) -> Blocks: ...
    def verify(
        self,
        cl: _Cl,
        nc: bytes,
        nc_name: str,
        tolerance: float | None,
        between: float | None,
        offsets: list[str],
        run: Any,
    ) -> dict[str, Any]: ...
    def plot(
        self, nc: bytes, nc_name: str, cl: _Cl | None, page: bool, views: list[str]
    ) -> str: ...
    def path(self, nc: bytes, nc_name: str) -> dict[str, Any]: ...

def decode(nc: bytes, encoding: str) -> str:
    """The text of an NC program."""

def encode(nc: str, encoding: str) -> bytes:
    """The bytes of an NC program."""

def ready_posts() -> list[str]:
    """Names of the posts inside the package."""

def explain(subject: str) -> str: ...
def check(files: list[tuple[str, str]], strict: bool) -> tuple[Diagnostic, ...]: ...
def diff(
    first: bytes,
    second: bytes,
    names: tuple[str, str],
    tolerance: float,
    ignore: list[str],
    modal: bool,
    diameter: bool,
    encoding: str,
) -> list[tuple[int | None, int | None, str]]: ...
def plot_cl(
    cl: _Cl,
    name: str | None,
    dialect: str | None,
    unit: str | None,
    page: bool,
    views: list[str],
) -> str: ...
def cl_path(
    cl: _Cl, name: str | None, dialect: str | None, unit: str | None
) -> dict[str, Any]: ...

