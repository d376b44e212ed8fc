// Opens a mesh file. In: a path. Out: bytes and format. The format follows from the name's ending; the content must
// agree.
#include <cstring>

#include "core/platform/files.hpp"
#include "importer/check.hpp"

namespace frond {

static constexpr uint64_t LARGEST_FILE = 1ull << 30;  // [byte]

static std::string read_bytes(const std::string& path) {
    const FileStatus status = status_of(path);
    if (!status.exists) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", status.error.c_str());
    if (!status.is_regular) fail(FROND_RESULT_FILE_NOT_FOUND, "not a regular file");
    if (status.size == 0) fail(FROND_RESULT_FILE_FORMAT, "the file is empty");
    if (status.size > LARGEST_FILE) fail(FROND_RESULT_FILE_FORMAT, "the file is larger than 1 GiB");
    std::string bytes, error;
    if (!read_file(path, status.size, bytes, error)) fail(FROND_RESULT_FILE_NOT_FOUND, "%s", error.c_str());
    if (bytes.size() != status.size)
        fail(FROND_RESULT_FILE_NOT_FOUND, "only %zu of %zu bytes could be read", bytes.size(), size_t(status.size));
    return bytes;
}

// One row for each FileFormat. Formats without a check are checked by their reader.
struct FormatRow {
    const char *ending, *name;
    bool is_text;
    void (*check)(const MeshFile& file);
};
static const FormatRow FORMATS[] = {
    {".obj", "OBJ", true, check_obj},   {".ply", "PLY", false, nullptr},   {".gltf", "glTF", true, check_gltf},
    {".glb", "GLB", false, check_gltf}, {".fbx", "FBX", false, check_fbx}, {".dae", "DAE", true, check_dae},
    {".stl", "STL", false, check_stl},  {".urdf", "URDF", true, nullptr},
};
static_assert(sizeof FORMATS / sizeof FORMATS[0] == size_t(FileFormat::URDF) + 1, "every format needs its row");

static const FormatRow& row_of(FileFormat format) {
    return FORMATS[size_t(format)];
}

static FileFormat format_by_name(const std::string& name) {
    std::string meshes;
    for (size_t i = 0; i <= size_t(FileFormat::URDF); ++i) {
        if (has_ending(name, FORMATS[i].ending)) return FileFormat(i);
        if (FileFormat(i) != FileFormat::URDF) meshes += std::string(" ") + FORMATS[i].ending;
    }
    const size_t dot = name.rfind('.');
    const std::string ending = dot == std::string::npos ? "" : name.substr(dot);
    fail(FROND_RESULT_FILE_FORMAT, "the name ends in \"%s\"; meshes are read from%s, trees of links from .urdf",
         ending.c_str(), meshes.c_str());
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

MeshFile open_file(const std::string& path) {
    MeshFile file;
    file.path = path;
    file.name = file_name(path);
    file.folder = folder_of(path);
    file.format = format_by_name(file.name);
    file.bytes = read_bytes(path);

    const char* content = format_by_content(file.bytes);
    const FormatRow& row = row_of(file.format);
    if (content && strcmp(content, row.name) != 0 && file.format != FileFormat::STL)
        fail(FROND_RESULT_FILE_FORMAT, "the content is that of a %s file, not of the %s file that the name promises",
             content, row.name);
    const bool is_wide = starts_with(file.bytes, "\xff\xfe") || starts_with(file.bytes, "\xfe\xff");
    const size_t zero = file.bytes.find('\0');
    if (row.is_text && !is_wide && zero != std::string::npos)
        fail(FROND_RESULT_FILE_FORMAT,
             "the file has a zero byte at %zu, so it is not the %s text that the name promises", zero, row.name);
    return file;
}

void check_file(const MeshFile& file) {
    if (row_of(file.format).check) row_of(file.format).check(file);
}

}  // namespace frond
