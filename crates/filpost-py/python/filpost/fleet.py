"""Many CL files on many machines: posted, verified, each NC program written once.

The work is cut into batches of files, and each batch may be done again by another worker when
its own one dies. What a worker leaves behind does no harm: an NC program appears whole under its
name or not at all, and one that is already there is compared with what it would be, never
written again. Nothing here asks for an order.
"""

from __future__ import annotations

import functools
import importlib
import os
import pickle
import tempfile
from dataclasses import dataclass
from typing import Any, Iterable, Iterator, Literal, Sequence

from ._data import Diagnostic, Error
from ._program import Program

__all__ = ["File", "Outcome", "here", "on_dask", "on_ray", "post_one"]

#: Names of a CL file and of the NC program that it becomes.
File = tuple[str, str]


@dataclass(frozen=True)
class Outcome:
    """What became of a CL file."""

    cl: str
    """Name of the CL file."""
    nc: str
    """Name of the NC program; there is none where the CL file was refused."""
    verdict: Literal["agrees", "partly", "differs", "refused", "lost"]
    """That of the check; ``refused``: the post or the check refuses it; ``lost``: every worker
    that took it died."""
    diags: tuple[Diagnostic, ...] = ()
    """Errors of a refused file, else the warnings of the post."""
    findings: tuple[str, ...] = ()
    """What the check found."""
    blocks: int = 0
    """Blocks of the program."""
    written: bool = False
    """True where this very task wrote the program; False where an earlier one had."""


def post_one(program: Program, cl: str, nc: str) -> Outcome:
    """Posts a CL file, verifies the program in memory, and writes it when the check does not
    find it wrong. A program that is there already is left as it is."""
    try:
        with open(cl, "rb") as file:
            text = file.read()
        result = program.run(text, name=cl)
        found = program.verify(text, result, cl_name=cl, nc_name=nc)
        findings = tuple(finding.message for finding in found.findings)
        outcome = functools.partial(
            Outcome, cl, nc, found.verdict, result.warnings, findings, result.report.blocks
        )
        if found.verdict == "differs":
            return outcome()
        return outcome(written=_write_once(nc, result.nc))
    except Error as error:
        return Outcome(cl, nc, "refused", error.diags)
    except OSError as error:
        return Outcome(cl, nc, "refused", (_not_usable(nc if error.filename == nc else cl, error),))


def here(program: Program, files: Iterable[File]) -> Iterator[Outcome]:
    """The same in this process, one file after the other."""
    for cl, nc in files:
        yield post_one(program, cl, nc)


def on_dask(
    client: Any, program: Program, files: Iterable[File], *, batch: int = 50
) -> Iterator[Outcome]:
    """Outcomes as they come, each file once, by the workers of a ``distributed.Client``. They see
    the same folders, and have filpost."""
    distributed: Any = importlib.import_module("distributed")

    pickled = _pickled(program)

    def submit(part: Sequence[File]) -> Any:
        future = client.submit(_post_many, pickled, part, pure=False, retries=2)
        parts[future.key] = part
        return future

    parts: dict[Any, Sequence[File]] = {}
    done = distributed.as_completed([submit(part) for part in _batches(files, batch)])
    for future in done:
        part = parts.pop(future.key)
        if future.status == "finished":
            try:
                yield from future.result()
                continue
            except Exception as error:
                last = error
        else:
            last = future.exception()
        again, lost = _halves(part, last)
        yield from lost
        for half in again:
            done.add(submit(half))


def on_ray(program: Program, files: Iterable[File], *, batch: int = 50) -> Iterator[Outcome]:
    """Outcomes as they come, each file once, by the workers of Ray, which was started. They see
    the same folders, and have filpost."""
    ray: Any = importlib.import_module("ray")
    remote = ray.remote(max_retries=5)(_post_many)
    pickled = ray.put(_pickled(program))
    parts = {remote.remote(pickled, part): part for part in _batches(files, batch)}
    while parts:
        (reference,), _ = ray.wait(list(parts), num_returns=1)
        part = parts.pop(reference)
        try:
            outcomes = ray.get(reference)
        except ray.exceptions.RayError as error:
            again, outcomes = _halves(part, error)
            parts.update({remote.remote(pickled, half): half for half in again})
        yield from outcomes


def _post_many(pickled: bytes, files: Sequence[File]) -> list[Outcome]:
    return list(here(_program(pickled), files))


@functools.lru_cache(maxsize=4)
def _program(pickled: bytes) -> Program:
    program = pickle.loads(pickled)
    assert isinstance(program, Program)
    return program


def _pickled(program: Program) -> bytes:
    try:
        return pickle.dumps(program)
    except Exception:
        # Functions that were made on the spot; both fleets bring cloudpickle.
        return bytes(importlib.import_module("cloudpickle").dumps(program))


def _batches(files: Iterable[File], size: int) -> Iterator[Sequence[File]]:
    every = list(files)
    names = {os.path.realpath(nc) for _, nc in every}
    if len(names) < len(every):
        raise ValueError("two CL files would become the same NC program")
    for start in range(0, len(every), max(size, 1)):
        yield every[start : start + max(size, 1)]


def _halves(
    part: Sequence[File], error: BaseException
) -> tuple[list[Sequence[File]], list[Outcome]]:
    """What to try again of a batch that killed its workers; a single file is lost."""
    if len(part) > 1:
        return [part[: len(part) // 2], part[len(part) // 2 :]], []
    [(cl, nc)] = part
    told = Diagnostic(
        "E0702", "error", "lost", f"{type(error).__name__}: {error}", cl, None, None,
        "Post this file by itself.", (),
    )  # fmt: skip
    return [], [Outcome(cl, nc, "lost", (told,))]


def _write_once(name: str, text: bytes) -> bool:
    """Gives a whole file its name, unless there is one; True when it did.

    Raises FileExistsError where another program has the name.
    """
    folder = os.path.dirname(name) or "."
    handle, pending = tempfile.mkstemp(prefix=".filpost-", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(pending, 0o644)
        try:
            os.link(pending, name)  # unlike a renaming, this fails where the name is taken
            return True
        except FileExistsError:
            with open(name, "rb") as file:
                if file.read() != text:
                    raise FileExistsError(17, "another program has this name", name) from None
            return False
    finally:
        os.unlink(pending)


def _not_usable(name: str, error: OSError) -> Diagnostic:
    return Diagnostic(
        "E0702" if isinstance(error, FileExistsError) else "E0701", "error",
        "a file that can't be used", f"{name}: {error.strerror}", name, None, None,
        "Look at the file and its folder.", (),
    )  # fmt: skip
