// glTF compressed by meshoptimizer is unpacked; what is damaged is refused.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "core/error.hpp"
#include "io/import.hpp"
#include "io/import_files.hpp"

using namespace frond;

// Returns a stem in glTF whose positions and indices are compressed, and the buffer.
static std::string compressed_json(std::string& buffer) {
    const std::vector<float> positions = files::stem_positions();
    const std::vector<uint32_t> indices = files::stem_indices();
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(8, 12)),
        triangles(meshopt_encodeIndexBufferBound(24, 8));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 8, 12));
    triangles.resize(meshopt_encodeIndexBuffer(triangles.data(), triangles.size(), indices.data(), 24));
    buffer = files::bytes_of(vertices) + files::bytes_of(triangles);
    const auto view = [](size_t offset, size_t length, const std::string& rest) {
        return "{\"buffer\":1,\"byteLength\":96,\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,"
               "\"byteOffset\":" +
               std::to_string(offset) + ",\"byteLength\":" + std::to_string(length) + rest + "}}}";
    };
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"stem","mesh":0}],
"extensionsUsed":["EXT_meshopt_compression"],"extensionsRequired":["EXT_meshopt_compression"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,0,-1],"max":[1,1,1]},
{"bufferView":1,"componentType":5125,"count":24,"type":"SCALAR"}],"bufferViews":[)" +
           view(0, vertices.size(), ",\"byteStride\":12,\"mode\":\"ATTRIBUTES\",\"count\":8") + "," +
           view(vertices.size(), triangles.size(), ",\"byteStride\":4,\"mode\":\"TRIANGLES\",\"count\":24") +
           "],\"buffers\":[{\"byteLength\":" + std::to_string(buffer.size()) +
           "},{\"byteLength\":192,\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}]}";
}

TEST(Import, ReadsCompressedGltf) {
    files::Folder folder;
    std::string buffer;
    const std::string json = compressed_json(buffer);
    const Surface surface = import_surface(folder.write("stem.glb", files::glb_of(json, buffer)), {});
    EXPECT_EQ(surface.triangles.size(), 8u);
    EXPECT_EQ(surface.positions.size(), 8u);
    EXPECT_NEAR(surface.height(), 0.5, 1e-6);
    // A view outside its buffer is refused.
    for (const char* place : {"\"byteOffset\":-8", "\"byteOffset\":9000000000000000000"}) {
        std::string bad = json;
        bad.replace(bad.find("\"byteOffset\":0"), 14, place);
        EXPECT_THROW(import_surface(folder.write("bad.glb", files::glb_of(bad, buffer)), {}), Error) << place;
    }
}
