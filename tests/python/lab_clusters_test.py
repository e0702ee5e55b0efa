# SPDX-License-Identifier: MIT
"""Studies on dask.distributed, MPI and Slurm, killed at random: the same bytes as in one process. What is not installed is skipped, and said so."""

import importlib.util
import os
import pathlib
import shutil
import socket
import subprocess
import unittest

from lab_study_test import Killed, descendants
import waiting

DASK = unittest.skipUnless(importlib.util.find_spec("distributed"), "python3-distributed is not installed")
MPI = unittest.skipUnless(importlib.util.find_spec("mpi4py") and shutil.which("mpirun"), "mpi4py or mpirun is not installed")
SLURM = unittest.skipUnless(os.getuid() == 0 and all(map(shutil.which, ("slurmctld", "slurmd", "sbatch", "munged"))),
                            "slurm-wlm is not installed, or this is not root")


class Clusters(Killed):
    def setUp(self):
        super().setUp()
        self.begin_study()

    def dask(self):
        return self.start("--executor", "dask", "--workers", "2", "--resume")

    def of_dask(self, process):
        return [process.pid, *(pid for pid, words in descendants(process.pid).items() if "spawn_main" in words)]

    @DASK
    def test_workers_and_scheduler_of_dask_are_killed(self):
        self.survives(self.dask, self.of_dask)

    @MPI
    def test_ranks_of_mpi_are_killed(self):
        mpirun = ["mpirun", *(["--allow-run-as-root"] if os.getuid() == 0 else []), "-n", "4", "--oversubscribe"]
        self.survives(lambda: self.start("--executor", "mpi", "--resume", before=mpirun),
                      lambda process: [pid for pid, words in descendants(process.pid).items() if "--executor mpi" in words])

    def slurm(self):
        """Submits the study to a cluster of one node, which this test starts; returns whether its jobs are over."""
        if not hasattr(self, "cluster"):
            self.cluster = self.enterContext(Slurm(self.folder))
        (self.folder / "out/results.npz").unlink(missing_ok=True)   # a table that was made while points were missing says so, and is not the last one
        process = self.start("--executor", "slurm", "--workers", "3", "--resume", env=self.cluster.environment)
        self.assertEqual((said := process.communicate(), process.returncode)[1], 0, said)
        return lambda: self.cluster.jobs() == []

    @SLURM
    def test_steps_of_slurm_and_its_scheduler_are_killed(self):
        def victims(_):
            all_words = {int(path.parent.name): path.read_text().split("\0") for path in pathlib.Path("/proc").glob("[0-9]*/cmdline") if path.exists()}
            steps = [pid for pid, said in all_words.items() if "--shard" in said and str(self.folder / "out") in said]
            return [*steps, self.cluster.scheduler.pid] if steps else []

        self.survives(self.slurm, victims, lambda is_over: is_over())

    @DASK
    @SLURM
    def test_killed_on_dask_it_ends_on_slurm(self):
        self.survives(self.dask, self.of_dask, stays=True)
        self.assertTrue(0 < len(self.held()) < self.prepared.design.count)
        self.assertTrue(waiting.eventually(self.slurm(), 0.2))
        self.same()
        self.assertEqual(len(self.held()), self.prepared.design.count)


class Slurm:
    """A cluster of one node, in a folder, with a key of its own: it runs as root, so nobody else may submit jobs."""

    def __init__(self, folder):
        self.folder = folder / "cluster"

    def __enter__(self):
        os.chmod(self.folder.parent, 0o755)
        self.folder.mkdir(0o755)
        (self.folder / "key").write_bytes(os.urandom(1024))
        os.chmod(self.folder / "key", 0o600)
        munge = ["munged", "--foreground", "--force", "--num-threads=2", f"--socket={self.folder}/munge.socket", f"--key-file={self.folder}/key",
                 *(f"--{name}-file={self.folder}/munge.{name}" for name in ("log", "pid", "seed"))]
        self.host = host = socket.gethostname().split(".")[0]
        with socket.socket() as one, socket.socket() as two:
            for free in (one, two):
                free.bind(("127.0.0.1", 0))
            ports = [free.getsockname()[1] for free in (one, two)]
        (self.folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
AuthInfo=socket={self.folder}/munge.socket
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MinJobAge=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP OverSubscribe=FORCE:4
""")
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.others = [self.begin(*munge), self.begin("slurmd", "-D", "-N", host)]
        self.scheduler = self.begin("slurmctld", "-D")
        if not self.is_ready():
            self.__exit__()
            raise unittest.SkipTest("slurmctld, slurmd or munged cannot start here: " + "\n".join(p.read_text()[-600:] for p in self.folder.glob("*log")))
        return self

    def __exit__(self, *_):
        for process in (self.scheduler, *reversed(self.others)):
            process.terminate()
            process.wait()

    def begin(self, *words):
        return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=self.environment)

    def said(self, *words):
        return subprocess.run([*words, "--noheader"], capture_output=True, text=True, env=self.environment, check=False).stdout.split()

    def is_ready(self):
        is_up, ended = lambda: self.said("sinfo", "--format=%T") in (["idle"], ["mixed"], ["allocated"]), lambda: self.scheduler.poll() is not None
        waiting.eventually(lambda: is_up() or ended(), 0.2)
        return is_up()

    def jobs(self):
        """The jobs that wait or run. A scheduler that was killed is started again, as systemd does. It may have forgotten jobs, give their numbers to new
        ones, which the node then refuses, and wait for jobs that have ended meanwhile; so somebody cancels all, and frees the node."""
        died = self.scheduler.poll() is not None
        if died:
            self.scheduler = self.begin("slurmctld", "-D")
            assert self.is_ready(), "slurmctld does not start again"
        if died or any(state.startswith("drain") for state in self.said("sinfo", "--format=%T")):
            for words in (["scancel", "--user=root"], ["scontrol", "update", f"nodename={self.host}", "state=resume"]):
                subprocess.run(words, env=self.environment, stderr=subprocess.DEVNULL, check=False)
        return self.said("squeue", "--format=%i")


if __name__ == "__main__":
    unittest.main(verbosity=2)   # so that it says what it skips
