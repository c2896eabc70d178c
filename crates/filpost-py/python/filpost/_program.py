"""A program: a machine with its FIL, ready to post CL files."""

from __future__ import annotations

import datetime
import os
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Literal, Mapping

from . import _given
from ._data import Deviation, Diagnostic, Finding, Path, Report, Result, Unverified, Verification
from ._filpost import Blocks, Cancel, Post
from ._given import Named, Source

__all__ = ["Program"]

Unit = Literal["mm", "inch"]


@dataclass(frozen=True)
class _Parts:
    ready: str | None
    folder: str | None
    machine: tuple[str, str] | None
    option_file: tuple[str, str] | None
    over: list[tuple[str, str]]
    settings: list[str]
    options: list[tuple[str, str]]
    fil: list[tuple[str, str]]
    functions: list[tuple[str, int, Callable[..., Any]]]
    limits: list[tuple[str, int]]
    compat: tuple[str, str] | None
    strict: bool
    allow: list[str]
    levels: list[tuple[str, str]]
    clock: str | None
    read: str | None
    write: str | None


@dataclass(frozen=True)
class _Run:
    name: str | None
    cancel: Cancel | None


class Program:
    """A machine with its compiled FIL.

    It never changes: threads share it, and each run starts from the same state. A run does
    not hold the GIL, except while a callable of yours is called. A program can be pickled
    where its functions can.

    The machine is one of

    ready
        a post inside the package, see ``filpost.ready_posts()``
    machine
        a ``machine.toml``: its text, ``(name, text)``, or a ``pathlib.Path``
    option_file
        an option file of G-POST (``UNCX01.Pnn``), given alike
    folder
        a folder with ``machine.toml`` and, where there is one, ``post.fil``, as
        ``filpost new`` makes it; see ``from_folder``

    and the generic mill without any. On top of it come

    over, settings
        further ``machine.toml``; settings as ``{"rapid.split": 0}``
    options
        values of options of the post: ``{"style": "plain", "preload": False}``
    fil
        FIL files, each ``(name, text)`` or a ``pathlib.Path``
    functions
        functions of yours for FIL: ``{"DEPTHF": f}``. ``f`` takes floats, texts, and None
        for EMPTY, and returns one of them; what it raises stops the run and is the
        ``__cause__`` of the ``filpost.Error``. ``(2, f)`` says the number of arguments where
        the callable does not. Threads that share the program call it at the same time.
    limits
        what a run may use up: ``fuel`` (steps of a section), ``call_depth``,
        ``array_elements``, ``text_bytes``, ``output_bytes``
    allow, strict, compat
        as the options of the command
    levels
        levels of codes or of ``all``: ``{"E0532": "warn"}``, ``allow``, ``warn`` or ``deny``
    cl_dialect, raw_records, units
        how CL files are read: the CAM system where it is not recognized, records as they
        are written, the unit (``mm`` or ``inch``) of files that do not say it
    clock
        what DATEF and TIMEF give: a ``datetime``, or ``"system"`` for the time of the run in
        UTC; a script that asks for the time is refused without
    grant_read, grant_write
        folders that scripts may use; none without

    Raises ``filpost.Error`` with all that is wrong.
    """

    def __init__(
        self,
        *,
        ready: str | None = None,
        folder: str | os.PathLike[str] | None = None,
        machine: Named | str | None = None,
        option_file: Named | None = None,
        over: Iterable[Named] = (),
        settings: Mapping[str, Any] | None = None,
        options: Mapping[str, Any] | None = None,
        fil: Iterable[Named] = (),
        functions: Mapping[str, Any] | None = None,
        limits: Mapping[str, int] | None = None,
        compat: Named | None = None,
        strict: bool = False,
        allow: Iterable[str] = (),
        levels: Mapping[str, str] | None = None,
        cl_dialect: str | None = None,
        raw_records: bool = False,
        units: Unit | None = None,
        clock: datetime.datetime | Literal["system"] | None = None,
        grant_read: str | os.PathLike[str] | None = None,
        grant_write: str | os.PathLike[str] | None = None,
    ) -> None:
        if sum(given is not None for given in (ready, folder, machine, option_file)) > 1:
            raise ValueError("give one of ready, folder, machine and option_file")
        self._parts = _Parts(
            ready=ready,
            folder=None if folder is None else os.fspath(folder),
            machine=None if machine is None else _given.named(machine, "machine.toml"),
            option_file=None if option_file is None else _given.named(option_file, "UNCX01.P01"),
            over=[_given.named(one, "machine.toml") for one in _files(over, "over")],
            settings=[f"{key}={_setting(value)}" for key, value in (settings or {}).items()],
            options=[(str(name), _option(value)) for name, value in (options or {}).items()],
            fil=[_given.named(one, "post.fil") for one in _files(fil, "fil")],
            functions=_given.functions(dict(functions or {})),
            limits=[(name, int(value)) for name, value in (limits or {}).items()],
            compat=None if compat is None else _given.named(compat, "compat.toml"),
            strict=strict,
            allow=_given.texts(allow, "allow"),
            levels=[(str(code), str(level)) for code, level in (levels or {}).items()],
            clock=None if clock is None else _clock(clock),
            read=None if grant_read is None else os.fspath(grant_read),
            write=None if grant_write is None else os.fspath(grant_write),
        )
        self._reading = (cl_dialect, raw_records, units)
        self._post = Post(self._parts, *self._reading)

    @classmethod
    def from_folder(cls, folder: str | os.PathLike[str], **rest: Any) -> Program:
        """The post in a folder: its ``machine.toml`` and, where there is one, ``post.fil``.

        ``rest`` is what else ``Program`` takes.
        """
        return cls(folder=folder, **rest)

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuilt, (self._parts, self._reading)

    @property
    def encoding(self) -> str:
        """The encoding of its NC programs, ``tape.encoding`` of the machine."""
        return self._post.encoding

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """Warnings of building: settings without effect, forgiven FIL."""
        return self._post.warnings

    def run(
        self,
        cl: Source | None = None,
        *,
        path: str | os.PathLike[str] | None = None,
        name: str | None = None,
        cancel: Cancel | None = None,
    ) -> Result:
        """Posts a CL file: its text, a ``pathlib.Path``, an open file, or the file at ``path``.

        ``name`` is what messages call it. ``cancel`` stops the run from another thread.
        Ctrl-C stops it too.
        """
        nc, report = self._post.run(_given.cl_or_path(cl, path), _Run(name, cancel))
        return Result(nc, report, self.encoding)

    def run_files(
        self,
        cl: str | os.PathLike[str],
        nc: str | os.PathLike[str],
        *,
        cancel: Cancel | None = None,
    ) -> Report:
        """Posts a CL file into an NC file, in constant memory.

        After an error there is no file under the name ``nc``; an older one stays as it was.
        """
        return self._post.run_files(os.fspath(cl), os.fspath(nc), _Run(None, cancel))

    def blocks(
        self,
        cl: Source | None = None,
        *,
        path: str | os.PathLike[str] | None = None,
        name: str | None = None,
        cancel: Cancel | None = None,
    ) -> Blocks:
        """The blocks of a CL file one by one, each with what made it and its words.

        Lazy: a block is made when it is asked for, and an error is raised where it occurs;
        what came before it is no program then. The CL file is read once, so FIL that asks
        for totals of the program or goes back in the file is refused.
        """
        return self._post.blocks(_given.cl_or_path(cl, path), _Run(name, cancel))

    def verify(
        self,
        cl: Source,
        nc: Source | Result,
        *,
        tolerance: float | None = None,
        between: float | None = None,
        offsets: Iterable[str] = (),
        cl_name: str | None = None,
        nc_name: str | None = None,
        cancel: Cancel | None = None,
    ) -> Verification:
        """Reads an NC program back and compares it with its CL file.

        ``tolerance`` is what lengths (mm) and angles (degrees) may be off by besides their
        last digit, ``between`` what the tip may leave its line by between the ends of
        motions that turn the machine (mm), ``offsets`` the work offsets (``G55``) that the
        program may choose by itself.
        """
        text, name = _given.nc(nc, nc_name, self.encoding)
        found = self._post.verify(
            _given.cl(cl),
            text,
            name,
            tolerance,
            between,
            _given.texts(offsets, "offsets"),
            _Run(cl_name, cancel),
        )
        found["findings"] = tuple(Finding(*one) for one in found["findings"])
        found["not_compared"] = tuple(Unverified(*one) for one in found["not_compared"])
        found["position"] = Deviation(*found["position"])
        found["axis"] = Deviation(*found["axis"])
        return Verification(**found)

    def plot(
        self,
        nc: Source | Result,
        *,
        cl: Source | None = None,
        form: Literal["svg", "html"] = "svg",
        views: Iterable[str] = ("xy", "isometric", "zx", "zy"),
        name: str | None = None,
    ) -> str:
        """A picture (``svg``) or a page that zooms (``html``) of an NC program on the
        machine, with the path of ``cl`` under it."""
        text, name = _given.nc(nc, name, self.encoding)
        under = None if cl is None else _given.cl(cl)
        return self._post.plot(
            text, name, under, _is_page(form), _given.texts(views, "views")
        )

    def path(self, nc: Source | Result, *, name: str | None = None) -> Path:
        """The path of the tool tip that an NC program makes on the machine, as numpy arrays
        in mm, in the frame of the part."""
        _given.need_numpy()
        return Path(**self._post.path(*_given.nc(nc, name, self.encoding)))

    def __repr__(self) -> str:
        machine = self._parts.ready or (self._parts.machine or self._parts.option_file or ("",))[0]
        return f"<filpost.Program {machine or 'fanuc-mill'}>"


def _rebuilt(parts: _Parts, reading: tuple[Any, ...]) -> Program:
    program = Program.__new__(Program)
    program._parts, program._reading = parts, reading
    program._post = Post(parts, *reading)
    return program


def _files(given: Any, what: str) -> list[Any]:
    if isinstance(given, (str, os.PathLike)) or (
        isinstance(given, tuple) and len(given) == 2 and all(isinstance(one, str) for one in given)
    ):
        raise TypeError(f"{what}: a list of files is needed, each (name, text) or a pathlib.Path")
    return list(given)


def _clock(given: datetime.datetime | str) -> str:
    if isinstance(given, datetime.datetime):
        return given.replace(microsecond=0, tzinfo=None).isoformat()
    return given


def _setting(value: Any) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    return str(value)


def _option(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)


def _is_page(form: str) -> bool:
    if form not in ("svg", "html"):
        raise ValueError(f"no form `{form}`; there are svg and html")
    return form == "html"
