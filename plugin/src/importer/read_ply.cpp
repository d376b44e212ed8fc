// Reads PLY, text and binary of either byte order. In: bytes. Out: a surface of one part. Does not use assimp, whose
// PLY reader crashes, aborts or hangs on truncated files. Reads vertices with normals, colours and texture coordinates;
// faces with any number of corners, texture coordinates per corner, triangle strips; skips other elements.
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/log.hpp"
#include "core/platform/number_text.hpp"
#include "importer/importer.hpp"

namespace frond {

enum class PlyType { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE };
static const size_t TYPE_SIZE[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType count_type = PlyType::UINT8, type = PlyType::FLOAT;
};

struct PlyElement {
    std::string name;
    size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    bool is_text = true, is_big_endian = false;
    std::vector<PlyElement> elements;
    std::string texture;  // "comment TextureFile leaf.png"
    size_t data = 0;      // start of the data [byte]
    long line = 1;        // current line; after the header, the first line of the data
};

// ---- header ----

static PlyType type_of(const std::string& name, long line) {
    static const char* const NAMES[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                           {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                           {"float", "float32"}, {"double", "float64"}};
    for (int i = 0; i < 8; ++i)
        if (name == NAMES[i][0] || name == NAMES[i][1]) return PlyType(i);
    fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a PLY type", line, name.c_str());
}

static void read_property(std::istringstream& words, PlyHeader& header) {
    if (header.elements.empty())
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: a property stands before any element", header.line);
    PlyProperty property;
    std::string word, other;
    words >> word;
    if (word == "list") {
        property.is_list = true;
        words >> word >> other;
        property.count_type = type_of(word, header.line);
        word = other;
    }
    property.type = type_of(word, header.line);
    if (!(words >> property.name)) fail(FROND_RESULT_FILE_FORMAT, "line %ld: the property has no name", header.line);
    if (property.is_list && property.count_type >= PlyType::FLOAT)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: a list's length must be an integer", header.line);
    if (header.elements.back().properties.size() >= 1000)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: more than 1000 properties", header.line);
    header.elements.back().properties.push_back(property);
}

static void read_format(std::istringstream& words, PlyHeader& header) {
    std::string format;
    words >> format;
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.30s\" is not a PLY format", header.line, format.c_str());
    header.is_text = format == "ascii";
    header.is_big_endian = format == "binary_big_endian";
}

static void read_element(std::istringstream& words, PlyHeader& header) {
    PlyElement element;
    long long count = -1;
    words >> element.name >> count;
    if (count < 0) fail(FROND_RESULT_FILE_FORMAT, "line %ld: the element has no valid count", header.line);
    if (header.elements.size() >= 100) fail(FROND_RESULT_FILE_FORMAT, "line %ld: more than 100 elements", header.line);
    element.count = size_t(count);
    header.elements.push_back(element);
}

static PlyHeader read_header(const std::string& bytes) {
    PlyHeader header;
    size_t at = 0;
    for (header.line = 1;; ++header.line) {
        size_t end = bytes.find('\n', at);
        if (end == std::string::npos || end - at > 4096)
            fail(FROND_RESULT_FILE_FORMAT, "line %ld: the header is cut off: there is no \"end_header\"", header.line);
        std::istringstream words(bytes.substr(at, end - at));
        at = end + 1;
        std::string word;
        words >> word;
        if (header.line == 1 && word != "ply") fail(FROND_RESULT_FILE_FORMAT, "line 1: a PLY file begins with \"ply\"");
        if (word == "end_header") break;
        if (word == "format") read_format(words, header);
        if (word == "element") read_element(words, header);
        if (word == "property") read_property(words, header);
        if (word == "comment" && words >> word && word == "TextureFile") {
            std::getline(words >> std::ws, header.texture);
            while (!header.texture.empty() && header.texture.back() == '\r') header.texture.pop_back();
        }
    }
    ++header.line;
    header.data = at;
    return header;
}

// Rejects counts that cannot fit into the file before memory is allocated for them.
static void check_counts(const PlyHeader& header, const std::string& bytes) {
    const size_t left = bytes.size() - header.data;
    for (const PlyElement& element : header.elements) {
        size_t smallest = 0;
        for (const PlyProperty& property : element.properties)
            smallest += header.is_text ? 2 : TYPE_SIZE[int(property.is_list ? property.count_type : property.type)];
        if (smallest > 0 && element.count > (left + 1) / smallest)
            fail(FROND_RESULT_FILE_FORMAT,
                 "the file is cut off: %zu \"%s\" are announced, but only %zu bytes follow the header", element.count,
                 element.name.c_str(), left);
    }
}

// ---- values ----

struct PlyCursor {
    const std::string& bytes;
    size_t at;
    long line;
    bool is_text, is_big_endian;
};

[[noreturn]] static void fail_cut(const PlyCursor& cursor, const PlyElement& element, size_t index) {
    if (cursor.is_text)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: the file ends in \"%s\" %zu of %zu", cursor.line,
             element.name.c_str(), index, element.count);
    fail(FROND_RESULT_FILE_FORMAT, "the file is cut off in \"%s\" %zu of %zu", element.name.c_str(), index,
         element.count);
}

static double read_text_value(PlyCursor& cursor, const PlyElement& element, size_t index) {
    const std::string& bytes = cursor.bytes;
    while (cursor.at < bytes.size() && uint8_t(bytes[cursor.at]) <= 32) cursor.line += bytes[cursor.at++] == '\n';
    if (cursor.at >= bytes.size()) fail_cut(cursor, element, index);
    const char *begin = bytes.data() + cursor.at, *end = bytes.data() + bytes.size();
    if (*begin == '+') ++begin;
    double value = 0;
    const auto result = read_number(begin, end, value);
    const bool is_whole = result.ptr == end || uint8_t(*result.ptr) <= 32;
    if (result.ec == std::errc::invalid_argument || !is_whole)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a number", cursor.line,
             std::string(begin, size_t(std::min<ptrdiff_t>(20, end - begin))).c_str());
    cursor.at = size_t(result.ptr - bytes.data());
    return value;
}

template <typename Value>
static double decode(const char* bytes) {
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

static double read_value(PlyCursor& cursor, PlyType type, const PlyElement& element, size_t index) {
    if (cursor.is_text) return read_text_value(cursor, element, index);
    const size_t size = TYPE_SIZE[int(type)];
    if (cursor.bytes.size() - cursor.at < size) fail_cut(cursor, element, index);
    char bytes[8];
    for (size_t i = 0; i < size; ++i) bytes[cursor.is_big_endian ? size - 1 - i : i] = cursor.bytes[cursor.at + i];
    cursor.at += size;
    switch (type) {
        case PlyType::INT8:
            return decode<int8_t>(bytes);
        case PlyType::UINT8:
            return decode<uint8_t>(bytes);
        case PlyType::INT16:
            return decode<int16_t>(bytes);
        case PlyType::UINT16:
            return decode<uint16_t>(bytes);
        case PlyType::INT32:
            return decode<int32_t>(bytes);
        case PlyType::UINT32:
            return decode<uint32_t>(bytes);
        case PlyType::FLOAT:
            return decode<float>(bytes);
        case PlyType::DOUBLE:
            return decode<double>(bytes);
    }
    return 0;
}

static void read_list(PlyCursor& cursor, const PlyProperty& property, const PlyElement& element, size_t index,
                      std::vector<double>& values) {
    const double count = read_value(cursor, property.count_type, element, index);
    const size_t left = cursor.bytes.size() - cursor.at, smallest = cursor.is_text ? 2 : TYPE_SIZE[int(property.type)];
    if (!(count >= 0) || count != std::floor(count) || count > double((left + 1) / smallest))
        fail(FROND_RESULT_FILE_FORMAT,
             "the file is cut off or damaged: \"%s\" %zu of %zu has a list of %g values, and %zu bytes are left",
             element.name.c_str(), index, element.count, count, left);
    values.clear();
    for (size_t i = 0; i < size_t(count); ++i) values.push_back(read_value(cursor, property.type, element, index));
}

// ---- vertices ----

enum Slot { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, ALPHA, U, V, SLOT_COUNT };

static int slot_of(const std::string& name) {
    static const struct {
        const char* name;
        int slot;
    } ROWS[] = {{"x", X},
                {"y", Y},
                {"z", Z},
                {"nx", NX},
                {"ny", NY},
                {"nz", NZ},
                {"red", RED},
                {"green", GREEN},
                {"blue", BLUE},
                {"alpha", ALPHA},
                {"r", RED},
                {"g", GREEN},
                {"b", BLUE},
                {"diffuse_red", RED},
                {"diffuse_green", GREEN},
                {"diffuse_blue", BLUE},
                {"u", U},
                {"v", V},
                {"s", U},
                {"t", V},
                {"texture_u", U},
                {"texture_v", V},
                {"texture_s", U},
                {"texture_t", V}};
    for (const auto& row : ROWS)
        if (name == row.name) return row.slot;
    return -1;
}

static uint8_t channel_of(double value, PlyType type) {
    if (type >= PlyType::FLOAT) value *= 255;
    if (type == PlyType::UINT16 || type == PlyType::INT16) value /= 257;
    return value > 0 ? uint8_t(std::min(255.0, value + 0.5)) : uint8_t(0);
}

static void read_vertices(PlyCursor& cursor, const PlyElement& element, Corners& corners) {
    std::vector<int> slots;
    bool has[SLOT_COUNT] = {};
    PlyType types[SLOT_COUNT] = {};
    for (const PlyProperty& property : element.properties) {
        slots.push_back(property.is_list ? -1 : slot_of(property.name));
        if (slots.back() < 0) continue;
        has[slots.back()] = true;
        types[slots.back()] = property.type;
    }
    if (!has[X] || !has[Y] || !has[Z]) fail(FROND_RESULT_FILE_FORMAT, "the vertices have no x, y and z");
    const bool has_normals = has[NX] && has[NY] && has[NZ], has_colors = has[RED] && has[GREEN] && has[BLUE];
    std::vector<double> list;
    for (size_t i = 0; i < element.count; ++i) {
        double values[SLOT_COUNT] = {};
        for (size_t k = 0; k < slots.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            if (property.is_list)
                read_list(cursor, property, element, i, list);
            else {
                const double value = read_value(cursor, property.type, element, i);
                if (slots[k] >= 0) values[slots[k]] = value;
            }
        }
        corners.positions.push_back(Vec3(values[X], values[Y], values[Z]));
        if (has_normals) corners.normals.push_back(Vec3f(float(values[NX]), float(values[NY]), float(values[NZ])));
        if (has[U] && has[V]) corners.uvs.push_back(Vec2f(float(values[U]), 1 - float(values[V])));
        if (has_colors)
            corners.colors.push_back({channel_of(values[RED], types[RED]), channel_of(values[GREEN], types[GREEN]),
                                      channel_of(values[BLUE], types[BLUE]),
                                      has[ALPHA] ? channel_of(values[ALPHA], types[ALPHA]) : uint8_t(255)});
    }
}

// ---- faces ----

// Triangles and their texture coordinates, three per triangle; zero if the file has none.
struct PlyFaces {
    std::vector<Triangle> triangles;
    std::vector<Vec2f> corner_uvs;
};

static int index_of(double value, const PlyElement& element, size_t index, size_t vertex_count) {
    if (!(value >= 0 && value < double(vertex_count)))
        fail(FROND_RESULT_FILE_FORMAT, "\"%s\" %zu refers to vertex %.0f, but there are %zu", element.name.c_str(),
             index, value, vertex_count);
    return int(value);
}

static void add_fan(PlyFaces& faces, const std::vector<int>& face, const std::vector<double>& uvs) {
    const bool has_uvs = uvs.size() == 2 * face.size();
    for (size_t k = 2; k < face.size(); ++k) {
        const size_t corners[3] = {0, k - 1, k};
        faces.triangles.push_back({face[corners[0]], face[corners[1]], face[corners[2]]});
        for (size_t corner : corners)
            faces.corner_uvs.push_back(has_uvs ? Vec2f(float(uvs[2 * corner]), 1 - float(uvs[2 * corner + 1]))
                                               : Vec2f(0, 0));
    }
    if (faces.triangles.size() > size_t(MAX_TRIANGLES))
        fail(FROND_RESULT_BAD_GEOMETRY, "the file has more than the %d triangles that are allowed; simplify it",
             MAX_TRIANGLES);
}

static void add_strip(PlyFaces& faces, const std::vector<double>& strip, const PlyElement& element, size_t index,
                      size_t vertex_count) {
    size_t begin = 0;
    for (size_t k = 0; k < strip.size(); ++k) {
        if (strip[k] == -1) {
            begin = k + 1;
            continue;
        }
        if (k < begin + 2) continue;
        int corner[3];
        for (size_t i = 0; i < 3; ++i) corner[i] = index_of(strip[k - 2 + i], element, index, vertex_count);
        const bool is_odd = (k - begin) % 2 == 1;
        add_fan(faces, {corner[is_odd ? 1 : 0], corner[is_odd ? 0 : 1], corner[2]}, {});
    }
}

static void read_faces(PlyCursor& cursor, const PlyElement& element, size_t vertex_count, PlyFaces& faces,
                       bool& has_uvs) {
    std::vector<double> indices, uvs, other;
    std::vector<int> face;
    for (size_t i = 0; i < element.count; ++i) {
        indices.clear();
        uvs.clear();
        for (const PlyProperty& property : element.properties) {
            const bool is_indices = property.name == "vertex_indices" || property.name == "vertex_index";
            if (!property.is_list)
                read_value(cursor, property.type, element, i);
            else
                read_list(cursor, property, element, i,
                          is_indices                    ? indices
                          : property.name == "texcoord" ? uvs
                                                        : other);
        }
        has_uvs = has_uvs || !uvs.empty();
        if (element.name == "tristrips") {
            add_strip(faces, indices, element, i, vertex_count);
            continue;
        }
        face.clear();
        for (double index : indices) face.push_back(index_of(index, element, i, vertex_count));
        add_fan(faces, face, uvs);
    }
}

static void skip_element(PlyCursor& cursor, const PlyElement& element) {
    std::vector<double> list;
    if (element.properties.empty()) return;
    for (size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties)
            if (property.is_list)
                read_list(cursor, property, element, i, list);
            else
                read_value(cursor, property.type, element, i);
}

// Makes a vertex for each corner, as texture coordinates by corner require, then merges equal ones.
static void split_corners(Corners& corners, const PlyFaces& faces) {
    Corners split;
    for (const Triangle& triangle : corners.triangles) {
        const int first = int(split.positions.size());
        for (int corner : triangle) {
            split.positions.push_back(corners.positions[size_t(corner)]);
            if (!corners.normals.empty()) split.normals.push_back(corners.normals[size_t(corner)]);
            if (!corners.colors.empty()) split.colors.push_back(corners.colors[size_t(corner)]);
        }
        split.triangles.push_back({first, first + 1, first + 2});
    }
    split.uvs = faces.corner_uvs;
    corners = std::move(split);
    weld_corners(corners);
}

Surface read_ply(const MeshFile& file) {
    const PlyHeader header = read_header(file.bytes);
    check_counts(header, file.bytes);
    Corners corners;
    PlyFaces faces;
    bool has_corner_uvs = false, has_vertices = false;
    PlyCursor cursor{file.bytes, header.data, header.line, header.is_text, header.is_big_endian};
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex" && !has_vertices) {
            read_vertices(cursor, element, corners);
            has_vertices = true;
        } else if (element.name == "face" || element.name == "tristrips") {
            read_faces(cursor, element, corners.positions.size(), faces, has_corner_uvs);
        } else {
            skip_element(cursor, element);
        }
    }
    if (faces.triangles.empty())
        fail(FROND_RESULT_FILE_FORMAT, "there are %zu vertices but no faces; make a mesh of the point cloud first",
             corners.positions.size());
    corners.triangles = faces.triangles;
    if (has_corner_uvs) split_corners(corners, faces);

    Surface surface;
    Part part;
    part.name = file.name.substr(0, file.name.rfind('.'));
    if (!corners.colors.empty()) part.color = {1, 1, 1, 1};
    if (!header.texture.empty() && !corners.uvs.empty())
        part.texture = take_texture_file(surface, file, header.texture);
    if (part.texture < 0 && !corners.uvs.empty() && corners.colors.empty())
        part.texture = guess_texture(surface, file, "");
    if (part.texture >= 0) part.color = {1, 1, 1, 1};
    append_part(surface, corners, part);
    return surface;
}

}  // namespace frond
