// The scenes as the frond command runs them: the paper's counts, standing, swaying, and pictures compared with
// references. FROND_UPDATE_PICTURES=1 in the environment rewrites the references.
#include "scenes/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "studio/studio.hpp"
#include "support/sanitized.hpp"

using namespace frond::tools;

static frond_model_info info_of(const Play& play) {
    frond_model_info info;
    EXPECT_EQ(frond_model_get_info(play.stage.plant_models[0], &info), FROND_OK);
    return info;
}

static double distance(const frond_vec3& a, const frond_vec3& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

static std::vector<float> surface_of(const Play& play) {
    frond_surface_view view;
    EXPECT_EQ(frond_plant_get_surface(play.stage.plants[0], &view), FROND_OK);
    return std::vector<float>(view.positions, view.positions + 3 * size_t(view.vertex_count));
}

static double farthest_move(const std::vector<float>& from, const std::vector<float>& to) {
    double farthest = 0;
    for (size_t v = 0; v + 2 < from.size(); v += 3)
        farthest = std::max(farthest, distance({from[v], from[v + 1], from[v + 2]}, {to[v], to[v + 1], to[v + 2]}));
    return farthest;
}

static Play play_of(const char* scene, const std::vector<std::string>& assignments = {}) {
    const Casting casting = cast(scene);
    return Play(casting, settings_of(casting, assignments));
}

TEST(Paper, CornHasItsCounts) {
    const Play play = play_of("corn");
    const frond_model_info info = info_of(play);
    EXPECT_EQ(info.vertex_count, 925);
    EXPECT_EQ(info.triangle_count, 1184);
    EXPECT_NEAR(info.node_count, 452, 45);
    EXPECT_NEAR(info.tet_count, 1156, 115);
    EXPECT_GE(info.min_dihedral, 10);
    EXPECT_EQ(info.contained, 1);
}

TEST(Paper, CucumberHasItsCounts) {
    const Play play = play_of("cucumber");
    const frond_model_info info = info_of(play);
    EXPECT_EQ(info.vertex_count, 22004);
    EXPECT_EQ(info.triangle_count, 30244);
    EXPECT_NEAR(info.node_count, 521, 52);
    EXPECT_NEAR(info.tet_count, 1431, 143);
    EXPECT_NEAR(info.upper.y, 2.1, 0.05);
    EXPECT_GE(info.min_dihedral, 10);
    EXPECT_EQ(info.contained, 1);
}

class EveryScene : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, ::testing::Values("corn", "cucumber", "drag", "cucumber_drag"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(EveryScene, RunsWithoutTrouble) {
    Play play = play_of(GetParam());
    const std::vector<float> start = surface_of(play);
    const double height = info_of(play).upper.y;
    double farthest = 0;
    for (int i = 0; i < 300; i++) {
        play.step();
        frond_report report;
        ASSERT_EQ(frond_world_get_report(play.stage.world, &report), FROND_OK);
        ASSERT_EQ(report.trouble, 0u) << "step " << i;
        if (i % 20 == 19) farthest = std::max(farthest, farthest_move(start, surface_of(play)));
    }
    const bool is_dragged = std::string(GetParam()).find("drag") != std::string::npos;
    if (is_dragged)
        EXPECT_GT(farthest, 0.05 * height);
    else
        EXPECT_LT(farthest, 0.005 * height);
}

TEST(WindScene, BendsItsPlantsDownTheWindAndEndsWithoutIt) {
    Play play = play_of("wind", {"mechanics=rod"});
    frond_vec3 start = {}, tip = {}, force = {};
    ASSERT_EQ(frond_plant_get_tip(play.stage.plants[0], &start), FROND_OK);
    double mean = 0, farthest = 0;
    for (int i = 0; i < 180; i++) {
        play.step();
        frond_report report;
        ASSERT_EQ(frond_world_get_report(play.stage.world, &report), FROND_OK);
        ASSERT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u) << "step " << i;
        ASSERT_EQ(frond_plant_get_air_force(play.stage.plants[0], &force), FROND_OK);
        ASSERT_EQ(frond_plant_get_tip(play.stage.plants[0], &tip), FROND_OK);
        mean += force.x / 180;
        farthest = std::max(farthest, tip.x - start.x);
    }
    EXPECT_GT(mean, 0.5);
    EXPECT_GT(farthest, 0.02);
    Play calm = play_of("wind", {"wind=0,0,0"});
    calm.step();
    ASSERT_EQ(frond_plant_get_air_force(calm.stage.plants[0], &force), FROND_OK);
    EXPECT_EQ(force.x, 0);
    EXPECT_THROW(play_of("wind", {"turbulence=7"}), SceneError);
}

// Pictures the plant half a second after its release, or at rest, to show both shape and motion.
TEST_P(EveryScene, LooksAsItDid) {
    Play play = play_of(GetParam());
    for (int i = 0; i < 110; i++) play.step();
    View view;
    view.width = 480;
    view.height = 480;
    view.overlays = {"force"};
    Studio studio(view);
    const uint8_t* pixels = studio.shoot(play.stage);
    const std::string reference = std::string(FROND_SOURCE_DIR) + "/tests/tools/reference/" + GetParam() + ".png";
    if (std::getenv("FROND_UPDATE_PICTURES")) {
        ASSERT_TRUE(frond_picture_write_png(reference.c_str(), pixels, view.width, view.height));
        GTEST_SKIP() << "wrote " << reference;
    }
    const std::string kept = std::string(GetParam()) + "_difference.png";
    frond_picture_difference difference;
    ASSERT_TRUE(frond_picture_compare_file(pixels, view.width, view.height, reference.c_str(), FROND_PICTURE_TOLERANCE,
                                           &difference, kept.c_str()))
        << frond_picture_last_error();
    EXPECT_TRUE(difference.same) << "differs by " << difference.worst << " at " << difference.worst_x << ","
                                 << difference.worst_y << "; see " << std::filesystem::absolute(kept);
}

TEST(Box, ComesToRestOnLeavesAndStays) {
    Play play = play_of("box");
    frond_rigid_state before, now;
    for (int i = 0; i < 240; i++) play.step();
    must(frond_rigid_get_state(play.stage.rigids.back(), &before));
    EXPECT_GT(before.position.y, 0.2);  // not on the ground
    EXPECT_GT(frond_plant_get_contact_count(play.stage.plants[0]), 2);
    for (int i = 0; i < 60; i++) {
        play.step();
        must(frond_rigid_get_state(play.stage.rigids.back(), &now));
        const frond_vec3 &v = now.velocity, &p = now.position, &q = before.position;
        EXPECT_LT(std::hypot(v.x, v.y, v.z), 0.001) << i;  // no jitter above 1 mm/s
        EXPECT_LT(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z), 0.002) << i;
    }
}

TEST(Flag, FoldsOntoItselfAndPassesThroughOnlyWithoutSelfContact) {
    for (const char* mechanics : {"mechanics=rod", "mechanics=tet_corotational"}) {
        Play play = play_of("flag", {mechanics}), through = play_of("flag", {mechanics, "self_contact=off"});
        for (int i = 0; i < 240; i++) {
            play.step();
            through.step();
            frond_report report;
            must(frond_world_get_report(play.stage.world, &report));
            EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u) << i;
        }
        // The tip is beside the lower half, on the side it came from, and pressed on it; without contact it is beyond.
        frond_vec3 tip, tip_through;
        must(frond_grab_get(play.stage.grabs[0], &tip, nullptr, nullptr));
        must(frond_grab_get(through.stage.grabs[0], &tip_through, nullptr, nullptr));
        EXPECT_LT(tip.y, 0.1);
        EXPECT_GT(tip.x, 0);
        EXPECT_LT(tip.x, 0.03);
        EXPECT_LT(tip_through.x, -0.01);
        EXPECT_GT(frond_plant_get_contact_count(play.stage.plants[0]), 0);
        EXPECT_EQ(frond_plant_get_contact_count(through.stage.plants[0]), 0);
    }
}

TEST(Trellis, HoldsAPlantThatLeansOnIt) {
    Play play = play_of("trellis");
    Play free = play_of("trellis", {"response=none"});
    for (int i = 0; i < 180; i++) {
        play.step();
        free.step();
    }
    EXPECT_GT(frond_plant_get_contact_count(play.stage.plants[0]), 0);
    frond_vec3 held = {}, fallen = {};
    must(frond_plant_get_tip(play.stage.plants[0], &held));
    must(frond_plant_get_tip(free.stage.plants[0], &fallen));
    EXPECT_LT(held.x, fallen.x - 0.001);
}

// ---- breaking ----------------------------------------------------------------------------------------------------

struct Break {
    frond_vec3 pull = {}, hold = {};  // force of the hand [N], and the point that it holds [m]
    frond_vec3 begin = {}, end = {};  // ends of the capsule that broke, just before [m]
    double radius = 0;
    frond_fragment broken = {};
};

static std::vector<frond_capsule> capsules_of(const Play& play) {
    std::vector<frond_capsule> capsules(size_t(frond_plant_get_capsule_count(play.stage.plants[0])));
    must(frond_plant_get_capsules(play.stage.plants[0], capsules.data(), int(capsules.size())));
    return capsules;
}

static Break play_until_it_breaks(Play& play) {
    Break out;
    for (int i = 0; i < 400; i++) {
        if (!play.stage.grabs.empty()) must(frond_grab_get(play.stage.grabs[0], &out.hold, nullptr, &out.pull));
        const std::vector<frond_capsule> capsules = capsules_of(play);
        play.step();
        frond_report report;
        must(frond_world_get_report(play.stage.world, &report));
        EXPECT_EQ(report.trouble & FROND_TROUBLE_REWOUND, 0u) << i;
        if (frond_plant_get_fragment_count(play.stage.plants[0]) == 0) continue;
        must(frond_plant_get_fragment(play.stage.plants[0], 0, &out.broken));
        const frond_capsule& capsule = capsules[size_t(out.broken.capsule)];
        out.begin = capsule.begin;
        out.end = capsule.end;
        out.radius = capsule.radius;
        return out;
    }
    ADD_FAILURE() << "nothing broke";
    return out;
}

static frond_vec3 cross(const frond_vec3& a, const frond_vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static frond_vec3 difference(const frond_vec3& a, const frond_vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
static double length_of(const frond_vec3& a) {
    return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

static frond_organ organ_of(const Play& play, const std::string& name) {
    frond_organ organ = {};
    for (int i = 0; i < info_of(play).organ_count; i++) {
        must(frond_model_get_organ(play.stage.plant_models[0], i, &organ));
        if (name == organ.name) return organ;
    }
    ADD_FAILURE() << "there is no " << name;
    return organ;
}

// A round section breaks at the moment strength pi r^3 / 4.
TEST(Snap, ACornStalkBreaksNearTheMomentThatItsStrengthBears) {
    frond_material stalk = {};
    must(frond_material_preset("grass_stem", &stalk));
    for (const char* mechanics : {"rod", "tet_corotational", "tet_neohookean"}) {
        SCOPED_TRACE(mechanics);
        // A leaf that falls over as the stalk is bent would hit the ground and shake the stalk.
        Play play = play_of("snap", {std::string("mechanics=") + mechanics, "rigid_contact=off"});
        const std::vector<frond_capsule> standing = capsules_of(play);
        const Break b = play_until_it_breaks(play);
        frond_rigid_state before = {}, after = {};
        must(frond_rigid_get_state(b.broken.rigid, &before));
        // Moments of the hand and of the fragment's weight, about the middle of the broken segment.
        const frond_vec3 middle = {0.5 * (b.begin.x + b.end.x), 0.5 * (b.begin.y + b.end.y),
                                   0.5 * (b.begin.z + b.end.z)};
        const frond_vec3 by_hand = cross(difference(b.hold, middle), b.pull);
        const frond_vec3 by_weight = cross(difference(before.position, middle), {0, -9.81 * b.broken.mass, 0});
        const double moment = length_of({by_hand.x + by_weight.x, by_hand.y + by_weight.y, by_hand.z + by_weight.z});
        const double known = stalk.strength * M_PI * std::pow(b.radius, 3) / 4;
        EXPECT_NEAR(moment / known, 1, 0.25);  // leaves that fall over add to the moment
        // The fragment falls over, the stump stands up again.
        for (int i = 0; i < 240; i++) play.step();
        must(frond_rigid_get_state(b.broken.rigid, &after));
        EXPECT_LT(after.position.y, before.position.y - 0.2);
        EXPECT_GT(after.position.y, 0);
        EXPECT_EQ(frond_plant_get_fragment_count(play.stage.plants[0]), 1);
        EXPECT_LT(distance(capsules_of(play)[0].end, standing[0].end), 0.005);
    }
}

// The section is flat, so that its strength is between those of its thin and its wide side.
TEST(Pick, ACucumberComesOffItsPeduncleAndFallsToTheGround) {
    Play play = play_of("pick");
    frond_vec3 tip_before = {}, tip = {};
    must(frond_plant_get_tip(play.stage.plants[0], &tip_before));
    const Break b = play_until_it_breaks(play);
    const frond_organ peduncle = organ_of(play, "peduncle_3"), fruit = organ_of(play, "fruit_3");
    EXPECT_GT(b.broken.mass, 0.5 * fruit.mass);
    EXPECT_LT(b.broken.mass, 1.5 * fruit.mass);

    const frond_vec3 middle = {(b.begin.x + b.end.x) / 2, (b.begin.y + b.end.y) / 2, (b.begin.z + b.end.z) / 2};
    frond_rigid_state state = {};
    must(frond_rigid_get_state(b.broken.rigid, &state));
    const frond_vec3 by_hand = cross(difference(b.hold, middle), b.pull);
    const frond_vec3 by_weight = cross(difference(state.position, middle), {0, -9.81 * b.broken.mass, 0});
    const double moment = length_of({by_hand.x + by_weight.x, by_hand.y + by_weight.y, by_hand.z + by_weight.z});
    const double bears = peduncle.material.strength / peduncle.material.young;  // strain of the outermost fibre [-]
    EXPECT_GT(moment, 0.9 * bears * peduncle.bending_thin.lower / (peduncle.thickness.upper / 2));
    EXPECT_LT(moment, 1.1 * bears * peduncle.bending_wide.upper / (peduncle.width.upper / 2));
    // It is the chord of an arc as long as the peduncle, which the moment bends no farther than about its thin side.
    const double half_angle = 0.5 * moment * peduncle.length / peduncle.bending_thin.lower;
    EXPECT_LT(distance(b.begin, b.end), 1.01 * peduncle.length);
    EXPECT_GT(distance(b.begin, b.end), 0.99 * peduncle.length * std::sin(half_angle) / half_angle);
    EXPECT_LT(half_angle, M_PI / 2);

    for (int i = 0; i < 240; i++) play.step();
    must(frond_rigid_get_state(b.broken.rigid, &state));
    // It lies on the ground, where it may rock on its round side: Bullet's bodies roll without loss.
    const frond_vec3 lies = state.position;
    for (int i = 0; i < 240; i++) {
        play.step();
        must(frond_rigid_get_state(b.broken.rigid, &state));
        ASSERT_LT(state.position.y, 0.05);
        ASSERT_LT(distance(state.position, lies), 0.03);
    }
    must(frond_plant_get_tip(play.stage.plants[0], &tip));
    EXPECT_LT(distance(tip, tip_before), 0.02);  // carries less now
    EXPECT_EQ(frond_plant_get_fragment_count(play.stage.plants[0]), 1);
}

// The minimum of many steps counts, so that a busy processor does not matter.
TEST(Twig, OfSixtyRodsIsQuick) {
    Play play = play_of("twig");
    EXPECT_NEAR(info_of(play).capsule_count, 60, 2);
    double lower = 1e9;
    for (int i = 0; i < 300; i++) {
        play.step();
        frond_report report;
        ASSERT_EQ(frond_world_get_report(play.stage.world, &report), FROND_OK);
        EXPECT_EQ(report.trouble, 0u) << i;
        frond_profile profile;
        ASSERT_EQ(frond_world_get_profile(play.stage.world, &profile), FROND_OK);
        lower = std::min(lower, profile.ms_step);
    }
    if (!SANITIZED) {
        EXPECT_LT(lower, 0.1);
    }
}

TEST(Settings, NameTheirKeysWhenOneIsWrong) {
    Settings settings;
    apply_setting(settings, "cage_size=0.3");
    EXPECT_EQ(settings.model.cage_size, 0.3);
    apply_setting(settings, "mechanics=tet_linear");
    EXPECT_EQ(settings.plant.mechanics, FROND_MECHANICS_TET_LINEAR);
    apply_setting(settings, "gravity=0,0,-9.81");
    EXPECT_EQ(settings.world.gravity.z, -9.81);
    for (const char* wrong : {"cage_siz=0.3", "cage_size", "cage_size=abc", "cage_size=nan", "mechanics=jelly",
                              "gravity=1,2", "material.stem.taste=3", "=", ""})
        EXPECT_THROW(apply_setting(settings, wrong), SceneError) << wrong;
    try {
        apply_setting(settings, "mechanics=jelly");
    } catch (const SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("tet_corotational"), std::string::npos);
    }
}

TEST(Settings, OfMaterialsReachTheOrgan) {
    const Play soft = play_of("corn", {"material.stem.density=500"}), normal = play_of("corn");
    EXPECT_LT(info_of(soft).mass, info_of(normal).mass);
    EXPECT_THROW(play_of("corn", {"material.pancake.young=1e9"}), SceneError);
}

TEST(Casting, NamesTheScenesThereAre) {
    EXPECT_THROW(cast("no_such_scene"), SceneError);
    EXPECT_STREQ(cast(model_path("corn/corn.obj")).scene->name, "tug");
    EXPECT_THROW(model_path("no/such.obj"), SceneError);
}
