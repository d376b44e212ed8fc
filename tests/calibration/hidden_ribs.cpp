// Leaves that a bare sheet would not carry get a midrib.
#include <gtest/gtest.h>

#include "modelling/build.hpp"
#include "support/model_def.hpp"

namespace frond::test {

// A standing leaf, narrow at its base as drawn leaves are, 0.6 m high: its tissue alone would need to be 20 times
// stiffer.
static Surface narrow_leaf() {
    Surface surface;
    const double widths[] = {0.004, 0.03, 0.08, 0.1, 0.08, 0.04, 0.005};
    for (int i = 0; i < 7; i++)
        for (double side : {-0.5, 0.5}) surface.positions.push_back({side * widths[i], 0.1 * i, 0.002 * i * i});
    for (int i = 0; i < 6; i++) {
        surface.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
        surface.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    }
    surface.parts.emplace_back();
    surface.parts[0].name = "leaf";
    surface.parts[0].triangle_count = 12;
    surface.normals.assign(surface.positions.size(), Vec3f::UnitZ());
    return surface;
}

TEST(HiddenRibs, CarryALeafThatIsNarrowAtItsBase) {
    const auto model = build_from_surface(narrow_leaf(), model_def());
    EXPECT_LE(model->organ_stiffer[0], 3);
    frond_organ_material given = {"leaf", *material_preset("blade")};
    frond_model_def def = model_def();
    def.organs = &given;
    def.organ_count = 1;
    // What the caller gives is taken as it is.
    const auto bare = build_from_surface(narrow_leaf(), def);
    EXPECT_GT(bare->organ_stiffer[0], 4);
    // The rib is thickest at the base.
    const auto thickest = [](const Model& one) {
        size_t best = 0;
        for (size_t i = 0; i < one.sections.size(); i++)
            if (one.chain.nodes[i].parent >= 0 && one.sections[i].bending_thin() > one.sections[best].bending_thin())
                best = i;
        return one.chain.nodes[best].position.y();
    };
    EXPECT_LT(thickest(*model), 0.3);
}

}  // namespace frond::test
