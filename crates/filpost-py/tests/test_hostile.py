"""What users do by mistake, and what threads, forks and signals do to a program."""

import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading

import filpost
import pytest

CL = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n"
CALL = "CIMFIL/ON,LOADTL\nX=CALLF(POSTF(7,4))\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n"


def mill(**more):
    more.setdefault("options", {"style": "plain"})
    return filpost.Program(ready="fanuc-mill", **more)


def calling(function):
    return mill(fil=[("call.fil", CALL)], functions={"CALLF": (1, function)})


def test_programs_in_code_pages():
    text = CL.replace("FINI", "PPRINT / FRÄSER Ø10\nFINI")
    program = mill(settings={"tape.encoding": "windows-1252"})
    result = program.run(text)
    assert program.encoding == result.encoding == "windows-1252"
    assert b"(FR\xc4SER \xd810)" in result.nc and "(FRÄSER Ø10)" in result.text
    assert result.report.bytes == len(result.nc)
    assert pickle.loads(pickle.dumps(program)).run(text) == result
    for nc in (result, result.nc, result.text):
        assert program.verify(text, nc).verdict == "agrees"
    other = result.nc.replace(b"\xc4", b"\xd6")
    (found,) = filpost.diff(result, other, encoding="windows-1252")
    assert "FRÖSER" in found.message
    in_utf8 = mill().run(text)
    assert in_utf8.encoding == "UTF-8" and in_utf8.nc.decode() == in_utf8.text == result.text
    assert filpost.diff(result, in_utf8) == []
    with pytest.raises(filpost.Error) as refused:
        program.run(CL.replace("FINI", "PPRINT / 刀\nFINI"))
    assert refused.value.code == "E0543" and refused.value.line == 6
    with pytest.raises(ValueError, match="刀"):
        program.verify(text, result.text + "(刀)\n")
    with pytest.raises(ValueError, match="klingon"):
        filpost.diff("G0\n", "G0\n", encoding="klingon")


@pytest.mark.parametrize("raised", [KeyboardInterrupt, SystemExit, MemoryError, StopIteration, OSError])
def test_each_exception_of_a_callable_comes_out(raised):
    def function(number):
        raise raised("of the callable")

    program = calling(function)
    with pytest.raises((filpost.Error, raised)) as caught:
        program.run(CL)
    found = caught.value
    while found is not None and not isinstance(found, raised):
        found = found.__cause__
    assert isinstance(found, raised), repr(caught.value)
    # The program is as it was.
    assert "X1." in mill().run(CL).text


def test_a_signal_stops_a_long_read():
    def stop(number, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(KeyboardInterrupt):
            mill().run(CL.replace("FINI", "GOTO / 1, 2, 3\nGOTO / 3, 2, 1\n" * 1_000_000 + "FINI"))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert "X1." in mill().run(CL).text


def test_a_callable_may_run_its_own_program():
    depth = []

    def function(number):
        depth.append(number)
        return len(program.run(CL).nc) if len(depth) < 20 else 0

    program = calling(function)
    assert "X1." in program.run(CL).text
    assert len(depth) == 20


def test_generators_are_dropped_half_way():
    cl = "UNITS / MM\nLOADTL / 3\nFEDRAT / 200, MMPM\n" + "GOTO / 1, 2, 3\nGOTO / 2, 2, 3\n" * 5000
    program = mill()
    for taken in range(50):
        blocks = program.blocks(cl + "FINI\n")
        for _ in range(taken):
            next(blocks)
        del blocks
    blocks = program.blocks(CL)
    assert len(list(blocks)) > 3 and list(blocks) == []


@pytest.mark.parametrize("wrong", [None, 7, 1.5, [], {}, object(), {"GOTO"}])
def test_what_is_no_text_is_a_type_error(wrong):
    program = mill()
    for call in (
        lambda: program.run(wrong),
        lambda: program.blocks(wrong),
        lambda: program.verify(wrong, "G0\n"),
        lambda: program.verify(CL, wrong),
        lambda: program.path(wrong),
        lambda: filpost.cl_path(wrong),
    ):
        with pytest.raises(TypeError):
            call()


def test_names_that_are_not_there(tmp_path):
    gone = tmp_path / "gone.ncl"
    with pytest.raises(filpost.Error) as refused:
        mill().run(gone)
    assert refused.value.code == "E0701"
    with pytest.raises(filpost.Error):
        mill().run(tmp_path)
    with pytest.raises(filpost.Error):
        mill().run_files(gone, tmp_path / "out.nc")
    with pytest.raises((TypeError, ValueError, filpost.Error)):
        mill().run_files(None, None)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("text", ["", "\0", "\0" * 9999, "GOTO / 1, \0, 3\nFINI\n", "Ä" * 9999, "\ufeff" + CL])
def test_strange_texts_end_in_a_program_or_an_error(text):
    for call in (lambda: mill().run(text).nc, lambda: list(mill().blocks(text))):
        try:
            call()
        except filpost.Error as error:
            assert error.code and error.diags


def test_huge_inputs_end():
    with pytest.raises(filpost.Error):
        mill().run("X" * 20_000_000)
    with pytest.raises(filpost.Error):
        mill(fil=[("deep.fil", "A=" + "(" * 100_000 + "1" + ")" * 100_000 + "\nFINI\n")])
    with pytest.raises(filpost.Error):
        mill(fil=[("loop.fil", "10)\nJUMPTO/10\nFINI\n")]).run(CL)


def test_threads_build_run_and_drop_programs():
    wrong = []

    def work():
        try:
            for _ in range(20):
                program = calling(lambda number: number + 1)
                assert program.run(CL).nc == program.run(CL).nc
                next(iter(program.blocks(CL)))
        except BaseException as error:
            wrong.append(error)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_child_of_a_fork_posts():
    program = mill()
    expected = program.run(CL).nc
    child = os.fork()
    if child == 0:
        os._exit(0 if program.run(CL).nc == expected else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_without_numpy_only_paths_are_missing():
    code = (
        "import sys; sys.modules['numpy'] = None; import filpost\n"
        "program = filpost.Program(ready='fanuc-mill')\n"
        f"nc = program.run({CL!r})\n"
        "try: program.path(nc)\n"
        "except ImportError as error: print('ImportError', error)\n"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert ran.returncode == 0 and ran.stdout.startswith("ImportError"), ran


def test_errors_and_results_can_be_pickled():
    with pytest.raises(filpost.Error) as refused:
        mill().run(CL.replace("GOTO", "GOTOO"))
    again = pickle.loads(pickle.dumps(refused.value))
    assert (again.code, again.line, again.diags) == (
        refused.value.code,
        refused.value.line,
        refused.value.diags,
    )
    result = mill().run(CL)
    assert pickle.loads(pickle.dumps(result)) == result


def test_a_path_is_a_name_and_a_text_is_a_text(tmp_path):
    name = pathlib.Path(tmp_path / "größe.ncl")
    name.write_text(CL)
    assert mill().run(name).nc == mill().run(CL).nc
