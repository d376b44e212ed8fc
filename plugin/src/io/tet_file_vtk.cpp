// Reads legacy VTK files, versions 1 to 5.1, text and binary (big-endian), with an unstructured grid: tetrahedra of any
// order, of which the four corners are kept; an integer cell array whose name means regions gives the regions. Follows
// the VTK file formats chapter of the VTK user's guide.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/tet_file.hpp"

namespace frond {

struct VtkReading {
    std::vector<Vec3> points;
    std::vector<size_t> begins;  // start of each cell in connectivity; one more than cells
    std::vector<int64_t> connectivity;
    std::vector<int64_t> types;
    std::vector<int64_t> regions;  // region of each cell; empty if the file has none
    bool is_binary = false;
    size_t cell_data = 0, point_data = 0;  // tuples of the arrays that follow
};

static bool is_word(const std::string& a, const char* b) {
    if (a.size() != std::char_traits<char>::length(b)) return false;
    return std::equal(a.begin(), a.end(), b, [](char x, char y) { return toupper(x) == toupper(y); });
}

// Returns the bytes of a value of a VTK type; 0 if the type is unknown.
static size_t type_size(const std::string& type) {
    static const struct {
        const char* name;
        size_t size;
    } ROWS[] = {{"char", 1},          {"unsigned_char", 1}, {"short", 2},       {"unsigned_short", 2},
                {"int", 4},           {"unsigned_int", 4},  {"float", 4},       {"long", 8},
                {"unsigned_long", 8}, {"double", 8},        {"vtkidtype", 4},   {"vtktypeint64", 8},
                {"vtktypeuint64", 8}, {"vtktypeint32", 4},  {"signed_char", 1}, {"vtktypeuint8", 1},
                {"vtktypeuint32", 4}};
    for (const auto& row : ROWS)
        if (is_word(type, row.name)) return row.size;
    return 0;
}

static double read_of_type(TetFile& file, const std::string& type) {
    if (!file.is_binary) return read_real(file);
    if (is_word(type, "float")) return double(read_float(file));
    if (is_word(type, "double")) return read_real(file);
    switch (type_size(type)) {
        case 1:
            return double(int8_t(read_byte(file)));
        case 2: {
            const uint8_t high = read_byte(file), low = read_byte(file);
            return double(int16_t(high << 8 | low));
        }
        case 4:
            return double(read_whole(file));
        default:
            return double(read_long(file));
    }
}

// Numbers begin on the line after the words that announce them.
static void begin_numbers(TetFile& file, const VtkReading& reading) {
    skip_line_end(file);
    file.is_binary = reading.is_binary;
    file.is_swapped = true;
}

static size_t checked_type(TetFile& file, const std::string& type) {
    const size_t size = type_size(type);
    if (size == 0) fail_at(file, "\"" + type.substr(0, 40) + "\" is not a type of numbers");
    return size;
}

static void read_points(TetFile& file, VtkReading& reading) {
    const int64_t announced = read_whole(file);
    const std::string type = read_word(file);
    const size_t size = checked_type(file, type);
    begin_numbers(file, reading);
    const size_t count = read_count(file, announced, 3 * size, "points");
    for (size_t i = 0; i < count; ++i) {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) point[axis] = read_of_type(file, type);
        if (!point.allFinite()) fail_at(file, text_of("point %zu is not finite", i));
        reading.points.push_back(point);
    }
    file.is_binary = false;
}

// Up to version 4, each cell is stored as its length and its points; from version 5, as offsets, then points.
static void read_cells(TetFile& file, VtkReading& reading) {
    const int64_t first = read_whole(file), second = read_whole(file);
    skip_line_end(file);
    const size_t before = file.at;
    const long line_before = file.line;
    reading.begins.assign(1, 0);
    if (!is_at_end(file) && is_word(read_word(file), "OFFSETS")) {
        std::string type = read_word(file);
        size_t size = checked_type(file, type);
        begin_numbers(file, reading);
        const size_t offset_count = read_count(file, first, size, "offsets");
        reading.begins.clear();
        for (size_t i = 0; i < offset_count; ++i) {
            const double offset = read_of_type(file, type);
            const double last = reading.begins.empty() ? 0 : double(reading.begins.back());
            if (!(offset >= last && offset <= double(second))) fail_at(file, text_of("offset %zu is out of order", i));
            reading.begins.push_back(size_t(offset));
        }
        file.is_binary = false;
        if (!is_word(read_word(file), "CONNECTIVITY")) fail_at(file, "CONNECTIVITY must follow OFFSETS");
        type = read_word(file);
        size = checked_type(file, type);
        begin_numbers(file, reading);
        const size_t count = read_count(file, second, size, "corners");
        for (size_t i = 0; i < count; ++i) reading.connectivity.push_back(int64_t(read_of_type(file, type)));
        file.is_binary = false;
        if (reading.begins.empty()) reading.begins.push_back(0);
        return;
    }
    file.at = before;
    file.line = line_before;
    file.is_binary = reading.is_binary;
    file.is_swapped = true;
    const size_t count = read_count(file, first, 4, "cells");
    read_count(file, second, 4, "numbers");
    for (size_t i = 0; i < count; ++i) {
        const size_t corners = read_count(file, read_whole(file), 4, "corners");
        for (size_t k = 0; k < corners; ++k) reading.connectivity.push_back(read_whole(file));
        reading.begins.push_back(reading.connectivity.size());
    }
    file.is_binary = false;
}

static void read_types(TetFile& file, VtkReading& reading) {
    const int64_t announced = read_whole(file);
    begin_numbers(file, reading);
    const size_t count = read_count(file, announced, 4, "cell types");
    for (size_t i = 0; i < count; ++i) reading.types.push_back(read_whole(file));
    file.is_binary = false;
}

// ---- arrays by cell ----

static bool tells_regions(const std::string& name) {
    std::string lower;
    for (char letter : name) lower += char(tolower(uint8_t(letter)));
    for (const char* word : {"region", "material", "entit", "physical", "attribute", "medit:ref", "domain", "organ",
                             "label", "subdomain", "block"})
        if (lower.find(word) != std::string::npos) return true;
    return false;
}

static void read_array(TetFile& file, VtkReading& reading, const std::string& name, const std::string& type,
                       int64_t components, int64_t tuples) {
    begin_numbers(file, reading);
    if (is_word(type, "bit") || is_word(type, "string") || is_word(type, "variant") || is_word(type, "utf8_string"))
        fail_at(file,
                "the array \"" + name.substr(0, 40) + "\" is of type " + type.substr(0, 40) + ", which is not read");
    const size_t size = checked_type(file, type);
    if (components < 0 || components > 1000000) fail_at(file, "the array has no valid number of components");
    const size_t count = read_count(file, tuples, std::max<size_t>(1, size * size_t(components)), "values");
    const bool is_wanted = reading.cell_data > 0 && components == 1 && count == reading.types.size() &&
                           reading.regions.empty() && tells_regions(name);
    for (size_t i = 0; i < count; ++i)
        for (int64_t k = 0; k < components; ++k) {
            const double value = read_of_type(file, type);
            if (is_wanted) reading.regions.push_back(std::abs(value) < 1e9 ? int64_t(value) : 0);
        }
    file.is_binary = false;
}

static void read_scalars(TetFile& file, VtkReading& reading) {
    const std::string name = read_word(file), type = read_word(file);
    const std::string rest = read_line(file);
    const int64_t components = rest.empty() ? 1 : std::max(1, atoi(rest.c_str()));
    const size_t before = file.at;
    const long line_before = file.line;
    if (!is_at_end(file) && file.bytes.compare(file.at, 12, "LOOKUP_TABLE") == 0)
        read_line(file);
    else {
        file.at = before;
        file.line = line_before;
    }
    // The line's end was already read: goes back to it.
    if (file.at > 0) {
        --file.at;
        --file.line;
    }
    read_array(file, reading, name, type, components, int64_t(std::max(reading.cell_data, reading.point_data)));
}

static void skip_metadata(TetFile& file) {
    read_line(file);
    while (!is_at_end(file))
        if (read_line(file).empty()) return;
}

static void read_field(TetFile& file, VtkReading& reading) {
    read_word(file);
    const size_t count = read_count(file, read_whole(file), 4, "arrays");
    for (size_t i = 0; i < count; ++i) {
        std::string name = read_word(file);
        if (name == "METADATA") {
            skip_metadata(file);
            name = read_word(file);
        }
        const int64_t components = read_whole(file), tuples = read_whole(file);
        const std::string type = read_word(file);
        read_array(file, reading, name, type, components, tuples);
    }
}

static void begin_data(TetFile& file, VtkReading& reading, bool is_cells) {
    const size_t count = read_count(file, read_whole(file), 0 + 1, "tuples");
    reading.cell_data = is_cells ? count : 0;
    reading.point_data = is_cells ? 0 : count;
    if (is_cells && count != reading.types.size())
        fail_at(file, text_of("there are %zu values for %zu cells", count, reading.types.size()));
}

// Reads one keyword with its data. Returns false when only data follow that are not needed.
static bool read_block(TetFile& file, VtkReading& reading) {
    const std::string word = read_word(file);
    if (is_word(word, "POINTS"))
        read_points(file, reading);
    else if (is_word(word, "CELLS"))
        read_cells(file, reading);
    else if (is_word(word, "CELL_TYPES"))
        read_types(file, reading);
    else if (is_word(word, "CELL_DATA") || is_word(word, "POINT_DATA"))
        begin_data(file, reading, is_word(word, "CELL_DATA"));
    else if (is_word(word, "SCALARS"))
        read_scalars(file, reading);
    else if (is_word(word, "FIELD"))
        read_field(file, reading);
    else if (is_word(word, "METADATA"))
        skip_metadata(file);
    else if (is_word(word, "VECTORS") || is_word(word, "NORMALS")) {
        const std::string name = read_word(file), type = read_word(file);
        read_array(file, reading, "", type, 3, int64_t(std::max(reading.cell_data, reading.point_data)));
    } else if (reading.types.empty())
        fail_at(file, "\"" + word.substr(0, 40) + "\" is not known here");
    else
        return false;
    return true;
}

static TetMesh make_mesh(const TetFile& file, VtkReading& reading) {
    TetMesh mesh;
    if (reading.begins.size() != reading.types.size() + 1)
        fail(FROND_RESULT_FILE_FORMAT, "%s: there are %zu cells but %zu cell types", file.name.c_str(),
             reading.begins.empty() ? 0 : reading.begins.size() - 1, reading.types.size());
    size_t other_volumes = 0;
    for (size_t c = 0; c < reading.types.size(); ++c) {
        const int64_t type = reading.types[c];
        // Linear, quadratic, Lagrange and Bezier tetrahedra; voxels, hexahedra, wedges, pyramids and the like.
        const bool is_tet = type == 10 || type == 24 || type == 71 || type == 78;
        other_volumes += !is_tet && ((type >= 11 && type <= 16) || (type >= 25 && type <= 33) || type >= 72);
        if (!is_tet) continue;
        if (reading.begins[c + 1] - reading.begins[c] < 4 || reading.begins[c + 1] > reading.connectivity.size())
            fail(FROND_RESULT_FILE_FORMAT, "%s: cell %zu is a tetrahedron of fewer than four points", file.name.c_str(),
                 c);
        Tet tet;
        for (size_t k = 0; k < 4; ++k) {
            const int64_t point = reading.connectivity[reading.begins[c] + k];
            if (point < 0 || size_t(point) >= reading.points.size())
                fail(FROND_RESULT_FILE_FORMAT, "%s: cell %zu refers to point %lld, but there are %zu",
                     file.name.c_str(), c, (long long)point, reading.points.size());
            tet[k] = int(point);
        }
        const std::string region = reading.regions.size() == reading.types.size()
                                       ? "region_" + std::to_string(reading.regions[c])
                                       : std::string("plant");
        mesh.tets.push_back(tet);
        const int index = region_index(mesh, region);
        mesh.tet_region.push_back(index);
    }
    if (other_volumes > 0) warn("%s: %zu cells that are not tetrahedra are left out", file.name.c_str(), other_volumes);
    mesh.nodes = std::move(reading.points);
    return mesh;
}

TetMesh read_vtk(TetFile& file) {
    // Three lines of header, then the kind of grid.
    VtkReading reading;
    if (file.bytes.compare(0, 14, "# vtk DataFile") != 0) fail_at(file, "a VTK file begins with \"# vtk DataFile\"");
    read_line(file);
    read_line(file);
    const std::string format = read_line(file);
    if (!is_word(format, "ASCII") && !is_word(format, "BINARY"))
        fail_at(file, "the third line must be ASCII or BINARY");
    reading.is_binary = is_word(format, "BINARY");
    if (!is_word(read_word(file), "DATASET")) fail_at(file, "DATASET must follow the header");
    const std::string kind = read_word(file);
    if (!is_word(kind, "UNSTRUCTURED_GRID"))
        fail_at(file, "the grid is a " + kind.substr(0, 40) + "; only UNSTRUCTURED_GRID has tetrahedra");

    while (!is_at_end(file)) {
        while (!is_at_end(file) && uint8_t(file.bytes[file.at]) <= 32) file.line += file.bytes[file.at++] == '\n';
        if (is_at_end(file) || !read_block(file, reading)) break;
    }
    return make_mesh(file, reading);
}

}  // namespace frond
