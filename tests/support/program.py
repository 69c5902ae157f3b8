# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the program share: a folder to work in, and runs that must end as they should."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


class ProgramCase(unittest.TestCase):
    program = source = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = Path(folder.name)
        cls.environment = {**os.environ, "CAMBIUM_CACHE": str(cls.work / "cache")}

    def cambium(self, *command, code=0, within=600):
        done = subprocess.run([self.program, *command], cwd=self.work, text=True, capture_output=True,
                              env=self.environment, timeout=within)
        if done.returncode != code:
            raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done


def main(case, plugin):
    """Arguments: the program, the source folder. Exit code 77: the plugin was not built."""
    case.program, case.source = sys.argv[1:3]
    if subprocess.run([case.program, "plugins", "describe", plugin], capture_output=True).returncode:
        print(f"skipped: the plugin '{plugin}' was not built")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
