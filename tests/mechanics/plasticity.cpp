// Plasticity: the law of a section compared with the integral over its fibres, the plastic curvature of a bent rod,
// creep, and elastic energy that plastic flow never increases.
#include "mechanics/plasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mechanics/mechanics.hpp"
#include "mechanics/rod_elements.hpp"
#include "support/meshes.hpp"

namespace frond::test {
namespace plasticity_tests {

constexpr double NEVER = 1e9;  // time of flow after which creep is complete, so that its rate does not matter [s]

// Returns the moment over that at first yield, by fibres: sum of y clamp(k y) over sum of y^2, with y over the rim's
// distance.
double moment_by_fibres(double k, const std::function<double(double)>& width) {
    constexpr int FIBRES = 20000;
    double moment = 0, first = 0;
    for (int i = 0; i < FIBRES; ++i) {
        const double y = (i + 0.5) / FIBRES;
        moment += width(y) * y * std::min(k * y, 1.0);
        first += width(y) * y * y;
    }
    return moment / first;
}

TEST(SectionLimit, IsTheIntegralOverElasticAndPerfectlyPlasticFibres) {
    for (double k : {0.3, 1.0, 1.01, 1.5, 3.0, 20.0}) {
        EXPECT_NEAR(section_limit({0.01, 0, 0, true}, k), moment_by_fibres(k, [](double) { return 1; }), 1e-5);
        for (double hollow : {0.0, 0.6, 0.95}) {
            const auto width = [&](double y) {
                return std::sqrt(1 - y * y) - std::sqrt(std::max(hollow * hollow - y * y, 0.0));
            };
            EXPECT_NEAR(section_limit({0.01, 0, hollow, false}, k), moment_by_fibres(k, width), 1e-4) << k << hollow;
        }
    }
}

TEST(ElasticShare, FollowsTheSectionHoweverTheLoadingIsCut) {
    const Yield yield = {0.02, 0, 0, true};
    double hardening = 0;
    EXPECT_EQ(elastic_share(yield, 0.0199, NEVER, hardening), 1);
    EXPECT_EQ(hardening, 0);
    double elastic = 0, bent = 0;
    for (int step = 0; step < 100; ++step) {
        bent += 0.001;
        elastic += 0.001;
        elastic *= elastic_share(yield, elastic, NEVER, hardening);
        EXPECT_NEAR(elastic, 0.02 * section_limit(yield, bent / 0.02), 1e-12);
        EXPECT_NEAR(bent - elastic, 0.02 * hardening, 1e-12);
    }
}

// ---- rods -------------------------------------------------------------------------------------------------------

// Returns a straight stem of 20 segments and 1 m with a radius of 1 cm.
Model stem_model(double yield_strain, double creep = 0) {
    Model model;
    Organ organ;
    organ.name = organ.kind = "stem";
    organ.material = plain_material(1000, 1e8, 0.3, 1e-3);
    organ.material.yield_strain = yield_strain;
    organ.material.creep_rate = creep;
    model.organs = {organ};
    model.organ_stiffer = {1};
    for (int i = 0; i <= 20; ++i) {
        model.chain.nodes.push_back({Vec3(0, 0.05 * i, 0), 0.01, i - 1, 0, 0.05 * i, 0.01});
        Section section = {};
        section.length = 0.05;
        section.axis = Vec3::UnitY();
        section.thin = Vec3::UnitX();
        section.area = M_PI * 1e-4;
        section.inertia_thin = section.inertia_wide = M_PI / 4 * 1e-8;
        finish_section(organ, section);
        model.sections.push_back(section);
        model.chain_mass.push_back(0.01);
    }
    return model;
}

// Returns the stem bent to an arc of the given curvature [1/m], as long as at rest.
VecX arc(const Elements& elements, double curvature) {
    VecX x = elements.modelled;
    for (int i = 0; i < elements.node_count; i += 2) {
        const double turn = elements.modelled[3 * i + 1] * curvature, r = 1 / curvature;
        point(x, i) = Vec3(r * (1 - std::cos(turn)), r * std::sin(turn), 0);
        point(x, i + 1) = Vec3(0, 0, -turn);
    }
    return x;
}

std::unique_ptr<Elements> bend_beyond(const Model& model, double curvature, double time) {
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    const auto shared = row.make(model, FROND_MECHANICS_ROD);
    EXPECT_TRUE(row.yields(*shared, arc(*shared, curvature)));
    auto own = row.copy(*shared);
    row.flow(*own, arc(*own, curvature), time);
    return own;
}

TEST(RodPlasticity, KeepsTheSetOfElasticPerfectlyPlasticBending) {
    const double first = 0.02 / 0.01;  // curvature at first yield [1/m]
    for (double k : {1.2, 2.0, 5.0}) {
        const auto own = bend_beyond(stem_model(0.02), k * first, NEVER);
        const double set = k * first - first * section_limit({0.02, 0, 0, false}, k);
        const RodElements& rods = as_rods(*own);
        for (size_t s = 0; s < rods.segments.size(); s++) {
            EXPECT_NEAR(rods.segments[s].set_curvature.norm(), set, 0.01 * k * first);
            EXPECT_NEAR(rods.hardening[s] * first, set, 0.01 * k * first);
        }
        // Its unloaded shape is the arc of that curvature.
        VecX f = VecX::Zero(own->modelled.size());
        mechanics(FROND_MECHANICS_ROD).add_force(*own, arc(*own, set), f);
        VecX whole = VecX::Zero(f.size());
        mechanics(FROND_MECHANICS_ROD).add_force(*own, arc(*own, k * first), whole);
        EXPECT_LT(f.norm(), 0.03 * whole.norm());
    }
}

TEST(RodPlasticity, KeepsNothingBelowItsYield) {
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    const auto shared = row.make(stem_model(0.02), FROND_MECHANICS_ROD);
    const VecX x = arc(*shared, 0.99 * 2);
    EXPECT_FALSE(row.yields(*shared, x));
    const auto own = row.copy(*shared);
    for (int n = 0; n < 100; ++n) row.flow(*own, x, 1.0 / 60);
    for (double value : row.get_plastic(*own)) EXPECT_EQ(value, 0);
    EXPECT_EQ(row.energy(*own, x), row.energy(*shared, x));
    EXPECT_TRUE(row.make(stem_model(0), FROND_MECHANICS_ROD)->yields.empty());
}

TEST(RodPlasticity, KeepsNoStretch) {
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    const auto shared = row.make(stem_model(0.02), FROND_MECHANICS_ROD);
    VecX x = shared->modelled;
    for (int i = 0; i < shared->node_count; i += 2) point(x, i) *= 1.5;
    EXPECT_FALSE(row.yields(*shared, x));
    const auto own = row.copy(*shared);
    row.flow(*own, x, NEVER);
    EXPECT_EQ(row.energy(*own, x), row.energy(*shared, x));
}

TEST(RodPlasticity, CreepsAtItsRateTowardsTheYield) {
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    const double first = 2, curvature = 1.4 * first;
    auto own = bend_beyond(stem_model(0.02, 0.5), curvature, 1e-9);
    const VecX x = arc(*own, curvature);
    const auto excess = [&] { return (curvature - as_rods(*own).segments[10].set_curvature.norm()) / first - 1; };
    const double start = excess();
    EXPECT_GT(start, 0.2);
    for (int n = 0; n < 120; ++n) row.flow(*own, x, 1.0 / 60);
    EXPECT_NEAR(excess(), start * std::exp(-0.5 * 2), 0.01 * start);
    // The result does not depend on the step's length.
    auto other = bend_beyond(stem_model(0.02, 0.5), curvature, 1e-9);
    row.flow(*other, x, 2);
    EXPECT_NEAR(row.energy(*other, x), row.energy(*own, x), 1e-3 * row.energy(*own, x));
}

TEST(RodPlasticity, BentToAndFroAThousandTimesItHoldsNoMoreEnergy) {
    const Mechanics& row = mechanics(FROND_MECHANICS_ROD);
    const auto shared = row.make(stem_model(0.02, 0.1), FROND_MECHANICS_ROD);
    const auto own = row.copy(*shared);
    double most = 0;
    for (int cycle = 0; cycle < 1000; ++cycle)
        for (double k : {5.0, -5.0}) {
            const VecX x = arc(*own, k * 2);
            const double before = row.energy(*own, x);
            row.flow(*own, x, 1.0 / 60);
            const double after = row.energy(*own, x);
            ASSERT_LE(after, before * (1 + 1e-12));
            if (cycle == 0) most = std::max(most, after);
            ASSERT_LE(after, 1.8 * most) << "cycle " << cycle;
        }
    for (double value : row.get_plastic(*own)) ASSERT_TRUE(std::isfinite(value));
}

// ---- tets -------------------------------------------------------------------------------------------------------

// Share of a stretched bar's energy that is volumetric and does not yield: (1 - 2 nu) / 3.
constexpr double OF_VOLUME = 0.4 / 3;

struct EveryTet : testing::TestWithParam<std::pair<int, int>> {
    const frond_mechanics which = frond_mechanics(GetParam().first);
    const Mechanics& row = mechanics(which, GetParam().second);
    Model box(double yield_strain, double creep = 0) const {
        Model model = box_model(1, 1, 2, {0.1, 0.1, 0.2}, {1000, 1e6, 0.3});
        model.organs.front().material.yield_strain = yield_strain;
        model.organs.front().material.creep_rate = creep;
        return model;
    }
    // Returns a bar stretched by s along z and contracted by nu s across.
    VecX pulled(const Elements& elements, double s) const {
        VecX x = elements.modelled;
        for (int i = 0; i < elements.node_count; ++i)
            point(x, i) = point(x, i).cwiseProduct(Vec3(1 - 0.3 * s, 1 - 0.3 * s, 1 + s));
        return x;
    }
};
INSTANTIATE_TEST_SUITE_P(Tets, EveryTet,
                         testing::Values(std::pair(0, 1), std::pair(1, 1), std::pair(2, 1), std::pair(0, 2),
                                         std::pair(1, 2), std::pair(2, 2)),
                         [](const auto& info) {
                             return std::string(mechanics(frond_mechanics(info.param.first)).name) +
                                    (info.param.second == 2 ? "_quadratic" : "");
                         });

TEST_P(EveryTet, KeepsWhatIsBeyondTheYieldOfAPulledBar) {
    const auto shared = row.make(box(0.01), which);
    EXPECT_FALSE(row.yields(*shared, pulled(*shared, 0.0098)));
    EXPECT_TRUE(row.yields(*shared, pulled(*shared, 0.0102)));
    const auto own = row.copy(*shared);
    const VecX x = pulled(*own, 0.03);
    const double energy = row.energy(*own, x);
    row.flow(*own, x, NEVER);
    // The elastic strain is now what the section's law leaves; at three times the yield strain this is 1.60 of it.
    const double left = section_limit({0.01, 0, 0, false}, 3) / 3;
    EXPECT_NEAR(row.energy(*own, x) / energy, OF_VOLUME + (1 - OF_VOLUME) * left * left, 0.03);
    // A second flow changes nothing but rounding.
    const double after = row.energy(*own, x);
    row.flow(*own, x, NEVER);
    EXPECT_NEAR(row.energy(*own, x), after, 1e-3 * after);
}

TEST_P(EveryTet, ForceStaysMinusTheGradientOfEnergy) {
    Dice dice(3);
    const auto shared = row.make(box(0.01), which);
    const auto own = row.copy(*shared);
    row.flow(*own, own->modelled + dice.vector(own->modelled.size(), 0.02), NEVER);
    const VecX x = own->modelled + dice.vector(own->modelled.size(), 0.01);
    VecX f = VecX::Zero(x.size());
    row.add_force(*own, x, f);
    for (Eigen::Index i = 0; i < x.size(); i += 5) {
        constexpr double H = 1e-6;
        VecX left = x, right = x;
        left[i] -= H;
        right[i] += H;
        EXPECT_NEAR(f[i], -(row.energy(*own, right) - row.energy(*own, left)) / (2 * H), 1e-5 * f.norm());
    }
}

TEST_P(EveryTet, ThrownAboutAThousandTimesEnergyNeverGrowsByIt) {
    Dice dice(4);
    const auto shared = row.make(box(0.02, 3), which);
    const auto own = row.copy(*shared);
    for (int n = 0; n < 1000; ++n) {
        const VecX x = own->modelled + dice.vector(own->modelled.size(), n % 2 ? 0.01 : 0.06);
        const double before = row.energy(*own, x);
        row.flow(*own, x, 1.0 / 60);
        ASSERT_LE(row.energy(*own, x), before * (1 + 1e-12));
        ASSERT_TRUE(std::isfinite(row.energy(*own, x)));
    }
}

TEST_P(EveryTet, CreepsAtItsRateTowardsTheYield) {
    const auto shared = row.make(box(0.01, 0.5), which);
    const auto own = row.copy(*shared);
    const VecX x = pulled(*own, 0.014);
    const auto strain = [&] {
        const double square = 2 * row.energy(*own, x) / (1e6 * 0.1 * 0.1 * 0.2);
        return std::sqrt((square - OF_VOLUME * 0.014 * 0.014) / (1 - OF_VOLUME));
    };
    row.flow(*own, x, 1e-9);
    const double start = strain() - 0.01;
    EXPECT_GT(start, 0.002);
    for (int n = 0; n < 120; ++n) row.flow(*own, x, 1.0 / 60);
    EXPECT_NEAR(strain() - 0.01, start * std::exp(-0.5 * 2), 0.06 * start);
}

TEST_P(EveryTet, TakesBackTheNumbersThatItGave) {
    Dice dice(5);
    const auto shared = row.make(box(0.01), which);
    const auto own = row.copy(*shared), other = row.copy(*shared);
    const VecX x = own->modelled + dice.vector(own->modelled.size(), 0.03);
    row.flow(*own, x, NEVER);
    std::vector<double> values = row.get_plastic(*own);
    row.set_plastic(*other, values);
    EXPECT_EQ(row.energy(*other, x), row.energy(*own, x));
    values[0] *= 2;
    EXPECT_ANY_THROW(row.set_plastic(*other, values));
    values.pop_back();
    EXPECT_ANY_THROW(row.set_plastic(*other, values));
    EXPECT_EQ(row.energy(*other, x), row.energy(*own, x));
}

}  // namespace plasticity_tests

}  // namespace frond::test
