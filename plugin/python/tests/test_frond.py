"""Worlds, models and plants of Frond's own."""

import gc
import math

import frond
import frond.picture
import numpy as np
import pytest

STEMS = [{"parent": -1, "begin": (0, 0, 0), "end": (0, 0.3, 0), "radius_begin": 0.02, "radius_end": 0.015},
         {"parent": 0, "begin": (0, 0.3, 0), "end": (0, 0.6, 0), "radius_begin": 0.015, "radius_end": 0.01}]


@pytest.fixture(scope="module")
def corn():
    return frond.Model("corn")


@pytest.fixture(scope="module")
def stem():
    return frond.Model.from_stems(STEMS)


def test_a_plant_stands_and_its_root_holds_its_weight(corn):
    with frond.World() as world:
        plant = world.add_plant(corn, mechanics="rod")
        for _ in range(30):
            world.step(1 / 60)
        weight = corn.info.mass * 9.81
        assert plant.tip[1] > 2 and world.report.plant_count == 1
        assert abs(plant.root_force().force[1] / weight - 1) < 0.01
        assert plant == world.plants[0] and len({plant, world.plants[0]}) == 1
    assert not world.is_valid and not plant.is_valid


def test_models_come_from_all_sources(corn, tmp_path):
    nodes, tets = corn.cage
    assert nodes.shape[1] == 3 and tets.shape[1] == 4 and not nodes.flags.writeable
    box = np.array([[x, y, z] for x in (0, .1) for y in (0, 1) for z in (0, .1)], np.float32)
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6),
             (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    for model in (frond.Model.from_triangles(box, faces), frond.Model.from_stems(STEMS),
                  frond.Model.from_tets(box[[0, 2, 1, 4]], [[0, 1, 2, 3]], scale=1, up=(0, 1, 0))):
        assert model.info.mass > 0 and len(model.organs) == model.info.organ_count
        assert len(model.capsule_organs) == model.info.capsule_count == (model.chain.parents >= 0).sum()
    corn.write_urdf(tmp_path / "corn.urdf")
    again = frond.Model(tmp_path / "corn.urdf").info
    assert again.chain_length == pytest.approx(corn.info.chain_length)
    assert again.mass == pytest.approx(corn.info.mass, rel=0.01) and again.capsule_count == corn.info.capsule_count
    corn.save(tmp_path / "corn.frond")
    cooked = frond.Model(tmp_path / "corn.frond")
    assert cooked.to_bytes() == corn.to_bytes() == (tmp_path / "corn.frond").read_bytes()
    assert frond.Model.from_bytes(corn.to_bytes()).info.mass == corn.info.mass == cooked.info.mass
    assert len(corn.textures) == corn.info.texture_count and corn.textures[0].bytes[:4] == b"\x89PNG"
    assert {part.kind for part in corn.parts} >= {"stem", "blade"}
    organs = corn.organs
    assert all(organs[organ.parent].kind == "stem" for organ in organs if organ.kind == "blade")
    assert any(organ.parent == -1 for organ in organs)


def test_materials_are_given_by_name_dict_or_object():
    soft = frond.material_preset("blade")
    for material in ("blade", soft, {"young": soft.young, "density": 500}):
        model = frond.Model.from_stems(STEMS, organs={"stem": material})
        assert model.organs[0].material.young == soft.young
    assert frond.default_material() == frond.material_preset("stem")


def test_organs_are_corrected(tmp_path):
    names = {organ.name: organ.kind for organ in frond.Model("corn").organs}
    assert names["silk_1"] == "flower"
    corrected = frond.Model("corn", corrections={"silk_1": {"leave_out": True}, "tassel": {"kind": "flower"}})
    organs = {organ.name: organ.kind for organ in corrected.organs}
    assert "silk_1" not in organs and organs["tassel"] == "flower"
    for wrong in ({"silk_1": {"kind": "antenna"}}, {"silk_1": {"colour": 1}}, {"nothing": {"leave_out": True}}, 3):
        with pytest.raises(frond.Error):
            frond.Model("corn", corrections=wrong)
    with pytest.raises(frond.Error):
        frond.Model("corn", corrections_file=tmp_path / "missing.frond.json")


def test_arrays_of_a_model_outlive_it():
    model = frond.Model.from_stems(STEMS)
    cage, chain, expected = model.cage, model.chain, model.cage.nodes.copy()
    model.destroy()
    assert not model.is_valid
    with pytest.raises(frond.Error, match="stale"):
        model.info
    others = [frond.Model.from_stems(STEMS) for _ in range(5)]
    gc.collect()
    assert np.array_equal(cage.nodes, expected) and chain.radii.max() == 0.02
    del others, model


def test_state_surface_and_forces_are_arrays(stem):
    world = frond.World(sleep_distance=0)
    plant = world.add_plant(stem)
    x, v = plant.get_state()
    assert x.shape == v.shape == (plant.node_count, 3)
    plant.set_state(velocities=v + [0.1, 0, 0])
    plant.add_force(plant.node_count - 1, (0.1, 0, 0))
    surface = plant.surface
    before = surface.positions.copy()
    world.step(0.1)
    assert np.array_equal(surface.positions, before) and not np.array_equal(plant.surface.positions, before)
    assert plant.previous_positions.shape == before.shape
    assert plant.strains.shape == (plant.capsule_count,) and plant.momentum.shape == (3,)
    assert plant.energy.kinetic > 0 and len(plant.capsules) == plant.capsule_count
    assert plant.definition.mechanics == frond.Mechanics.TET_COROTATIONAL
    plant.set_mechanics("rod")
    plant.set_integrator(frond.Integrator.SDIRK2)
    assert plant.definition.integrator == frond.Integrator.SDIRK2
    states = plant.chain_state
    assert len(states) == plant.chain_node_count and states[0].rotation.shape == (4,)
    plant.set_chain_state(states)
    plant.add_chain_load(plant.chain_node_count - 1, moment=(0, 0, 1e-3))
    plant.add_distributed_load(0, (0.1, 0, 0))
    plant.set_support(0, "across_axis", axis=(0, 0, 2))
    world.step(0.1)
    held = plant.support_force(0)
    assert held.force[1] > 0 and abs(held.moment[2]) < 1e-12
    with pytest.raises(frond.Error, match="axis"):
        plant.set_support(0, frond.HeldTurns.ABOUT_AXIS, axis=(0, 0, 0))
    plant.remove_support(0)
    with pytest.raises(frond.Error, match="no support"):
        plant.support_force(0)
    assert len(plant.section_forces) == plant.capsule_count and plant.section_forces[0].tension < 0
    plant.set_plastic(plant.get_plastic())
    plant.pin(plant.node_count - 1)
    plant.move_pin(plant.node_count - 1, x[-1] + [0.01, 0, 0])
    plant.unpin(plant.node_count - 1)
    plant.set_transform((1, 0, 0))
    plant.reset()


def test_forces_are_means_over_a_call_and_of_its_last_substep(stem):
    world = frond.World(max_substep=1 / 240)
    plant = world.add_plant(stem)
    ball = world.add_rigid(mass=0.2, size=(0.04, 0, 0), position=(-0.2, 0.5, 0), velocity=(2, 0, 0))
    assert len(world.forces()) == 0
    impulse, total = np.zeros(3), np.zeros(3)
    before = ball.state.velocity
    for _ in range(30):
        world.step(1 / 60)
        total += world.forces()["force"].sum(axis=0) / 60
        last = world.forces(mean=False)
        assert np.allclose(sorted(last["force"][:, 0]), sorted(c.impulse[0] * 240 for c in plant.contacts))
    impulse = 0.2 * (before - ball.state.velocity + [0, -9.81 * 0.5, 0])
    assert abs(total[0]) > 0.1 and np.allclose(total, impulse, atol=1e-9)
    table = world.forces()
    assert set(table["organ"]) <= {0, -1} and (table["object"] == ball.body).all()


def test_bonds_grabs_events_rays_and_breaking(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    assert world.take_events() == []
    grab = plant.grab((0, 0.6, 0), 20)
    grab.move((0.1, 0.6, 0))
    anchor = world.add_rigid(mass=0, position=(0, 3, 0))
    bond = plant.bond((0, 0.3, 0), anchor)
    world.step(0.1)
    assert grab.force[0] > 0 and np.allclose(grab.target, (0.1, 0.6, 0)) and bond.force().shape == (3,)
    assert bond.force(mean=True).shape == (3,) and plant.root_force(mean=True).force.shape == (3,)
    hit = world.cast_ray((-1, 0.2, 0), (1, 0, 0), 5)
    assert hit.plant == plant and abs(hit.distance - 1) < 0.05
    assert world.cast_ray((-1, 5, 0), (1, 0, 0), 5) is None
    for held in (grab, bond):
        held.destroy()
        assert not held.is_valid
        with pytest.raises(frond.Error, match="stale"):
            held.point
    plant.break_at(plant.capsule_count - 1)
    (fragment,) = plant.fragments
    assert fragment.rigid.is_valid and fragment.mass > 0
    world.step(0.1)
    assert frond.Event.BROKE in {event.event for event in world.take_events()}
    assert frond.plant_at(world, plant.bullet_object) == plant and world.bullet_world


@pytest.mark.parametrize("mechanics", ["rod", "tet_corotational"])
def test_the_force_of_a_grab_is_what_the_root_holds(corn, mechanics):
    world = frond.World(sleep_distance=0)
    plant = world.add_plant(corn, mechanics=mechanics, mass_damping=3)
    grab = plant.grab((0, 1, 0), 200)
    start = grab.point
    assert np.allclose(grab.force, 0)
    for step in range(400):
        grab.move(start + [0.2 * min(1, step / 120), 0, 0])
        world.step(1 / 60)
    total = plant.root_force().force + grab.force - [0, corn.info.mass * 9.81, 0]
    assert np.linalg.norm(grab.force) > 5 and np.linalg.norm(total) < 0.01 * np.linalg.norm(grab.force)
    assert np.allclose(grab.force, 200 * (grab.target - grab.point))


def test_wind_fields_and_what_they_raise(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    world.set_wind(velocity=(5, 0, 0), turbulence=0, profile="uniform")
    assert np.allclose(world.get_wind_at((0, 1, 0)), (5, 0, 0))
    world.set_wind_field(lambda points, time, air: air * 2)
    world.step(0.1)
    assert np.allclose(world.get_wind_at((0, 1, 0)), (10, 0, 0)) and plant.air_force[0] > 0

    def broken(points, time, air):
        raise ValueError("no wind today")

    world.set_wind_field(broken)
    with pytest.raises(ValueError, match="no wind today"):
        world.step(0.1)
    world.set_wind_field(None)
    world.remove_wind()
    assert np.allclose(world.get_wind_at((0, 1, 0)), 0)


def test_detail_robots_and_other_settings(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    world.set_detail(distance=lambda plant, metres: 20.0, half_from=10)
    world.set_viewer((0, 0, 0))
    plant.wake()
    world.step(0.1)
    assert plant.detail == frond.Detail.ROD
    assert isinstance(plant.trouble, frond.Trouble) and not plant.trouble & frond.Trouble.REWOUND
    world.remove_detail()
    robot = world.add_robot("arm", position=(2, 0, 0))
    elbow = next(i for i in range(robot.link_count) if robot.link(i).joint == frond.Joint.REVOLUTE)
    robot.set_joint(elbow, 0.1)
    robot.drive_to(elbow, 0.2)
    world.step(0.5)
    assert abs(robot.link_state(elbow).joint_position - 0.2) < 0.02 and robot.find_link("nothing") == -1
    robot.drive_at(elbow, 0)
    robot.release(elbow)
    assert robot.multi_body and robot.joint_motor(elbow) and robot.surface.triangles.shape[1] == 3
    world.set_gravity((0, -1, 0))
    world.set_effects(frond.Effect.ALL)
    world.set_interpolation(0.5)
    world.shift_origin((10, 0, 0))
    assert world.profile.ms_of_effect.shape == (15,) and world.state_hash != 0
    with pytest.raises(frond.Error, match="robots"):
        world.save()


def test_snapshots_go_back_to_the_bit(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    plant.grab((0, 0.6, 0), 5).move((0.2, 0.6, 0))
    world.step(0.2)
    saved = world.save()
    world.step(0.5)
    after = world.state_hash
    world.restore(saved)
    assert world.state_hash != after
    world.step(0.5)
    assert world.state_hash == after
    with pytest.raises(frond.Error):
        world.restore(saved[:-1])


def test_pictures_and_films(stem, tmp_path):
    world = frond.World()
    plant = world.add_plant(stem)
    with frond.picture.Picture(160, 120, samples=4) as picture:
        with picture.frame(camera=frond.picture.camera_on(plant), ground=False):
            picture.draw_organs(plant, 3)
            picture.draw_plant(plant, frond.PictureWhat.CAPSULES | frond.PictureWhat.CONTACTS)
            picture.draw_arrow((0, 0.3, 0), (0.1, 0.3, 0), 2, (1, 0, 0))
        assert set(np.unique(picture.ids)) == {-1, *range(3, 3 + len(stem.organs))} and picture.pixels.std() > 5
        seen = picture.distances[picture.ids >= 0]
        assert np.isfinite(seen).all() and np.isinf(picture.distances[picture.ids < 0]).all()
        picture.write(tmp_path / "a.png")
        assert np.array_equal(frond.picture.read_png(tmp_path / "a.png"), picture.pixels)
        assert frond.picture.compare(picture.pixels, picture.pixels).same
        assert frond.picture.compare_file(picture.pixels, tmp_path / "a.png").worst == 0
        film = frond.picture.Film(160, 120)
        film.add(picture.pixels)
        film.add(picture.pixels)
        assert film.frame_count == 2
        film.write_sheet(tmp_path / "sheet.png", 2, 1)
        film.write_webp(tmp_path / "film.webp")
        with pytest.raises(frond.Error):
            film.add(picture.pixels[:10])
    with pytest.raises(frond.Error):
        picture.pixels


def test_every_wrong_argument_is_refused_with_a_remedy(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    grab = plant.grab((0, 0.6, 0), 5)
    wrong = [
        lambda: frond.World(gravity=(0, 0)), lambda: frond.World(gravity=(0, math.nan, 0)),
        lambda: frond.World(response="strong"), lambda: frond.World(effects=1 << 30), lambda: frond.World(nothing=1),
        lambda: frond.Model("no/such/file.obj"), lambda: frond.Model(None), lambda: frond.Model("a\0b"),
        lambda: frond.Model("corn", organs={"wood": "stem"}), lambda: frond.Model("corn", organs=[1]),
        lambda: frond.Model.from_triangles([[0, 0, 0]], [[0, 1, 2]]), lambda: frond.Model.from_triangles([], []),
        lambda: frond.Model.from_triangles([[0, 0, 0]] * 3, [[0, 1, 2.5]]),
        lambda: frond.Model.from_triangles([[0, 0, 0]] * 3, [[0, 1, 2**40]]),
        lambda: frond.Model.from_stems([{"parent": -1}]), lambda: frond.Model.from_stems([]),
        lambda: frond.Model.from_tets([[0, 0, 0]], [[0, 1, 2]]), lambda: frond.material_preset("stone"),
        lambda: world.add_plant(stem, mechanics="glue"), lambda: world.add_plant(stem, mechanics=frond.Shape.BOX),
        lambda: world.add_plant(stem, mechanics=77), lambda: world.add_plant(stem, rotation=(0, 0, 0, 0)),
        lambda: world.add_plant(stem, element_order="two"), lambda: world.add_plant(stem, tuning=3),
        lambda: world.add_plant(stem, tuning={"mass": "heavy"}), lambda: world.add_plant(stem, group=2**40),
        lambda: world.add_plant(stem, user=3), lambda: world.add_plant(17), lambda: world.step(-1),
        lambda: world.step("long"), lambda: world.step(math.nan), lambda: world.set_wind(velocity=(1e9, 0, 0)),
        lambda: world.set_wind(profile="steep"), lambda: world.set_wind_field(3),
        lambda: world.add_rigid(shape="torus"),
        lambda: world.add_rigid(mass=-1), lambda: world.add_robot("no.urdf"), lambda: world.restore(b"nonsense"),
        lambda: world.restore(None), lambda: world.cast_ray((0, 0, 0), (0, 0, 0), 1), lambda: world.set_effects("wind"),
        lambda: plant.pin(-1), lambda: plant.pin(1.5), lambda: plant.pin(True), lambda: plant.pin(2**70),
        lambda: plant.move_pin(plant.node_count - 1, (0, 0, 0)), lambda: plant.set_state(np.zeros((3, 3))),
        lambda: plant.set_state(np.zeros(5)), lambda: plant.set_state("zero"), lambda: plant.set_plastic([1, 2]),
        lambda: plant.grab((0, 0, 0), -1), lambda: plant.grab((0, 0), 1), lambda: plant.bond((0, 0, 0), 5),
        lambda: plant.bond_robot((0, 0, 0), 5, 0), lambda: plant.bond_body((0, 0, 0), 1, 0),
        lambda: plant.break_at(10**6), lambda: plant.set_effects(-1), lambda: plant.set_integrator("euler"),
        lambda: plant.set_transform((0, 0, math.inf)), lambda: grab.move(None), lambda: plant.root_force((1, 2)),
        lambda: world.wrench_on("arm"), lambda: frond.picture.Picture(0, 10), lambda: frond.picture.Picture("a", 1),
        lambda: frond.picture.camera_of_matrices([0] * 16, [0] * 16), lambda: frond.picture.read_png("no.png"),
        lambda: stem.recommend(), lambda: stem.recommend(error=-1), lambda: stem.write_urdf("/no/such/folder/a.urdf"),
        lambda: stem.save("/no/such/folder/a.frond"), lambda: frond.Model.from_bytes(b"frond"),
        lambda: frond.Model.from_bytes(stem.to_bytes()[:-1]), lambda: frond.Model.from_bytes("frond")]
    before = world.state_hash
    for number, call in enumerate(wrong):
        with pytest.raises(frond.Error) as caught:
            call()
        assert len(str(caught.value)) > 12, number
    assert world.state_hash == before and world.report.plant_count == 1


def test_stale_handles_say_so(stem):
    world = frond.World()
    plant, ball = world.add_plant(stem), world.add_rigid()
    grab = plant.grab((0, 0.6, 0), 5)
    robot = world.add_robot("arm")
    ball.destroy()
    with pytest.raises(frond.Error, match="stale") as caught:
        ball.state
    assert caught.value.code == frond.Result.BAD_HANDLE
    world.destroy()
    world.destroy()
    for call in (lambda: plant.tip, lambda: plant.wake(), lambda: plant.root_force(mean=True), lambda: grab.force,
                 lambda: robot.link_state(0), lambda: world.report, lambda: world.step(0.1), lambda: world.forces(),
                 lambda: world.add_plant(stem), lambda: plant.get_state(), lambda: plant.bond_body((0, 0, 0), 1)):
        with pytest.raises(frond.Error, match="stale"):
            call()
    assert plant.node_count == 0 and not plant.is_awake and world.bullet_world == 0 and robot.link_count == 0


def test_worlds_are_freed_when_nothing_refers_to_them(stem):
    world = frond.World()
    plant = world.add_plant(stem)
    del world
    gc.collect()
    plant.world.step(0.01)
    handle = plant._handle
    del plant
    gc.collect()
    assert not frond._lib.lib.frond_plant_is_valid(handle)


def test_warnings_go_where_they_are_sent():
    heard = []
    frond.set_log(heard.append)
    frond.Model("wheat", scale=2, allow_stiffening=10)  # twice as large, its stems are made stiffer
    frond.set_log(None)
    assert any("stiffer" in text for text in heard)
