"""The examples run, and check what they print themselves."""

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


@pytest.mark.parametrize("name, arguments", [("hello", []), ("arm", ["."]), ("stiffness", ["corn", "stiffness.png"]),
                                             ("beam", ["2"])])
def test_example(name, arguments, tmp_path):
    run = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py"), *arguments], cwd=tmp_path, capture_output=True,
                         text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    print(run.stdout)
