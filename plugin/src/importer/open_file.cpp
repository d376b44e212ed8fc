// Opens a mesh file. In: a path. Out: bytes and format. The format follows from the name's ending; the content must
// agree.
#include <strings.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "importer/check.hpp"

namespace frond {

static constexpr long long LARGEST_FILE = 1ll << 30;  // [byte]

static std::string read_bytes(const std::string& path) {
    struct stat status;
    if (stat(path.c_str(), &status) != 0) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", strerror(errno));
    if (!S_ISREG(status.st_mode)) fail(FROND_RESULT_FILE_NOT_FOUND, "not a regular file");
    if (status.st_size == 0) fail(FROND_RESULT_FILE_FORMAT, "the file is empty");
    if (status.st_size > LARGEST_FILE) fail(FROND_RESULT_FILE_FORMAT, "the file is larger than 1 GiB");
    FILE* file = fopen(path.c_str(), "rb");
    if (!file) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", strerror(errno));
    std::string bytes(size_t(status.st_size), '\0');
    const size_t count = fread(&bytes[0], 1, bytes.size(), file);
    fclose(file);
    if (count != bytes.size())
        fail(FROND_RESULT_FILE_NOT_FOUND, "only %zu of %zu bytes could be read", count, bytes.size());
    return bytes;
}

static FileFormat format_by_name(const std::string& name) {
    static const struct {
        const char* ending;
        FileFormat format;
    } ROWS[] = {{".obj", FileFormat::OBJ}, {".ply", FileFormat::PLY},  {".gltf", FileFormat::GLTF},
                {".glb", FileFormat::GLB}, {".fbx", FileFormat::FBX},  {".dae", FileFormat::DAE},
                {".stl", FileFormat::STL}, {".urdf", FileFormat::URDF}};
    const size_t dot = name.rfind('.');
    const std::string ending = dot == std::string::npos ? "" : name.substr(dot);
    for (const auto& row : ROWS)
        if (strcasecmp(row.ending, ending.c_str()) == 0) return row.format;
    fail(FROND_RESULT_FILE_FORMAT,
         "the name ends in \"%s\"; meshes are read from .obj .ply .gltf .glb .fbx .dae .stl, trees of links from .urdf",
         ending.c_str());
}

static bool starts_with(const std::string& bytes, const char* text) {
    return bytes.compare(0, strlen(text), text) == 0;
}

// Returns the format that the first bytes indicate, for formats with a magic number; null if there is none.
static const char* format_by_content(const std::string& bytes) {
    if (starts_with(bytes, "glTF")) return "GLB";
    if (starts_with(bytes, "Kaydara FBX Binary")) return "FBX";
    if (starts_with(bytes, "ply\n") || starts_with(bytes, "ply\r")) return "PLY";
    if (starts_with(bytes, "\x89PNG")) return "PNG";
    if (starts_with(bytes, "\xff\xd8\xff")) return "JPEG";
    if (starts_with(bytes, "PK\x03\x04")) return "ZIP";
    if (starts_with(bytes, "\x1f\x8b")) return "gzip";
    if (starts_with(bytes, "BLENDER")) return "Blender";
    if (starts_with(bytes, "version https://git-lfs")) return "Git LFS pointer";
    return nullptr;
}

static const char* name_of(FileFormat format) {
    static const char* const NAMES[] = {"OBJ", "PLY", "glTF", "GLB", "FBX", "DAE", "STL", "URDF"};
    return NAMES[int(format)];
}

MeshFile open_file(const std::string& path) {
    MeshFile file;
    file.path = path;
    const size_t slash = path.rfind('/');
    file.name = path.substr(slash + 1);
    file.folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
    file.format = format_by_name(file.name);
    file.bytes = read_bytes(path);

    const char* content = format_by_content(file.bytes);
    if (content && strcmp(content, name_of(file.format)) != 0 && file.format != FileFormat::STL)
        fail(FROND_RESULT_FILE_FORMAT, "the content is that of a %s file, not of the %s file that the name promises",
             content, name_of(file.format));
    const bool is_text = file.format == FileFormat::OBJ || file.format == FileFormat::GLTF ||
                         file.format == FileFormat::DAE || file.format == FileFormat::URDF;
    const bool is_wide = starts_with(file.bytes, "\xff\xfe") || starts_with(file.bytes, "\xfe\xff");
    const size_t zero = file.bytes.find('\0');
    if (is_text && !is_wide && zero != std::string::npos)
        fail(FROND_RESULT_FILE_FORMAT,
             "the file has a zero byte at %zu, so it is not the %s text that the name promises", zero,
             name_of(file.format));
    return file;
}

void check_file(const MeshFile& file) {
    switch (file.format) {
        case FileFormat::OBJ:
            return check_obj(file);
        case FileFormat::PLY:
        case FileFormat::URDF:
            return;  // the reader itself checks
        case FileFormat::GLTF:
        case FileFormat::GLB:
            return check_gltf(file);
        case FileFormat::FBX:
            return check_fbx(file);
        case FileFormat::DAE:
            return check_dae(file);
        case FileFormat::STL:
            return check_stl(file);
    }
}

}  // namespace frond
