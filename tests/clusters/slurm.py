# SPDX-License-Identifier: BSD-3-Clause
"""A Slurm of one node that lives in a folder, for as long as a test takes."""

import os
import secrets
import shutil
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")

CONF = """\
ClusterName=cambium
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class SlurmAbsent(Exception):
    """Slurm cannot run here; says why."""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class Slurm:
    @staticmethod
    def check():
        path = os.environ["PATH"] + ":/usr/sbin:/sbin"
        for program in PROGRAMS:
            if not shutil.which(program, path=path):
                raise SlurmAbsent(f"{program} is not installed")
        if os.getuid() != 0:
            raise SlurmAbsent("slurmd runs jobs as root only")

    def __init__(self, folder):
        self.folder, self.daemons = Path(folder), []
        self.environment = dict(os.environ, SLURM_CONF=f"{folder}/slurm.conf",
                                PATH=os.environ["PATH"] + ":/usr/sbin:/sbin")

    def __enter__(self):
        for sub in ("state", "spool"):
            (self.folder / sub).mkdir(parents=True)
        self.folder.chmod(0o755)
        host = socket.gethostname().split(".")[0]
        (self.folder / "slurm.conf").write_text(
            CONF.format(folder=self.folder, host=host, user="root", ports=free_ports(2)))
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o600)
        self.start("munged", "--foreground", "--force", f"--key-file={key}",
                   f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                   f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munge.seed")
        self.until(lambda: (self.folder / "munge.socket").exists(), "munged does not start")
        self.start("slurmctld", "-D", "-i")
        self.start("slurmd", "-D", "-N", host)
        self.until(lambda: "idle" in self.run(["sinfo", "-h", "-o", "%T"], check=False),
                   "the node does not become idle")
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait(30)

    def start(self, *command):
        log = open(self.folder / f"{command[0]}.out", "w")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log))

    def run(self, command, folder=None, environment={}, check=True):
        done = subprocess.run(command, cwd=folder, env={**self.environment, **environment},
                              text=True, capture_output=True)
        assert not check or done.returncode == 0, f"{command}:\n{done.stdout}{done.stderr}"
        return done.stdout

    def wait(self, job, seconds=300):
        """Until the job is done; every job before it must have succeeded."""
        states = lambda: self.run(["squeue", "-h", "-t", "all", "-o", "%T"]).split()
        self.until(lambda: all(s not in ("PENDING", "RUNNING", "CONFIGURING", "COMPLETING")
                               for s in states()), f"job {job} does not end", seconds)
        assert set(states()) == {"COMPLETED"}, self.run(["squeue", "-t", "all"])

    def until(self, condition, complaint, seconds=60):
        end = time.monotonic() + seconds
        while not condition():
            logs = "".join(f"{f}:\n{f.read_text()[-2000:]}" for f in self.folder.glob("*.log"))
            assert time.monotonic() < end, f"{complaint}\n{logs}"
            assert all(d.poll() is None for d in self.daemons), f"{complaint}: a daemon ended\n{logs}"
            time.sleep(0.2)
