// Units that files state, and plants in map coordinates.
#include <gtest/gtest.h>

#include <sstream>

#include "core/error.hpp"
#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

TEST(Units, OfAComment) {
    files::Folder folder;
    const struct {
        const char* comment;
        double unit;
    } rows[] = {{"## File units = inches", 0.0254}, {"# Units: centimeters", 0.01},   {"# unit mm", 0.001},
                {"# unit of geometry", 1},          {"# 12 feet of united stems", 1}, {"#", 1}};
    for (const auto& row : rows) {
        const Surface surface =
            import_surface(folder.write("p.obj", row.comment + ("\n" + files::obj())), {0, Vec3::UnitY()});
        const double height = 0.5 * row.unit;
        EXPECT_NEAR(surface.height(), height, 1e-5 * height) << row.comment;
        EXPECT_NEAR(surface.scale, row.unit, 1e-12) << row.comment;
    }
}

TEST(Units, AreNotGuessedWhereTheFileStatesThem) {
    files::Folder folder;
    // glTF is in metres: this stem is 51 m high.
    std::string json = files::gltf_json();
    json.replace(json.find("\"children\""), 0, "\"scale\":[102,102,102],");
    for (const char* name : {"tree.glb", "lily.glb"}) {
        const Surface surface = import_surface(folder.write(name, files::glb_of(json, files::glb_binary())), {});
        EXPECT_NEAR(surface.height(), 51, 1e-3) << name;
        EXPECT_EQ(surface.scale, 1) << name;
    }
}

// Returns text with the coordinates of each vertex moved.
static std::string move_obj(const Vec3& way) {
    std::istringstream in(files::obj());
    std::ostringstream out;
    out.precision(12);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        Vec3 place;
        if (words >> word && word == "v" && words >> place[0] >> place[1] >> place[2])
            out << "v " << place[0] + way[0] << ' ' << place[1] + way[1] << ' ' << place[2] + way[2] << '\n';
        else
            out << line << '\n';
    }
    return out.str();
}

TEST(MapCoordinates, ObjKeepsItsShape) {
    files::Folder folder;
    const Surface near = import_surface(folder.write("near.obj", files::obj()), {0, Vec3::UnitY()});
    for (const Vec3& way : {Vec3(4e5, 120, 5.4e6), Vec3(0, 5.4e6, 0), Vec3(-30, 0, 0)}) {
        const Surface far = import_surface(folder.write("far.obj", move_obj(way)), {0, Vec3::UnitY()});
        ASSERT_EQ(far.positions.size(), near.positions.size());
        for (size_t i = 0; i < near.positions.size(); ++i)
            EXPECT_NEAR((far.positions[i] - far.positions[0] - near.positions[i] + near.positions[0]).norm(), 0, 1e-6);
    }
}

TEST(MapCoordinates, PlyInDoublePrecisionKeepsItsShape) {
    files::Folder folder;
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const Surface surface = import_surface(
        folder.write("far.ply", header + "400000.1 5400000.1 0\n400000.2 5400000.1 0\n400000.1 5400000.4 0\n3 0 1 2\n"),
        {0, Vec3::UnitY()});
    const Vec3 size = surface.upper() - surface.lower();
    EXPECT_NEAR(size.x(), 0.1, 1e-6);
    EXPECT_NEAR(size.y(), 0.3, 1e-6);
}

TEST(MapCoordinates, RoundedAwayIsRefused) {
    files::Folder folder;
    const std::string facet =
        "facet normal 0 0 0\nouter loop\nvertex 400000 5400000 0\nvertex 400000.5 5400000 0\nvertex 400000 "
        "5400000.5 0\nendloop\nendfacet\n";
    try {
        import_surface(folder.write("far.stl", "solid far\n" + facet + "endsolid far\n"), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_BAD_GEOMETRY);
        EXPECT_NE(std::string(error.what()).find("origin"), std::string::npos) << error.what();
    }
}
