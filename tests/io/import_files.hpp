// Files for the import tests: a small plant of a stem and a mirrored leaf, in two nodes, written in each format.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "support/system.hpp"

namespace files {

// A folder that is deleted with its owner.
struct Folder {
    const std::string path = make_temporary_folder();
    Folder() = default;
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path); }
    std::string write(const std::string& name, const std::string& bytes) const {
        const std::string file = path + "/" + name;
        std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        return file;
    }
};

template <typename Value>
void put(std::string& out, Value value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
std::string bytes_of(const std::vector<Value>& values) {
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

// Returns the stem, 0.5 m tall, a prism of four sides without ends: 8 vertices, 8 triangles. y is up.
inline std::vector<float> stem_positions() {
    const float r = 0.01f, h = 0.5f;
    return {r, 0, r, r, 0, -r, -r, 0, -r, -r, 0, r, r, h, r, r, h, -r, -r, h, -r, -r, h, r};
}
inline std::vector<uint32_t> stem_indices() {
    std::vector<uint32_t> indices;
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t next = (k + 1) % 4;
        for (uint32_t i : {k, next, next + 4, k, next + 4, k + 4}) indices.push_back(i);
    }
    return indices;
}
// Returns the leaf in its node's frame: 4 vertices, 2 triangles facing down. The node mirrors x, does not rotate, and
// raises it by 0.4.
inline std::vector<float> leaf_positions() {
    return {0, 0, 0, 0.2f, 0, 0, 0.2f, 0, 0.1f, 0, 0, 0.1f};
}
inline std::vector<float> leaf_uvs_bottom_up() {
    return {0, 0, 1, 0, 1, 0.75f, 0, 0.75f};
}
inline std::vector<uint32_t> leaf_indices() {
    return {0, 1, 2, 0, 2, 3};
}

// In formats without nodes the leaf is written in its final position.
inline std::string obj(bool with_colors = false, const std::string& material_library = "") {
    std::string out = material_library.empty() ? "" : "mtllib " + material_library + "\n";
    const std::vector<float> stem = stem_positions();
    char line[200];
    out += "o stem\nusemtl bark\n";
    for (size_t i = 0; i < stem.size(); i += 3) {
        snprintf(line, sizeof line, "v %g %g %g%s\n", double(stem[i]), double(stem[i + 1]), double(stem[i + 2]),
                 with_colors ? " 0.25 0.5 0.125" : "");
        out += line;
    }
    const std::vector<uint32_t> indices = stem_indices();
    for (size_t i = 0; i < indices.size(); i += 3) {
        snprintf(line, sizeof line, "f %u %u %u\n", indices[i] + 1, indices[i + 1] + 1, indices[i + 2] + 1);
        out += line;
    }
    out += "o leaf\nusemtl green\n";
    for (const char* vertex : {"0 0.4 0", "-0.2 0.4 0", "-0.2 0.4 0.1", "0 0.4 0.1"})
        out += std::string("v ") + vertex + (with_colors ? " 0.25 0.5 0.125" : "") + "\n";
    if (with_colors) return out + "f 9 11 10\nf 9 12 11\n";
    out += "vt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 0.75\n";
    return out + "f 9/1 11/3 10/2\nf 9/1 12/4 11/3\n";
}

inline std::string ply(bool is_binary) {
    const std::vector<float> stem = stem_positions();
    const std::vector<uint32_t> indices = stem_indices();
    std::string out =
        std::string("ply\nformat ") + (is_binary ? "binary_little_endian" : "ascii") +
        " 1.0\ncomment made by hand\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 8\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (size_t i = 0; i < stem.size(); i += 3) {
        if (is_binary) {
            for (size_t k = 0; k < 3; ++k) put(out, stem[i + k]);
            out += "\x40\x80\x20";
        } else {
            char line[100];
            snprintf(line, sizeof line, "%g %g %g 64 128 32\n", double(stem[i]), double(stem[i + 1]),
                     double(stem[i + 2]));
            out += line;
        }
    }
    for (size_t i = 0; i < indices.size(); i += 3) {
        if (is_binary) {
            put(out, uint8_t(3));
            for (size_t k = 0; k < 3; ++k) put(out, int32_t(indices[i + k]));
        } else {
            char line[100];
            snprintf(line, sizeof line, "3 %u %u %u\n", indices[i], indices[i + 1], indices[i + 2]);
            out += line;
        }
    }
    return out;
}

inline std::string stl(bool is_binary) {
    const std::vector<float> stem = stem_positions();
    const std::vector<uint32_t> indices = stem_indices();
    std::string out = is_binary ? std::string(80, ' ') : "solid stem\n";
    if (is_binary) put(out, uint32_t(indices.size() / 3));
    for (size_t i = 0; i < indices.size(); i += 3) {
        if (is_binary)
            out += bytes_of(std::vector<float>{0, 0, 0});
        else
            out += "facet normal 0 0 0\nouter loop\n";
        for (size_t k = 0; k < 3; ++k) {
            const float* at = &stem[3 * indices[i + k]];
            char line[100];
            snprintf(line, sizeof line, "vertex %g %g %g\n", double(at[0]), double(at[1]), double(at[2]));
            out += is_binary ? bytes_of(std::vector<float>(at, at + 3)) : line;
        }
        if (is_binary)
            put(out, uint16_t(0));
        else
            out += "endloop\nendfacet\n";
    }
    return is_binary ? out : out + "endsolid stem\n";
}

// ---- glTF ----

inline std::string glb_of(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string out = "glTF";
    put(out, uint32_t(2));
    put(out, uint32_t(12 + 8 + json.size() + 8 + binary.size()));
    put(out, uint32_t(json.size()));
    put(out, uint32_t(0x4E4F534A));
    out += json;
    put(out, uint32_t(binary.size()));
    put(out, uint32_t(0x004E4942));
    return out + binary;
}

// Returns a few bytes that begin like a PNG: the import cannot decode it.
inline std::string png() {
    return std::string("\x89PNG\r\n\x1a\n") + std::string(24, '\x07');
}

// Returns a TGA of 8 x 8 pixels whose alpha is that of its column.
inline std::string tga(const std::array<int, 8>& alpha) {
    std::string out = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 32, 0x28};
    for (int y = 0; y < 8; ++y)
        for (const int a : alpha) out += {20, char(200), 20, char(a)};
    return out;
}
// Returns one that is transparent from a column on.
inline std::string tga_cut_from(int column) {
    std::array<int, 8> alpha;
    for (int x = 0; x < 8; ++x) alpha[size_t(x)] = x < column ? 255 : 0;
    return tga(alpha);
}

// Returns a PNG of 8 x 8 pixels by a palette whose second colour, that from a column on, is transparent. Its deflated
// data is stored as it is, and its checksums are zero, which readers of textures do not mind.
inline std::string palette_png_cut_from(int column) {
    std::string out = "\x89PNG\r\n\x1a\n";
    const auto add_chunk = [&](const char* kind, const std::string& data) {
        out += {0, 0, 0, char(data.size())};
        out += kind + data + std::string(4, '\0');
    };
    add_chunk("IHDR", {0, 0, 0, 8, 0, 0, 0, 8, 8, 3, 0, 0, 0});
    add_chunk("PLTE", {20, char(200), 20, 0, 0, 0});
    add_chunk("tRNS", {char(255), 0});
    std::string rows;
    for (int y = 0; y < 8; ++y) {
        rows += '\0';  // no filter
        for (int x = 0; x < 8; ++x) rows += char(x < column ? 0 : 1);
    }
    const char size = char(rows.size());
    add_chunk("IDAT", std::string({0x78, 0x01, 0x01, size, 0, char(~size), char(255)}) + rows + std::string(4, '\0'));
    add_chunk("IEND", "");
    return out;
}

// Returns the buffer: stem (96 + 96 bytes), leaf (48 + 24 bytes), uvs (32), image (32).
inline std::string glb_binary() {
    std::vector<float> uvs = leaf_uvs_bottom_up();
    for (size_t i = 1; i < uvs.size(); i += 2) uvs[i] = 1 - uvs[i];
    return bytes_of(stem_positions()) + bytes_of(stem_indices()) + bytes_of(leaf_positions()) +
           bytes_of(leaf_indices()) + bytes_of(uvs) + png();
}

inline std::string gltf_json(const std::string& buffer_uri = "") {
    const std::string uri = buffer_uri.empty() ? "" : "\"uri\":\"" + buffer_uri + "\",";
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"plant","children":[1,2,3]},{"name":"stem","mesh":0},
{"name":"leaf","mesh":1,"translation":[0,0.4,0],"scale":[-1,1,1]},
{"name":"leaf_twin","mesh":1,"translation":[0,0.2,0]}],
"meshes":[{"name":"stem_mesh","primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"name":"leaf_mesh","primitives":[{"attributes":{"POSITION":2,"TEXCOORD_0":4},"indices":3,"material":1}]}],
"materials":[{"name":"bark","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.125,1]}},
{"name":"green","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,1],"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"bufferView":5,"mimeType":"image/png","name":"leaf_image"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,0,-1],"max":[1,1,1]},
{"bufferView":1,"componentType":5125,"count":24,"type":"SCALAR"},
{"bufferView":2,"componentType":5126,"count":4,"type":"VEC3","min":[-1,0,-1],"max":[1,1,1]},
{"bufferView":3,"componentType":5125,"count":6,"type":"SCALAR"},
{"bufferView":4,"componentType":5126,"count":4,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":96},
{"buffer":0,"byteOffset":192,"byteLength":48},{"buffer":0,"byteOffset":240,"byteLength":24},
{"buffer":0,"byteOffset":264,"byteLength":32},{"buffer":0,"byteOffset":296,"byteLength":32}],
"buffers":[{)" +
           uri + R"("byteLength":328}]})";
}

inline std::string glb() {
    return glb_of(gltf_json(), glb_binary());
}

// ---- COLLADA ----

inline std::string numbers(const std::vector<float>& values) {
    std::string out;
    char text[40];
    for (float value : values) {
        snprintf(text, sizeof text, "%g ", double(value));
        out += text;
    }
    return out;
}

inline std::string dae_mesh(const std::string& id, const std::vector<float>& positions,
                            const std::vector<uint32_t>& indices) {
    std::string corners;
    for (uint32_t index : indices) corners += std::to_string(index) + " ";
    const std::string floats = std::to_string(positions.size()), count = std::to_string(positions.size() / 3);
    return "<geometry id=\"" + id + "-mesh\" name=\"" + id + "\"><mesh><source id=\"" + id + "-p\"><float_array id=\"" +
           id + "-a\" count=\"" + floats + "\">" + numbers(positions) +
           "</float_array><technique_common><accessor source=\"#" + id + "-a\" count=\"" + count +
           "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
           "type=\"float\"/></accessor></technique_common></source><vertices id=\"" +
           id + "-v\"><input semantic=\"POSITION\" source=\"#" + id + "-p\"/></vertices><triangles count=\"" +
           std::to_string(indices.size() / 3) + "\" material=\"green\"><input semantic=\"VERTEX\" source=\"#" + id +
           "-v\" offset=\"0\"/><p>" + corners + "</p></triangles></mesh></geometry>";
}

// Returns y-up positions in centimetres, in a file that declares z up if requested.
inline std::string dae(bool is_z_up) {
    std::vector<float> stem = stem_positions(), leaf = leaf_positions();
    for (std::vector<float>* positions : {&stem, &leaf})
        for (size_t i = 0; i < positions->size(); i += 3) {
            float* at = &(*positions)[i];
            for (size_t k = 0; k < 3; ++k) at[k] *= 100;
            if (is_z_up) {
                std::swap(at[1], at[2]);
                at[1] = -at[1];
            }
        }
    const std::string lift = is_z_up ? "0 0 40" : "0 40 0";
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset>"
           "<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>" +
           std::string(is_z_up ? "Z_UP" : "Y_UP") +
           "</up_axis></asset><library_effects><effect id=\"green-fx\"><profile_COMMON><technique "
           "sid=\"common\"><lambert>"
           "<diffuse><color>0.5 0.5 0 "
           "1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>"
           "<library_materials><material id=\"green-m\" name=\"green\"><instance_effect url=\"#green-fx\"/></material>"
           "</library_materials><library_geometries>" +
           dae_mesh("stem", stem, stem_indices()) + dae_mesh("leaf", leaf, leaf_indices()) +
           "</library_geometries><library_visual_scenes><visual_scene id=\"S\" name=\"S\">"
           "<node id=\"n1\" name=\"stem\"><instance_geometry url=\"#stem-mesh\"><bind_material><technique_common>"
           "<instance_material symbol=\"green\" "
           "target=\"#green-m\"/></technique_common></bind_material></instance_geometry></node>"
           "<node id=\"n2\" name=\"leaf\"><translate>" +
           lift +
           "</translate><scale>-1 1 1</scale>"
           "<instance_geometry url=\"#leaf-mesh\"><bind_material><technique_common><instance_material symbol=\"green\" "
           "target=\"#green-m\"/></technique_common></bind_material></instance_geometry></node></visual_scene>"
           "</library_visual_scenes><scene><instance_visual_scene url=\"#S\"/></scene></COLLADA>\n";
}

// ---- FBX ----

// One property: a type letter and its text and binary forms.
struct FbxProperty {
    std::string text, binary;
};

inline FbxProperty fbx_text(const std::string& value) {
    FbxProperty property{"\"" + value + "\"", "S"};
    // "Model::stem" is stored in reverse order in binary.
    std::string stored = value;
    const size_t colon = value.find("::");
    if (colon != std::string::npos) stored = value.substr(colon + 2) + std::string("\0\1", 2) + value.substr(0, colon);
    put(property.binary, uint32_t(stored.size()));
    property.binary += stored;
    return property;
}
inline FbxProperty fbx_long(int64_t value) {
    FbxProperty property{std::to_string(value), "L"};
    put(property.binary, value);
    return property;
}
inline FbxProperty fbx_int(int32_t value) {
    FbxProperty property{std::to_string(value), "I"};
    put(property.binary, value);
    return property;
}
inline FbxProperty fbx_double(double value) {
    FbxProperty property{std::to_string(value), "D"};
    put(property.binary, value);
    return property;
}
template <typename Value>
FbxProperty fbx_array(char letter, const std::vector<Value>& values) {
    FbxProperty property{"*" + std::to_string(values.size()) + " {\n a: ", std::string(1, letter)};
    for (size_t i = 0; i < values.size(); ++i) property.text += (i ? "," : "") + std::to_string(values[i]);
    property.text += "\n}";
    put(property.binary, uint32_t(values.size()));
    put(property.binary, uint32_t(0));
    put(property.binary, uint32_t(values.size() * sizeof(Value)));
    property.binary += bytes_of(values);
    return property;
}

struct FbxNode {
    std::string name;
    std::vector<FbxProperty> properties;
    std::vector<FbxNode> children;
};

inline void write_fbx_text(const FbxNode& node, std::string& out) {
    out += node.name + ": ";
    for (size_t i = 0; i < node.properties.size(); ++i) out += (i ? ", " : "") + node.properties[i].text;
    if (!node.children.empty()) {
        out += " {\n";
        for (const FbxNode& child : node.children) write_fbx_text(child, out);
        out += "}";
    }
    out += "\n";
}

inline void write_fbx_binary(const FbxNode& node, std::string& out) {
    const size_t begin = out.size();
    std::string properties;
    for (const FbxProperty& property : node.properties) properties += property.binary;
    put(out, uint32_t(0));
    put(out, uint32_t(node.properties.size()));
    put(out, uint32_t(properties.size()));
    put(out, uint8_t(node.name.size()));
    out += node.name + properties;
    for (const FbxNode& child : node.children) write_fbx_binary(child, out);
    if (!node.children.empty()) out += std::string(13, '\0');
    const uint32_t end = uint32_t(out.size());
    memcpy(&out[begin], &end, 4);
}

inline FbxNode fbx_setting(const std::string& name, const std::string& type, std::vector<FbxProperty> values) {
    std::vector<FbxProperty> properties = {fbx_text(name), fbx_text(type), fbx_text(""), fbx_text("A")};
    properties.insert(properties.end(), values.begin(), values.end());
    return {"P", properties, {}};
}

inline FbxNode fbx_geometry(int64_t id, const std::string& name, const std::vector<float>& positions,
                            const std::vector<uint32_t>& indices) {
    std::vector<double> vertices(positions.begin(), positions.end());
    std::vector<int32_t> corners(indices.begin(), indices.end());
    for (double& value : vertices) value *= 100;
    for (size_t i = 2; i < corners.size(); i += 3) corners[i] = -corners[i] - 1;
    return {"Geometry",
            {fbx_long(id), fbx_text("Geometry::" + name), fbx_text("Mesh")},
            {{"Vertices", {fbx_array('d', vertices)}, {}},
             {"PolygonVertexIndex", {fbx_array('i', corners)}, {}},
             {"GeometryVersion", {fbx_int(124)}, {}},
             {"LayerElementMaterial",
              {fbx_int(0)},
              {{"Version", {fbx_int(101)}, {}},
               {"Name", {fbx_text("")}, {}},
               {"MappingInformationType", {fbx_text("AllSame")}, {}},
               {"ReferenceInformationType", {fbx_text("IndexToDirect")}, {}},
               {"Materials", {fbx_array('i', std::vector<int32_t>{0})}, {}}}},
             {"Layer",
              {fbx_int(0)},
              {{"Version", {fbx_int(100)}, {}},
               {"LayerElement",
                {},
                {{"Type", {fbx_text("LayerElementMaterial")}, {}}, {"TypedIndex", {fbx_int(0)}, {}}}}}}}};
}

// Returns a file in units of `unit` centimetres, with up axis 1 (y) or 2 (z).
inline std::string fbx(bool is_binary, int up_axis = 1, double unit = 1) {
    std::vector<float> stem = stem_positions(), leaf = leaf_positions();
    const double lift = 40 / unit;
    for (std::vector<float>* positions : {&stem, &leaf})
        for (size_t i = 0; i < positions->size(); i += 3) {
            float* at = &(*positions)[i];
            for (size_t k = 0; k < 3; ++k) at[k] = float(at[k] / unit);
            if (up_axis == 2) {
                std::swap(at[1], at[2]);
                at[1] = -at[1];
            }
        }
    const FbxNode settings = {
        "Properties70",
        {},
        {fbx_setting("UpAxis", "int", {fbx_int(up_axis)}), fbx_setting("UpAxisSign", "int", {fbx_int(1)}),
         fbx_setting("UnitScaleFactor", "double", {fbx_double(unit)})}};
    const FbxNode lifted = {
        "Properties70",
        {},
        {fbx_setting("Lcl Translation", "Lcl Translation",
                     {fbx_double(0), fbx_double(up_axis == 1 ? lift : 0), fbx_double(up_axis == 2 ? lift : 0)}),
         fbx_setting("Lcl Scaling", "Lcl Scaling", {fbx_double(-1), fbx_double(1), fbx_double(1)})}};
    const FbxNode green = {
        "Properties70", {}, {fbx_setting("DiffuseColor", "Color", {fbx_double(0.5), fbx_double(0.5), fbx_double(0)})}};
    const auto connect = [](int64_t from, int64_t to) {
        return FbxNode{"C", {fbx_text("OO"), fbx_long(from), fbx_long(to)}, {}};
    };
    const std::vector<FbxNode> nodes = {
        {"FBXHeaderExtension", {}, {{"FBXHeaderVersion", {fbx_int(1003)}, {}}, {"FBXVersion", {fbx_int(7400)}, {}}}},
        {"GlobalSettings", {}, {{"Version", {fbx_int(1000)}, {}}, settings}},
        {"Objects",
         {},
         {fbx_geometry(10, "stem", stem, stem_indices()),
          fbx_geometry(11, "leaf", leaf, leaf_indices()),
          {"Model", {fbx_long(20), fbx_text("Model::stem"), fbx_text("Mesh")}, {{"Version", {fbx_int(232)}, {}}}},
          {"Model",
           {fbx_long(21), fbx_text("Model::leaf"), fbx_text("Mesh")},
           {{"Version", {fbx_int(232)}, {}}, lifted}},
          {"Material",
           {fbx_long(30), fbx_text("Material::green"), fbx_text("")},
           {{"Version", {fbx_int(102)}, {}}, {"ShadingModel", {fbx_text("phong")}, {}}, green}}}},
        {"Connections",
         {},
         {connect(20, 0), connect(21, 0), connect(10, 20), connect(11, 21), connect(30, 20), connect(30, 21)}}};
    std::string out = is_binary ? std::string("Kaydara FBX Binary  \0\x1a\0", 23) : "; FBX 7.4.0 project file\n";
    if (is_binary) put(out, uint32_t(7400));
    for (const FbxNode& node : nodes) is_binary ? write_fbx_binary(node, out) : write_fbx_text(node, out);
    return is_binary ? out + std::string(13 + 160, '\0') : out;
}

}  // namespace files
