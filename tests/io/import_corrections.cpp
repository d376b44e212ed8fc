// Files MESH.frond.json: what they say is read, and what is wrong with them is said.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

TEST(Corrections, AreReadBesideTheMesh) {
    files::Folder folder;
    const std::string mesh = folder.write("plant.obj", files::obj());
    folder.write("plant.frond.json",
                 R"({"unit": 0.01, "up": [0, 0, 2], "allow_stiffening": 5, "organs": {"stem": {"kind": "root",
                    "parent": "leaf", "root": true, "leave_out": true, "material": {"young": 2e6, "midrib": 0.1},
                    "why": "I saw it", "certainty": 1}}})");
    Corrections corrections;
    ImportOptions options;
    options.corrections = "beside";
    const Surface surface = import_surface(mesh, options, &corrections);
    EXPECT_EQ(surface.scale, 0.01);
    EXPECT_EQ(surface.up, Vec3::UnitZ());
    EXPECT_EQ(corrections.allow_stiffening, 5);
    ASSERT_EQ(corrections.organs.size(), 1u);
    const OrganCorrection& organ = corrections.organs[0];
    EXPECT_EQ(organ.organ, "stem");
    EXPECT_EQ(organ.kind, "root");
    EXPECT_EQ(organ.parent, "leaf");
    EXPECT_TRUE(organ.is_root && organ.leave_out);
    ASSERT_EQ(organ.material.size(), 2u);
    EXPECT_STREQ(MATERIAL_FIELDS[organ.material[0].first].name, "young");
    EXPECT_EQ(organ.material[0].second, 2e6);
    // The caller's own words win; without the wish the file is not looked for.
    options.scale = 0.5;
    EXPECT_EQ(import_surface(mesh, options).scale, 0.5);
    EXPECT_EQ(import_surface(mesh, {}).scale, 1);
}

TEST(Corrections, ThatAreWrongSayWhere) {
    files::Folder folder;
    const std::string mesh = folder.write("plant.obj", files::obj());
    const struct {
        const char *json, *word;
    } rows[] = {{"", "line 1"},
                {"{\n\"unit\": 1,,\n}", "line 2"},
                {"[]", "braces"},
                {R"({"unit": -1})", "unit"},
                {R"({"unit": "cm"})", "unit is \"cm\""},
                {R"({"up": [0, 0]})", "[0, 0, 1]"},
                {R"({"units": 1})", "\"units\"; it has unit, up"},
                {R"({"organs": {"a": {"knd": "stem"}}})", "\"knd\"; it has kind"},
                {R"({"organs": {"a": {"kind": 3}}})", "the organ \"a\".kind is 3"},
                {R"({"organs": {"a": {"root": 1}}})", "true or false"},
                {R"({"organs": {"a": {"material": {"yung": 1}}}})", "density, young"},
                {R"({"allow_stiffening": 0.5})", "allow_stiffening"}};
    ImportOptions options;
    options.corrections = "beside";
    for (const auto& row : rows) {
        folder.write("plant.frond.json", row.json);
        try {
            import_surface(mesh, options);
            ADD_FAILURE() << row.json;
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find("plant.frond.json: "), std::string::npos) << text;
            EXPECT_NE(text.find(row.word), std::string::npos) << text;
        }
    }
    options.corrections = "/no/such.json";
    EXPECT_THROW(import_surface(mesh, options), Error);
}
