# SPDX-License-Identifier: MIT
"""Studies on dask.distributed, MPI and Slurm: the same bytes as in one process. What is not installed is skipped, and said so."""

import os
import pathlib
import shutil
import socket
import subprocess
import sys
import unittest

from lab_study_test import Killed, descendants
import waiting

WORDS = [sys.executable, "-B", "-m", "tactus.lab", "study"]


def has(package):
    try:
        __import__(package)
        return True
    except ImportError:
        return False


DASK = unittest.skipUnless(has("distributed"), "python3-distributed is not installed")
MPI = unittest.skipUnless(has("mpi4py") and shutil.which("mpirun"), "mpi4py or mpirun is not installed")
SLURM = unittest.skipUnless(os.getuid() == 0 and all(map(shutil.which, ("slurmctld", "slurmd", "sbatch", "munged"))),
                            "slurm-wlm is not installed, or this is not root")


class Clusters(Killed):
    def setUp(self):
        super().setUp()
        self.begin_study()

    def start(self, *words, **options):
        return subprocess.Popen([*map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder, **options)

    def ran(self, *words, **options):
        process = self.start(*words, **options)
        said = process.communicate()
        self.assertEqual(process.returncode, 0, said)
        return said[0]

    def same(self, out):
        self.assertEqual((self.folder / out / "results.tcol").read_bytes(), (self.folder / "whole/results.tcol").read_bytes(), out)
        self.assertEqual(self.held(out)[1], self.prepared.design.count)   # nothing was rendered twice

    def dask(self, out):
        return [*WORDS, self.file, "--out", out, "--executor", "dask", "--workers", "2", "--resume"]

    @DASK
    def test_dask(self):
        self.ran(*self.dask("dask"))
        self.same("dask")

    @DASK
    def test_workers_and_scheduler_of_dask_are_killed(self):
        self.survives(lambda: self.start(*self.dask("out")),
                      lambda process: [process.pid, *(pid for pid, words in descendants(process.pid).items() if "spawn_main" in words)])

    def mpi(self, out):
        root = ["--allow-run-as-root"] if os.getuid() == 0 else []
        return ["mpirun", *root, "-n", "4", "--oversubscribe", *WORDS, self.file, "--out", out, "--executor", "mpi", "--resume"]

    @MPI
    def test_mpi(self):
        self.ran(*self.mpi("mpi"))
        self.same("mpi")

    @MPI
    def test_ranks_of_mpi_are_killed(self):
        self.survives(lambda: self.start(*self.mpi("out")),
                      lambda process: [pid for pid, words in descendants(process.pid).items() if "--executor mpi" in words])

    def slurm(self, out, environment):
        return [*WORDS, self.file, "--out", out, "--executor", "slurm", "--workers", "3", "--resume"], {"env": environment}

    def cluster(self):
        environment = self.enterContext(Slurm(self.folder))
        if not environment:
            self.skipTest("slurmctld, slurmd or munged cannot start here")
        return environment

    def is_over(self, environment):
        return not self.ran("squeue", "--noheader", env=environment).strip()

    @SLURM
    def test_slurm(self):
        environment = self.cluster()
        words, options = self.slurm("slurm", environment)
        self.ran(*words, **options)
        self.assertTrue(waiting.eventually(lambda: self.is_over(environment), 0.2))
        self.same("slurm")

    @SLURM
    def test_steps_of_slurm_are_killed(self):
        environment = self.cluster()
        words, options = self.slurm("out", environment)

        def steps(_):
            all_words = {int(path.parent.name): path.read_text().split("\0") for path in pathlib.Path("/proc").glob("[0-9]*/cmdline") if path.exists()}
            return [pid for pid, said in all_words.items() if "--shard" in said and str(self.folder / "out") in said]

        self.survives(lambda: self.ran(*words, **options) and None, steps, lambda _: self.is_over(environment))

    @DASK
    @SLURM
    def test_begun_on_dask_it_ends_on_slurm(self):
        environment = self.cluster()
        process = self.start(*self.dask("both"), env=environment)
        self.assertTrue(waiting.eventually(lambda: self.held("both")[1] >= 10 or process.poll() is not None))
        process.kill()
        process.communicate()
        begun = self.held("both")[1]
        self.assertTrue(10 <= begun < self.prepared.design.count, begun)
        words, options = self.slurm("both", environment)
        self.ran(*words, **options)
        self.assertTrue(waiting.eventually(lambda: self.is_over(environment), 0.2))
        self.same("both")


class Slurm:
    """A cluster of one node, in a folder."""

    def __init__(self, folder):
        self.folder = folder / "cluster"
        self.processes = []

    def __enter__(self):
        self.folder.mkdir()
        os.chmod(self.folder, 0o755)
        os.chmod(self.folder.parent, 0o755)
        host = socket.gethostname().split(".")[0]
        (self.folder / "key").write_bytes(os.urandom(1024))
        os.chmod(self.folder / "key", 0o600)
        munge = self.folder / "munge.socket"
        self.start("munged", "--foreground", "--force", f"--socket={munge}", f"--key-file={self.folder}/key", f"--log-file={self.folder}/munge.log",
                   f"--pid-file={self.folder}/munge.pid", f"--seed-file={self.folder}/munge.seed", "--num-threads=2")
        ports = []
        for _ in range(2):
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                ports.append(free.getsockname()[1])
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={munge}
CryptoType=crypto/munge
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
MinJobAge=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:4
""")
        environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.start("slurmctld", "-D", "-f", f"{self.folder}/slurm.conf", env=environment)
        self.start("slurmd", "-D", "-f", f"{self.folder}/slurm.conf", "-N", host, env=environment)
        said = []

        def stands():
            said[:] = subprocess.run(["sinfo", "--noheader", "--format=%T"], capture_output=True, text=True, env=environment, check=False).stdout.split()
            return said in (["idle"], ["mixed"]) or any(process.poll() is not None for process in self.processes)

        waiting.eventually(stands, 0.2)
        if said in (["idle"], ["mixed"]):
            return environment
        for name in ("slurmctld.log", "slurmd.log", "munge.log"):
            path = pathlib.Path(self.folder / name)
            print(f"{name}: {path.read_text()[-600:] if path.exists() else 'none'}", file=sys.__stderr__)
        return None

    def start(self, *words, **options):
        self.processes.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options))

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.terminate()
            process.wait()


if __name__ == "__main__":
    unittest.main(verbosity=2)   # so that it says what it skips
