// Damaged, absurd and hostile files: each gives an error with name and cause or a valid surface, in bounded time, and
// never crashes this process.
#include <random>

#include "core/timer.hpp"
#include "io/import_damage.hpp"

namespace import_damage_tests {

void expect_valid(const Surface& surface) {
    ASSERT_FALSE(surface.triangles.empty());
    for (const Triangle& triangle : surface.triangles)
        for (int corner : triangle) ASSERT_TRUE(corner >= 0 && size_t(corner) < surface.positions.size());
    for (const Vec3& position : surface.positions) ASSERT_TRUE(position.allFinite());
    for (const Vec3f& normal : surface.normals) ASSERT_NEAR(normal.norm(), 1, 1e-3);
    ASSERT_EQ(surface.normals.size(), surface.positions.size());
}

// Returns whether the file was refused; the text must name it.
bool is_refused(const std::string& path, const std::string& name) {
    try {
        ImportLimits limits;
        limits.cpu_seconds = 2;
        limits.wall_seconds = 60;
        Surface surface = run_importer(path, limits);
        place_surface(surface, {});
        expect_valid(surface);
        return false;
    } catch (const Error& error) {
        EXPECT_TRUE(error.code == FROND_RESULT_FILE_FORMAT || error.code == FROND_RESULT_BAD_GEOMETRY) << error.what();
        if (error.code == FROND_RESULT_FILE_FORMAT) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
        EXPECT_GT(std::string(error.what()).size(), name.size() + 10);
        return true;
    }
}

TEST_F(ImportDamage, FilesCutAnywhereAreRefusedOrPartlyRead) {
    files::Folder folder;
    for (const Sample& sample : samples())
        for (int tenth = 0; tenth < 10; ++tenth) {
            const std::string cut = sample.bytes.substr(0, sample.bytes.size() * size_t(tenth) / 10);
            const bool refused = is_refused(folder.write(sample.name, cut), sample.name);
            // A truncated OBJ is a shorter OBJ, and an FBX ends with padding; every other format has an end that must
            // be present.
            const bool may_pass = sample.name[2] == 'o' || std::string(sample.name) == "b.fbx";
            EXPECT_TRUE(refused || may_pass) << sample.name << " cut to " << cut.size();
        }
}

TEST_F(ImportDamage, MutantsAreRefusedOrReadInBoundedTime) {
    files::Folder folder;
    std::mt19937 random(7);
    for (const Sample& sample : samples())
        for (int mutant = 0; mutant < 24; ++mutant) {
            std::string bytes = sample.bytes;
            const int changes = 1 + mutant % 4;
            for (int i = 0; i < changes; ++i) {
                const size_t at = random() % bytes.size();
                if (mutant % 3 == 0)
                    bytes[at] = char(random());
                else if (mutant % 3 == 1)
                    bytes.erase(at, 1 + random() % 8);
                else
                    bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 40));
            }
            const Timer timer;
            is_refused(folder.write(sample.name, bytes), sample.name);
            EXPECT_LT(timer.ms(), 60000) << sample.name << " mutant " << mutant;
        }
}

TEST_F(ImportDamage, ErrorsNameTheCause) {
    files::Folder folder;
    const struct {
        const char *name, *cause;
        std::string bytes;
    } ROWS[] = {
        {"a.ply", "end_header", "ply\nformat ascii 1.0\nelement vertex 3\n"},
        {"b.ply", "99999999999",
         "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n0\n"},
        {"c.ply", "cut off", files::ply(true).substr(0, files::ply(true).size() - 5)},
        {"d.ply", "line 12",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n0 1 0\n1 zwei 0\n3 0 1 2\n"},
        {"e.ply", "vertex 7",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n0 1 0\n1 0 0\n3 0 1 7\n"},
        {"f.ply", "point cloud",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n0 0 0\n"},
        {"a.obj", "line 4", "v 0 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 9\n"},
        {"b.obj", "no face", "v 0 0 0\nv 0 1 0\nv 1 0 0\n"},
        {"c.obj", "zero byte", std::string("v 0 0 0\0v 0 1 0\nf 1 2 3\n", 24)},
        {"a.stl", "5000000 triangles",
         std::string(80, ' ') + std::string("\x40\x4b\x4c\0", 4) + std::string(100, '\1')},
        {"b.stl", "endsolid", "solid x\nfacet normal 0 0 1\n"},
        {"a.glb", "cut off", files::glb().substr(0, 500)},
        {"b.glb", "JSON", files::glb_of("{\"asset\":", "")},
        {"a.gltf", "not in the model's folder", files::gltf_json("missing.bin")},
        {"b.gltf", "not in the model's folder", files::gltf_json("../../../../../../etc/passwd")},
        {"a.dae", "</COLLADA>", files::dae(false).substr(0, 2000)},
        {"a.fbx", "cut off", files::fbx(true).substr(0, 900)},
        {"b.fbx", "braces", files::fbx(false).substr(0, 900)},
        {"a.jpg", ".obj .ply", "x"},
        {"d.obj", "GLB", files::glb()},
        {"e.obj", "empty", ""},
    };
    for (const auto& row : ROWS) {
        const std::string error = error_of(folder.write(row.name, row.bytes));
        EXPECT_NE(error.find(row.name), std::string::npos) << error;
        EXPECT_NE(error.find(row.cause), std::string::npos) << row.name << ": " << error;
    }
}

TEST_F(ImportDamage, BadPathsAreToldApart) {
    files::Folder folder;
    EXPECT_NE(error_of(folder.path + "/none.obj").find("No such file"), std::string::npos);
    EXPECT_NE(error_of(folder.path).find("directory"), std::string::npos);
#ifndef _WIN32
    EXPECT_NE(error_of("/dev/null").find("not a regular file"), std::string::npos);
#endif
    EXPECT_NE(error_of("").find("empty"), std::string::npos);
    EXPECT_NE(error_of(std::string("/tmp/a\0b.obj", 12)).find("zero byte"), std::string::npos);
}

TEST_F(ImportDamage, AbsurdCoordinatesLoseTheirTrianglesOnly) {
    files::Folder folder;
    const std::string good = files::obj();
    const Surface surface =
        import_surface(folder.write("a.obj", good + "v 1e30 0 0\nv nan 0 0\nf 1 2 13\nf 1 2 14\n"), {});
    EXPECT_EQ(surface.triangles.size(), 10u);
    EXPECT_EQ(surface.dropped_triangles, 2);
    EXPECT_NEAR(surface.height(), 0.5, 1e-6);
    EXPECT_NE(error_of(folder.write("b.obj", "v nan 0 0\nv nan 1 0\nv nan 0 1\nf 1 2 3\n")).find("b.obj"),
              std::string::npos);
}

TEST_F(ImportDamage, AHugeModelIsRefusedNotTried) {
    // Instances of instances: 2^30 leaves.
    std::string nodes;
    for (int level = 0; level < 30; ++level)
        nodes += "{\"children\":[" + std::to_string(level + 1) + "," + std::to_string(level + 1) + "]},";
    std::string json = files::gltf_json();
    const size_t begin = json.find("\"nodes\":[{\"name\""), end = json.find("\"meshes\"");
    json.replace(begin, end - begin, "\"nodes\":[" + nodes + "{\"mesh\":0}],");
    files::Folder folder;
    EXPECT_TRUE(is_refused(folder.write("bomb.glb", files::glb_of(json, files::glb_binary())), "bomb.glb"));
}

TEST_F(ImportDamage, DeepNestingDoesNotCrash) {
    files::Folder folder;
    EXPECT_TRUE(is_refused(folder.write("deep.gltf", std::string(200000, '[')), "deep.gltf"));
    std::string dae = files::dae(false), open, close;
    for (int i = 0; i < 100000; ++i) {
        open += "<node>";
        close += "</node>";
    }
    dae.insert(dae.find("<node id=\"n1\""), open + close);
    is_refused(folder.write("deep.dae", dae), "deep.dae");
}

TEST_F(ImportDamage, TooMuchOutputIsRefused) {
    files::Folder folder;
    ImportLimits limits;
    limits.output_mib = 0.0001;
    EXPECT_THROW(run_importer(folder.write("a.obj", files::obj()), limits), Error);
}

TEST(ImportStream, RefusesEveryCutAndEveryChangedByte) {
    ImportResult result;
    result.warnings = {"careful"};
    const float xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const int32_t indices[] = {0, 1, 2};
    result.surface = surface_from_triangles(xyz, 3, indices, 1);
    const std::string bytes = encode_import(result);
    ImportResult back;
    ASSERT_TRUE(decode_import(bytes.data(), bytes.size(), back));
    EXPECT_EQ(back.warnings, result.warnings);
    EXPECT_EQ(back.surface.triangles, result.surface.triangles);
    EXPECT_EQ(back.surface.positions, result.surface.positions);
    for (size_t count = 0; count < bytes.size(); ++count) {
        ImportResult cut;
        EXPECT_FALSE(decode_import(bytes.data(), count, cut));
    }
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i] = char(changed[i] ^ 0x41);
        ImportResult other;
        EXPECT_FALSE(decode_import(changed.data(), changed.size(), other)) << i;
    }
}

TEST(ImportStream, RefusesASurfaceThatDoesNotHoldTogether) {
    const float xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const int32_t indices[] = {0, 1, 2};
    const Surface good = surface_from_triangles(xyz, 3, indices, 1);
    const auto is_accepted = [](const Surface& surface) {
        ImportResult result, back;
        result.surface = surface;
        const std::string bytes = encode_import(result);
        return decode_import(bytes.data(), bytes.size(), back);
    };
    EXPECT_TRUE(is_accepted(good));
    Surface bad = good;
    bad.triangles[0][1] = 3;
    EXPECT_FALSE(is_accepted(bad));
    bad = good;
    bad.parts[0].triangle_count = 2;
    EXPECT_FALSE(is_accepted(bad));
    bad = good;
    bad.parts[0].texture = 0;
    EXPECT_FALSE(is_accepted(bad));
    bad = good;
    bad.uvs.resize(2);
    EXPECT_FALSE(is_accepted(bad));
    bad = good;
    bad.scale = NAN;
    EXPECT_FALSE(is_accepted(bad));
}

}  // namespace import_damage_tests
