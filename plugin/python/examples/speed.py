"""Steps a second of an arm of seven axes that stirs a corn plant, as rods and as a cage, and without it; on one core.

    speed.py [URDF [HAND [ROUNDS]]]     kuka_iiwa/model.urdf, its link 6 and 5 rounds of 960 steps, if not given
"""

import statistics
import sys
import time

import frond
import frond.pybullet
import pybullet as p
import pybullet_data

URDF = sys.argv[1] if len(sys.argv) > 1 else "kuka_iiwa/model.urdf"
HAND = int(sys.argv[2]) if len(sys.argv) > 2 else 6
ROUNDS = int(sys.argv[3]) if len(sys.argv) > 3 else 5
POSES, HELD, JOINTS = 40, 24, range(7)


def steps_a_second(mechanics):
    """Returns steps per CPU second of each round, and in which share of decisions something touched the plant."""
    client = p.connect(p.DIRECT)
    p.setAdditionalSearchPath(pybullet_data.getDataPath())
    p.setGravity(0, 0, -9.81)
    arm = p.loadURDF(URDF, (-0.55, 0, 0), useFixedBase=True)
    if mechanics:
        plant = frond.pybullet.attach(client).add_plant("corn", position=(0, 0.12, 0), mechanics=mechanics)
    poses = [p.calculateInverseKinematics(arm, HAND, (0.05, -0.35 + 0.45 * abs(1 - i / 20), 0.75))[:7]
             for i in range(POSES)]
    speeds, touched = [], 0
    for _ in range(ROUNDS):
        spent = 0.0
        for pose in poses:
            p.setJointMotorControlArray(arm, JOINTS, p.POSITION_CONTROL, targetPositions=pose, forces=[200] * 7)
            begin = time.process_time()
            for _ in range(HELD):
                p.stepSimulation()
            spent += time.process_time() - begin
            touched += bool(mechanics) and any(contact.impulse.any() for contact in plant.contacts)
        speeds.append(POSES * HELD / spent)
    p.disconnect(client)
    return speeds, touched / (ROUNDS * POSES)


print("steps per CPU second: best and median round; share of the time in which the arm pushes the plant")
for name in (None, "rod", "tet_corotational"):
    found, share = steps_a_second(name)
    print(f"{name or 'no plant':20}{max(found):8.0f}{statistics.median(found):8.0f}{100 * share:8.0f} %")
