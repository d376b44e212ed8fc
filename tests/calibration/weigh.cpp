// Cage and chain weigh what the surface holds, organ by organ and where it is, with every mechanics.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "cage/cage_patches.hpp"
#include "cage/tet_geometry.hpp"
#include "calibration/calibration.hpp"
#include "calibration/weigh.hpp"
#include "modelling/build.hpp"
#include "solve/solve.hpp"
#include "support/model_def.hpp"

namespace frond::test {
namespace weigh_tests {

// A mass and its centre.
struct Body {
    double mass = 0;             // [kg]
    Vec3 moment = Vec3::Zero();  // mass times position [kg m]
    void add(double more, const Vec3& place) {
        mass += more;
        moment += more * place;
    }
    Vec3 centre() const { return moment / mass; }
};

double density_of(const Organ& organ) {
    return organ.material.density * (1 - hole_share(organ));
}

std::vector<int> organs_of_triangles(const Surface& surface) {
    std::vector<int> organs(surface.triangles.size());
    for (const Part& part : surface.parts)
        std::fill_n(organs.begin() + part.first_triangle, part.triangle_count, part.organ);
    return organs;
}

// Returns the organs as the surface shows them: what closed patches enclose, and other patches' area by thickness.
std::vector<Body> bodies_of_surface(const Model& model) {
    const std::vector<int> organs = organs_of_triangles(model.surface);
    const Patches patches = make_patches(model.topology, organs, model.organs);
    std::vector<Body> shapes(patches.patches.size()), bodies(model.organs.size());
    const auto add = [&](Body& shape, bool filled, const Vec3& a, const Vec3& b, const Vec3& c) {
        const double area = 0.5 * (b - a).cross(c - a).norm(), volume = a.dot(b.cross(c)) / 6;
        shape.add(filled ? volume : area, (a + b + c) / (filled ? 4 : 3));
    };
    for (size_t t = 0; t < organs.size(); t++) {
        if (patches.repeated[t]) continue;
        Triangle corner = model.topology.triangles[t];
        if (patches.flipped[t]) std::swap(corner[1], corner[2]);
        const auto at = [&](size_t k) { return model.topology.points[size_t(corner[k])]; };
        const size_t p = size_t(patches.triangle_patch[t]);
        add(shapes[p], patches.patches[p].filled, at(0), at(1), at(2));
    }
    for (size_t p = 0; p < shapes.size(); p++) {
        const Patch& patch = patches.patches[p];
        if (patch.filled)
            for (const auto& cap : patch.caps) add(shapes[p], true, cap[0], cap[1], cap[2]);
        if (shapes[p].mass > 0)
            bodies[size_t(patch.organ)].add(patch.tissue * density_of(model.organs[size_t(patch.organ)]),
                                            shapes[p].centre());
    }
    return bodies;
}

std::vector<Body> bodies_of_cage(const Model& model) {
    std::vector<Body> bodies(model.organs.size());
    for (const Tissue& part : model.cage.tissue) {
        Vec3 centre = Vec3::Zero();
        for (int corner : model.cage.tets[size_t(part.tet)]) centre += model.cage.nodes[size_t(corner)] / 4;
        bodies[size_t(part.organ)].add(part.volume * density_of(model.organs[size_t(part.organ)]), centre);
    }
    return bodies;
}

// Returns the organs as the chain carries them, what hangs on an organ for want of its own capsules included.
std::vector<Body> bodies_of_chain(const Model& model) {
    std::vector<Body> bodies(model.organs.size());
    const std::vector<CapsuleMass> capsules = weigh_capsules(model);
    for (size_t i = 0; i < capsules.size(); i++) {
        const ChainNode& node = model.chain.nodes[i];
        Body& body = bodies[size_t(node.organ)];
        body.add(capsules[i].at_end, node.position);
        if (node.parent >= 0) body.add(capsules[i].at_begin, model.chain.nodes[size_t(node.parent)].position);
    }
    return bodies;
}

// Returns which organs carry others that have no capsules.
std::vector<char> find_bearers(const Model& model, const std::vector<Body>& chain) {
    std::vector<char> bear(model.organs.size(), 0);
    for (const Part& part : model.surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            for (int corner : model.surface.triangles[size_t(t)]) {
                const int capsule = model.chain.vertex_capsule[size_t(corner)];
                const size_t on = size_t(model.chain.nodes[size_t(capsule)].organ);
                if (on != size_t(part.organ) && !(chain[size_t(part.organ)].mass > 0)) bear[on] = 1;
            }
    return bear;
}

// Returns the distance of a place from the nearest of an organ's capsules [m].
double distance_from_capsules(const Chain& chain, int organ, const Vec3& place) {
    double least = INFINITY;
    for (const ChainNode& node : chain.nodes) {
        if (node.organ != organ || node.parent < 0) continue;
        const Vec3& begin = chain.nodes[size_t(node.parent)].position;
        const Vec3 way = node.position - begin;
        const double along = std::clamp((place - begin).dot(way) / way.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (begin + along * way - place).norm());
    }
    return least;
}

std::vector<double> sizes_of_organs(const Model& model) {
    std::vector<Eigen::AlignedBox3d> boxes(model.organs.size());
    for (const Part& part : model.surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++)
            for (int corner : model.surface.triangles[size_t(t)])
                boxes[size_t(part.organ)].extend(model.surface.positions[size_t(corner)]);
    std::vector<double> sizes;
    for (const Eigen::AlignedBox3d& box : boxes) sizes.push_back(box.diagonal().norm());
    return sizes;
}

// Returns the edge of a cube of twelve tets of the cage's mean volume [m].
double cell_size(const Cage& cage) {
    double volume = 0;
    for (const Tet& tet : cage.tets) volume += tet_volume(cage.nodes, tet);
    return std::cbrt(12 * volume / double(cage.tets.size()));
}

struct WeighedPlant : testing::TestWithParam<const char*> {
    std::shared_ptr<const Model> model = build_from_file(
        std::string(FROND_SOURCE_DIR) + "/models/" + GetParam() + "/" + GetParam() + ".obj", model_def());
};
// Expects the chain to have the mass of the tets, and its centre where theirs is.
void expect_same_centre(const Model& model) {
    constexpr double OFF = 0.005;  // over the plant's height: what a cage is to one side of its organs [-]
    Vec3 tets = Vec3::Zero(), chain = tets;
    double mass = 0;
    for (size_t e = 0; e < model.cage.tets.size(); e++) {
        const Tet& tet = model.cage.tets[e];
        for (int corner : tet)
            tets += model.tet_density[e] * tet_volume(model.cage.nodes, tet) / 4 * model.cage.nodes[size_t(corner)];
    }
    for (size_t i = 0; i < model.chain.nodes.size(); i++) {
        EXPECT_GE(model.chain_mass[i], 0);
        mass += model.chain_mass[i];
        chain += model.chain_mass[i] * model.chain.nodes[i].position;
    }
    EXPECT_NEAR(mass, model.mass(), 1e-9 * model.mass());
    const double height = model.surface.upper().y() - model.surface.lower().y();
    EXPECT_LT((chain - tets).norm() / model.mass(), OFF * height);
}

// A square tower of one cube, cut into six tets, a layer.
TetMesh tower(int layers) {
    constexpr double WIDE = 0.1, HIGH = 1;  // [m]
    TetMesh mesh;
    mesh.regions = {"stem"};
    for (int layer = 0; layer <= layers; layer++)
        for (int corner = 0; corner < 4; corner++)
            mesh.nodes.push_back({WIDE * (corner % 2), HIGH * layer / layers, WIDE * (corner / 2)});
    for (int layer = 0; layer < layers; layer++)
        for (const Tet& tet :
             {Tet{0, 1, 3, 7}, Tet{0, 3, 2, 7}, Tet{0, 2, 6, 7}, Tet{0, 6, 4, 7}, Tet{0, 4, 5, 7}, Tet{0, 5, 1, 7}}) {
            Tet raised = tet;
            for (int& node : raised) node += 4 * layer;
            mesh.tets.push_back(raised);
            mesh.tet_region.push_back(0);
        }
    return mesh;
}

// A leaf of 5 by 20 cm, drawn with two faces `thickness` apart; the last of its twelve triangles may be missing.
Surface drawn_leaf(double thickness, bool whole) {
    Surface surface;
    for (int corner = 0; corner < 8; corner++)
        surface.positions.push_back({0.05 * (corner & 1), 0.2 * (corner >> 1 & 1), thickness * (corner >> 2)});
    surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    if (!whole) surface.triangles.pop_back();
    surface.parts.emplace_back();
    surface.parts[0].name = "leaf";
    surface.parts[0].triangle_count = int(surface.triangles.size());
    surface.normals.assign(surface.positions.size(), Vec3f::UnitZ());
    return surface;
}

TEST(Weigh, ALeafByItsFacesHoweverThickItWasDrawn) {
    frond_model_def def = model_def();
    def.rest = FROND_REST_WITHOUT_GRAVITY;
    const Material& blade = *material_preset("blade");
    const double face = 0.05 * 0.2 * blade.thickness * blade.density;
    EXPECT_NEAR(build_from_surface(drawn_leaf(5e-4, true), def)->mass(), 0.05 * 0.2 * 5e-4 * blade.density,
                0.05 * face);
    for (const bool whole : {true, false})
        EXPECT_NEAR(build_from_surface(drawn_leaf(4e-3, whole), def)->mass(), 2 * face, 0.25 * face) << whole;
    frond_organ_material given = {"leaf", blade};
    def.organs = &given;
    def.organ_count = 1;
    EXPECT_NEAR(build_from_surface(drawn_leaf(4e-3, true), def)->mass(), 0.05 * 0.2 * 4e-3 * blade.density,
                0.05 * face);
}

INSTANTIATE_TEST_SUITE_P(Weigh, WeighedPlant, testing::Values("corn", "cucumber", "sunflower", "wheat"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(WeighedPlant, HangsEachTetOnItsOwnOrgan) {
    std::vector<char> has_nodes(model->organs.size(), 0);
    for (const ChainNode& node : model->chain.nodes)
        if (node.organ >= 0) has_nodes[size_t(node.organ)] = 1;
    const std::vector<int> hangs = hang_tets(*model);
    ASSERT_EQ(hangs.size(), model->cage.tets.size());
    for (size_t e = 0; e < hangs.size(); e++) {
        const int organ = model->cage.tet_organ[e];
        if (!has_nodes[size_t(organ)]) continue;
        EXPECT_EQ(model->chain.nodes[size_t(hangs[e])].organ, organ) << "tet " << e;
    }
}

TEST_P(WeighedPlant, GivesEachOrganTheTissueOfItsSurfaceInCageAndChain) {
    const std::vector<Body> surface = bodies_of_surface(*model), cage = bodies_of_cage(*model),
                            chain = bodies_of_chain(*model);
    const std::vector<char> bears = find_bearers(*model, chain);
    double in_cage = 0, in_chain = 0;
    for (size_t o = 0; o < surface.size(); o++) {
        SCOPED_TRACE(model->organs[o].name);
        EXPECT_NEAR(cage[o].mass, surface[o].mass, 0.001 * surface[o].mass);
        EXPECT_NEAR(model->organ_mass[o], cage[o].mass, 1e-9 * cage[o].mass);
        if (chain[o].mass > 0) {
            EXPECT_GT(chain[o].mass, (1 - 1e-9) * model->organ_mass[o]);
            EXPECT_TRUE(bears[o] || chain[o].mass < (1 + 1e-9) * model->organ_mass[o]);
        }
        in_cage += cage[o].mass;
        in_chain += chain[o].mass;
    }
    EXPECT_NEAR(in_cage, model->mass(), 1e-9 * model->mass());
    EXPECT_NEAR(in_chain, model->mass(), 1e-9 * model->mass());
}

// A tet has its mass at its own centre, which may be a good part of a cell away from an organ that is smaller than
// that.
TEST_P(WeighedPlant, HasEachOrganInTheCageWhereItsSurfaceIs) {
    constexpr double SMALL = 0.4, LARGE = 0.1, MEAN = 0.07;  // shares of a cell [-]
    const std::vector<Body> surface = bodies_of_surface(*model), cage = bodies_of_cage(*model);
    const std::vector<double> sizes = sizes_of_organs(*model);
    const double cell = cell_size(model->cage);
    double sum = 0;
    for (size_t o = 0; o < surface.size(); o++) {
        const double off = (cage[o].centre() - surface[o].centre()).norm();
        EXPECT_LT(off, (sizes[o] > 3 * cell ? LARGE : SMALL) * cell) << model->organs[o].name;
        EXPECT_LT((model->cage.organ_centre[o] - surface[o].centre()).norm(), 1e-6 * sizes[o]);
        sum += off * surface[o].mass;
    }
    EXPECT_LT(sum / model->mass(), MEAN * cell);
}

TEST_P(WeighedPlant, HasEachOrganInTheChainWhereItsSurfaceIs) {
    constexpr double OFF = 0.04, MEAN = 0.002;  // shares of the organ's and the plant's size [-]
    const std::vector<Body> surface = bodies_of_surface(*model), chain = bodies_of_chain(*model);
    const std::vector<double> sizes = sizes_of_organs(*model);
    const std::vector<char> bears = find_bearers(*model, chain);
    double sum = 0;
    for (size_t o = 0; o < surface.size(); o++) {
        if (!(chain[o].mass > 0) || bears[o]) continue;
        const double off = (chain[o].centre() - surface[o].centre()).norm();
        EXPECT_LT(off, OFF * sizes[o] + distance_from_capsules(model->chain, int(o), surface[o].centre()))
            << model->organs[o].name;
        sum += off * surface[o].mass;
    }
    EXPECT_LT(sum / model->mass(), MEAN * model->surface.size());
}

TEST_P(WeighedPlant, CarriesTheMassOfItsTetsWhereTheyAre) {
    expect_same_centre(*model);
}

TEST(WeighedTets, AreCarriedWhereTheyAreHoweverCoarse) {
    for (const int layers : {1, 2, 3, 6, 12}) {
        SCOPED_TRACE(layers);
        expect_same_centre(*build_from_tets(tower(layers), model_def()));
    }
}

// A tet weighs what its volume at rest does, which for wheat's linear tets is 3 % less than as modelled.
struct WeighedMovingPlant : WeighedPlant {};

INSTANTIATE_TEST_SUITE_P(Weigh, WeighedMovingPlant, testing::Values("corn", "cucumber", "sunflower"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(WeighedMovingPlant, WeighsTheSameInAllMechanics) {
    for (int which = 0; which < FROND_MECHANICS_COUNT; which++) {
        ensure_rest_shape(*model, frond_mechanics(which), 1);
        const auto system = make_system(model, frond_mechanics(which), FROND_MASS_LUMPED);
        EXPECT_NEAR(node_mass_of(*system).sum(), model->mass(), 0.01 * model->mass())
            << mechanics(frond_mechanics(which)).name;
    }
}

}  // namespace weigh_tests

}  // namespace frond::test
