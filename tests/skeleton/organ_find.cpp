// Organs by name and by shape, and their names and materials.
#include <gtest/gtest.h>

#include <set>

#include "chain_shapes.hpp"
#include "core/error.hpp"
#include "skeleton/organ_clues.hpp"
#include "skeleton/organ_correct.hpp"
#include "support/materials.hpp"

namespace frond {
namespace organ_find_tests {

using namespace test;

TEST(OrganNames, AreReadInSeveralSpellingsAndLanguages) {
    const std::pair<const char*, const char*> cases[] = {
        {"leaf", "blade"},
        {"Leaf_012", "blade"},
        {"MapleLeaf3", "blade"},
        {"mapleleaf", "blade"},
        {"leaves.001", "blade"},
        {"LEAVES", "blade"},
        {"TreeFoliageMat", "blade"},
        {"Blatt_03", "blade"},
        {"Feuilles", "blade"},
        {"hojas", "blade"},
        {"needles", "blade"},
        {"palmFrond", "blade"},
        {"leafmat", "blade"},
        {"VG07lef2", "blade"},
        {"VG07frt1", "fruit"},
        {"叶子", "blade"},
        {"trunk", "branch"},
        {"Bark01", "branch"},
        {"twigs", "branch"},
        {"tree_stem", "branch"},
        {"Zweige", "branch"},
        {"stem", "stem"},
        {"Stalk_A", "stem"},
        {"sugar-cane", "stem"},
        {"culm", "stem"},
        {"mainStem", "stem"},
        {"petiole_3", "petiole"},
        {"leafstalk", "petiole"},
        {"leaf_stem", "petiole"},
        {"LeafStalk", "petiole"},
        {"flower_stalk", "peduncle"},
        {"fruitStem", "peduncle"},
        {"leaf_rib", "midrib"},
        {"midrib", "midrib"},
        {"stem_leaf", "blade"},
        {"Petal", "flower"},
        {"tassel", "peduncle"},
        {"silk_1", "flower"},
        {"sunflower_leaf", "blade"},
        {"ear_1", "fruit"},
        {"CornEar", "fruit"},
        {"cob", "fruit"},
        {"berries", "fruit"},
        {"tomato_leaf", "blade"},
        {"roots", "root"},
        {"TapRoot", "root"},
        {"tendril_2", "tendril"},
        {"Ranke", "tendril"},
        {"stake", "support"},
        {"tie_3", "support"},
        {"FlowerPot", "support"},
        {"flowerpot", "support"},
        {"trellis", "support"},
        {"Soil", "support"},
        {"ground", "support"},
        {"earth", "support"},
        // Words that merely contain such a word.
        {"Stemonitis", ""},
        {"ecosystem", ""},
        {"near", ""},
        {"linear", ""},
        {"potato", ""},
        {"Plane.003", ""},
        {"Object_4", ""},
        {"RootNode", ""},
        {"GLTF_SceneRootNode", ""},
        {"Branches_and_leaves", ""},
        {"", ""},
        {"\xff\xfe__..", ""},
    };
    for (const auto& [name, kind] : cases) EXPECT_EQ(read_name(name).kind, kind) << name;
}

using Kinds = std::vector<std::string>;

// Returns the kinds of parts with these names and materials.
Kinds kinds(std::initializer_list<std::pair<const char*, const char*>> parts) {
    Surface surface;
    for (const auto& [name, material] : parts) {
        surface.parts.emplace_back();
        surface.parts.back().name = name;
        surface.parts.back().material = material;
    }
    return kinds_by_name(surface);
}

TEST(OrganNames, OfASpeciesMeanTheFruitOnlyBesideOtherParts) {
    EXPECT_EQ(kinds({{"tomato", ""}}), Kinds({""}));
    EXPECT_EQ(kinds({{"flower", ""}}), Kinds({""}));
    EXPECT_EQ(kinds({{"tomato_1", ""}, {"tomato_2", ""}}), Kinds({"", ""}));
    EXPECT_EQ(kinds({{"stem", ""}, {"tomato_1", ""}, {"TomatoPlant", ""}}), Kinds({"stem", "fruit", ""}));
    // Node names take precedence over material names, and both over the name of a species.
    EXPECT_EQ(kinds({{"trunk", "leaf"}, {"Object_3", "leaf"}, {"cucumber", "leaf"}}),
              Kinds({"branch", "blade", "blade"}));
    EXPECT_EQ(kinds({{"root", ""}, {"root", "bark"}}), Kinds({"", "branch"}));
}

TEST(OrganNames, ThatAllPartsShareAreThePlants) {
    EXPECT_EQ(kinds({{"Flowers", "Green"}, {"Flowers", "Cyan"}}), Kinds({"", ""}));
    EXPECT_EQ(kinds({{"BushBerries_1", "Green"}, {"BushBerries_1", "Berry"}}), Kinds({"", "fruit"}));
    EXPECT_EQ(kinds({{"FlowerPot6", "GroundFlowerPot6"},
                     {"FlowerPot6", "LeafsFlowerPot6"},
                     {"FlowerPot6", "FlowersFlowerPot6"}}),
              Kinds({"support", "blade", "flower"}));
    EXPECT_EQ(kinds({{"leaf_1", ""}, {"leaf_2", ""}}), Kinds({"blade", "blade"}));
    EXPECT_EQ(kinds({{"Plane", "WildFlower"}}), Kinds({""}));
    EXPECT_EQ(kinds({{"WildFlower", "WildFlower"}}), Kinds({""}));
}

TEST(OrganNames, OfColorsAreNoFruits) {
    Surface surface;
    const auto kind_of = [&](const char* material, const char* other) {
        surface.parts.assign(2, Part());
        surface.parts[0].material = material;
        surface.parts[1].material = other;
        return kinds_by_name(surface)[0];
    };
    EXPECT_EQ(kind_of("Orange", "Wood"), "fruit");
    EXPECT_EQ(kind_of("Orange", "DarkGreen"), "");
    EXPECT_EQ(kind_of("Orange", "LightOrange"), "");
    EXPECT_EQ(kind_of("LightOrange", "Wood"), "");
    EXPECT_EQ(kind_of("Berry", "Green"), "fruit");
}

// Returns a trunk with a ball on top, as trees are drawn in children's books.
Sketch ball_tree() {
    Sketch sketch;
    sketch.begin_part("trunk");
    sketch.tube(line({0, 0, 0}, {0, 4, 0}, 8), 0.1, 8);
    sketch.begin_part("Object_2");
    const int sides = 12, rings = 7;
    const int bottom = sketch.add({0, 4, 0}), top = sketch.add({0, 6, 0}), first = top + 1;
    for (int i = 1; i <= rings; i++)
        for (int k = 0; k < sides; k++) {
            const double up = M_PI * i / (rings + 1), around = 2 * M_PI * k / sides;
            sketch.add({std::sin(up) * std::cos(around), 5 - std::cos(up), std::sin(up) * std::sin(around)});
        }
    for (int k = 0; k < sides; k++) {
        const int next = (k + 1) % sides;
        sketch.triangle(bottom, first + k, first + next);
        for (int i = 0; i + 1 < rings; i++) {
            const int a = first + i * sides + k, b = first + i * sides + next;
            sketch.triangle(a, a + sides, b);
            sketch.triangle(b, a + sides, b + sides);
        }
        sketch.triangle(top, first + (rings - 1) * sides + next, first + (rings - 1) * sides + k);
    }
    return sketch;
}

TEST(Organs, OfALargeRoundShapeThatIsHeldUpAreFoliage) {
    Sketch sketch = ball_tree();
    sketch.surface.parts[0].name = "Object_1";
    const Grown grown = grow(sketch);
    ASSERT_EQ(grown.organs.size(), 2u) << "all of the ball is of one kind";
    EXPECT_EQ(grown.organs[1].kind, "crown");
    // A crown that encloses no volume is a heap of leaves.
    Sketch heap = ball_tree();
    // Its triangles share no edge and face both ways.
    for (size_t i = 0; i < heap.surface.triangles.size(); i++) {
        Triangle& triangle = heap.surface.triangles[i];
        const Vec3 place = heap.surface.positions[size_t(triangle[2])];
        triangle[2] = heap.add(place + Vec3(1e-3, 1e-3, 0) * double(i % 7 + 1));
        if (i % 2) std::swap(triangle[0], triangle[1]);
    }
    EXPECT_EQ(grow(heap).organs[1].kind, "blade");
    // Stems that fill the same box with little surface are no crown.
    Sketch bare;
    bare.tube(line({0, 0, 0}, {0, 4, 0}, 8), 0.1, 8);
    const int first = bare.tube(line({-1, 4, 0}, {1, 6, 0}, 8), 0.05, 8);
    const int second = bare.tube(line({0, 4, -1}, {0, 6, 1}, 8), 0.05, 8);
    bare.triangle(first + 32, second + 32, second + 33);  // they cross, as one component
    for (const Organ& organ : grow(bare).organs) EXPECT_EQ(organ.kind, "branch");
}

TEST(Organs, OfABushMayBeFoliageFromTheGroundOn) {
    for (const char* name : {"Object_1", "BushBerries_2", "Hedge"}) {
        Sketch sketch = ball_tree();
        // The trunk shrinks to 7 cm.
        for (Vec3& position : sketch.surface.positions)
            position.y() = position.y() <= 4 ? 0.0175 * position.y() : position.y() - 3.93;
        sketch.surface.parts[0].name = name;
        bool has_crown = false;
        for (const Organ& organ : grow(sketch).organs) has_crown = has_crown || organ.kind == "crown";
        EXPECT_TRUE(has_crown) << name;
    }
    // What nothing holds up is a crown by name only: it may be a pumpkin.
    for (const char* name : {"Object_1", "BushBerries_2"}) {
        Sketch sketch = ball_tree();
        sketch.surface.triangles.erase(sketch.surface.triangles.begin(),
                                       sketch.surface.triangles.begin() + sketch.surface.parts[0].triangle_count);
        sketch.surface.parts.erase(sketch.surface.parts.begin());
        sketch.surface.parts[0].first_triangle = 0;
        sketch.surface.parts[0].name = name;
        clean_surface(sketch.surface);
        bool has_crown = false;
        for (const Organ& organ : grow(sketch).organs) has_crown = has_crown || organ.kind == "crown";
        EXPECT_EQ(has_crown, std::string(name) != "Object_1") << name;
    }
    // However small it is; solid it weighed 250 times as much.
    Sketch small = ball_tree();
    for (Vec3& position : small.surface.positions) position.y() = position.y() <= 4 ? 0 : position.y() - 4;
    for (Vec3& position : small.surface.positions) position *= 0.3 / small.surface.height();
    for (Part& part : small.surface.parts) part.name = "Bush_1";
    clean_surface(small.surface);
    const Grown grown = grow(small);
    EXPECT_TRUE(std::any_of(grown.organs.begin(), grown.organs.end(),
                            [](const Organ& organ) { return organ.kind == "crown"; }));
}

TEST(Organs, ThatAreGreenAndGrowOnWoodAreFoliage) {
    Sketch sketch;
    sketch.begin_part("trunk");
    sketch.tube(line({0, 0, 0}, {0, 4, 0}, 8), 0.1, 8);
    sketch.begin_part("Object_2");
    sketch.tube(line({0, 4, 0}, {1, 5, 0}, 4), 0.1, 8);
    EXPECT_EQ(grow(sketch).organs[1].kind, "branch");
    sketch.surface.parts[1].color = {0.1f, 0.4f, 0.05f, 1};
    const Grown grown = grow(sketch);
    EXPECT_EQ(grown.organs[0].kind, "branch");
    EXPECT_EQ(grown.organs[1].kind, "blade");
}

TEST(Organs, CalledBranchesThatAreCardsOnWoodAreFoliage) {
    Sketch sketch;
    sketch.begin_part("Bark");
    sketch.tube(line({0, 0, 0}, {0, 4, 0}, 8), 0.1, 8);
    sketch.begin_part("Branch");
    for (int i = 0; i < 12; i++) {
        const double angle = 2.4 * i, y = 2 + 0.15 * i;
        const Vec3 out(std::cos(angle), 0.3, std::sin(angle));
        sketch.strip(line({0, y, 0}, Vec3(0, y, 0) + out, 2), 0.4, Vec3(-out.z(), 0, out.x()));
    }
    const Grown grown = grow(sketch);
    ASSERT_EQ(grown.organs.size(), 13u) << "each card is one";
    EXPECT_EQ(grown.organs[0].kind, "branch");
    for (size_t i = 1; i < grown.organs.size(); i++) EXPECT_EQ(grown.organs[i].kind, "blade");
}

TEST(Organs, HaveTheirKindsColorWhereTheFileBringsNone) {
    Sketch sketch = ball_tree();
    sketch.surface.parts[1].name = "leaves";
    const std::array<float, 4> grey = {0.64f, 0.64f, 0.64f, 1}, pink = {0.8f, 0.3f, 0.4f, 1};
    sketch.surface.parts[0].color = sketch.surface.parts[1].color = grey;
    const Grown plain = grow(sketch);
    EXPECT_GT(plain.surface.parts[0].color[0], 1.2f * plain.surface.parts[0].color[1]) << "wood is brown";
    EXPECT_GT(plain.surface.parts[1].color[1], 1.2f * plain.surface.parts[1].color[0]) << "leaves are green";
    // Next to a colour, grey was chosen as well.
    sketch.surface.parts[1].color = pink;
    const Grown pale = grow(sketch);
    EXPECT_EQ(pale.surface.parts[0].color, grey);
    EXPECT_EQ(pale.surface.parts[1].color, pink);
}

TEST(Organs, AreToldByShapeWhereNamesSayNothing) {
    Sketch sketch = leafy_plant(5, false);
    const int stem = 20 * 8 * 2;
    const Surface before = sketch.surface;
    Grown grown = grow(sketch);
    // The stem and each leaf, in one run of triangles each.
    ASSERT_EQ(grown.organs.size(), 6u);
    ASSERT_EQ(grown.surface.parts.size(), 6u);
    std::set<std::string> names;
    for (const Part& part : grown.surface.parts) {
        const Organ& organ = grown.organs[size_t(part.organ)];
        EXPECT_EQ(part.triangle_count, organ.kind == "stem" ? stem : (int(before.triangles.size()) - stem) / 5);
        EXPECT_GT(organ.certainty, 0.5);
        EXPECT_NE(organ.why, "");
        names.insert(organ.name);
    }
    EXPECT_EQ(names.size(), 6u);
}

TEST(Organs, OfOneMeshAreToldByLocalShape) {
    // A tube whose last ring continues as a wide sheet.
    Sketch sketch;
    const int first = sketch.tube(line({0, 0, 0}, {0, 1, 0}, 20), 0.01, 8);
    const int ring = first + 20 * 8;
    const int sheet = int(sketch.surface.positions.size());
    sketch.strip(line({0, 1.02, 0}, {0.5, 1.4, 0}, 10), 0.15, Vec3::UnitZ(), 7);
    for (int k = 0; k < 7; k++) {
        sketch.triangle(ring + k, ring + k + 1, sheet + k);
        sketch.triangle(ring + k + 1, sheet + k + 1, sheet + k);
    }
    Surface surface = sketch.surface;
    Topology topology = make_topology(surface);
    ASSERT_EQ(topology.component_count, 1);
    const std::vector<Organ> organs = find_organs(surface, topology);
    ASSERT_EQ(organs.size(), 2u);
    for (const Part& part : surface.parts)
        for (int t = part.first_triangle; t < part.first_triangle + part.triangle_count; t++) {
            double y = 0;
            for (int p : topology.triangles[size_t(t)]) y += topology.points[size_t(p)].y() / 3;
            if (y < 0.9) {
                EXPECT_EQ(organs[size_t(part.organ)].kind, "stem");
            }
            if (y > 1.1) {
                EXPECT_EQ(organs[size_t(part.organ)].kind, "blade");
            }
        }
}

TEST(Organs, OfHundredsOfCardsAreClusters) {
    Sketch sketch;
    for (int i = 0; i < 300; i++)
        sketch.strip(line({0.1 * (i % 20), 0.2 * (i / 20), 0}, {0.1 * (i % 20), 0.2 * (i / 20) + 0.05, 0.02}, 1), 0.03,
                     Vec3::UnitX(), 1);
    const Grown grown = grow(sketch);
    EXPECT_GE(grown.organs.size(), 10u);
    EXPECT_LE(grown.organs.size(), 60u);
    for (const Organ& organ : grown.organs) EXPECT_EQ(organ.kind, "blade");
}

TEST(Organs, OfATallPlantAreOfWood) {
    Sketch sketch;
    sketch.tube(line({0, 0, 0}, {0, 8, 0}, 20), 0.1, 8);
    EXPECT_EQ(grow(sketch).organs[0].kind, "branch");
}

TEST(Organs, ReorderSurfaceAndTopologyAlike) {
    Sketch sketch = leafy_plant(7, false);
    // Shuffled, so that parts cannot be split without moving triangles.
    std::mt19937_64 engine(1);
    for (size_t i = sketch.surface.triangles.size(); i-- > 1;)
        std::swap(sketch.surface.triangles[i], sketch.surface.triangles[engine() % (i + 1)]);
    Surface surface = sketch.surface;
    Topology topology = make_topology(surface);
    std::multiset<std::pair<Triangle, int>> before, after;
    for (size_t t = 0; t < surface.triangles.size(); t++)
        before.insert({topology.triangles[t], topology.triangle_component[t]});
    find_organs(surface, topology);
    int next = 0;
    for (const Part& part : surface.parts) {
        EXPECT_EQ(part.first_triangle, next);
        next += part.triangle_count;
    }
    EXPECT_EQ(next, int(surface.triangles.size()));
    for (size_t t = 0; t < surface.triangles.size(); t++) {
        after.insert({topology.triangles[t], topology.triangle_component[t]});
        for (size_t k = 0; k < 3; k++)
            EXPECT_EQ(topology.vertex_point[size_t(surface.triangles[t][k])], topology.triangles[t][k]);
    }
    EXPECT_EQ(before, after);
    // Joints still lie on their triangles.
    for (const Joint& joint : topology.joints) {
        EXPECT_NE(topology.triangle_component[size_t(joint.triangle_a)],
                  topology.triangle_component[size_t(joint.triangle_b)]);
        for (const auto& [triangle, place] :
             {std::pair{joint.triangle_a, joint.point_a}, std::pair{joint.triangle_b, joint.point_b}}) {
            const Triangle& t = topology.triangles[size_t(triangle)];
            const Vec3 &a = topology.points[size_t(t[0])], &b = topology.points[size_t(t[1])],
                       &c = topology.points[size_t(t[2])];
            EXPECT_NEAR((b - a).cross(c - a).normalized().dot(place - a), 0, 1e-9);
            for (const Vec3& corner : {a, b, c}) EXPECT_LE((place - corner).norm(), 0.3);
        }
    }
}

TEST(Organs, HaveTheirPartsNameOrOneOfTheirOwn) {
    Sketch sketch;
    for (const char* name : {"leaf", "stem", "stem", "", "stem_1", "blade"}) {
        sketch.begin_part(name, "leaf");
        const double x = 0.2 * double(sketch.surface.parts.size());
        sketch.strip(line({x, 0, 0}, {x, 1, 0}, 4), 0.05, Vec3::UnitZ());
    }
    const Grown grown = grow(sketch);
    std::vector<std::string> names;
    for (const Organ& organ : grown.organs) names.push_back(organ.name);
    EXPECT_EQ(names, std::vector<std::string>({"leaf", "stem_2", "stem_3", "blade_1", "stem_1", "blade"}));
}

std::string failure(Sketch sketch, const std::vector<frond_organ_material>& overrides, int count = -1) {
    Topology topology = make_topology(sketch.surface);
    try {
        std::vector<Organ> organs = find_organs(sketch.surface, topology);
        override_materials(organs, overrides.data(), count < 0 ? int(overrides.size()) : count);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_BAD_ARGUMENT);
        return error.what();
    }
    return "";
}

TEST(Organs, TakeMaterialsByNameOrKindTheLastMatchWins) {
    Sketch sketch = leafy_plant(3, true);
    Surface surface = sketch.surface;
    Topology topology = make_topology(surface);
    const Material soft = plain_material(800, 1e5, 0.1, 1e-4), hard = plain_material(1200, 1e10, 0.4, 1e-3);
    const frond_organ_material overrides[] = {{"blade", soft}, {"leaf_2", hard}};
    std::vector<Organ> organs = find_organs(surface, topology);
    override_materials(organs, overrides, 2);
    EXPECT_EQ(organs[0].material.young, material_preset("stem")->young);
    EXPECT_EQ(organs[1].material.young, 1e5);
    EXPECT_EQ(organs[2].material.young, 1e10);
    EXPECT_EQ(organs[3].material.density, 800);
}

TEST(Organs, RefuseMaterialsThatFitNothingOrAreAbsurd) {
    const Sketch sketch = leafy_plant(2, true);
    const Material good = *material_preset("stem");
    EXPECT_EQ(failure(sketch, {{"stem", good}}), "");
    const std::string text = failure(sketch, {{"thorn", good}});
    for (const char* word : {"thorn", "stem", "leaf_1", "leaf_2", "blade"})
        EXPECT_NE(text.find(word), std::string::npos) << text;
    Material bad = good;
    bad.hollow = 1;
    EXPECT_NE(failure(sketch, {{"stem", bad}}).find("hollow of organ \"stem\""), std::string::npos);
    EXPECT_NE(failure(sketch, {{nullptr, good}}), "");
    EXPECT_NE(failure(sketch, {{"", good}}), "");
    EXPECT_NE(failure(sketch, {}, 1), "");
}

}  // namespace organ_find_tests

}  // namespace frond
