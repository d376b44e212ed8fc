"""A Gymnasium environment: a robot arm reaches through leaves.

    env = frond.gym.ReachThroughLeaves()
    envs = gymnasium.make_vec("frond/ReachThroughLeaves-v0", num_envs=4, vectorization_mode="async")

A KUKA arm of seven axes stands before three corn plants and has to bring its hand to a target among them without
breaking what it pushes aside.

Action        changes of the seven joints' targets, -1 .. 1 times `speed` [rad/s]
Observation   joint positions [rad], joint velocities [rad/s], the hand's position and the target's from there [m], the
              force of all plants on the hand and its sum over the arm [N], their largest strain over what breaks them
              [-], each axis clipped by the observation space
Reward        how much nearer the hand came [m], less what it strained leaves and stems; 10 for the target, -10 and the
              end for anything that breaks
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import pybullet as p
import pybullet_data

from . import pybullet as frond_pybullet
from ._generated import Effect
from ._lib import integer, numbers, real, refuse, row_of
from .model import Model

HAND = 6
JOINTS = 7
READY = (0.0, -0.4, 0.0, -1.7, 0.0, 1.0, 0.0)


def finite(array: np.ndarray, name: str) -> np.ndarray:
    if not np.isfinite(array).all():
        raise refuse(f"{name} is {array}; pass finite numbers")
    return array


class ReachThroughLeaves(gymnasium.Env):
    """The environment above. `mechanics` of the plants; `steps` of 1/240 s a decision; `limit` decisions an episode."""

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, mechanics: str = "rod", speed: float = 1.0, steps: int = 12, limit: int = 200,
                 render_mode: str | None = None) -> None:
        row_of(mechanics, "frond_mechanics", "mechanics")
        if not 0 < real(speed, "speed") < np.inf:
            raise refuse(f"speed is {speed}; pass one above zero [rad/s]")
        for name, count in (("steps", steps), ("limit", limit)):
            if integer(count, name) < 1:
                raise refuse(f"{name} is {count}; pass one at least")
        if render_mode is not None and render_mode not in self.metadata["render_modes"]:
            raise refuse(f"render_mode is {render_mode!r}; pass None or 'rgb_array'")
        self.mechanics, self.speed, self.steps, self.limit = mechanics, speed, steps, limit
        self.render_mode = render_mode
        self.decisions = -1  # until the first reset
        reach = np.array([4.0] * 7 + [20.0] * 7 + [2.0] * 6 + [1000.0] * 4 + [10.0], np.float32)
        self.reach = reach
        self.observation_space = gymnasium.spaces.Box(-reach, reach, dtype=np.float32)
        self.action_space = gymnasium.spaces.Box(-1, 1, (JOINTS,), np.float32)
        self.client = p.connect(p.DIRECT)
        self.model = Model("corn")
        organs = self.model.organs
        breaking = [organ.material.strength / organ.material.young if organ.material.strength else np.inf
                    for organ in organs]
        self.breaking = np.array([breaking[organ] if organ >= 0 else np.inf for organ in self.model.capsule_organs])
        self._build()

    def _build(self) -> None:
        """Makes the scene anew, so that each episode repeats to the bit."""
        p.resetSimulation(physicsClientId=self.client)
        p.setGravity(0, 0, -9.81, physicsClientId=self.client)
        self.arm = p.loadURDF(pybullet_data.getDataPath() + "/kuka_iiwa/model.urdf", (-0.6, 0, 0), useFixedBase=True,
                              physicsClientId=self.client)
        self.world = frond_pybullet.attach(self.client)
        effects = Effect.DEFAULT | Effect.BREAKING
        self.plants = [self.world.add_plant(self.model, mechanics=self.mechanics, effects=effects, position=(x, y, 0))
                       for x, y in ((0.0, -0.3), (0.05, 0.0), (0.0, 0.3))]
        self.at_rest = [np.nan_to_num(plant.strains) for plant in self.plants]
        self.target = np.zeros(3)

    def _check_open(self) -> None:
        if not p.isConnected(self.client):
            raise refuse("the environment is closed; make another one")

    # ---- the arm

    def _state(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        states = p.getJointStates(self.arm, range(JOINTS), physicsClientId=self.client)
        hand = p.getLinkState(self.arm, HAND, computeForwardKinematics=True, physicsClientId=self.client)[4]
        return np.array([s[0] for s in states]), np.array([s[1] for s in states]), np.array(hand)

    def _strain(self) -> float:
        """Returns the largest strain of a plant over what breaks it, beyond that at rest [-]."""
        return max(float(np.max((plant.strains - rest) / self.breaking))
                   for plant, rest in zip(self.plants, self.at_rest))

    def _observe(self) -> np.ndarray:
        positions, velocities, hand = self._state()
        table = self.world.forces(body=self.arm)
        on_hand = -table["force"][table["link"] == HAND].sum(axis=0)
        total = np.linalg.norm(table["force"].sum(axis=0))
        seen = np.concatenate([positions, velocities, hand, self.target - hand, on_hand, [total, self._strain()]])
        return np.clip(seen, -self.reach, self.reach).astype(np.float32)

    # ---- Gymnasium's

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[np.ndarray, dict]:
        """Begins an episode: plants whole and at rest, the arm folded, a target drawn from `seed`; or
        options={"target": xyz}."""
        self._check_open()
        target = (options or {}).get("target")
        if target is not None:
            target = finite(numbers(target, "target", (3,)), "target")
        super().reset(seed=seed)
        self._build()
        for joint, position in enumerate(READY):
            p.resetJointState(self.arm, joint, position, physicsClientId=self.client)
        self.wanted = np.array(READY)
        drawn = self.np_random.uniform((0.05, -0.25, 0.5), (0.2, 0.25, 0.9))
        self.target = drawn if target is None else target
        self.decisions = 0
        self.distance = float(np.linalg.norm(self.target - self._state()[2]))
        return self._observe(), {}

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict]:
        """Moves the joints' targets and steps PyBullet and the plants."""
        self._check_open()
        if self.decisions < 0:
            raise refuse("no episode has begun; call reset first")
        change = np.clip(finite(numbers(action, "action", (JOINTS,)), "action"), -1, 1)
        self.wanted = np.clip(self.wanted + change * self.speed * self.steps / 240, -2.9, 2.9)
        p.setJointMotorControlArray(self.arm, range(JOINTS), p.POSITION_CONTROL, targetPositions=self.wanted.tolist(),
                                    forces=[200.0] * JOINTS, physicsClientId=self.client)
        for _ in range(self.steps):
            p.stepSimulation(physicsClientId=self.client)
        self.decisions += 1
        seen = self._observe()
        distance = float(np.linalg.norm(self.target - self._state()[2]))
        broken = sum(len(plant.fragments) for plant in self.plants)
        reached = distance < 0.05
        reward = self.distance - distance - 0.01 * max(float(seen[-1]), 0) + 10 * reached - 10 * (broken > 0)
        self.distance = distance
        info = {"distance": distance, "broken": broken, "reached": reached}
        return seen, float(reward), reached or broken > 0, self.decisions >= self.limit, info

    def render(self) -> np.ndarray | None:
        """Returns a picture of 480 x 360 pixels."""
        if self.render_mode != "rgb_array":
            return None
        view = p.computeViewMatrixFromYawPitchRoll((-0.1, 0, 0.9), 2.8, 40, -15, 0, 2)
        projection = p.computeProjectionMatrixFOV(50, 4 / 3, 0.05, 20)
        return frond_pybullet.camera_image(self.world, 480, 360, view, projection).rgb

    def save(self) -> tuple[Any, ...]:
        """Returns the state of arm and plants, for restore."""
        return (frond_pybullet.save(self.world), self.wanted.copy(), self.target.copy(), self.decisions, self.distance)

    def restore(self, saved: tuple[Any, ...]) -> None:
        """Goes back to a state of save. Plants that have broken since cannot go back: reset them."""
        self._check_open()
        if not isinstance(saved, tuple) or len(saved) != 5:
            raise refuse(f"saved is {saved!r}; pass what save gave")
        frond_pybullet.restore(self.world, saved[0])
        self.wanted, self.target, self.decisions, self.distance = saved[1].copy(), saved[2].copy(), *saved[3:]

    def close(self) -> None:
        """Disconnects from PyBullet."""
        if p.isConnected(self.client):
            p.disconnect(self.client)


gymnasium.register("frond/ReachThroughLeaves-v0", entry_point="frond.gym:ReachThroughLeaves")

__all__ = ["ReachThroughLeaves"]
