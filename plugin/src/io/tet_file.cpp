// Reads tet files. In: a path. Out: nodes, tets and named regions. The format follows from the name's ending; the
// readers are our own and trust nothing.
#include "io/tet_file.hpp"

#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "core/platform/files.hpp"
#include "core/platform/number_text.hpp"

namespace frond {

static constexpr uint64_t LARGEST_TET_FILE = 1ull << 30;  // [byte]

// The formats.
struct TetFormat {
    const char* ending;
    TetMesh (*read)(TetFile& file);
};
static const TetFormat TET_FORMATS[] = {{".msh", read_gmsh}, {".vtk", read_vtk}};

static const TetFormat* format_of(const std::string& path) {
    for (const TetFormat& format : TET_FORMATS)
        if (has_ending(path, format.ending)) return &format;
    return nullptr;
}

bool is_tet_file(const std::string& path) {
    return format_of(path) != nullptr;
}

void fail_at(const TetFile& file, const std::string& what) {
    if (file.is_binary) fail(FROND_RESULT_FILE_FORMAT, "%s: byte %zu: %s", file.name.c_str(), file.at, what.c_str());
    fail(FROND_RESULT_FILE_FORMAT, "%s: line %ld: %s", file.name.c_str(), file.line, what.c_str());
}

bool is_at_end(const TetFile& file) {
    return file.at >= file.bytes.size();
}

std::string read_line(TetFile& file) {
    size_t end = file.bytes.find('\n', file.at);
    if (end == std::string::npos) end = file.bytes.size();
    std::string line = file.bytes.substr(file.at, end - file.at);
    file.at = std::min(end + 1, file.bytes.size());
    ++file.line;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    return line;
}

void skip_line_end(TetFile& file) {
    while (!is_at_end(file) && file.bytes[file.at] != '\n' && uint8_t(file.bytes[file.at]) <= 32) ++file.at;
    if (!is_at_end(file) && file.bytes[file.at] == '\n') {
        ++file.at;
        ++file.line;
    }
}

std::string read_word(TetFile& file) {
    const std::string& bytes = file.bytes;
    while (file.at < bytes.size() && uint8_t(bytes[file.at]) <= 32) file.line += bytes[file.at++] == '\n';
    const size_t begin = file.at;
    while (file.at < bytes.size() && uint8_t(bytes[file.at]) > 32 && file.at - begin < 256) ++file.at;
    if (begin == file.at) fail_at(file, "the file is cut off");
    return bytes.substr(begin, file.at - begin);
}

template <typename Value>
static Value text_value(TetFile& file) {
    const std::string word = read_word(file);
    const char *begin = word.data() + (word[0] == '+' ? 1 : 0), *end = word.data() + word.size();
    Value value{};
    const auto result = read_number(begin, end, value);
    // A number that is too small for a double is zero, one that is too large infinite.
    if (result.ec == std::errc::result_out_of_range && result.ptr == end && std::is_floating_point<Value>::value)
        return word.find("e-") != std::string::npos || word.find("E-") != std::string::npos ? Value(0)
                                                                                            : Value(INFINITY);
    if (result.ec != std::errc() || result.ptr != end) fail_at(file, "\"" + word.substr(0, 40) + "\" is not a number");
    return value;
}

template <typename Value>
static Value binary_value(TetFile& file) {
    if (file.bytes.size() - file.at < sizeof(Value)) fail_at(file, "the file is cut off");
    char bytes[sizeof(Value)];
    for (size_t i = 0; i < sizeof(Value); ++i)
        bytes[file.is_swapped ? sizeof(Value) - 1 - i : i] = file.bytes[file.at + i];
    file.at += sizeof(Value);
    Value value;
    std::memcpy(&value, bytes, sizeof(Value));
    return value;
}

double read_real(TetFile& file) {
    return file.is_binary ? binary_value<double>(file) : text_value<double>(file);
}
float read_float(TetFile& file) {
    return file.is_binary ? binary_value<float>(file) : float(text_value<double>(file));
}
int64_t read_whole(TetFile& file) {
    return file.is_binary ? binary_value<int32_t>(file) : text_value<int64_t>(file);
}
int64_t read_long(TetFile& file) {
    return file.is_binary ? binary_value<int64_t>(file) : text_value<int64_t>(file);
}
uint8_t read_byte(TetFile& file) {
    return file.is_binary ? binary_value<uint8_t>(file) : uint8_t(text_value<int64_t>(file));
}

size_t read_count(TetFile& file, int64_t count, size_t smallest, const char* what) {
    const size_t left = file.bytes.size() - file.at, each = file.is_binary ? smallest : 2;
    if (count < 0 || size_t(count) > (left + 1) / each)
        fail_at(file, text_of("%lld %s are announced, but only %zu bytes are left", (long long)count, what, left));
    return size_t(count);
}

int region_index(TetMesh& mesh, const std::string& name) {
    // The region is nearly always the one used last.
    if (!mesh.tet_region.empty() && mesh.regions[size_t(mesh.tet_region.back())] == name) return mesh.tet_region.back();
    for (size_t i = 0; i < mesh.regions.size(); ++i)
        if (mesh.regions[i] == name) return int(i);
    if (mesh.regions.size() >= 1000) fail(FROND_RESULT_FILE_FORMAT, "there are more than 1000 regions");
    mesh.regions.push_back(name);
    return int(mesh.regions.size()) - 1;
}

static TetFile open_tet_file(const std::string& path) {
    TetFile file;
    file.name = file_name(path);
    const FileStatus status = status_of(path);
    std::string error;
    if (path.find('\0') != std::string::npos) fail(FROND_RESULT_FILE_NOT_FOUND, "the path has a zero byte");
    if (!status.exists) fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), status.error.c_str());
    if (!status.is_regular) fail(FROND_RESULT_FILE_NOT_FOUND, "%s is not a regular file", path.c_str());
    if (status.size == 0) fail(FROND_RESULT_FILE_FORMAT, "%s: the file is empty", file.name.c_str());
    if (status.size > LARGEST_TET_FILE)
        fail(FROND_RESULT_FILE_FORMAT, "%s: the file is larger than 1 GiB", file.name.c_str());
    if (!read_file(path, status.size, file.bytes, error))
        fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), error.c_str());
    return file;
}

TetMesh import_tets(const std::string& path) {
    const TetFormat* format = format_of(path);
    if (!format) {
        std::string endings;
        for (const TetFormat& row : TET_FORMATS) endings += std::string(" ") + row.ending;
        fail(FROND_RESULT_FILE_FORMAT, "%s: tets are read from files that end in%s", file_name(path).c_str(),
             endings.c_str());
    }
    TetFile file = open_tet_file(path);
    TetMesh mesh = format->read(file);
    if (mesh.tets.empty())
        fail(FROND_RESULT_FILE_FORMAT, "%s: there are no tetrahedra in the file; mesh the volume, not only its surface",
             file.name.c_str());
    return mesh;
}

}  // namespace frond
