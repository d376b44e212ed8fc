// Files of grown plants: the committed ones are what the generator writes, byte for byte, in any locale.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "grow/grow.hpp"

namespace frond::grow {
namespace files_test_tests {

std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << "cannot read " << path;
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

// A locale that writes 1.234,5, active during the lifetime of this object.
struct OddNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\1"; }
};
struct OddLocale {
    std::locale before = std::locale::global(std::locale(std::locale(), new OddNumbers));
    ~OddLocale() { std::locale::global(before); }
};

TEST(GrowFiles, CommittedFilesAreReproducedByteForByte) {
    for (const char* kind : {"corn", "cucumber", "wheat", "sunflower"}) {
        const std::filesystem::path folder = std::filesystem::path(FROND_SOURCE_DIR) / "models" / kind;
        const GrownPlant plant = grow_plant(kind);
        const std::string name = kind;
        // EXPECT_TRUE instead of EXPECT_EQ, since a printed difference of two megabytes would help nobody.
        EXPECT_TRUE(read_bytes(folder / (name + ".obj")) == obj_text(plant, name + ".mtl")) << name;
        EXPECT_EQ(read_bytes(folder / (name + ".mtl")), mtl_text(plant));
        for (const GrownImage& image : plant.images)
            EXPECT_TRUE(read_bytes(folder / image.name) == png_bytes(image)) << name;
    }
}

TEST(GrowFiles, WrittenFilesAreTheTexts) {
    const auto folder = std::filesystem::temp_directory_path() / ("frond_grow_" + std::to_string(::getpid())) / "deep";
    const GrownPlant plant = grow_plant("corn");
    const std::string path = write_obj(plant, folder.string());
    EXPECT_EQ(path, (folder / "corn.obj").string());
    EXPECT_TRUE(read_bytes(path) == obj_text(plant, "corn.mtl"));
    EXPECT_EQ(read_bytes(folder / "corn.mtl"), mtl_text(plant));
    EXPECT_EQ(read_bytes(folder / "corn_blade.png").substr(1, 3), "PNG");
    std::filesystem::remove_all(folder.parent_path());
}

TEST(GrowFiles, TheLocaleDoesNotChangeTheText) {
    const std::string plain = obj_text(grow_plant("corn"), "corn.mtl");
    OddLocale odd;
    EXPECT_TRUE(obj_text(grow_plant("corn"), "corn.mtl") == plain);
}

TEST(GrowFiles, NumbersAreRoundedAndKeepTheirSign) {
    GrownPlant plant;
    plant.kind = "point";
    plant.positions = {{-0.5, 0.000004, -0.000004}, {12.345678, -0.00001, 1}};
    plant.colors = {{0, 1, 0.5}, {0.0004, 0.9996, 0.25}};
    plant.uvs.resize(2);
    plant.materials = {{"plain", {0.1, 0.2, 0.3}, ""}};
    plant.organs = {{"dot", 0, 0, 2, 0, 0}};
    const std::string text = obj_text(plant, "point.mtl");
    EXPECT_NE(text.find("v -0.50000 0.00000 0.00000 0.000 1.000 0.500\n"), std::string::npos) << text;
    EXPECT_NE(text.find("v 12.34568 -0.00001 1.00000 0.000 1.000 0.250\n"), std::string::npos) << text;
}

TEST(GrowFiles, AFolderThatCannotBeMadeIsNamed) {
    try {
        write_obj(grow_plant("corn"), "/dev/null/frond");
        FAIL() << "wrote into /dev/null";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("/dev/null/frond"), std::string::npos) << error.what();
    }
}

TEST(GrowKinds, UnknownKindsAndSettingsAreRefusedWithTheNamesThereAre) {
    const auto text_of_refusal = [](const std::string& kind, const GrownSettings& settings) -> std::string {
        try {
            grow_plant(kind, settings);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(text_of_refusal("triffid", {}).find("corn, cucumber"), std::string::npos);
    EXPECT_NE(text_of_refusal("corn", {{"legs", 3}}).find("leaf_length"), std::string::npos);
    EXPECT_NE(text_of_refusal("corn", {{"arch", 99}}).find("arch must be from"), std::string::npos);
    EXPECT_NE(text_of_refusal("cucumber", {{"droop", std::nan("")}}).find("droop must be from"), std::string::npos);
}

}  // namespace files_test_tests

}  // namespace frond::grow
