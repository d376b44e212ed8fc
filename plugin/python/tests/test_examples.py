"""The examples run, and check what they print themselves; memory stays flat over resets."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


@pytest.mark.parametrize("name, arguments", [("hello", []), ("arm", ["."]), ("stiffness", ["corn", "stiffness.png"]),
                                             ("beam", ["2"]), ("speed", ["kuka_iiwa/model.urdf", "6", "1"])])
def test_example(name, arguments, tmp_path):
    run = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py"), *arguments], cwd=tmp_path, capture_output=True,
                         text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    print(run.stdout)


def test_memory_stays_flat_over_resets_and_connections():
    run = subprocess.run([sys.executable, str(Path(__file__).with_name("soak.py")), "300", "20"], capture_output=True,
                         text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    for what in ("resets", "connections"):
        sizes = [float(size) for size in re.findall(rf"\d+ {what}: ([\d.]+) MB", run.stdout)]
        assert sizes[-2] < sizes[len(sizes) // 2] + 2, run.stdout
