# SPDX-License-Identifier: MIT
"""Studies on dask.distributed, MPI and Slurm: the same bytes as in one process. What is not installed is skipped, and said so."""

import os
import pathlib
import shutil
import socket
import subprocess
import sys
import unittest

from lab_study_test import Quiet, points, wall
import waiting
from tactus import lab
from tactus.lab import _drive

WORDS = [sys.executable, "-B", "-m", "tactus.lab", "study"]


def has(package):
    try:
        __import__(package)
        return True
    except ImportError:
        return False


class Clusters(Quiet):
    def setUp(self):
        super().setUp()
        self.study = wall(keep=["motor.force.z"], factors=[lab.Factor("wall.stiffness", low=1000.0, high=5000.0, count=20),
                                                           lab.Factor("wall.damping", values=[0, 0.5, -1, 2])])
        self.file = self.folder / "s.json"
        self.file.write_text(self.study.text())
        self.study.run(self.folder / "whole")
        self.whole = (self.folder / "whole/results.tcol").read_bytes()

    def ran(self, *words, **options):
        done = subprocess.run([*map(str, words)], capture_output=True, text=True, cwd=self.folder, **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def same(self, out):
        self.assertEqual((self.folder / out / "results.tcol").read_bytes(), self.whole, out)

    @unittest.skipUnless(has("distributed"), "python3-distributed is not installed")
    def test_dask(self):
        self.ran(*WORDS, self.file, "--out", "dask", "--executor", "dask", "--workers", "2")
        self.same("dask")

    @unittest.skipUnless(has("mpi4py") and shutil.which("mpirun"), "mpi4py or mpirun is not installed")
    def test_mpi(self):
        root = ["--allow-run-as-root"] if os.getuid() == 0 else []
        self.ran("mpirun", *root, "-n", "4", "--oversubscribe", *WORDS, self.file, "--out", "mpi", "--executor", "mpi")
        self.same("mpi")

    @unittest.skipUnless(os.getuid() == 0 and all(map(shutil.which, ("slurmctld", "slurmd", "sbatch", "munged"))),
                         "slurm-wlm is not installed, or this is not root")
    def test_slurm_goes_on_with_what_another_executor_began(self):
        with Slurm(self.folder) as environment:
            if not environment:
                self.skipTest("slurmctld, slurmd or munged cannot start here")
            self.ran(*WORDS, self.file, "--out", "slurm", "--executor", "slurm", "--workers", "3", env=environment)
            self.wait_for(environment)
            self.same("slurm")
            prepared = self.study.prepare()
            _drive.drive(prepared, self.folder / "both", shard=(1, 2))
            begun = len(lab._parts.Folder(prepared, self.folder / "both", False, False).keys())
            self.assertEqual(begun, len(points(prepared.design)) // 2)
            self.ran(*WORDS, self.file, "--out", "both", "--executor", "slurm", "--workers", "3", "--resume", env=environment)
            self.wait_for(environment)
            self.same("both")
            sizes = [frame.about["n"] for _, _, frame in lab._parts.Folder(prepared, self.folder / "both", False, False).frames()]
            self.assertEqual(sum(sizes), prepared.design.count)   # nothing was rendered twice

    def wait_for(self, environment):
        self.assertTrue(waiting.eventually(lambda: not self.ran("squeue", "--noheader", env=environment).strip(), 0.2))


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
