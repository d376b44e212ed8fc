// Air: the drag of a pole, of falling bodies and of bending blades agrees with formulas and published values; still air
// only removes energy; a gale makes no step unstable; switched off, air has no effect at all.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/rotation.hpp"
#include "modelling/build.hpp"
#include "plant/plant_step.hpp"
#include "solve/integrator.hpp"
#include "support/materials.hpp"
#include "support/model_def.hpp"
#include "support/soups.hpp"

namespace frond::test {
namespace air_tests {

constexpr double DENSITY = 1.2, VISCOSITY = 1.5e-5;

frond_wind_def wind_def(double speed, double turbulence = 0) {
    frond_wind_def def = {};
    def.velocity = {speed, 0, 0};
    def.turbulence = turbulence;
    def.length_scale = 10;
    def.seed = 3;
    def.profile = FROND_WIND_PROFILE_UNIFORM;
    def.reference_height = 10;
    def.roughness = 0.03;
    def.density = DENSITY;
    return def;
}

// Returns a def with some twenty capsules along L, one material and no gravity.
frond_model_def long_def(double L, const frond_organ_material& organ) {
    frond_model_def def = model_def();
    def.capsule_height = L / 20;
    def.cage_size = L / 10;
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    def.organs = &organ;
    def.organ_count = 1;
    return def;
}

// Returns an upright sheet with its normal along x.
std::shared_ptr<const Model> sheet_model(const char* name, double L, double W, const Material& material) {
    Surface surface;
    add_sheet(surface, 2, 40, [&](double s, double t) { return Vec3(0, t * L, (s - 0.5) * W); });
    surface.parts[0].name = name;
    const frond_organ_material organ = {"blade", material};
    return build_from_surface(std::move(surface), long_def(L, organ));
}

std::shared_ptr<const Model> stem_model(double L, double r, const Material& material) {
    const frond_stem stem = {-1, {0, 0, 0}, {0, L, 0}, r, r};
    const frond_organ_material organ = {"stem", material};
    return build_from_stems(&stem, 1, long_def(L, organ));
}

struct Blown {
    std::unique_ptr<Plant> plant;
    std::unique_ptr<Wind> wind;
    Surroundings surroundings;

    Blown(const std::shared_ptr<const Model>& model, frond_mechanics which, const frond_wind_def& air,
          frond_integrator integrator = FROND_INTEGRATOR_BDF2, double root_height = 0) {
        frond_plant_def def = plant_def(which);
        def.integrator = integrator;
        def.root_height = root_height;
        def.effects = FROND_EFFECT_ALL & ~uint32_t(FROND_EFFECT_PLASTICITY);
        plant = create_plant(model, def);
        wind = make_wind(air);
        surroundings.wind = wind.get();
    }
    void lay_down() { plant->rotation = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()); }
    void step(double h) {
        pass_time(*wind, h);
        surroundings.time += h;
        step_plant(*plant, surroundings, h);
    }
    void run(double time, double h) {
        for (int i = 0; i < int(std::lround(time / h)); ++i) step(h);
    }
    double energy() const {
        const frond_energy e = energy_of(*plant, surroundings.gravity);
        return e.kinetic + e.elastic + e.gravity;
    }
    Vec3 mean_velocity() const {
        const VecX& mass = node_mass_of(*plant->system);
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < mass.size(); ++i) sum += mass[i] * point(plant->state.motion.v, i);
        return plant->rotation * Vec3(sum / mass.sum());
    }
};

double chain_length(const Model& model) {
    double sum = 0;
    for (size_t i = 0; i < model.sections.size(); ++i)
        if (model.chain.nodes[i].parent >= 0) sum += model.sections[i].length;
    return sum;
}

Material stiff(double drag = 0) {
    Material material = plain_material(1000, 1e11, 0.3, 1e-3);
    material.drag = drag;
    return material;
}

// ---- one segment -----------------------------------------------------------------------------------------------

AirPiece piece_of(AirShape shape, double coefficient, const Vec3& area) {
    AirPiece piece = {};
    piece.shape = shape;
    piece.coefficient = coefficient;
    piece.area = area;
    piece.size = 0.04;
    piece.skin = 0;  // skin friction is tested separately
    piece.chord_along = 0.5;
    piece.chord_across = 0.1;
    return piece;
}
Vec3 force_on(const AirPiece& piece, const Mat3& frame, const Vec3& velocity) {
    return air_resistance(piece, frame, velocity, DENSITY) * velocity;
}
const Mat3 FRAME = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();

TEST(Resistance, OfASheetIsPressureAlongItsNormal) {
    const AirPiece sheet = piece_of(AirShape::SHEET, 1.3, {0, 0.02, 0});
    const Vec3 velocity = FRAME * Vec3(3, -4, 5);
    EXPECT_NEAR((force_on(sheet, FRAME, velocity) + 0.5 * DENSITY * 1.3 * 0.02 * 16 * FRAME.col(1)).norm(), 0, 1e-12);
}

TEST(Resistance, OfARoundPieceIsDragAcrossItsAxisOnTheAreaThatIsSeen) {
    const AirPiece round = piece_of(AirShape::ROUND, 1.1, {0, 0.03, 0.01});
    for (double angle : {0.0, 0.6, M_PI / 2}) {
        const Vec3 across(0, 5 * std::cos(angle), 5 * std::sin(angle));
        const double seen = std::hypot(0.03 * std::cos(angle), 0.01 * std::sin(angle));
        const Vec3 force = force_on(round, FRAME, FRAME * (across + Vec3(7, 0, 0)));
        EXPECT_NEAR((force - 0.5 * DENSITY * 1.1 * seen * 5 * (FRAME * across)).norm(), 0, 1e-12);
    }
}

TEST(Resistance, OfACompactPieceIsDragAlongTheFlow) {
    const AirPiece compact = piece_of(AirShape::COMPACT, 0.5, {0.01, 0.03, 0.02});
    const Vec3 velocity(1, 2, -2), local = FRAME.transpose() * velocity;
    const double seen = Vec3(0.01 * local[0], 0.03 * local[1], 0.02 * local[2]).norm() / 3;
    EXPECT_NEAR((force_on(compact, FRAME, velocity) - 0.5 * DENSITY * 0.5 * seen * 3 * velocity).norm(), 0, 1e-12);
}

// White 1991: at Re = 1000, 1.1 for a cylinder and 0.61 for a sphere; very slow spheres obey Stokes.
TEST(Resistance, FollowsTheReynoldsNumber) {
    const double slow = 1000 * VISCOSITY / 0.04;
    const AirPiece cylinder = piece_of(AirShape::ROUND, 0, {0, 0.04, 0.04});
    const AirPiece sphere = piece_of(AirShape::COMPACT, 0, Vec3::Constant(M_PI * 0.02 * 0.02));
    const double pressure = 0.5 * DENSITY * slow * slow;
    EXPECT_NEAR(force_on(cylinder, FRAME, slow * FRAME.col(1)).norm() / (pressure * 0.04), 1.1, 1e-9);
    EXPECT_NEAR(force_on(sphere, FRAME, slow * FRAME.col(0)).norm() / (pressure * M_PI * 4e-4), 0.608, 1e-3);
    const double stokes = 3 * M_PI * DENSITY * VISCOSITY * 0.04;
    EXPECT_NEAR(air_resistance(sphere, FRAME, Vec3(1e-8, 0, 0), DENSITY)(0, 0) / stokes, 1, 0.05);
    EXPECT_TRUE(air_resistance(sphere, FRAME, Vec3::Zero(), DENSITY).isZero(0));
}

// 1.328 / sqrt Re for each side (Blasius), with the flow along the blade or across it.
TEST(Resistance, OfTheSkinIsThatOfAFlatPlate) {
    AirPiece sheet = piece_of(AirShape::SHEET, 1.3, {0, 0.02, 0});
    sheet.skin = 0.04;
    const double along = 0.5 * DENSITY * 36 * 0.04 * 1.328 / std::sqrt(6 * 0.5 / VISCOSITY);
    const double across = 0.5 * DENSITY * 36 * 0.04 * 1.328 / std::sqrt(6 * 0.1 / VISCOSITY);
    EXPECT_NEAR((force_on(sheet, FRAME, 6 * FRAME.col(0)) - along * FRAME.col(0)).norm(), 0, 1e-12);
    EXPECT_NEAR((force_on(sheet, FRAME, 6 * FRAME.col(2)) - across * FRAME.col(2)).norm(), 0, 1e-12);
}

// ---- plants ----------------------------------------------------------------------------------------------------

struct EveryAir : testing::TestWithParam<int> {
    const frond_mechanics which = frond_mechanics(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Mechanics, EveryAir,
                         testing::Values(int(FROND_MECHANICS_TET_COROTATIONAL), int(FROND_MECHANICS_TET_NEOHOOKEAN),
                                         int(FROND_MECHANICS_ROD)),
                         [](const auto& info) { return mechanics(frond_mechanics(info.param)).name; });

TEST_P(EveryAir, PoleHasTheDragOfTheFormulaAndItsRootHoldsIt) {
    Blown pole(stem_model(1, 0.02, stiff(1.1)), which, wind_def(10));
    pole.plant->input.settings.mass_damping = 50;
    pole.run(1, 1.0 / 120);
    const double known = 0.5 * DENSITY * 1.1 * 0.04 * 1 * 100;
    const Vec3 force = air_force(*pole.plant);
    EXPECT_NEAR(force.x() / known, 1, 0.01);
    EXPECT_NEAR(force.y() / known, 0, 0.01);
    EXPECT_NEAR(force.z() / known, 0, 0.01);

    // The reaction at the root balances the forces of its elements and of the air.
    VecX f = VecX::Zero(pole.plant->state.motion.x.size());
    mechanics(which).add_force(elements_of(*pole.plant->system), pole.plant->state.motion.x, f);
    add_attachment_force(pole.plant->step.loads->drags[0].attachment, pole.plant->state.motion.x, Vec3::Zero(), f);
    for (const Drag& drag : pole.plant->step.loads->drags)
        add_attachment_force(drag.attachment, pole.plant->state.motion.x, drag.force, f);
    Vec3 reaction = Vec3::Zero();
    const int next = pole.plant->follow ? 2 : 1;
    for (int i = 0; i < f.size() / 3; i += next)
        if (pole.plant->state.motion.pinned[size_t(i)]) reaction -= point(f, i);
    EXPECT_NEAR(reaction.x() / known, -1, 0.01);
}

// A plate falls at sqrt(2 m g / (rho Cd A)), a stem with the coefficient of its own Reynolds number.
TEST_P(EveryAir, FreePlateAndStemFallWithTheirTerminalVelocities) {
    Material leaf = plain_material(900, 1e11, 0.3, 0.5e-3);  // stiff, or its tips would bend away
    leaf.drag = 1.5;
    Blown plate(sheet_model("leaf", 0.8, 0.08, leaf), which, wind_def(0), FROND_INTEGRATOR_BDF2, -1);
    plate.lay_down();
    plate.surroundings.gravity = {0, -GRAVITY, 0};
    plate.run(0.9, 1.0 / 120);  // four times the settling time; later it begins to glide
    const double weight = node_mass_of(*plate.plant->system).sum() * GRAVITY;
    EXPECT_NEAR(-plate.mean_velocity().y() / std::sqrt(2 * weight / (DENSITY * 1.5 * 0.8 * 0.08)), 1, 0.03);

    Blown stem(stem_model(0.6, 0.01, plain_material(50, 1e9, 0.3, 1e-3)), which, wind_def(0), FROND_INTEGRATOR_BDF2,
               -1);
    stem.lay_down();
    stem.surroundings.gravity = {0, -GRAVITY, 0};
    stem.run(6, 1.0 / 120);
    const double v = -stem.mean_velocity().y(), Re = v * 0.02 / VISCOSITY;
    const double drag = 0.5 * DENSITY * (1 + 10 * std::pow(Re, -2.0 / 3)) * 0.02 * 0.6 * v * v;
    EXPECT_NEAR(drag / (node_mass_of(*stem.plant->system).sum() * GRAVITY), 1, 0.03);
}

// Drag of a bent blade over that of a stiff one, by the Cauchy number; the values follow from the differential equation
// of Gosselin, de Langre, Machado-Almeida 2010 (tests/study/known.cpp solves it).
struct Reconfigured {
    double C, R;
};
constexpr Reconfigured PUBLISHED[] = {{1, 0.9748}, {10, 0.5236}, {100, 0.1918}, {1000, 0.0890}};

TEST(Reconfiguration, OfABladeOfRodsFollowsThePublishedCurve) {
    constexpr double CD = 1.8;
    Material leaf = plain_material(900, 1e9, 0.3, 2e-3);
    leaf.drag = CD;
    const auto model = sheet_model("leaf", 0.8, 0.1, leaf);
    const double L = chain_length(*model), W = 0.1, EI = model->sections.back().bending_thin();
    EXPECT_NEAR(L, 0.8, 0.02);
    EXPECT_NEAR(EI, 1e9 * W * 8e-9 / 12, 0.02 * EI);
    for (const Reconfigured& known : PUBLISHED) {
        const double speed = std::sqrt(known.C * EI / (0.5 * DENSITY * CD * W * L * L * L));
        Blown blade(model, FROND_MECHANICS_ROD, wind_def(speed));
        blade.plant->input.settings.mass_damping = 10;
        blade.run(3, 1.0 / 480);
        const double R = air_force(*blade.plant).x() / (0.5 * DENSITY * CD * W * L * speed * speed);
        EXPECT_NEAR(R / known.R, 1, 0.05) << "C = " << known.C << ", R = " << R;
    }
}

TEST_P(EveryAir, StillAirOnlyTakesEnergyFromASway) {
    const auto model = sheet_model("leaf", 0.5, 0.06, plain_material(100, 1e8, 0.3, 1e-3));
    Blown with(model, which, wind_def(0), FROND_INTEGRATOR_TR_BDF2),
        without(model, which, wind_def(0), FROND_INTEGRATOR_TR_BDF2);
    without.surroundings.wind = nullptr;
    for (Blown* one : {&with, &without}) {
        one->plant->input.settings.newton_iterations = 3;
        VecX v = VecX::Zero(3 * node_count_of(*one->plant));
        for (int i = 0; i < node_count_of(*one->plant); ++i) {
            const double y = cage_places(*one->plant)[3 * i + 1];
            if (!one->plant->input.pinned[size_t(i)]) v[3 * i] = 8 * y * y;
        }
        set_state(*one->plant, nullptr, v.data());
    }
    const double start = with.energy();
    for (int n = 0; n < 240; ++n) {
        with.step(1.0 / 240);
        without.step(1.0 / 240);
        double power = 0;
        for (const Drag& drag : with.plant->step.loads->drags) {
            const Vec3 velocity =
                attachment_velocity(drag.attachment, with.plant->state.motion.x, with.plant->state.motion.v);
            power += velocity.dot(drag.force - drag.damping * velocity);
        }
        EXPECT_LE(power, 0) << "step " << n;
        EXPECT_LE(with.energy(), 1.001 * start) << "step " << n;
    }
    EXPECT_LT(with.energy(), 0.5 * without.energy());
}

// A leaf of grass in gusts around 60 m/s, at steps of 1/30 s, is not stretched.
TEST_P(EveryAir, LightLeafInAGaleIsStableAtLongSteps) {
    const Material leaf = *material_preset("grass_blade");
    const auto model = sheet_model("leaf", 0.8, 0.06, leaf);
    for (frond_integrator method : {FROND_INTEGRATOR_IMPLICIT_EULER, FROND_INTEGRATOR_BDF2}) {
        Blown blade(model, which, wind_def(60, 0.3), method);
        blade.plant->input.settings.mass_damping = 0.1;
        blade.plant->input.settings.stiffness_damping = 0.002;
        blade.surroundings.gravity = {0, -GRAVITY, 0};
        double mean = 0;
        for (int n = 0; n < 60; ++n) {
            blade.step(1.0 / 30);
            EXPECT_EQ(blade.plant->trouble & FROND_TROUBLE_REWOUND, 0u) << integrator(method).name << " step " << n;
            // The wind sets in at once, so that the first steps overshoot.
            const double reach = (n < 10 ? 2 : 1.5) * 0.8;
            for (const Vec3& p : blade.plant->view.chain_positions) ASSERT_LT(p.norm(), reach) << "step " << n;
            mean += blade.plant->view.chain_positions.back().x() / 60;
        }
        EXPECT_GT(mean, 0.25) << integrator(method).name;
    }
}

// Returns the length of the arc between a chain's node and its parent, as bent as they are turned, over that at rest.
double arc_over_rest(const Plant& plant, const std::vector<ChainNode>& nodes, int node) {
    const int parent = nodes[size_t(node)].parent;
    const VecX& x = plant.state.motion.x;
    const Vec3 rest = nodes[size_t(node)].position - nodes[size_t(parent)].position;
    const auto along = [&](int i) { return Vec3(rotation_of<double>(point(x, 2 * i + 1)) * rest); };
    const double half = 0.5 * std::acos(std::clamp(along(parent).dot(along(node)) / rest.squaredNorm(), -1.0, 1.0));
    const double chord = (point(x, 2 * node) - point(x, 2 * parent)).norm() / rest.norm();
    return half > 1e-6 ? chord * half / std::sin(half) : chord;
}

// A leaf that wind turns by most of a radian in a step.
TEST(Air, BlownAboutALeafKeepsItsLengthInOneSolve) {
    const auto model = sheet_model("leaf", 0.8, 0.06, *material_preset("grass_blade"));
    const std::vector<ChainNode>& nodes = model->chain.nodes;
    for (const double speed : {5, 11, 13, 25}) {
        Blown blade(model, FROND_MECHANICS_ROD, wind_def(speed));
        for (int n = 0; n < 60; ++n) {
            blade.step(1.0 / 60);
            if (speed < 12) {
                EXPECT_EQ(blade.plant->trouble, 0u) << speed << " m/s, step " << n;
            }
            for (int i = 1; i < int(nodes.size()); ++i)
                EXPECT_NEAR(arc_over_rest(*blade.plant, nodes, i), 1, 0.02) << speed << " m/s, step " << n;
        }
    }
}

// ---- effects ---------------------------------------------------------------------------------------------------

TEST(Air, WithoutOneOfBothEffectsTheOtherHalfIsLeftOut) {
    const auto model = stem_model(0.6, 0.01, plain_material(100, 1e7, 0.3, 1e-3));
    // Wind alone pushes, however fast the plant moves; drag alone ignores the wind.
    Blown pushed(model, FROND_MECHANICS_ROD, wind_def(5)), dragged(model, FROND_MECHANICS_ROD, wind_def(5));
    pushed.plant->input.effects &= ~uint32_t(FROND_EFFECT_AIR_DRAG);
    dragged.plant->input.effects &= ~uint32_t(FROND_EFFECT_WIND);
    pushed.step(1.0 / 60);
    dragged.step(1.0 / 60);
    EXPECT_GT(pushed.plant->view.chain_positions.back().x(), 0);
    for (const Drag& drag : pushed.plant->step.loads->drags) EXPECT_TRUE(drag.damping.isZero(0));
    EXPECT_LT((dragged.plant->state.motion.x - elements_of(*dragged.plant->system).modelled).norm(), 1e-12);
    EXPECT_TRUE(dragged.plant->step.loads->drags.empty());
}

TEST(Air, OffOrAbsentChangesNoBitAndAllocatesNothing) {
    const auto model = stem_model(0.6, 0.01, plain_material(100, 1e7, 0.3, 1e-3));
    const auto run = [&](bool air, frond_effects without) {
        Blown blown(model, FROND_MECHANICS_ROD, wind_def(5));
        if (!air) blown.surroundings.wind = nullptr;
        blown.plant->input.effects &= ~without;
        blown.surroundings.gravity = {1, -GRAVITY, 0};
        blown.run(0.5, 1.0 / 60);
        EXPECT_EQ(blown.plant->state.air == nullptr, !air || without != 0);
        EXPECT_EQ(air_force(*blown.plant).norm() == 0, !air || without != 0);
        return blown.plant->state.motion.x;
    };
    const VecX none = run(false, 0);
    EXPECT_EQ(run(true, FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG), none);
    EXPECT_NE(run(true, 0), none);
    EXPECT_EQ(run(true, 0), run(true, 0));
}

TEST(Air, IsSwitchedWhileAPlantStands) {
    const auto model = stem_model(0.6, 0.01, plain_material(100, 1e7, 0.3, 1e-3));
    Blown blown(model, FROND_MECHANICS_ROD, wind_def(5));
    blown.run(0.2, 1.0 / 60);
    EXPECT_GT(air_force(*blown.plant).x(), 0);
    set_mechanics(*blown.plant, FROND_MECHANICS_TET_COROTATIONAL);
    blown.run(0.2, 1.0 / 60);
    EXPECT_GT(air_force(*blown.plant).x(), 0);
    blown.plant->input.effects &= ~uint32_t(FROND_EFFECT_WIND | FROND_EFFECT_AIR_DRAG);
    blown.step(1.0 / 60);
    EXPECT_EQ(air_force(*blown.plant).norm(), 0);
}

// A rotated plant feels the world's wind.
TEST(Air, BlowsInTheFrameOfTheWorld) {
    const auto model = stem_model(0.6, 0.01, plain_material(100, 1e8, 0.3, 1e-3));
    Blown straight(model, FROND_MECHANICS_ROD, wind_def(5)), turned(model, FROND_MECHANICS_ROD, wind_def(5));
    turned.plant->rotation = Eigen::AngleAxisd(2, Vec3::UnitY());
    turned.plant->position = {0, 3, 0};
    straight.run(0.5, 1.0 / 60);
    turned.run(0.5, 1.0 / 60);
    EXPECT_NEAR((air_force(*turned.plant) - air_force(*straight.plant)).norm(), 0,
                1e-6 * air_force(*straight.plant).norm());
}

}  // namespace air_tests

}  // namespace frond::test
