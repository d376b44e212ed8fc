"""Sweeps over settings, and rollouts of the environment, on one core, all cores or a cluster, by Ray.

    python -m frond.sweep accuracy                       all cores of this machine
    python -m frond.sweep stiffness --address auto       a cluster that runs
    python -m frond.sweep wind --workers 0               this process alone, without Ray
    python -m frond.sweep rollouts --seeds 32            episodes of frond.gym

Each prints CSV. Results do not depend on where a part of the work is done, but for CPU times; what a worker was doing
when it died is done again by another. Ray comes with pip install 'frond[sweep]'.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import sys
import time
from typing import Any, Callable, Iterable, Sequence

import numpy as np

from ._generated import Result
from ._lib import Error, integer, refuse
from .model import Model, material_preset
from .world import World

Case = dict[str, Any]
RETRIES = 5


# ---- cases: each is a function of its settings alone --------------------------------------------------------------


def sway(mechanics: str, integrator: str, dt: float, seconds: float = 1.0) -> tuple[np.ndarray, float]:
    """Pulls a corn plant aside for a tenth of a second and lets it sway. Returns its tip each tenth of a second [m],
    and the CPU time [s]."""
    world = World(sleep_distance=0, max_substep=dt)
    plant = world.add_plant(Model("corn"), mechanics=mechanics, integrator=integrator)
    node = int(np.argmax(plant.get_state()[0][:, 1]))
    begin = time.process_time()
    tips = []
    for tenth in range(round(10 * seconds)):
        if tenth == 0:
            plant.add_force(node, (0.5, 0, 0))
        world.step(0.1)
        tips.append(plant.get_state()[0][node])
    return np.array(tips), time.process_time() - begin


def accuracy(mechanics: str = "rod", integrator: str = "bdf2", dt: float = 1 / 60) -> Case:
    """Compares with the same mechanics at a sixteenth of the step: rms error of the tip over its path [-], CPU [s]."""
    tips, spent = sway(mechanics, integrator, dt)
    right, _ = sway(mechanics, integrator, dt / 16)
    size = np.sqrt(np.mean(np.sum((right - right.mean(axis=0)) ** 2, axis=1)))
    return {"error": float(np.sqrt(np.mean(np.sum((tips - right) ** 2, axis=1))) / size), "cpu": spent}


def stiffness(factor: float = 1.0, mechanics: str = "rod") -> Case:
    """Scales the stem's stiffness: how far a steady wind of 3 m/s bends the tip [m]."""
    material = material_preset("stem")
    settings = {name: getattr(material, name) for name in type(material).__dataclass_fields__}
    model = Model("corn", organs={"stem": {**settings, "young": material.young * factor}})
    return bend(model, 3.0, mechanics)


def wind(speed: float = 5.0, mechanics: str = "rod") -> Case:
    """How far a steady wind bends the tip of corn [m]."""
    return bend(Model("corn"), speed, mechanics)


def bend(model: Model, speed: float, mechanics: str) -> Case:
    world = World(sleep_distance=0)
    plant = world.add_plant(model, mechanics=mechanics)
    before = plant.tip
    world.set_wind(velocity=(speed, 0, 0), turbulence=0, profile="uniform")
    tips = []
    for step in range(480):
        world.step(1 / 60)
        if step >= 240:
            tips.append(plant.tip - before)
    return {"bend": float(np.mean(tips, axis=0)[0]), "air": float(plant.air_force[0])}


def rollout(seed: int = 0, decisions: int = 40) -> Case:
    """One episode of frond.gym, the hand going straight to its target: sum of rewards, and whether it got there."""
    import pybullet as p

    from .gym import HAND, ReachThroughLeaves

    env = _kept_environment(ReachThroughLeaves)
    env.reset(seed=seed)
    total, info = 0.0, {}
    for _ in range(decisions):
        pose = p.calculateInverseKinematics(env.arm, HAND, env.target.tolist(), physicsClientId=env.client)
        action = np.clip((np.array(pose) - env.wanted) * 240 / env.steps / env.speed, -1, 1)
        _, reward, ended, cut, info = env.step(action)
        total += reward
        if ended or cut:
            break
    return {"reward": total, "reached": bool(info["reached"]), "broken": int(info["broken"])}


_environments: dict[Any, Any] = {}


def _kept_environment(kind: Any) -> Any:
    """Returns this process's environment, made once: an actor keeps it from episode to episode."""
    if kind not in _environments:
        _environments[kind] = kind()
    return _environments[kind]


SWEEPS: dict[str, tuple[Callable[..., Case], list[Case]]] = {
    "accuracy": (accuracy, [{"mechanics": m, "integrator": i, "dt": 1 / hertz} for m, i, hertz in itertools.product(
        ("rod", "tet_corotational"), ("implicit_euler", "bdf2", "sdirk2"), (30, 60, 120))]),
    "stiffness": (stiffness, [{"factor": factor} for factor in (1.0, 1.5, 2.0, 3.0, 4.0)]),
    "wind": (wind, [{"speed": float(speed)} for speed in range(0, 17, 2)]),
}


# ---- where the work is done ---------------------------------------------------------------------------------------


def start(address: str | None) -> Any:
    """Starts Ray on this machine, or joins the cluster of an address; returns the module."""
    try:
        import ray
    except ImportError:
        raise Error(Result.UNSUPPORTED, "Ray is not installed; pip install 'frond[sweep]', or use workers=0") from None
    if not ray.is_initialized():
        ray.init(address=address, log_to_driver=False, include_dashboard=False if address is None else None)
    return ray


def check_cases(cases: Any, workers: Any) -> None:
    if not isinstance(cases, (list, tuple)) or not all(isinstance(case, dict) for case in cases):
        raise refuse(f"cases is {cases!r}; pass a list of dicts of keyword arguments")
    if workers is not None and integer(workers, "workers") < 0:
        raise refuse(f"workers is {workers}; pass none below zero")


def run(function: Callable[..., Case], cases: Sequence[Case], address: str | None = None,
        workers: int | None = None) -> list[Case]:
    """Returns function(**case) of each case, in their order: as Ray tasks on this machine or the cluster of an address,
    or with workers=0 in this process. A task whose worker dies is done again, up to RETRIES times."""
    check_cases(cases, workers)
    if not callable(function):
        raise refuse(f"function is {function!r}; pass one that takes a case's items as keyword arguments")
    if workers == 0:
        return [function(**case) for case in cases]
    ray = start(address)
    task = ray.remote(max_retries=RETRIES, num_cpus=1)(function)
    return ray.get([task.remote(**case) for case in cases])


class Player:
    """An actor: a process that keeps an environment and plays episodes."""

    def play(self, **case: Any) -> Case:
        return rollout(**case)

    def process(self) -> int:
        import os

        return os.getpid()


def players(count: int, address: str | None = None) -> list[Any]:
    """Starts actors for play; one that dies is started anew, and its episode played again."""
    ray = start(address)
    actor = ray.remote(max_restarts=-1, max_task_retries=RETRIES, num_cpus=1)(Player)
    return [actor.remote() for _ in range(count)]


def play(cases: Sequence[Case], address: str | None = None, workers: int | None = None,
         actors: list[Any] | None = None) -> list[Case]:
    """Returns rollout(**case) of each case, in their order, shared out among actors; workers=0: in this process."""
    check_cases(cases, workers)
    if workers == 0:
        return [rollout(**case) for case in cases]
    ray = start(address)
    own = actors or players(workers or int(ray.cluster_resources().get("CPU", 1)), address)
    results = ray.get([own[number % len(own)].play.remote(**case) for number, case in enumerate(cases)])
    if actors is None:
        for actor in own:
            ray.kill(actor)
    return results


def write(cases: Iterable[Case], results: Iterable[Case], file: Any = None) -> None:
    """Writes cases and their results as CSV."""
    rows = [{**case, **result} for case, result in zip(cases, results)]
    if not rows:
        raise refuse("there are no cases to write")
    writer = csv.DictWriter(file or sys.stdout, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser("frond.sweep", description="Sweeps and rollouts; see help(frond.sweep).")
    parser.add_argument("what", choices=[*SWEEPS, "rollouts"])
    parser.add_argument("--address", help='a Ray cluster, "auto" for the one that runs here; default: this machine')
    parser.add_argument("--workers", type=int, help="0: in this process, without Ray")
    parser.add_argument("--seeds", type=int, default=16, help="episodes of rollouts")
    given = parser.parse_args(arguments)
    if given.what == "rollouts":
        cases: list[Case] = [{"seed": seed} for seed in range(given.seeds)]
        write(cases, play(cases, given.address, given.workers))
    else:
        function, cases = SWEEPS[given.what]
        write(cases, run(function, cases, given.address, given.workers))


__all__ = ["RETRIES", "SWEEPS", "Player", "accuracy", "play", "players", "rollout", "run", "start", "stiffness", "sway",
           "wind", "write"]

if __name__ == "__main__":
    main()
