"""Resets, connections and removals in any order, many of them: prints the memory, which is to stay flat.

    soak.py [RESETS [CONNECTIONS]]     10000 and 200, if not given
"""

import gc
import os
import sys

import frond.pybullet
import numpy as np
import pybullet as p

RESETS = int(sys.argv[1]) if len(sys.argv) > 1 else 10000
CONNECTIONS = int(sys.argv[2]) if len(sys.argv) > 2 else 200


def megabytes():
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def episode(client, model, random):
    """Plants, a bond, a grab, a fragment, a robot of Frond's and a ball, a few steps; some are removed by hand."""
    p.setGravity(0, 0, -9.81, physicsClientId=client)
    world = frond.pybullet.attach(client)
    plants = [world.add_plant(model, mechanics=("rod", "tet_corotational")[random.integers(2)], position=(i, 0, 0))
              for i in range(random.integers(1, 3))]
    ball = p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05, physicsClientId=client),
                             basePosition=(0, 0.02, 0.7), physicsClientId=client)
    grab = plants[0].grab((0, 0, 0.5), 5)
    if random.integers(2):
        plants[0].bond_body((0, 0, 0.5), ball)
    if random.integers(2):
        plants[-1].break_at(plants[-1].capsule_count - 1)
    if random.integers(3) == 0:
        world.add_robot("arm", position=(3, 0, 0))
    for _ in range(3):
        p.stepSimulation(physicsClientId=client)
        world.forces()
    order = random.integers(5)
    if order == 0:
        plants[0].destroy()
    elif order == 1:
        grab.destroy()
        p.removeBody(ball, physicsClientId=client)
    elif order == 2:
        world.destroy()
    return world, plants


def main():
    model = frond.Model.from_stems([
        {"parent": -1, "begin": (0, 0, 0), "end": (0, 0.3, 0), "radius_begin": 0.02, "radius_end": 0.015},
        {"parent": 0, "begin": (0, 0.3, 0), "end": (0, 0.6, 0), "radius_begin": 0.015, "radius_end": 0.01}])
    random = np.random.default_rng(2)
    kept = []
    client = p.connect(p.DIRECT)
    for number in range(RESETS):
        if number % max(RESETS // 20, 1) == 0:
            print(f"{number} resets: {megabytes():.1f} MB", flush=True)
        kept = (kept + [episode(client, model, random)])[-3:]
        p.resetSimulation(physicsClientId=client)
        assert not any(plant.is_valid for _, plants in kept for plant in plants)
    p.disconnect(client)
    after_resets = megabytes()
    print(f"{RESETS} resets: {after_resets:.1f} MB")
    for number in range(CONNECTIONS):
        if number % max(CONNECTIONS // 5, 1) == 0:
            print(f"{number} connections: {megabytes():.1f} MB", flush=True)
        clients = [p.connect(p.DIRECT) for _ in range(2)]
        for one in clients:
            episode(one, model, random)
        for one in random.permutation(clients):
            p.disconnect(int(one))
    print(f"{CONNECTIONS} connections: {megabytes():.1f} MB")


if __name__ == "__main__":
    main()
