"""The package as its users have it."""

import concurrent.futures
import datetime
import gc
import io
import pathlib
import pickle
import threading
import time

import filpost
import pytest

CL = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n"
RAISE = """CIMFIL/ON,LOADTL
POSTN/OUT,G,0,Z,SAFEZF(POSTF(7,4))
DMY=POSTF(13)
CIMFIL/OFF
FINI
"""


def mill(**more):
    more.setdefault("options", {"style": "plain"})
    return filpost.Program(ready="fanuc-mill", **more)


def long_cl(motions):
    head = "UNITS / MM\nLOADTL / 3\nFEDRAT / 200, MMPM\n"
    return head + "".join(f"GOTO / {i % 97}, {i % 89}, 5\n" for i in range(motions)) + "FINI\n"


def test_run_gives_program_and_report():
    result = mill().run(CL)
    assert "G1 G43 X1. Y2. Z3. F200. H3" in result.text
    report = result.report
    assert (report.records, report.bytes, report.unit) == (6, len(result.nc), "mm")
    assert report.blocks == result.text.count("\n")
    assert report.extents == ((1, 2, 3), (1, 2, 3))
    assert result.warnings == ()


def test_cl_comes_as_text_bytes_path_or_file(tmp_path):
    name = tmp_path / "part.ncl"
    name.write_text(CL)
    program = mill()
    want = program.run(CL).nc
    for cl in (CL.encode(), name, io.StringIO(CL), io.BytesIO(CL.encode()), open(name, "rb")):
        assert program.run(cl).nc == want
    with pytest.raises(TypeError, match="not int"):
        program.run(7)


def test_files_appear_only_after_success(tmp_path):
    good, bad, nc = tmp_path / "good.ncl", tmp_path / "bad.ncl", tmp_path / "out.nc"
    good.write_text(CL)
    bad.write_text(CL.replace("GOTO", "GOTOO"))
    with pytest.raises(filpost.Error) as refused:
        mill().run_files(bad, nc)
    assert not nc.exists()
    assert refused.value.file == str(bad) and refused.value.line == 5
    assert mill().run_files(good, nc).records == 6
    assert nc.read_bytes() == mill().run(CL).nc
    with pytest.raises(filpost.Error) as missing:
        mill().run(pathlib.Path(tmp_path / "none.ncl"))
    assert missing.value.code == "E0701"


def test_an_error_tells_code_file_and_line():
    with pytest.raises(filpost.Error) as refused:
        mill().run(CL.replace("GOTO / 1, 2, 3", "BANANA / 1"), name="part.ncl")
    error = refused.value
    assert (error.file, error.line) == ("part.ncl", 4 + 1)
    assert error.code.startswith("E") and error.diags[0].hint
    assert "BANANA" in str(error)
    assert error.code in filpost.explain(error.code)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.diags) == (str(error), error.diags)
    with pytest.raises(KeyError):
        filpost.explain("E9999")
    assert "G83" in filpost.explain("G83") and "rapid.split" in filpost.explain("rapid.split")


def test_a_path_is_a_path_and_a_text_a_text(tmp_path):
    cl = tmp_path / "part.ncl"
    cl.write_text(CL)
    assert mill().run(path=cl).nc == mill().run(path=str(cl)).nc == mill().run(CL).nc
    assert next(mill().blocks(path=cl)).text == next(mill().blocks(CL)).text
    for mistaken in (lambda: mill().run(str(cl)), lambda: filpost.Program(machine=str(cl))):
        with pytest.raises(ValueError, match="name of a file; give pathlib.Path"):
            mistaken()
    for call in (lambda: mill().run(), lambda: mill().run(CL, path=cl)):
        with pytest.raises(TypeError, match="give the CL file, or its path"):
            call()


def test_a_post_in_a_folder_and_a_clock(tmp_path):
    (tmp_path / "machine.toml").write_text('base = "fanuc-mill"\n')
    (tmp_path / "post.fil").write_text(
        "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nD=DATEF(1)\nPPRINT/'TOOL OF ',(TEXT/CONVI,D,4)\n"
        "CIMFIL/OFF\nFINI\n"
    )
    moment = datetime.datetime(2026, 1, 31, 12)
    program = filpost.Program.from_folder(tmp_path, clock=moment)
    assert "(TOOL OF 2026)" in program.run(CL).text
    assert pickle.loads(pickle.dumps(program)).run(CL).nc == program.run(CL).nc
    assert "(TOOL OF 20" in filpost.Program.from_folder(tmp_path, clock="system").run(CL).text
    with pytest.raises(filpost.Error) as without:
        filpost.Program.from_folder(tmp_path).run(CL)
    assert without.value.file == str(tmp_path / "post.fil")
    with pytest.raises(filpost.Error) as missing:
        filpost.Program.from_folder(tmp_path / "none")
    assert missing.value.code == "E0701"
    with pytest.raises(ValueError, match="give one of"):
        filpost.Program.from_folder(tmp_path, ready="haas-mill")


def test_all_that_is_wrong_with_a_program_comes_at_once():
    with pytest.raises(filpost.Error) as refused:
        mill(settings={"no.such": 1}, fil=[("bad.fil", "IF(")])
    assert {diag.file for diag in refused.value.diags} >= {"bad.fil"}
    assert len(refused.value.diags) >= 2


def test_blocks_tell_what_made_them():
    program = mill(fil=[("raise.fil", RAISE)], functions={"SAFEZF": lambda tool: 100 + tool})
    blocks = program.blocks(CL)
    found = list(blocks)
    assert [block.number for block in found] == list(range(1, len(found) + 1))
    assert "\n".join(block.text for block in found) + "\n" == program.run(CL).text
    raised = next(block for block in found if "Z103." in block.text)
    assert (raised.line, raised.record, raised.fil) == (2, 2, (("raise.fil", 2),))
    moved = next(block for block in found if "X1." in block.text)
    words = {word.letter: word for word in moved.words}
    assert (words["X"].text, words["X"].line, words["X"].record_word) == ("X1.", 5, 6)
    assert (words["F"].text, words["F"].line) == ("F200.", 4)
    assert words["X"].fil == () and not words["X"].made_by_fil
    assert blocks.report.records == 6


def test_blocks_are_lazy():
    cl = long_cl(200_000)
    started = time.perf_counter()
    first = next(mill().blocks(cl))
    lazily = time.perf_counter() - started
    started = time.perf_counter()
    result = mill().run(cl)
    assert first.text and lazily < (time.perf_counter() - started) / 4
    wrong = iter(mill().blocks(CL.replace("GOTO", "BANANA")))
    assert next(wrong).text
    with pytest.raises(filpost.Error):
        list(wrong)
    assert list(wrong) == [] and result.report.blocks > 200_000


def test_exceptions_of_callables_are_causes():
    class Drawer(Exception):
        pass

    def missing(tool):
        raise Drawer(f"tool {tool:.0f} is in no drawer")

    program = mill(fil=[("raise.fil", RAISE)], functions={"SAFEZF": missing})
    with pytest.raises(filpost.Error) as refused:
        program.run(CL)
    assert isinstance(refused.value.__cause__, Drawer)
    assert refused.value.__cause__.__traceback__ is not None
    assert refused.value.file == "raise.fil" and refused.value.line == 2
    with pytest.raises(filpost.Error) as lazily:
        list(program.blocks(CL))
    assert isinstance(lazily.value.__cause__, Drawer)
    # What was raised before is not the cause of another error.
    with pytest.raises(filpost.Error) as other:
        mill().run(CL.replace("GOTO", "BANANA"))
    assert other.value.__cause__ is None


@pytest.mark.parametrize("value", [[], object(), True, "x" * 3, float("nan")])
def test_what_a_callable_returns_is_checked(value):
    program = mill(fil=[("raise.fil", RAISE)], functions={"SAFEZF": lambda tool: value})
    with pytest.raises(filpost.Error):
        program.run(CL)


def test_callables_take_texts_and_empty():
    fil = """CIMFIL/ON,LOADTL
NAME=NAMEF('T',POSTF(4))
PPRINT/NAME
DMY=POSTF(13)
CIMFIL/OFF
FINI
"""
    seen = []

    def name(*given):
        seen.append(given)
        return "END MILL"

    program = mill(fil=[("name.fil", fil)], functions={"NAMEF": (2, name)})
    assert "(END MILL)" in program.run(CL).text
    assert seen == [("T", None)]
    with pytest.raises(TypeError, match="number of arguments"):
        mill(functions={"NAMEF": name})
    with pytest.raises(filpost.Error) as refused:
        mill(functions={"SQRTF": lambda x: x})
    assert refused.value.code == "E0229"


def test_threads_share_a_program():
    cl = long_cl(20_000)
    program = mill(
        fil=[("raise.fil", RAISE)], functions={"SAFEZF": lambda tool: 100 + tool}
    )
    want = program.run(cl).nc
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert all(one.nc == want for one in pool.map(program.run, [cl] * 16))


def test_the_gil_is_released_while_a_program_runs():
    cl = long_cl(400_000).encode()
    program, turns, done = mill(), 0, threading.Event()
    thread = threading.Thread(target=lambda: (program.run(cl), done.set()))
    thread.start()
    while not done.is_set():
        turns += 1
        time.sleep(0.001)
    thread.join()
    assert turns > 20, f"the other thread had {turns} turns"


def test_a_switch_stops_a_run():
    switch = filpost.Cancel()
    switch.cancel()
    assert switch.cancelled
    with pytest.raises(filpost.Error) as stopped:
        mill().run(long_cl(10_000), cancel=switch)
    assert stopped.value.cancelled


def test_limits_stop_a_script():
    fil = "CIMFIL/ON,LOADTL\nLOOP)A=A+1\nJUMPTO/LOOP\nCIMFIL/OFF\nFINI\n"
    with pytest.raises(filpost.Error) as refused:
        mill(fil=[("loop.fil", fil)], limits={"fuel": 1000}).run(CL)
    assert refused.value.file == "loop.fil"
    with pytest.raises(ValueError, match="no limit"):
        mill(limits={"petrol": 1})


def test_verify_finds_what_was_changed():
    program = mill()
    nc = program.run(CL)
    assert program.verify(CL, nc).verdict == "agrees"
    found = program.verify(CL, nc.text.replace("Y2.", "Y2.5"), nc_name="part.nc")
    assert found.verdict == "differs" and found.position.max == pytest.approx(0.5)
    assert found.findings[0].cl_line == 5
    assert program.verify(CL, nc.text.replace("Y2.", "Y2.5"), tolerance=0.6).verdict == "agrees"
    for wrong in ({"tolerance": -1}, {"offsets": ["G999999"]}, {"between": float("nan")}):
        with pytest.raises(ValueError):
            program.verify(CL, nc, **wrong)


def test_diff_reads_programs_as_a_control():
    one = mill().run(CL)
    assert filpost.diff(one, one.text) == []
    (found,) = filpost.diff(one, one.text.replace("Z3.", "Z2.5"))
    assert "Z deeper by 0.5" in found.message and found.lines[0] == found.lines[1]
    assert filpost.diff(one, one.text.replace("Z3.", "Z2.5"), ignore=["z"]) == []
    with pytest.raises(ValueError):
        filpost.diff(one, one, ignore=["zz"])


def test_pictures():
    program = mill()
    nc = program.run(long_cl(100))
    assert program.plot(nc).startswith("<svg")
    assert "<html" in program.plot(nc, cl=long_cl(100), form="html")
    assert filpost.plot_cl(long_cl(100), views=["xy"]).startswith("<svg")
    with pytest.raises(ValueError, match="no view"):
        filpost.plot_cl(CL, views=["front"])
    with pytest.raises(ValueError, match="no form"):
        filpost.plot_cl(CL, form="pdf")


def test_the_path_is_an_array_in_mm():
    np = pytest.importorskip("numpy")
    program = mill()
    inches = long_cl(100).replace("MMPM", "IPM").replace("MM", "INCHES")
    for cl, scale in ((long_cl(100), 1.0), (inches, 25.4)):
        nc = program.run(cl)
        path, asked = program.path(nc), filpost.cl_path(cl)
        assert path.points.dtype == np.float64 and path.points.shape[1] == 3
        assert path.points.base is not None or path.points.flags.owndata
        ends = path.points[path.ends.astype(int) - 1]
        assert np.allclose(ends[-1], [2 * scale, 10 * scale, 5 * scale], atol=1e-3)
        assert np.allclose(asked.points[-1], ends[-1], atol=1e-3)
        assert set(filpost.STROKES[stroke] for stroke in path.strokes) <= {"rapid", "feed"}
        assert path.unit == ("mm" if scale == 1 else "inch")


def test_dialects_and_units():
    no_unit = CL.replace("UNITS / MM\n", "")
    with pytest.raises(filpost.Error):
        mill().run(no_unit)
    assert mill(units="mm").run(no_unit).report.unit == "mm"
    assert mill(cl_dialect="nx").run(CL).report.dialect == "nx"
    with pytest.raises(ValueError, match="there are generic"):
        mill(cl_dialect="surfcam")


def test_machines_come_as_text_pair_or_path(tmp_path):
    toml = 'base = "fanuc-mill"\n[rapid]\nsplit = 0\n'
    name = tmp_path / "mine.toml"
    name.write_text(toml)
    want = None
    for machine in (toml, ("mine.toml", toml), name):
        text = filpost.Program(machine=machine).run(CL).text
        assert text == (want or text)
        want = text
    with pytest.raises(ValueError, match="one of"):
        filpost.Program(ready="fanuc-mill", machine=toml)
    with pytest.raises(TypeError, match="list"):
        mill(fil="raise.fil")
    with pytest.raises(filpost.Error) as none:
        filpost.Program(ready="fanuc-mil")
    assert "fanuc-mill" in none.value.diags[0].hint


def test_a_program_can_be_pickled():
    program = mill(settings={"rapid.split": 0}, units="mm")
    again = pickle.loads(pickle.dumps(program))
    assert again.run(CL).nc == program.run(CL).nc


def test_everything_is_documented():
    for name in filpost.__all__:
        thing = getattr(filpost, name)
        if callable(thing):
            assert thing.__doc__, name
            for attribute, value in vars(thing).items() if isinstance(thing, type) else ():
                if not attribute.startswith("_") and (callable(value) or hasattr(value, "__get__")):
                    assert value.__doc__, f"{name}.{attribute}"


def test_many_runs_keep_memory():
    resource = pytest.importorskip("resource")
    program = mill(fil=[("raise.fil", RAISE)], functions={"SAFEZF": lambda tool: 100 + tool})

    def runs(count):
        for _ in range(count):
            program.run(CL)
            list(program.blocks(CL))
            with pytest.raises(filpost.Error):
                program.run(CL.replace("GOTO", "BANANA"))
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    runs(200)
    before = runs(200)
    assert runs(1000) - before < 4096, "kilobytes"


def test_a_fleet_writes_each_program_once(tmp_path):
    from filpost import fleet

    files = []
    for name, text in [("good", CL), ("wrong", CL.replace("GOTO", "BANANA")), ("more", CL)]:
        (tmp_path / f"{name}.ncl").write_text(text)
        files.append((str(tmp_path / f"{name}.ncl"), str(tmp_path / f"{name}.nc")))
    files.append((str(tmp_path / "none.ncl"), str(tmp_path / "none.nc")))
    first = list(fleet.here(mill(), files))
    assert [one.verdict for one in first] == ["agrees", "refused", "agrees", "refused"]
    assert [one.written for one in first] == [True, False, True, False]
    assert sorted(one.name for one in tmp_path.glob("*.nc")) == ["good.nc", "more.nc"]
    stamps = [one.stat().st_mtime_ns for one in sorted(tmp_path.glob("*.nc"))]
    # The same again writes nothing; another program under the name refuses the file.
    again = list(fleet.here(mill(), files))
    assert [one.verdict for one in again] == [one.verdict for one in first]
    assert not any(one.written for one in again)
    assert stamps == [one.stat().st_mtime_ns for one in sorted(tmp_path.glob("*.nc"))]
    (tmp_path / "good.nc").write_text("G0 X0\n")
    assert next(fleet.here(mill(), files)).verdict == "refused"
    assert (tmp_path / "good.nc").read_text() == "G0 X0\n"
    assert not list(tmp_path.glob(".filpost-*"))


def test_the_notebook_of_the_documentation_runs():
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    name = pathlib.Path(__file__).parents[3] / "docs" / "python.ipynb"
    notebook = nbformat.read(name, as_version=4)
    shown = [cell.get("outputs", []) for cell in notebook.cells]
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    for cell, before in zip(notebook.cells, shown):
        # A slow kernel hands out what a cell prints in several parts.
        parts = (before, cell.get("outputs", []))
        texts = ["".join("".join(out.get("text", "")) for out in outs) for outs in parts]
        assert texts[0] == texts[1], cell.source


@pytest.mark.parametrize("page", ["docs/embedding.md", "docs/python.md", "crates/filpost-py/README.md"])
def test_examples_of_the_pages_run(page, capsys):
    """A block `python` runs, and a block `text printed` after it is what it prints."""
    text = (pathlib.Path(__file__).parents[3] / page).read_text()
    parts = text.split("```")[1::2]
    ran = 0
    for part, after in zip(parts, parts[1:] + [""]):
        if part.startswith("python\n"):
            exec(compile(part.removeprefix("python\n"), page, "exec"), {})
            out = capsys.readouterr().out
            if after.startswith("text printed\n"):
                assert out == after.removeprefix("text printed\n")
            ran += 1
    assert ran
