// Text that assimp fails on is imported all the same.
#include <gtest/gtest.h>

#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

TEST(ImportText, ReadsObjVerticesWithOpacityBehindTheirColor) {
    std::string text = files::obj(true);
    for (size_t at = text.find(" 0.25 0.5 0.125\n"); at != std::string::npos; at = text.find(" 0.25 0.5 0.125\n", at))
        text.replace(at, 16, " 0.25 0.5 0.125 0.9\n");
    files::Folder folder;
    const Surface surface = import_surface(folder.write("plant.obj", text), {});
    EXPECT_EQ(surface.positions.size(), 12u);
    ASSERT_EQ(surface.colors.size(), 12u);
    EXPECT_EQ(surface.colors[3], (Color{64, 128, 32, 255}));
}

TEST(ImportText, ReadsColladaWithBlanksInFrontOfNumbers) {
    files::Folder folder;
    std::string text = files::dae(false);
    const std::string color = "<color>0.5 0.5 0 1<";
    ASSERT_NE(text.find(color), std::string::npos);
    text.replace(text.find(color), color.size(), "<color>  0.5 0.5 0 1 <");
    const Surface surface = import_surface(folder.write("plant.dae", text), {});
    EXPECT_EQ(surface.triangles.size(), 10u);
    EXPECT_NEAR(surface.parts[0].color[0], 0.2140f, 1e-3f);
}
