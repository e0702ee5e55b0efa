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
        process = self.start("--executor", "slurm", "--workers", "3", "--resume", env=self.cluster)
        self.assertEqual((said := process.communicate(), process.returncode)[1], 0, said)
        return lambda: not subprocess.run(["squeue", "--noheader"], env=self.cluster, capture_output=True, check=True).stdout.strip()

    @SLURM
    def test_steps_of_slurm_are_killed(self):
        def steps(_):
            all_words = {int(path.parent.name): path.read_text().split("\0") for path in pathlib.Path("/proc").glob("[0-9]*/cmdline") if path.exists()}
            return [pid for pid, said in all_words.items() if "--shard" in said and str(self.folder / "out") in said]

        self.survives(self.slurm, steps, lambda is_over: is_over())

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
        host = socket.gethostname().split(".")[0]
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
        environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment}
        self.processes = [subprocess.Popen(words, **quiet) for words in (munge, ["slurmctld", "-D"], ["slurmd", "-D", "-N", host])]

        def said():
            return subprocess.run(["sinfo", "--noheader", "--format=%T"], capture_output=True, text=True, env=environment, check=False).stdout.split()

        waiting.eventually(lambda: said() in (["idle"], ["mixed"]) or any(process.poll() is not None for process in self.processes), 0.2)
        if said() not in (["idle"], ["mixed"]):
            self.__exit__()
            raise unittest.SkipTest("slurmctld, slurmd or munged cannot start here: " + "\n".join(p.read_text()[-600:] for p in self.folder.glob("*log")))
        return environment

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
            process.wait()


if __name__ == "__main__":
    unittest.main(verbosity=2)   # so that it says what it skips
