"""Posts and verifies many CL files on a local cluster whose workers are killed while it
runs, and sees that each file has its outcome and its program, once: run.py
dask|ray|slurm|here COUNT
"""

import os
import pathlib
import pickle
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time

import filpost
from filpost import fleet

#: Every so many CL files has a word that nobody knows.
WRONG = 97


def cl_of(number):
    """A CL file of a few hundred motions, another one for each number."""
    rng = random.Random(number)
    lines = [f"PARTNO / PART {number}", "UNITS / MM", f"LOADTL / {number % 40 + 1}"]
    lines += [f"SPINDL / RPM, {rng.randint(500, 9000)}, CLW", f"FEDRAT / {rng.randint(50, 900)}, MMPM"]
    for _ in range(rng.randint(100, 500)):
        lines.append("GOTO / " + ", ".join(f"{rng.uniform(0, 200):.3f}" for _ in range(3)))
    if number % WRONG == 5:
        lines.insert(9, "BANANA / 1")
    return "\n".join(lines) + "\nFINI\n"


def make(folder, count):
    files = []
    for number in range(count):
        name = folder / f"part{number}.ncl"
        name.write_text(cl_of(number))
        files.append((str(name), str(folder / f"part{number}.nc")))
    return files


def children_named(word):
    """Numbers of the processes below this one that have a word in their command."""
    parents = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                status = pathlib.Path("/proc", entry, "stat").read_text()
                command = pathlib.Path("/proc", entry, "cmdline").read_bytes()
            except OSError:
                continue
            parents[int(entry)] = (int(status.rsplit(")", 1)[1].split()[1]), command)

    def is_below(pid):
        while pid in parents and pid != os.getpid():
            pid = parents[pid][0]
        return pid == os.getpid()

    return [pid for pid, (_, command) in parents.items() if word in command and is_below(pid)]


class Killer(threading.Thread):
    """Kills a worker of this cluster every so often, until it is told to stop."""

    def __init__(self, workers, every):
        super().__init__(daemon=True)
        self.workers, self.every = workers, every
        self.killed, self.stop = 0, threading.Event()
        self.came = 0

    def run(self):
        due = 0
        while not self.stop.wait(self.every):
            workers = self.workers()
            if workers and self.came >= due:
                try:
                    os.kill(random.choice(workers), signal.SIGKILL)
                    due, self.killed = self.came + MOVES_ON, self.killed + 1
                except ProcessLookupError:
                    pass


class Keeper:
    """Starts workers anew where none is left: a local cluster of Dask gives one up for good
    that is killed while it starts. Clusters of several machines have such a thing of their own."""

    def __init__(self, cluster, workers, count):
        self.cluster, self.workers, self.count = cluster, workers, count
        self.stop = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def run(self):
        idle = 0
        while not self.stop.wait(1.0):
            idle = 0 if self.workers() else idle + 1
            if idle == 10:
                self.cluster.scale(0)
                self.cluster.scale(self.count)
                idle = 0

    def __enter__(self):
        self.thread.start()

    def __exit__(self, *_):
        self.stop.set()
        self.thread.join()


def on_dask(program, files, every):
    from distributed import Client, LocalCluster

    import dask

    # Each file is worth many tries: workers die of the killer, not of the files.
    dask.config.set({"distributed.scheduler.allowed-failures": 20})
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            def workers():
                # A nanny whose worker dies while it starts gives up for good.
                alive = [one.process for one in cluster.workers.values() if one.process]
                return [one.pid for one in alive if one.status.name == "running" and one.pid]

            yield Killer(workers, every)
            with Keeper(cluster, workers, 2):
                yield from fleet.on_dask(client, program, files, batch=25)


def on_ray(program, files, every):
    import ray

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, logging_level="ERROR")
    try:
        yield Killer(lambda: children_named(b"ray::_post_many"), every)
        yield from fleet.on_ray(program, files, batch=25)
    finally:
        ray.shutdown()


#: As many outcomes come between two kills at least: on a busy machine a worker may need longer to
#: start than the time between them.
MOVES_ON = 300

#: Jobs of the array of Slurm.
PARTS = 4


def on_slurm(program, files):
    """An array of jobs, of which the second is killed in the middle and submitted again."""
    folder = pathlib.Path(files[0][0]).parent
    (folder / "part.pickle").write_bytes(pickle.dumps((program, files)))
    script = folder / "part.sh"
    script.write_text(f"#!/bin/bash\nexec {sys.executable} {os.path.abspath(__file__)} part {folder}\n")
    submit = ["sbatch", "--wait", "--quiet", f"--output={folder}/part-%a.log"]
    subprocess.run([*submit, f"--array=1-{PARTS}", str(script)])
    left = [n for n in range(1, PARTS + 1) if not (folder / f"part-{n}.done").exists()]
    assert left == [2], left
    yield len(left)
    subprocess.run([*submit, f"--array={left[0]}", str(script)], check=True)
    for number in range(1, PARTS + 1):
        yield from pickle.loads((folder / f"part-{number}.done").read_bytes())


def part_of(folder):
    """A job of the array: posts and verifies each fourth file."""
    program, files = pickle.loads((folder / "part.pickle").read_bytes())
    number = int(os.environ["SLURM_ARRAY_TASK_ID"])
    own = files[number - 1 :: PARTS]
    began = folder / f"part-{number}.began"
    dies_at = len(own) // 2 if number == 2 and not began.exists() else None
    began.touch()
    outcomes = []
    for outcome in fleet.here(program, own):
        outcomes.append(outcome)
        if len(outcomes) == dies_at:
            os.kill(os.getpid(), signal.SIGKILL)
    (folder / f"part-{number}.done").write_bytes(pickle.dumps(outcomes))


def main(kind, count):
    program = filpost.Program(ready="fanuc-mill")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        files = make(folder, count)
        started = time.perf_counter()
        killer, killed = None, 0
        if kind == "here":
            outcomes = list(fleet.here(program, files))
        elif kind == "slurm":
            running = on_slurm(program, files)
            killed = next(running)
            outcomes = list(running)
        else:
            # Ray needs longer to start a worker.
            running = on_dask(program, files, 2.0) if kind == "dask" else on_ray(program, files, 3.0)
            killer = next(running)
            started = time.perf_counter()
            killer.start()
            outcomes = []
            for outcome in running:
                outcomes.append(outcome)
                killer.came += 1
            killer.stop.set()
        seconds = time.perf_counter() - started

        by_name = {outcome.cl: outcome for outcome in outcomes}
        assert len(outcomes) == len(by_name) == count, "each file has one outcome"
        refused = written = 0
        for number, (cl, nc) in enumerate(files):
            outcome = by_name[cl]
            if number % WRONG == 5:
                assert outcome.verdict == "refused" and not os.path.exists(nc), outcome
                assert any("BANANA" in diag.message and diag.file == cl for diag in outcome.diags)
                refused += 1
                continue
            assert outcome.verdict == "agrees", outcome
            text = pathlib.Path(nc).read_bytes()
            assert text == program.run(pathlib.Path(cl)).nc, f"{nc} is whole"
            written += outcome.written
        assert written + refused <= count
        stray = [name for name in os.listdir(folder) if not name.startswith((".filpost-", "part"))]
        assert not stray, stray
        killed = killer.killed if killer else killed
        if killer and count >= 1000:
            assert killed, "no worker was killed"
        again = count - refused - written
        print(
            f"{kind}: {count} files in {seconds:.1f} s ({count / seconds:.0f} a second), {killed} workers "
            f"killed, {refused} refused, {again} found written by a worker that had died"
        )


if __name__ == "__main__":
    if sys.argv[1] == "part":
        part_of(pathlib.Path(sys.argv[2]))
    else:
        main(sys.argv[1], int(sys.argv[2]))
