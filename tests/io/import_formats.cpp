// Each format's small plant is imported with its nodes' transforms, names, colours and texture coordinates.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

static const Part* find_part(const Surface& surface, const std::string& name) {
    for (const Part& part : surface.parts)
        if (part.name == name) return &part;
    return nullptr;
}

static Vec3 face_normal(const Surface& surface, int triangle) {
    const Triangle& t = surface.triangles[size_t(triangle)];
    const Vec3 a = surface.positions[size_t(t[0])];
    return (surface.positions[size_t(t[1])] - a).cross(surface.positions[size_t(t[2])] - a).normalized();
}

// Checks that stem and leaf are in place: the leaf raised and mirrored, and still facing down.
static void expect_plant(const Surface& surface) {
    EXPECT_NEAR(surface.lower().x(), -0.2, 1e-6);
    EXPECT_NEAR(surface.upper().x(), 0.01, 1e-6);
    EXPECT_NEAR(surface.lower().y(), 0, 1e-6);
    EXPECT_NEAR(surface.upper().y(), 0.5, 1e-6);
    EXPECT_NEAR(surface.lower().z(), -0.01, 1e-6);
    EXPECT_NEAR(surface.upper().z(), 0.1, 1e-6);
    EXPECT_EQ(surface.positions.size(), 12u);
    EXPECT_EQ(surface.triangles.size(), 10u);
    ASSERT_EQ(surface.normals.size(), 12u);
    const Part *stem = find_part(surface, "stem"), *leaf = find_part(surface, "leaf");
    ASSERT_TRUE(stem && leaf);
    EXPECT_EQ(stem->triangle_count, 8);
    EXPECT_EQ(leaf->triangle_count, 2);
    for (int t = 0; t < 2; ++t) EXPECT_LT(face_normal(surface, leaf->first_triangle + t).y(), -0.99);
    for (int corner : surface.triangles[size_t(leaf->first_triangle)]) {
        EXPECT_NEAR(surface.positions[size_t(corner)].y(), 0.4, 1e-6);
        EXPECT_LT(surface.normals[size_t(corner)].y(), -0.99f);
    }
    // The stem's sides face outwards.
    for (int t = stem->first_triangle; t < stem->first_triangle + 8; ++t) {
        const Triangle& corners = surface.triangles[size_t(t)];
        Vec3 middle = Vec3::Zero();
        for (int corner : corners) middle += surface.positions[size_t(corner)] / 3;
        EXPECT_GT(face_normal(surface, t).dot(Vec3(middle.x(), 0, middle.z())), 0);
    }
}

TEST(Import, ReadsObj) {
    files::Folder folder;
    const Surface surface = import_surface(folder.write("plant.obj", files::obj()), {});
    expect_plant(surface);
    EXPECT_EQ(find_part(surface, "leaf")->material, "green");
    ASSERT_EQ(surface.uvs.size(), 12u);
    // The file's v is counted from the bottom, ours from the top.
    const int first = surface.triangles[size_t(find_part(surface, "leaf")->first_triangle)][0];
    EXPECT_NEAR(surface.uvs[size_t(first)].y(), 1, 1e-6);
}

TEST(Import, ReadsObjWithMaterialsAndTexture) {
    files::Folder folder;
    folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.5 0\nnewmtl green\nKd 0 0 0\nmap_Kd C:\\work\\Leaf.PNG\n");
    folder.write("leaf.png", files::png());
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
    const Part *stem = find_part(surface, "stem"), *leaf = find_part(surface, "leaf");
    ASSERT_TRUE(stem && leaf);
    EXPECT_NEAR(stem->color[0], 0.2140f, 1e-3f) << "display colours become linear";
    EXPECT_NEAR(stem->color[2], 0.0f, 1e-6f);
    ASSERT_EQ(leaf->texture, 0) << "found by its bare name beside the model, whatever the case of its letters";
    EXPECT_EQ(leaf->color[0], 1.0f);
    const std::string bytes(surface.textures[0].bytes.begin(), surface.textures[0].bytes.end());
    EXPECT_EQ(bytes, files::png());
}

TEST(Import, TintsATextureWithTheColorOfAnMtlFileUnlessThatIsGrey) {
    const struct {
        const char* color;
        float green, blue;
    } cases[] = {{"0.5 0.5 0", 0.2140f, 0}, {"0.8 0.8 0.8", 1, 1}, {"0 0 0", 1, 1}};
    for (const auto& expected : cases) {
        files::Folder folder;
        folder.write("plant.mtl",
                     std::string("newmtl green\nKd ") + expected.color + "\nmap_Kd leaf.png\nnewmtl bark\nKd 1 1 1\n");
        folder.write("leaf.png", files::png());
        const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
        const Part* leaf = find_part(surface, "leaf");
        ASSERT_TRUE(leaf && leaf->texture == 0);
        EXPECT_NEAR(leaf->color[1], expected.green, 1e-3f) << expected.color;
        EXPECT_NEAR(leaf->color[2], expected.blue, 1e-3f) << expected.color;
    }
}

TEST(Import, DoesNotReadTexturesOutsideTheModelsFolder) {
    files::Folder outside, folder;
    outside.write("secret.png", files::png());
    for (const std::string& reference :
         {outside.path + "/secret.png", "../" + outside.path.substr(5) + "/secret.png", std::string("/etc/passwd")}) {
        folder.write("plant.mtl", "newmtl bark\nKd 0.5 0.5 0\nnewmtl green\nKd 0.25 0.5 0\nmap_Kd " + reference + "\n");
        const Surface surface = import_surface(folder.write("plant.obj", files::obj(false, "plant.mtl")), {});
        EXPECT_TRUE(surface.textures.empty()) << reference;
        EXPECT_EQ(find_part(surface, "leaf")->texture, -1);
        EXPECT_NEAR(find_part(surface, "leaf")->color[1], 0.2140f, 1e-3f);
    }
}

TEST(Import, KeepsVertexColorsOfObjAndItsVertexCount) {
    files::Folder folder;
    const Surface surface = import_surface(folder.write("plant.obj", files::obj(true)), {});
    expect_plant(surface);
    EXPECT_TRUE(surface.uvs.empty());
    ASSERT_EQ(surface.colors.size(), 12u);
    EXPECT_EQ(surface.colors[3], (Color{64, 128, 32, 255}));
}

TEST(Import, ObjWithoutNormalsKeepsExactlyItsVertices) {
    // A grid of quads that share their corners: as many vertices as "v" lines, not one for each corner.
    std::string text;
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 30; ++i)
            text += "v " + std::to_string(0.01 * i) + " " + std::to_string(0.02 * j) + " " +
                    std::to_string(0.001 * i * j) + " 0.2 0.6 0.1\n";
    for (int j = 0; j < 19; ++j)
        for (int i = 0; i < 29; ++i)
            text += "f " + std::to_string(30 * j + i + 1) + " " + std::to_string(30 * j + i + 2) + " " +
                    std::to_string(30 * j + i + 32) + " " + std::to_string(30 * j + i + 31) + "\n";
    files::Folder folder;
    const Surface surface = import_surface(folder.write("grid.obj", text), {});
    EXPECT_EQ(surface.positions.size(), 600u);
    EXPECT_EQ(surface.triangles.size(), size_t(2 * 19 * 29));
    EXPECT_EQ(surface.repaired_vertices, 0) << "a file without normals is not damaged";
}

TEST(Import, ReadsPlyTextAndBinaryAlike) {
    files::Folder folder;
    const Surface text = import_surface(folder.write("stem.ply", files::ply(false)), {});
    const Surface binary = import_surface(folder.write("stem_b.ply", files::ply(true)), {});
    EXPECT_EQ(text.positions.size(), 8u);
    EXPECT_EQ(text.triangles.size(), 8u);
    ASSERT_EQ(text.positions.size(), binary.positions.size());
    for (size_t i = 0; i < 8; ++i) {
        EXPECT_LT((text.positions[i] - binary.positions[i]).norm(), 1e-7);
        EXPECT_EQ(text.colors[i], (Color{64, 128, 32, 255}));
        EXPECT_EQ(binary.colors[i], (Color{64, 128, 32, 255}));
    }
    EXPECT_EQ(text.triangles, binary.triangles);
    EXPECT_EQ(text.parts[0].name, "stem");
}

TEST(Import, ReadsPlyBigEndianStripsQuadsAndCornerTexture) {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    const auto put_swapped = [&bytes](auto value) {
        std::string one;
        files::put(one, value);
        bytes.append(one.rbegin(), one.rend());
    };
    for (double value : {0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.3, 0.0, 0.1, 0.3, 0.0}) put_swapped(value);
    for (int32_t value : {4, 0, 1, 2, 3}) put_swapped(value);
    files::Folder folder;
    const Surface strip = import_surface(folder.write("strip.ply", bytes), {});
    ASSERT_EQ(strip.triangles.size(), 2u);
    EXPECT_GT(face_normal(strip, 0).z(), 0.99);
    EXPECT_GT(face_normal(strip, 1).z(), 0.99) << "every second triangle of a strip is turned";

    const std::string quad =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
        "1\n"
        "property list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n";
    const Surface surface = import_surface(folder.write("quad.ply", quad), {});
    EXPECT_EQ(surface.triangles.size(), 2u);
    EXPECT_EQ(surface.positions.size(), 4u);
    ASSERT_EQ(surface.uvs.size(), 4u);
    EXPECT_EQ(surface.uvs[0], Vec2f(0, 1));
    EXPECT_EQ(surface.uvs[2], Vec2f(1, 0));
}

TEST(Import, ReadsStlTextAndBinaryAlike) {
    files::Folder folder;
    for (bool is_binary : {false, true}) {
        const Surface surface = import_surface(folder.write("stem.stl", files::stl(is_binary)), {});
        EXPECT_EQ(surface.positions.size(), 8u) << "corners at the same place are one vertex";
        EXPECT_EQ(surface.triangles.size(), 8u);
    }
}

static void expect_gltf(const Surface& surface) {
    ASSERT_EQ(surface.parts.size(), 3u) << "an instance is a part of its own";
    EXPECT_EQ(surface.positions.size(), 16u);
    const Part *stem = find_part(surface, "stem"), *leaf = find_part(surface, "leaf"),
               *twin = find_part(surface, "leaf_twin");
    ASSERT_TRUE(stem && leaf && twin);
    EXPECT_NEAR(stem->color[0], 0.25f, 1e-6f) << "glTF's factors are linear";
    EXPECT_NEAR(leaf->color[1], 0.5f, 1e-6f);
    ASSERT_EQ(leaf->texture, 0);
    EXPECT_EQ(twin->texture, 0);
    EXPECT_EQ(surface.textures.size(), 1u);
    const std::string bytes(surface.textures[0].bytes.begin(), surface.textures[0].bytes.end());
    EXPECT_EQ(bytes, files::png());
    EXPECT_LT(face_normal(surface, leaf->first_triangle).y(), -0.99);
    EXPECT_LT(face_normal(surface, twin->first_triangle).y(), -0.99);
    EXPECT_LT(surface.positions[size_t(surface.triangles[size_t(leaf->first_triangle)][1])].x(), -0.1);
    EXPECT_GT(surface.positions[size_t(surface.triangles[size_t(twin->first_triangle)][1])].x(), 0.1);
    const Vec2f uv = surface.uvs[size_t(surface.triangles[size_t(leaf->first_triangle)][1])];
    EXPECT_NEAR(uv.y(), 0.25f, 1e-6f) << "v = 0 is the top row, as in the file";
}

TEST(Import, ReadsGlb) {
    files::Folder folder;
    expect_gltf(import_surface(folder.write("plant.glb", files::glb()), {}));
}

TEST(Import, ReadsGltfWithItsBufferBesideIt) {
    files::Folder folder;
    folder.write("plant data.bin", files::glb_binary());
    expect_gltf(import_surface(folder.write("plant.gltf", files::gltf_json("plant%20data.bin")), {}));
}

TEST(Import, ReadsQuantizedGltf) {
    // A quad in 16-bit integers, scaled by its node, with normals in bytes.
    std::string binary;
    for (const auto& corner :
         std::vector<std::array<int16_t, 4>>{{0, 0, 0, 0}, {32767, 0, 0, 0}, {32767, 0, 16384, 0}, {0, 0, 16384, 0}})
        for (int16_t value : corner) files::put(binary, value);
    for (int i = 0; i < 4; ++i)
        for (int8_t value : {0, 127, 0, 0}) files::put(binary, value);
    for (const auto& uv : std::vector<std::array<uint16_t, 2>>{{0, 0}, {65535, 0}, {65535, 65535}, {0, 65535}})
        for (uint16_t value : uv) files::put(binary, value);
    for (uint16_t index : {0, 2, 1, 0, 3, 2}) files::put(binary, index);
    const std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"extensionsUsed":["KHR_mesh_quantization","KHR_texture_transform","EXT_texture_webp"],
"extensionsRequired":["KHR_mesh_quantization","KHR_texture_transform","EXT_texture_webp"],
"nodes":[{"name":"leaf","mesh":0,"scale":[0.4,0.4,0.4]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],
"materials":[{"name":"green","pbrMetallicRoughness":{"baseColorTexture":{"index":0,
"extensions":{"KHR_texture_transform":{"offset":[0.25,0],"scale":[0.5,2]}}}}}],
"textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}],"images":[{"uri":"leaf.webp"}],
"accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5120,"normalized":true,"count":4,"type":"VEC3"},
{"bufferView":2,"componentType":5123,"normalized":true,"count":4,"type":"VEC2"},
{"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":32,"byteStride":8},{"buffer":0,"byteOffset":32,"byteLength":16,"byteStride":4},
{"buffer":0,"byteOffset":48,"byteLength":16,"byteStride":4},{"buffer":0,"byteOffset":64,"byteLength":12}],
"buffers":[{"byteLength":76}]})";
    files::Folder folder;
    folder.write("leaf.webp", files::png());
    const Surface surface = import_surface(folder.write("leaf.glb", files::glb_of(json, binary)), {});
    ASSERT_EQ(surface.positions.size(), 4u);
    EXPECT_NEAR(surface.upper().x(), 0.4, 1e-6);
    EXPECT_NEAR(surface.upper().z(), 0.2, 1e-4);
    EXPECT_GT(surface.normals[0].y(), 0.99f);
    EXPECT_NEAR(surface.uvs[2].x(), 0.75f, 1e-5f);
    EXPECT_NEAR(surface.uvs[2].y(), 2.0f, 1e-5f);
    EXPECT_EQ(surface.parts[0].texture, 0);
}

TEST(Import, NamesTheGltfExtensionThatItDoesNotRead) {
    files::Folder folder;
    std::string json = files::gltf_json();
    json.insert(1, "\"extensionsRequired\":[\"VENDOR_secret_meshes\"],");
    try {
        import_surface(folder.write("plant.glb", files::glb_of(json, files::glb_binary())), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, FROND_RESULT_FILE_FORMAT);
        EXPECT_NE(std::string(error.what()).find("VENDOR_secret_meshes"), std::string::npos) << error.what();
    }
}

TEST(Import, ReadsColladaInCentimetresWithEitherUpAxis) {
    files::Folder folder;
    for (bool is_z_up : {false, true}) {
        const Surface surface = import_surface(folder.write("plant.dae", files::dae(is_z_up)), {});
        expect_plant(surface);
        EXPECT_NEAR(surface.scale, 0.01, 1e-12);
        EXPECT_LT((surface.up - (is_z_up ? Vec3::UnitZ() : Vec3::UnitY())).norm(), 1e-12);
        EXPECT_EQ(surface.parts[0].material, "green");
        EXPECT_NEAR(surface.parts[0].color[0], 0.2140f, 1e-3f);
    }
}

TEST(Import, ReadsFbxTextAndBinaryInItsUnitsAndAxes) {
    files::Folder folder;
    for (bool is_binary : {false, true})
        for (int up_axis : {1, 2})
            for (double unit : {1.0, 2.54, 100.0}) {
                const Surface surface =
                    import_surface(folder.write("plant.fbx", files::fbx(is_binary, up_axis, unit)), {});
                expect_plant(surface);
                EXPECT_NEAR(surface.scale, 0.01 * unit, 1e-9);
                EXPECT_EQ(surface.up[up_axis], 1);
                EXPECT_EQ(surface.parts[0].material, "green");
                EXPECT_NEAR(surface.parts[0].color[0], 0.2140f, 1e-3f);
            }
}

TEST(Import, LeavesCoarserLevelsOfDetailOut) {
    files::Folder folder;
    std::string json = files::gltf_json();
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"\"leaf\"", "\"leaf_LOD0\""}, {"\"leaf_twin\"", "\"leaf_LOD1\""}})
        json.replace(json.find(from), from.size(), to);
    const Surface surface = import_surface(folder.write("plant.glb", files::glb_of(json, files::glb_binary())), {});
    EXPECT_EQ(surface.parts.size(), 2u);
    EXPECT_TRUE(find_part(surface, "leaf_LOD0"));
}

TEST(Import, SkinnedMeshesStandAsTheirBonesDo) {
    // One triangle, bound to a joint at the origin; the joint is then 0.3 m up and rotated by 90 degrees about z.
    std::string binary = files::bytes_of(std::vector<float>{0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0});
    for (int i = 0; i < 3; ++i) binary += std::string(4, '\0');
    for (int i = 0; i < 3; ++i) binary += files::bytes_of(std::vector<float>{1, 0, 0, 0});
    binary += files::bytes_of(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"name":"leaf","mesh":0,"skin":0,"translation":[5,5,5]},{"name":"bone","translation":[0,0.3,0],
"rotation":[0,0,0.70710678,0.70710678]}],"skins":[{"joints":[1],"inverseBindMatrices":3}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"},{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"},
{"bufferView":3,"componentType":5126,"count":1,"type":"MAT4"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},
{"buffer":0,"byteOffset":48,"byteLength":48},{"buffer":0,"byteOffset":96,"byteLength":64}],"buffers":[{"byteLength":160}]})";
    files::Folder folder;
    const Surface surface = import_surface(folder.write("leaf.glb", files::glb_of(json, binary)), {});
    EXPECT_NEAR(surface.lower().x(), -0.1, 1e-5);
    EXPECT_NEAR(surface.upper().x(), 0, 1e-5);
    EXPECT_NEAR(surface.lower().y(), 0.3, 1e-5);
    EXPECT_NEAR(surface.upper().y(), 0.4, 1e-5);
}
