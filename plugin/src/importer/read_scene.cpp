// Reads a mesh file through assimp. In: bytes. Out: a surface. assimp gets the bytes that were checked, and can open
// other files only in the model's folder.
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>

#include "core/platform/files.hpp"
#include "importer/importer.hpp"

namespace frond {

class MemoryFile : public Assimp::IOStream {
public:
    explicit MemoryFile(std::string content) : bytes(std::move(content)) {}
    size_t Read(void* out, size_t size, size_t count) override {
        if (size == 0) return 0;
        count = std::min(count, (bytes.size() - at) / size);
        std::memcpy(out, bytes.data() + at, size * count);
        at += size * count;
        return count;
    }
    size_t Write(const void*, size_t, size_t) override { return 0; }
    aiReturn Seek(size_t offset, aiOrigin origin) override {
        const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at : bytes.size();
        if (offset > bytes.size() - base) return aiReturn_FAILURE;
        at = base + offset;
        return aiReturn_SUCCESS;
    }
    size_t Tell() const override { return at; }
    size_t FileSize() const override { return bytes.size(); }
    void Flush() override {}

private:
    std::string bytes;
    size_t at = 0;
};

// Gives assimp the model's own bytes and the files in its folder.
class ModelFolder : public Assimp::IOSystem {
public:
    ModelFolder(const MeshFile& file, const std::string& bytes) : file(file), bytes(bytes) {}
    bool Exists(const char* path) const override { return path == file.path || !find(path).empty(); }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        if (!std::strchr(mode, 'r')) return nullptr;
        if (path == file.path) return new MemoryFile(bytes);
        const std::string found = find(path);
        std::string content, error;
        if (found.empty() || !read_file(found, LARGEST, content, error)) return nullptr;
        return new MemoryFile(std::move(content));
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    static constexpr size_t LARGEST = size_t(1) << 30;  // [byte]
    const MeshFile& file;
    const std::string& bytes;
    // assimp puts the folder in front of a reference; here it is removed again.
    std::string find(const char* path) const {
        std::string reference = path;
        for (const std::string& prefix : {file.folder + "/", std::string("./")})
            if (reference.compare(0, prefix.size(), prefix) == 0) reference = reference.substr(prefix.size());
        return find_beside(file.folder, reference);
    }
};

static std::string rewrite(const MeshFile& file) {
    switch (file.format) {
        case FileFormat::GLTF:
        case FileFormat::GLB:
            return rewrite_gltf(file);
        case FileFormat::OBJ:
            return rewrite_obj(file);
        case FileFormat::DAE:
            return rewrite_dae(file);
        default:
            return "";
    }
}

Surface read_scene(const MeshFile& file) {
    const std::string rewritten = rewrite(file);
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFolder(file, rewritten.empty() ? file.bytes : rewritten));
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, file.ignores_up);
    const aiScene* scene = importer.ReadFile(file.path, aiProcess_Triangulate);
    if (!scene) {
        const char* text = importer.GetErrorString();
        fail(FROND_RESULT_FILE_FORMAT, "the file could not be read: %s",
             text && *text ? text : "the reader gives no cause");
    }
    return take_scene(*scene, file);
}

}  // namespace frond
