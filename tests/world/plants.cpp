// Plants among plants: they push each other and themselves, come apart if they were made overlapping, conserve
// momentum, and do all of this whichever method finds their contacts. FCL measures how deep they overlap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "frond/frond.h"
#include "support/sanitized.hpp"
#include "support/stand.hpp"

namespace plants_tests {

using frond::Vec3;
using frond::test::CornPair;
using frond::test::H;
using frond::test::must;
using frond::test::Stand;

// ---- the paper's figure 5 ------------------------------------------------------------------------------------

TEST(CornPair, ComesApartWithinTwoSecondsAndStaysInEachOtherWithoutResponse) {
    for (const frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD}) {
        if (SANITIZED && mechanics != FROND_MECHANICS_ROD) continue;
        CornPair with(FROND_RESPONSE_IMPULSE, mechanics);
        const bool by_cages = mechanics == FROND_MECHANICS_TET_COROTATIONAL;
        const double cage_before = with.cage_depth(), surface_before = with.surface_depth();
        EXPECT_GT(cage_before, 0.01);
        EXPECT_GT(surface_before, 0.005);
        for (int i = 0; i < 120; i++) {
            with.steps(1);
            EXPECT_EQ(with.report().trouble & FROND_TROUBLE_REWOUND, 0u) << i;
        }
        EXPECT_LT(with.contact_depth(), 0.001) << frond_mechanics_name(mechanics);
        if (by_cages) {
            EXPECT_LT(with.cage_depth(), 0.001);
        }
        EXPECT_LT(with.surface_depth(), 0.001) << frond_mechanics_name(mechanics);
        if (SANITIZED) continue;
        // What single steps tell may be too deep, where an edge finds no shorter way out than across a whole leaf.
        int told_deep = 0;
        for (int i = 0; i < 120; i++) {
            with.steps(1);
            told_deep += with.contact_depth() > 0.001;
            if (by_cages) {
                EXPECT_LT(with.cage_depth(), 0.001) << i;
            }
            EXPECT_LT(with.surface_depth(), 0.001) << frond_mechanics_name(mechanics) << " later " << i;
        }
        EXPECT_LE(told_deep, 4) << frond_mechanics_name(mechanics);
        CornPair without(FROND_RESPONSE_NONE, mechanics);
        without.steps(120);
        EXPECT_GT(without.report().plant_contact_count, 0);
        EXPECT_GT(without.cage_depth(), 0.5 * cage_before) << frond_mechanics_name(mechanics);
        EXPECT_GT(without.surface_depth(), 0.5 * surface_before) << frond_mechanics_name(mechanics);
    }
}

// Checks every step from 2 s to 4 s, by FCL on cages and surfaces.
void expect_stays_apart(frond_mechanics mechanics, double step, const frond::test::Placement& placement) {
    CornPair pair(FROND_RESPONSE_IMPULSE, mechanics, step, placement);
    const int count = int(std::lround(2 / step));
    pair.steps(count);
    for (int i = 0; i <= count; i++) {
        if (i > 0) pair.steps(1);
        if (mechanics != FROND_MECHANICS_ROD) {
            EXPECT_LT(pair.cage_depth(), 0.001) << i << " of " << step << " s";
        }
        EXPECT_LT(pair.surface_depth(), 0.001) << i << " of " << step << " s, " << frond_mechanics_name(mechanics);
    }
}

TEST(CornPair, StaysApartWhereTheExamplePutsIt) {
    if (SANITIZED) GTEST_SKIP() << "a figure";
    expect_stays_apart(FROND_MECHANICS_TET_COROTATIONAL, H, frond::test::AS_IN_EXAMPLE);
}

// By its organs, which are apart where cages overlap: only surfaces count. Other turns than the example's, since there
// organs hardly touch.
TEST(CornPair, OfCagesStaysApartByItsOrgans) {
    if (SANITIZED) GTEST_SKIP() << "a figure";
    double before = 0;
    for (const double turn : {0.1, 1.3, 2.9, 4.4}) {
        CornPair pair(FROND_RESPONSE_IMPULSE, FROND_MECHANICS_TET_COROTATIONAL, H, {{0.8, 0, 0.03}, {turn, -turn}},
                      FROND_COLLISION_ORGANS);
        before = std::max(before, pair.surface_depth());
        pair.steps(120);
        for (int i = 0; i < 60; i++) {
            pair.steps(1);
            EXPECT_LT(pair.surface_depth(), 0.001) << turn << ", step " << i;
        }
    }
    EXPECT_GT(before, 0.005);
}

TEST(CornPair, TellsOfContactsThatAreLeftOut) {
    CornPair crowded(FROND_RESPONSE_IMPULSE, FROND_MECHANICS_TET_COROTATIONAL, H, {{0.02, 0, 0}, {0, 0}});
    crowded.steps(1);
    EXPECT_EQ(frond_plant_get_contact_count(crowded.plants[0]), 100);
    EXPECT_NE(crowded.report().trouble & FROND_TROUBLE_CROWDED, 0u);
    uint32_t trouble = 0;
    EXPECT_EQ(frond_plant_get_trouble(crowded.plants[0], &trouble), FROND_OK);
    EXPECT_NE(trouble & FROND_TROUBLE_CROWDED, 0u);
    CornPair pair(FROND_RESPONSE_IMPULSE, FROND_MECHANICS_TET_COROTATIONAL, H, frond::test::AS_IN_SCENE,
                  FROND_COLLISION_ORGANS);
    pair.steps(1);
    EXPECT_LT(frond_plant_get_contact_count(pair.plants[0]), 100);
    EXPECT_EQ(pair.report().trouble & FROND_TROUBLE_CROWDED, 0u);
}

TEST(CornPair, SpringsPartItToo) {
    if (SANITIZED) GTEST_SKIP() << "a figure";
    for (const frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD}) {
        CornPair pair(FROND_RESPONSE_PENALTY, mechanics);
        pair.steps(240);  // in double precision cages stay entangled for 3.2 s
        EXPECT_EQ(pair.report().trouble & FROND_TROUBLE_REWOUND, 0u);
        EXPECT_LT(pair.surface_depth(), 0.001) << frond_mechanics_name(mechanics);
        if (mechanics == FROND_MECHANICS_ROD) {
            EXPECT_LT(pair.contact_depth(), 0.001);
        } else {
            EXPECT_LT(pair.cage_depth(), 0.005);
        }
    }
}

TEST(CornPair, ComesApartGently) {
    if (SANITIZED) GTEST_SKIP() << "a figure";
    CornPair pair(FROND_RESPONSE_IMPULSE);
    double fastest = 0;
    for (int i = 0; i < 120; i++) {
        const std::vector<double> before = pair.places(pair.plants[0]);
        pair.steps(1);
        const std::vector<double> after = pair.places(pair.plants[0]);
        for (size_t k = 0; k < before.size(); k++) fastest = std::max(fastest, std::abs(after[k] - before[k]) / H);
    }
    EXPECT_LT(fastest, 3);  // [m/s]
}

// ---- stems in free fall -----------------------------------------------------------------------------------------

struct Free : testing::TestWithParam<frond_mechanics> {};
INSTANTIATE_TEST_SUITE_P(Plants, Free,
                         testing::Values(FROND_MECHANICS_TET_LINEAR, FROND_MECHANICS_TET_COROTATIONAL,
                                         FROND_MECHANICS_TET_NEOHOOKEAN, FROND_MECHANICS_ROD,
                                         FROND_MECHANICS_SPRING_CHAIN),
                         [](const auto& info) { return std::string(frond_mechanics_name(info.param)); });

// Two crossed stems, one thrown at the other.
struct ThrownStems : Stand {
    explicit ThrownStems(frond_mechanics mechanics, frond_world_def def = frond_default_world_def())
        : Stand(weightless(def)) {
        make_stems({{-1, {0, -0.3, 0}, {0, 0.3, 0}, 0.02, 0.02}});
        frond_plant_def plant = plant_def();
        plant.mechanics = mechanics;
        plant.root_height = -1;
        plant.effects &= ~uint32_t(FROND_EFFECT_DAMPING);
        add(plant, {0, 0, 0});
        // The second one lies across the first.
        plant.rotation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
        plant.position = {0.05, 0.04, 0.2};
        frond_plant other = {};
        must(frond_plant_create(world, model, &plant, &other));
        plants.push_back(other);
        throw_plant(plants[1], {0, 0, -1.5});
    }
    static frond_world_def weightless(frond_world_def def) {
        def.gravity = {0, 0, 0};
        return def;
    }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const frond_plant plant : plants) {
            frond_vec3 p = {};
            must(frond_plant_get_momentum(plant, &p));
            sum += Vec3(p.x, p.y, p.z);
        }
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (const frond_plant plant : plants) {
            frond_energy energy = {};
            must(frond_plant_get_energy(plant, &energy));
            sum += energy.kinetic + energy.elastic;
        }
        return sum;
    }
};

TEST_P(Free, StemsThatCollideKeepTheirMomentumAndGainNoEnergy) {
    for (const frond_response response : {FROND_RESPONSE_IMPULSE, FROND_RESPONSE_PENALTY}) {
        frond_world_def def = frond_default_world_def();
        def.response = response;
        ThrownStems stems(GetParam(), def);
        const Vec3 before = stems.momentum();
        const double energy = stems.energy();
        int touched = 0;
        for (int i = 0; i < 60; i++) {
            stems.steps(1);
            touched += stems.report().plant_contact_count > 0;
            EXPECT_LT(stems.energy(), 1.001 * energy) << i;
        }
        EXPECT_GT(touched, 0);
        EXPECT_LT((stems.momentum() - before).norm(), 1e-6 * before.norm());
        // The impact had an effect: the stem that was hit moves, and the other did not pass through it.
        frond_vec3 hit = {};
        must(frond_plant_get_momentum(stems.plants[0], &hit));
        EXPECT_LT(hit.z, 0.2 * before.z());
    }
}

TEST_P(Free, ContactsAreToldByBothPlantsAndPointAtEachOther) {
    ThrownStems stems(GetParam());
    int seen = 0;
    for (int i = 0; i < 30; i++) {
        stems.steps(1);
        const int count = frond_plant_get_contact_count(stems.plants[0]);
        ASSERT_EQ(frond_plant_get_contact_count(stems.plants[1]), count);
        std::vector<frond_contact> a(static_cast<size_t>(count)), b(static_cast<size_t>(count));
        must(frond_plant_get_contacts(stems.plants[0], a.data(), count));
        must(frond_plant_get_contacts(stems.plants[1], b.data(), count));
        for (size_t k = 0; k < a.size(); k++) {
            EXPECT_EQ(a[k].other.id, stems.plants[1].id);
            EXPECT_EQ(b[k].other.id, stems.plants[0].id);
            EXPECT_EQ(a[k].impulse.z, -b[k].impulse.z);
            EXPECT_EQ(a[k].normal.x, -b[k].normal.x);
            // Contacts that will close within the step, or have just opened, are reported too.
            EXPECT_LT(a[k].gap, 0.01 + 1.5 * H);
            EXPECT_EQ(a[k].gap, b[k].gap);
            seen++;
        }
    }
    EXPECT_GT(seen, 0);
}

TEST(Plants, EveryLayoutOfTheHashGivesTheSameMotion) {
    std::vector<uint64_t> hashes;
    const auto run = [&](frond_hash_layout layout, int table_size, double cell_size) {
        frond_world_def def = frond_default_world_def();
        def.tuning.hash_layout = layout;
        def.tuning.hash_table_size = table_size;
        def.tuning.hash_cell_size = cell_size;
        ThrownStems stems(FROND_MECHANICS_TET_COROTATIONAL, def);
        int contacts = 0;
        for (int i = 0; i < 40; i++) {
            stems.steps(1);
            contacts += stems.report().plant_contact_count;
        }
        EXPECT_GT(contacts, 0);
        hashes.push_back(stems.hash());
    };
    run(FROND_HASH_LAYOUT_BRUTE_FORCE, 0, 0);
    run(FROND_HASH_LAYOUT_GRID, 0, 0);
    run(FROND_HASH_LAYOUT_GRID, 0, 0.3);
    run(FROND_HASH_LAYOUT_PAPER, 0, 0);
    run(FROND_HASH_LAYOUT_PAPER, 7, 0.05);
    for (const uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

TEST(Plants, OffMeansThatTheyPassThroughEachOther) {
    for (const bool by_world : {false, true}) {
        ThrownStems stems(FROND_MECHANICS_ROD);
        if (by_world)
            must(frond_world_set_effects(stems.world, FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_PLANT_CONTACT)));
        else  // one of the two plants is enough
            must(
                frond_plant_set_effects(stems.plants[0], FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_PLANT_CONTACT)));
        for (int i = 0; i < 30; i++) {
            stems.steps(1);
            EXPECT_EQ(stems.report().plant_contact_count, 0);
        }
        frond_vec3 hit = {};
        must(frond_plant_get_momentum(stems.plants[0], &hit));
        EXPECT_LT(std::abs(hit.z), 1e-12);
    }
}

TEST(Plants, SwitchedOffWhileTheyTouchPassThroughEachOtherFromThenOn) {
    ThrownStems stems(FROND_MECHANICS_ROD);
    for (int i = 0; i < 30 && stems.report().plant_contact_count == 0; i++) stems.steps(1);
    ASSERT_GT(stems.report().plant_contact_count, 0);
    must(frond_world_set_effects(stems.world, FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_PLANT_CONTACT)));
    frond_vec3 before = {}, after = {};
    must(frond_plant_get_momentum(stems.plants[0], &before));
    for (int i = 0; i < 30; i++) {
        stems.steps(1);
        EXPECT_EQ(stems.report().plant_contact_count, 0);
    }
    must(frond_plant_get_momentum(stems.plants[0], &after));
    EXPECT_NEAR(after.z, before.z, 1e-9);
}

TEST(Plants, FarFromEachOtherMoveAsIfAlone) {
    const auto run = [](frond_effects effects) {
        Stand stand;
        stand.make_stems({{-1, {0, 0, 0}, {0.1, 0.5, 0}, 0.01, 0.01}}, 1e7);
        frond_plant_def def = stand.plant_def();
        def.effects = effects;
        stand.add(def, {0, 0, 0});
        stand.add(def, {2, 0, 0}, 1);
        stand.steps(30);
        EXPECT_EQ(stand.report().plant_contact_count, 0);
        return stand.hash();
    };
    EXPECT_EQ(run(FROND_EFFECT_DEFAULT), run(FROND_EFFECT_DEFAULT & ~uint32_t(FROND_EFFECT_PLANT_CONTACT)));
}

TEST(Plants, MayComeAndGoWhileTheyTouch) {
    for (const frond_mechanics mechanics : {FROND_MECHANICS_TET_COROTATIONAL, FROND_MECHANICS_ROD}) {
        Stand stand;
        stand.make_stems({{-1, {0, 0, 0}, {0, 0.4, 0}, 0.02, 0.01}, {0, {0, 0.2, 0}, {0.25, 0.35, 0}, 0.01, 0.006}},
                         1e8);
        frond_plant_def def = stand.plant_def();
        def.mechanics = mechanics;
        def.effects = FROND_EFFECT_DEFAULT | FROND_EFFECT_SELF_CONTACT;
        int touched = 0;
        for (int i = 0; i < 40; i++) {
            if (i % 3 == 0) stand.add(def, {0.06 * (i % 7), 0, 0.03 * (i % 4)}, i);
            if (i % 5 == 4) {
                frond_plant_destroy(stand.plants[size_t(i) % stand.plants.size()]);
                stand.plants.erase(stand.plants.begin() + long(size_t(i) % stand.plants.size()));
            }
            if (i == 20) must(frond_plant_set_mechanics(stand.plants[0], FROND_MECHANICS_TET_LINEAR));
            stand.steps(1);
            touched += stand.report().plant_contact_count > 0;
            for (const frond_plant plant : stand.plants)
                for (const double x : stand.places(plant)) ASSERT_TRUE(std::isfinite(x));
        }
        EXPECT_GT(touched, 20);
    }
}

}  // namespace plants_tests
