// Leaves that a bare sheet would not carry get a midrib.
#include <gtest/gtest.h>

#include "modelling/build.hpp"
#include "support/model_def.hpp"
#include "support/narrow_leaf.hpp"

namespace frond::test {

TEST(HiddenRibs, CarryALeafThatIsNarrowAtItsBase) {
    const auto model = build_from_surface(narrow_leaf(), model_def());
    EXPECT_LE(model->organ_stiffer[0], 3);
    frond_organ_material given = {"leaf", *material_preset("blade")};
    frond_model_def def = model_def();
    def.organs = &given;
    def.organ_count = 1;
    // A midrib or modulus that the caller gives is taken as it is.
    for (double Material::*field : {&Material::midrib, &Material::young}) {
        given.material = *material_preset("blade");
        given.material.*field *= 0.99;
        EXPECT_GT(build_from_surface(narrow_leaf(), def)->organ_stiffer[0], 4);
    }
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
