// Stems tied to a stake, as rods: what lies between two ties is held at both ends, and stays whole.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "io/import_files.hpp"
#include "support/lengths.hpp"
#include "support/materials.hpp"
#include "support/meshes.hpp"
#include "support/stand.hpp"

namespace frond::test {
namespace tied_stem_tests {

constexpr double BESIDE = 0.03;  // from the stake's axis to the stem's [m]
constexpr double STAKE = 0.01;   // its radius [m]

// Writes round tubes of 8 sides and rings of 5 cm into an OBJ file.
struct Tubes {
    std::string text;
    int vertices = 0;

    // Returns its first vertex.
    int add(const std::string& name, double x, double height, double radius) {
        text += "o " + name + "\n";
        const int rings = int(std::lround(height / 0.05)), first = vertices + 1;
        for (int ring = 0; ring <= rings; ring++)
            for (int k = 0; k < 8; k++)
                vertex(x + radius * std::cos(k * M_PI / 4), 0.05 * ring, radius * std::sin(k * M_PI / 4));
        for (int ring = 0; ring < rings; ring++)
            for (int k = 0; k < 8; k++) {
                const int a = first + 8 * ring + k, b = first + 8 * ring + (k + 1) % 8;
                face(a, a + 8, b);
                face(b, a + 8, b + 8);
            }
        return first;
    }
    // A triangle from one tube's corner to the other's; or a band with corners of its own, 0.5 mm off those tubes.
    void tie(int tube, int other, double height, double radius, bool is_loose) {
        text += "o tie_" + std::to_string(vertices) + "\n";
        const int corner = 8 * int(std::lround(height / 0.05)), first = vertices + 1;
        vertex(BESIDE / 2, height, 0.02);
        if (!is_loose) return face(tube + corner, other + corner, first);
        for (const double y : {height - 0.01, height + 0.01}) {
            vertex(STAKE + 5e-4, y, 0);
            vertex(BESIDE - radius - 5e-4, y, 0);
        }
        face(first + 1, first + 2, first + 3);
        face(first + 2, first + 4, first + 3);
    }

private:
    void vertex(double x, double y, double z) {
        text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
        vertices++;
    }
    void face(int a, int b, int c) {
        text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    }
};

struct Tied {
    double lower, upper, radius, young;  // heights of the ties [m], of the stem [m], [Pa]
    bool is_loose;                       // ties share no corners with stake and stem
    double stiffness() const { return young * M_PI * std::pow(radius, 4) / 4; }  // EI [N m^2]
};

// A stem of 1 m beside a stake that hardly bends.
struct TiedStem : Stand {
    frond_plant plant = {};
    std::vector<double> edges;
    double at = 0;  // height of the node that was pulled [m]

    explicit TiedStem(const Tied& tied) : Stand(weightless(H)) {
        Tubes tubes;
        const int stake = tubes.add("stake", 0, 1.05, STAKE), stalk = tubes.add("stem", BESIDE, 1, tied.radius);
        for (const double height : {tied.lower, tied.upper})
            tubes.tie(stake, stalk, height, tied.radius, tied.is_loose);
        const files::Folder folder;
        frond_organ_material organs[] = {{"stem", plain_material(1000, tied.young, 0.3, 1e-3)},
                                         {"support", plain_material(1000, 1e12, 0.3, 1e-3)}};
        frond_model_def def = frond_default_model_def();
        def.rest = FROND_REST_WITHOUT_GRAVITY;
        def.capsule_height = 0.05;
        def.scale = 1;
        def.organs = organs;
        def.organ_count = 2;
        must(frond_model_load(folder.write("tied.obj", tubes.text).c_str(), &def, &model));
        frond_plant_def own = plant_def();
        own.mechanics = FROND_MECHANICS_ROD;
        own.mass_damping = 5;
        plant = add(own, {0, 0, 0});
        edges = edge_lengths(plant);
    }
    // Returns how far the node of the stem that is nearest to a height is drawn aside by a force that lasts [m].
    double drawn_aside(double height, double force) {
        frond_chain_view chain;
        must(frond_model_get_chain(model, &chain));
        int pulled = 0;
        double nearest = INFINITY;
        for (int i = 0; i < chain.node_count; i++) {
            const double away = std::hypot(chain.nodes[3 * i] - BESIDE, chain.nodes[3 * i + 1] - height);
            if (away < nearest) nearest = away, pulled = i;
        }
        at = chain.nodes[3 * pulled + 1];
        std::vector<frond_chain_state> states(size_t(chain.node_count));
        for (int step = 0; step < 600; step++) {
            must(frond_plant_add_chain_load(plant, pulled, {0, 0, force}, {0, 0, 0}));
            steps(1);
        }
        must(frond_plant_get_chain_state(plant, states.data(), chain.node_count));
        return states[size_t(pulled)].position.z - chain.nodes[3 * pulled + 2];
    }
    double most_torn() const {
        const std::vector<double> now = edge_lengths(plant);
        double most = 0;
        for (size_t i = 0; i < now.size(); i++) most = std::max(most, now[i] / edges[i]);
        return most;
    }
};

// Returns random ties.
Tied make_tied(Dice& dice) {
    const double lower = 0.05 * std::round(dice.uniform(3, 6));
    return {lower, lower + 0.05 * std::round(dice.uniform(7, 11)), dice.uniform(0.006, 0.01), dice.uniform(1e8, 1e9),
            dice.uniform(0, 1) < 0.5};
}

// Near its upper tie it gives way as a beam on two supports at most, and no less than half of one that is clamped.
TEST(TiedStem, IsHeldAtBothEndsOfWhatLiesBetweenTwoTies) {
    for (uint64_t seed = 0; seed < 8; seed++) {
        Dice dice{seed};
        const Tied tied = make_tied(dice);
        const double span = tied.upper - tied.lower, force = 0.03 * tied.stiffness() / (span * span);
        TiedStem stem(tied);
        const double aside = stem.drawn_aside(tied.lower + 0.75 * span, force);
        const double a = stem.at - tied.lower, b = tied.upper - stem.at, load = force / (3 * tied.stiffness());
        EXPECT_LT(aside, load * a * a * b * b / span) << "seed " << seed;
        EXPECT_GT(aside, 0.5 * load * std::pow(a * b / span, 3)) << "seed " << seed;
    }
}

TEST(TiedStem, StaysWholeWhenItIsPulledFarAside) {
    for (uint64_t seed = 0; seed < 4; seed++) {
        Dice dice{seed};
        const Tied tied = make_tied(dice);
        const double span = tied.upper - tied.lower;
        TiedStem stem(tied);
        const double aside = stem.drawn_aside(tied.lower + 0.5 * span, 10 * tied.stiffness() / (span * span));
        EXPECT_GT(aside, 0.03 * span) << "seed " << seed;
        EXPECT_LT(stem.most_torn(), 1.3) << "seed " << seed;
        stem.steps(300);
        EXPECT_LT(stem.most_torn(), 1.05) << "seed " << seed;
    }
}

}  // namespace tied_stem_tests
}  // namespace frond::test
