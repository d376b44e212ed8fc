"""Plants in stock PyBullet."""

import os

import frond
import frond.pybullet
import numpy as np
import pybullet as p
import pybullet_data
import pytest

KINDS = {"default": 0, "discrete": p.RESET_USE_DISCRETE_DYNAMICS_WORLD, "deformable": p.RESET_USE_DEFORMABLE_WORLD}


@pytest.fixture(scope="module")
def corn():
    return frond.Model("corn")


@pytest.fixture
def client():
    number = p.connect(p.DIRECT)
    p.setAdditionalSearchPath(pybullet_data.getDataPath())
    p.setGravity(0, 0, -9.81)
    yield number
    if p.isConnected(number):
        p.disconnect(number)


@pytest.mark.parametrize("kind", KINDS)
def test_plants_push_and_are_pushed_in_every_kind_of_world(client, corn, kind):
    p.resetSimulation(KINDS[kind])
    p.setGravity(0, 0, -9.81)
    p.setPhysicsEngineParameter(numSubSteps=3)
    world = frond.pybullet.attach(client)
    plant = world.add_plant(corn, mechanics="rod")
    ball = p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05), basePosition=(0.25, 0, 0.8))
    p.resetBaseVelocity(ball, (-3, 0, 1))
    if kind == "deformable":
        cloth = p.loadSoftBody("cube.obj", basePosition=(3, 0, 0.5), scale=0.2, mass=1, useMassSpring=1)
        assert cloth >= 0
    impulse, seen = np.zeros(3), False
    for step in range(60):
        p.stepSimulation()
        impulse += world.wrench_on(ball).force / 240
        seen |= any(-1 in contact[1:3] for contact in p.getContactPoints(bodyA=ball) or p.getContactPoints())
    assert world.report.time == pytest.approx(60 / 240)
    assert seen and impulse[0] > 0.5
    speed = np.array(p.getBaseVelocity(ball)[0])
    assert 0.3 * (speed - [-3, 0, 1]) == pytest.approx(impulse - [0, 0, 0.3 * 9.81 * 60 / 240], abs=0.01)
    assert abs(plant.tip[0]) > 0.02


def test_a_resting_body_is_carried_by_its_weight(client):
    stem = frond.Model.from_stems([{"parent": -1, "begin": (0, 0, 0), "end": (0, 0.3, 0), "radius_begin": 0.03,
                                    "radius_end": 0.03}])
    world = frond.pybullet.attach(client, sleep_distance=0)
    p.setPhysicsEngineParameter(numSubSteps=2)
    plants = [world.add_plant(stem, position=(x, y, 0)) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    box = p.createMultiBody(0.5, p.createCollisionShape(p.GEOM_BOX, halfExtents=(0.3, 0.3, 0.02)),
                            basePosition=(0, 0, 0.36))
    for _ in range(1200):
        p.stepSimulation()
    weight = 0.5 * 9.81
    for mean in (True, False):
        assert world.wrench_on(box, mean=mean).force[2] == pytest.approx(weight, rel=1e-3)
    wrench = world.wrench_on(box, about=p.getBasePositionAndOrientation(box)[0])
    assert np.abs(wrench.moment).max() < 1e-3 * weight
    roots = sum(plant.root_force(mean=mean).force[2] for plant in plants for mean in (False,))
    assert roots == pytest.approx(weight + 4 * 9.81 * stem.info.mass, rel=0.01)


def test_the_root_holds_what_a_robot_pushes(client, corn):
    world = frond.pybullet.attach(client, sleep_distance=0)
    plant = world.add_plant(corn, position=(0, 0.12, 0), mechanics="rod")
    arm = p.loadURDF("kuka_iiwa/model.urdf", (-0.55, 0, 0), useFixedBase=True)
    joints = range(p.getNumJoints(arm))
    for step in range(1200):
        pose = p.calculateInverseKinematics(arm, 6, (0.05, -0.35 + 0.5 * min(step / 720, 1), 0.75))
        p.setJointMotorControlArray(arm, joints, p.POSITION_CONTROL, targetPositions=pose, forces=[200] * len(joints))
        p.stepSimulation()
        plant.root_force(mean=True)
    pushed = world.forces(plant=plant)["force"].sum(axis=0)
    assert np.linalg.norm(pushed) > 10
    held = plant.root_force(mean=True).force
    assert np.linalg.norm(held + pushed - [0, 0, corn.info.mass * 9.81]) < 0.01 * np.linalg.norm(held)
    table = world.forces(body=arm)
    assert set(table["link"]) <= set(joints) and {corn.organs[i].kind for i in table["organ"]} & {"stem", "blade"}
    total = sum(world.wrench_on(arm, link).force for link in joints)
    assert total == pytest.approx(-pushed)


GRIPPER = """<?xml version="1.0"?><robot name="gripper"><link name="palm"><inertial><mass value="1"/>
<inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>""" + "".join(f"""
<link name="{name}"><inertial><mass value="0.05"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/>
</inertial><collision><geometry><box size="0.02 0.06 0.1"/></geometry></collision></link><joint name="to_{name}"
type="prismatic"><parent link="palm"/><child link="{name}"/><origin xyz="{-0.04 * way} 0 0"/><axis xyz="{way} 0 0"/>
<limit lower="0" upper="0.039" effort="20" velocity="0.2"/></joint>""" for name, way in (("left", 1), ("right", -1))) + (
    "</robot>")


@pytest.mark.parametrize("step", [1 / 240, 1 / 60])
def test_light_fingers_hold_a_fruit(client, tmp_path, step):
    """Of 0.05 kg, with motors of 20 N: they sink into it by less than a millimetre and press it with that force."""
    (tmp_path / "gripper.urdf").write_text(GRIPPER)
    fruit = frond.Model.from_stems([{"parent": -1, "begin": (0, 0, 0), "end": (0, 0.25, 0), "radius_begin": 0.02,
                                     "radius_end": 0.02}])
    p.setTimeStep(step)
    p.setPhysicsEngineParameter(numSolverIterations=100)
    world = frond.pybullet.attach(client)
    world.add_plant(fruit, mechanics="rod", root_height=-1, position=(0, 0, 0.375))
    gripper = p.loadURDF(str(tmp_path / "gripper.urdf"), (0, 0, 0.5), useFixedBase=True)
    for finger in range(2):
        p.changeDynamics(gripper, finger, lateralFriction=1)
        p.setJointMotorControl2(gripper, finger, p.VELOCITY_CONTROL, targetVelocity=0.2, force=20)
    for i in range(int(3 / step)):
        p.stepSimulation()
        if i * step < 2:
            continue
        left, right = (p.getJointState(gripper, finger)[0] for finger in range(2))
        assert 0.038 < 0.06 - left - right < 0.0402
        assert world.wrench_on(gripper, 0).force[0] == pytest.approx(-20, rel=0.02)
        assert world.wrench_on(gripper, 1).force[0] == pytest.approx(20, rel=0.02)


def test_plants_are_held_by_links(client, corn):
    world = frond.pybullet.attach(client)
    plant = world.add_plant(corn, mechanics="rod")
    box = p.createMultiBody(0, p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.05] * 3), basePosition=(0.4, 0, 1))
    bond = plant.bond_body((0.4, 0, 1), box)
    for step in range(240):
        p.resetBasePositionAndOrientation(box, (0.4 + 0.0005 * step, 0, 1), (0, 0, 0, 1))
        p.stepSimulation()
        mean = bond.force(mean=True)
    assert bond.force()[0] > 0.05 and mean[0] > 0.05
    p.removeBody(box)
    p.stepSimulation()
    assert np.allclose(bond.force(), 0)
    with pytest.raises(frond.Error, match="no body 99"):
        plant.bond_body((0, 0, 1), 99)


def test_resets_removals_and_disconnects_come_in_any_order(corn):
    random = np.random.default_rng(1)
    clients, worlds, plants = [], {}, []
    for step in range(300):
        what = random.integers(8)
        if what == 0 or not clients:
            if len(clients) < 3:
                clients.append(p.connect(p.DIRECT))
            continue
        client = clients[random.integers(len(clients))]
        if what == 1:
            p.disconnect(client)
            clients.remove(client)
            worlds.pop(client, None)
        elif what == 2:
            p.resetSimulation(int(random.integers(3)), physicsClientId=client)
            if client in worlds:
                assert not worlds.pop(client).is_valid
        elif what == 3:
            worlds[client] = frond.pybullet.attach(client)
        elif what == 4 and client in worlds:
            plants.append(worlds[client].add_plant(corn, mechanics="rod", starts_asleep=bool(step % 2)))
        elif what == 5 and plants:
            plants.pop(random.integers(len(plants))).destroy()
        elif what == 6:
            frond.pybullet.detach(client)
            worlds.pop(client, None)
        else:
            p.createMultiBody(1, p.createCollisionShape(p.GEOM_SPHERE, radius=0.1, physicsClientId=client),
                              basePosition=(0, 0, 1), physicsClientId=client)
            p.stepSimulation(physicsClientId=client)
            if client in worlds:
                worlds[client].forces()
        for plant in plants:
            try:
                plant.tip
            except frond.Error as error:
                assert "stale" in str(error)
    for client in clients:
        p.disconnect(client)


def test_two_clients_have_plants_of_their_own(corn):
    first, second = p.connect(p.DIRECT), p.connect(p.DIRECT)
    worlds = [frond.pybullet.attach(client) for client in (first, second)]
    plants = [world.add_plant(corn) for world in worlds]
    assert frond.pybullet.attach(first) is worlds[0]
    p.stepSimulation(physicsClientId=second)
    assert worlds[0].report.time == 0 and worlds[1].report.time > 0
    p.disconnect(first)
    assert not plants[0].is_valid and plants[1].is_valid
    p.stepSimulation(physicsClientId=second)
    p.disconnect(second)
    assert not plants[1].is_valid


def test_states_are_saved_with_plants(client, corn):
    world = frond.pybullet.attach(client)
    plant = world.add_plant(corn, mechanics="rod")
    ball = p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05), basePosition=(0.25, 0, 0.8))
    p.resetBaseVelocity(ball, (-3, 0, 1))

    def run():
        for _ in range(60):
            p.stepSimulation()
        return np.concatenate([plant.get_state()[0].ravel(), p.getBasePositionAndOrientation(ball)[0]])

    run()
    saved = frond.pybullet.save(world)
    ends = [run()]
    for _ in range(2):
        frond.pybullet.restore(world, saved)
        ends.append(run())
    differences = [np.abs(end - ends[0]).max() for end in ends[1:]] + [np.abs(ends[2] - ends[1]).max()]
    print("replays differ from the first run, and from each other, by [m]", differences)
    assert max(differences) < 1e-6
    frond.pybullet.remove_saved(world, saved)


def test_the_camera_sees_bodies_plants_and_organs(client, corn):
    world = frond.pybullet.attach(client)
    world.add_plant(corn)
    wall = p.createMultiBody(0, p.createCollisionShape(p.GEOM_BOX, halfExtents=(2, 0.1, 3)), basePosition=(0, 1, 0))
    block = p.createMultiBody(0, p.createCollisionShape(p.GEOM_BOX, halfExtents=(0.5, 0.1, 0.3)),
                              basePosition=(0, -1, 0.9))
    view = p.computeViewMatrix((0, -4, 1.1), (0, 0, 1.1), (0, 0, 1))
    projection = p.computeProjectionMatrixFOV(40, 1, 0.1, 30)
    image = frond.pybullet.camera_image(world, 200, 200, view, projection)
    assert image.bodies[100, 5] == wall and image.distance[100, 5] == pytest.approx(4.9, rel=0.01)
    assert image.bodies[115, 100] == block and image.plants[115, 100] == -1  # before the plant
    plant = image.plants == 0
    assert plant.sum() > 500 and (image.bodies[plant] == -1).all() and (image.organs[plant] >= 0).all()
    assert abs(np.median(image.distance[plant]) - 4) < 0.3
    stem = image.organs == [organ.name for organ in corn.organs].index("stem")
    assert abs(np.nonzero(stem)[1].mean() - 100) < 4
    with pytest.raises(frond.Error, match="perspective"):
        frond.pybullet.camera_image(world, 10, 10, view, [1] * 16)


def test_frond_draws_bodies_where_pybullet_does(client, corn):
    p.loadURDF("plane.urdf")
    bodies = [p.loadURDF("franka_panda/panda.urdf", (-0.5, 0, 0), useFixedBase=True),
              p.loadURDF("husky/husky.urdf", (0.7, -0.9, 0.2)), p.loadURDF("r2d2.urdf", (1.3, 1.2, 0.5)),
              p.loadURDF("duck_vhacd.urdf", (0, -1.2, 0), globalScaling=5),
              p.createMultiBody(0, p.createCollisionShape(p.GEOM_CAPSULE, radius=0.1, height=0.5),
                                basePosition=(-1.2, 0.3, 0.5), baseOrientation=(0.5, 0.5, 0.5, 0.5))]
    world = frond.pybullet.attach(client)
    world.add_plant(corn, position=(0, 0.3, 0))
    camera = (400, 300, p.computeViewMatrix((1.9, -2.6, 1.7), (0, 0.2, 0.7), (0, 0, 1)),
              p.computeProjectionMatrixFOV(55, 4 / 3, 0.1, 20))
    ours = frond.pybullet.camera_image(world, *camera)
    theirs = frond.pybullet.camera_image(world, *camera, draw_bodies=False)
    for body in bodies:
        both, either = (ours.bodies == body) & (theirs.bodies == body), (ours.bodies == body) | (theirs.bodies == body)
        assert both.sum() > 0.8 * either.sum() > 80, body  # PyBullet draws round shapes with corners
        assert np.abs(ours.distance - theirs.distance)[both].mean() < 0.02, body
    assert (ours.plants == theirs.plants).mean() > 0.995
    linked = frond.pybullet.camera_image(world, *camera, flags=p.ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX).bodies
    is_arm = ours.bodies == bodies[0]
    assert (linked[is_arm] & 0xffffff == bodies[0]).all() and len(np.unique(linked[is_arm] >> 24)) > 5

    # PyBullet tells no triangles of this one.
    sheet = p.createMultiBody(0, -1, p.createVisualShape(
        p.GEOM_MESH, vertices=[(-1, 0, 0), (1, 0, 0), (0, 0, 2)], indices=[0, 1, 2, 0, 2, 1]),
        basePosition=(0, -0.5, 0))
    image = frond.pybullet.camera_image(world, *camera)
    assert (image.bodies == sheet).sum() > 1000 and (image.bodies == bodies[1]).sum() > 1000
    assert (image.plants >= 0).sum() < 0.8 * (ours.plants >= 0).sum()  # it stands before the plant


def test_wrong_use_is_refused_with_a_remedy(client, corn):
    for call in (lambda: frond.pybullet.attach(77), lambda: frond.pybullet.attach("client"),
                 lambda: frond.pybullet.PyBulletWorld(), lambda: frond.pybullet.attach(client, nothing=3)):
        with pytest.raises(frond.Error):
            call()
    world = frond.pybullet.attach(client)
    for call in (lambda: world.step(0.1), lambda: frond.pybullet.attach(client, sleep_distance=0),
                 lambda: world.add_plant(corn, rotation=(0, 0)), lambda: world.add_plant(corn, position=3)):
        with pytest.raises(frond.Error):
            call()
    world.destroy()
    assert frond.pybullet.attach(client).is_valid


# PyBullet itself crashes when it loads a plugin again after it was unloaded, of whatever kind.
def test_the_plugin_may_be_unloaded_for_good(client, corn):
    world = frond.pybullet.attach(client)
    plant = world.add_plant(corn)
    p.stepSimulation()
    p.unloadPlugin(p.loadPlugin(frond._lib.HOST_PATH, "_frond"))
    assert not world.is_valid and not plant.is_valid
    p.stepSimulation()


@pytest.mark.parametrize("end", ["reset", "remove", "disconnect"])
@pytest.mark.parametrize("shape", ["cloth", "solid"])
def test_soft_bodies_share_the_world(client, corn, tmp_path, shape, end):
    p.resetSimulation(p.RESET_USE_DEFORMABLE_WORLD)
    p.setGravity(0, 0, -9.81)
    world = frond.pybullet.attach(client)
    plants = [world.add_plant(corn, mechanics=mechanics, position=(x, 0, 0))
              for x, mechanics in ((0, "rod"), (2, "tet_corotational"))]
    if shape == "cloth":
        body = p.loadSoftBody("cloth_z_up.obj", basePosition=(0, 0, 2.4), scale=0.3, mass=0.1, useMassSpring=1,
                              springElasticStiffness=40, springDampingStiffness=0.1, collisionMargin=0.02)
    else:
        body = p.loadSoftBody("cube.obj", basePosition=(0, 0, 2.4), scale=0.1, mass=0.3, useMassSpring=1)
    ball = p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05), basePosition=(0.25, 0, 0.8))
    p.resetBaseVelocity(ball, (-3, 0, 1))
    push = np.zeros(3)
    for _ in range(90):
        p.stepSimulation()
        push += world.wrench_on(ball).force / 240
    height = np.array(p.getMeshData(body)[1])[:, 2].mean()
    assert height < 2.2 and np.isfinite(height) and push[0] > 0.5
    assert all(np.isfinite(plant.get_state()).all() for plant in plants)
    if end == "reset":
        p.resetSimulation(p.RESET_USE_DEFORMABLE_WORLD)
    elif end == "remove":
        p.removeBody(body)
        p.stepSimulation()
        plants.pop().destroy()
        p.stepSimulation()
        world.destroy()
        p.stepSimulation()
    else:
        p.disconnect()
    assert not any(plant.is_valid for plant in plants)


@pytest.mark.parametrize("gravity", [(0, 0, -9.81), (0, -9.81, 0), (0, 0, 0), (0, 9.81, 0)])
def test_plants_stand_against_gravity(client, corn, gravity):
    p.setGravity(*gravity)
    world = frond.pybullet.attach(client)
    plant = world.add_plant(corn)
    up = -np.array(gravity) / 9.81 if any(gravity) else np.array([0, 0, 1])
    assert (plant.surface.positions @ up).max() > 2 and abs((plant.surface.positions @ up).min()) < 0.1


@pytest.mark.skipif(not os.environ.get("DISPLAY"), reason="no display; run it under xvfb-run")
def test_the_window_and_real_time(corn):
    client = p.connect(p.GUI)
    try:
        p.setGravity(0, 0, -9.81)
        world = frond.pybullet.attach(client)
        plant = world.add_plant(corn, mechanics="rod")
        p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05), basePosition=(0.1, 0, 2.5))
        drawing = frond.pybullet.Drawing(world)
        for _ in range(10):
            p.stepSimulation()
            drawing.update()
        assert world.report.time == pytest.approx(10 / 240)
        p.setRealTimeSimulation(1)
        for number in range(30):
            other = world.add_plant(corn, position=(1, 0, 0), mechanics="rod")
            assert plant.get_state()[0].shape and other.tip[2] > 2 and world.forces() is not None
            other.destroy()
        drawing.update()
        assert world.report.time > 11 / 240
        p.resetSimulation()
        assert not plant.is_valid and not world.is_valid
        world = frond.pybullet.attach(client)
        world.add_plant(corn)
        p.setRealTimeSimulation(1)
    finally:
        p.disconnect(client)
    assert not world.is_valid
