"""What needs no program: codes, checks, comparisons, pictures of CL files."""

from __future__ import annotations

from typing import Iterable, Literal

from . import _filpost, _given
from ._data import Diagnostic, Difference, Path, Result
from ._given import Named, Source
from ._program import Unit, _files, _is_page


def check(fil: Iterable[Named], *, strict: bool = False) -> tuple[Diagnostic, ...]:
    """Everything that a program would refuse or warn of when it loads these FIL files, and
    what would run but is most likely not meant."""
    return _filpost.check([_given.named(one, "post.fil") for one in _files(fil, "fil")], strict)


def explain(subject: str) -> str:
    """What a code (``E0501``), a setting, a CL or FIL word, a function, a location
    (``INTCOM 1861``), a G or M code or a ready post means, as ``filpost explain`` tells it.

    Raises KeyError where there is no help.
    """
    return _filpost.explain(subject)


def diff(
    first: Source | Result,
    second: Source | Result,
    *,
    tolerance: float = 0.001,
    ignore: Iterable[str] = (),
    modal: bool = False,
    diameter: bool = False,
    names: tuple[str, str] = ("the first", "the second"),
    encoding: str = "UTF-8",
) -> list[Difference]:
    """Compares two NC programs as a control reads them; empty when they say the same.

    ``tolerance`` is in the unit of the programs and in degrees. ``ignore`` lists what is not
    looked at: ``n``, ``comments``, ``dates``, ``points`` or letters. With ``modal``,
    repeated modal words count. ``diameter`` is for lathes whose X is a diameter. ``encoding`` is that of both programs
    where they are bytes, such as ``windows-1252``.
    """
    one, _ = _given.nc(first, None, encoding)
    two, _ = _given.nc(second, None, encoding)
    ignored = _given.texts(ignore, "ignore")
    found = _filpost.diff(one, two, names, tolerance, ignored, modal, diameter, encoding)
    return [Difference((a, b), message) for a, b, message in found]


def plot_cl(
    cl: Source,
    *,
    form: Literal["svg", "html"] = "svg",
    views: Iterable[str] = ("xy", "isometric", "zx", "zy"),
    cl_dialect: str | None = None,
    units: Unit | None = None,
    name: str | None = None,
) -> str:
    """A picture (``svg``) or a page that zooms (``html``) of a CL file."""
    views = _given.texts(views, "views")
    return _filpost.plot_cl(_given.cl(cl), name, cl_dialect, units, _is_page(form), views)


def cl_path(
    cl: Source,
    *,
    cl_dialect: str | None = None,
    units: Unit | None = None,
    name: str | None = None,
) -> Path:
    """The path of the tool tip in a CL file, as numpy arrays in mm."""
    _given.need_numpy()
    return Path(**_filpost.cl_path(_given.cl(cl), name, cl_dialect, units))
