"""Steps a second of a KUKA arm that stirs a corn plant, as rods and as a cage, and without the plant; on one core."""

import sys
import time

import frond
import frond.pybullet
import pybullet as p
import pybullet_data

STEPS = int(sys.argv[1]) if len(sys.argv) > 1 else 4000


def steps_a_second(mechanics):
    client = p.connect(p.DIRECT)
    p.setAdditionalSearchPath(pybullet_data.getDataPath())
    p.setGravity(0, 0, -9.81)
    arm = p.loadURDF("kuka_iiwa/model.urdf", (-0.55, 0, 0), useFixedBase=True)
    touched = 0
    if mechanics:
        world = frond.pybullet.attach(client)
        plant = world.add_plant("corn", position=(0, 0.12, 0), mechanics=mechanics)
    joints = range(p.getNumJoints(arm))
    poses = [p.calculateInverseKinematics(arm, 6, (0.05, -0.35 + 0.45 * abs(1 - i / 20), 0.75)) for i in range(40)]
    spent = 0.0
    for step in range(STEPS):
        if step % 24 == 0:
            pose = poses[step // 24 % len(poses)]
            p.setJointMotorControlArray(arm, joints, p.POSITION_CONTROL, targetPositions=pose,
                                        forces=[200] * len(joints))
        begin = time.process_time()
        p.stepSimulation()
        spent += time.process_time() - begin
        if mechanics and step % 24 == 0:
            touched += len(plant.contacts) > 0
    p.disconnect(client)
    return STEPS / spent, touched * 24 / STEPS


alone, _ = steps_a_second(None)
print(f"the arm alone: {alone:.0f} steps/s")
for name in ("rod", "tet_corotational"):
    speed, share = steps_a_second(name)
    print(f"with corn as {name}: {speed:.0f} steps/s, touched in {100 * share:.0f} % of them")
