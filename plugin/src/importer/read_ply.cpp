// Reads PLY, text and binary of either byte order. In: bytes. Out: a surface of one part. Does not use assimp, whose
// PLY reader crashes, aborts or hangs on truncated files. Reads vertices with normals, colours and texture coordinates;
// faces with any number of corners, texture coordinates per corner, triangle strips; skips other elements.
#include "importer/importer.hpp"
#include "importer/ply_values.hpp"

namespace frond {

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
                read_ply_list(cursor, property, element, i, list);
            else {
                const double value = read_ply_value(cursor, property.type, element, i);
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
                read_ply_value(cursor, property.type, element, i);
            else
                read_ply_list(cursor, property, element, i,
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
                read_ply_list(cursor, property, element, i, list);
            else
                read_ply_value(cursor, property.type, element, i);
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
    const PlyHeader header = read_ply_header(file.bytes);
    check_ply_counts(header, file.bytes);
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
    if (part.texture >= 0) find_opacity(surface.textures[size_t(part.texture)]);
    if (part.texture >= 0) part.color = {1, 1, 1, 1};
    append_part(surface, corners, part);
    return surface;
}

}  // namespace frond
