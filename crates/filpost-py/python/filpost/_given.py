"""What users give, in the forms that the native half takes."""

from __future__ import annotations

import inspect
import os
import pathlib
from typing import Any, BinaryIO, Callable, Iterable, TextIO, Union

from . import _filpost

#: A CL file or an NC program: its text, its name (``pathlib.Path``), or an open file.
Source = Union[str, bytes, "os.PathLike[str]", BinaryIO, TextIO]

#: A FIL or machine file: name and text, or its name (``pathlib.Path``).
Named = Union["tuple[str, str]", "os.PathLike[str]"]


def cl_or_path(source: Source | None, path: str | os.PathLike[str] | None) -> Any:
    """A CL file that is given in one of two ways."""
    if (source is None) == (path is None):
        raise TypeError("give the CL file, or its path")
    return cl(source) if source is not None else pathlib.Path(path or "")


def cl(source: Source) -> bytes | os.PathLike[str]:
    """A CL file as bytes or a name; an open file is read to its end."""
    if isinstance(source, os.PathLike):
        return source
    if isinstance(source, str):
        return _no_name(source).encode()
    if isinstance(source, (bytes, bytearray, memoryview)):
        return bytes(source)
    read = getattr(source, "read", None)
    if read is None:
        kind = type(source).__name__
        raise TypeError(f"a text, bytes, a pathlib.Path or an open file is needed, not {kind}")
    text = read()
    return text.encode() if isinstance(text, str) else bytes(text)


def nc(source: Any, name: str | None, encoding: str) -> tuple[bytes, str]:
    """An NC program as bytes, and its name in messages; a text is encoded."""
    if isinstance(getattr(source, "nc", None), bytes):  # a Result
        source = source.nc if source.encoding == encoding else source.text
    if isinstance(source, os.PathLike):
        with open(source, "rb") as file:
            return file.read(), name or os.fspath(source)
    read = getattr(source, "read", None)
    taken = source if read is None else read()
    if isinstance(taken, str):
        return _filpost.encode(_no_name(taken), encoding), name or "NC"
    taken = cl(taken)
    assert isinstance(taken, bytes)
    return taken, name or "NC"


def named(source: Named | str, name: str) -> tuple[str, str]:
    """Name and text; a plain text gets the name that is told."""
    if isinstance(source, os.PathLike):
        with open(source, "rb") as file:
            return os.fspath(source), _text(file.read())
    if isinstance(source, str):
        return name, _no_name(source)
    given, text = source
    return str(given), text if isinstance(text, str) else _text(bytes(text))


def _no_name(text: str) -> str:
    """A text as it is; one that names a file is refused, since a name is no text of a file."""
    if "\n" not in text and os.path.isfile(text):
        raise ValueError(f"{text!r} is the name of a file; give pathlib.Path({text!r})")
    return text


def _text(given: bytes) -> str:
    try:
        return given.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError(
            f"this file is not UTF-8 ({error}); decode it and give (name, text)"
        ) from error


def functions(given: dict[str, Any]) -> list[tuple[str, int, Callable[..., Any]]]:
    """Name, number of arguments and callable of each function."""
    return [(name, *_function(name, value)) for name, value in given.items()]


def _function(name: str, value: Any) -> tuple[int, Callable[..., Any]]:
    if isinstance(value, tuple):
        arity, function = value
        return int(arity), function
    if not callable(value):
        raise TypeError(f"{name}: a callable is needed, not {type(value).__name__}")
    try:
        parameters = inspect.signature(value).parameters.values()
    except ValueError:
        parameters = None
    if parameters is None or any(p.kind is p.VAR_POSITIONAL for p in parameters):
        raise TypeError(f"{name}: give (number of arguments, callable), the callable does not say")
    positional = [p for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
    return sum(p.default is p.empty for p in positional), value


def texts(given: Iterable[str], what: str) -> list[str]:
    """A list of texts; a single text is most likely a mistake."""
    if isinstance(given, str):
        raise TypeError(f"{what}: a list of texts is needed, not a text")
    return list(given)


def need_numpy() -> None:
    """Raises ImportError where there is no numpy, which paths are made of."""
    try:
        import numpy  # noqa: F401
    except ImportError as error:
        raise ImportError("paths are numpy arrays; install numpy") from error
