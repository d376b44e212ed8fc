// Rewrites glTF for assimp 5.2: quantized attributes and texture transforms become plain floats, compressed buffer
// views plain ones, WebP textures plain textures. A document without any of these is not changed.
#include <meshoptimizer.h>

#include <cstring>
#include <map>

#include "core/elementary.hpp"
#include "importer/gltf.hpp"
#include "importer/importer.hpp"

namespace frond {

// A document that is being rewritten; new data goes into one more buffer.
struct Rewriting {
    GltfDocument document;
    std::string added;
    std::map<std::string, size_t> converted;  // attribute accessor and texture transform -> converted accessor
    bool is_changed = false;
};

// Appends bytes to the new buffer, whose index is known from the start. Returns the index of their buffer view.
static size_t add_view(Rewriting& work, const std::string& bytes) {
    Json& json = work.document.json;
    work.added.resize((work.added.size() + 3) / 4 * 4, '\0');
    json["bufferViews"].push_back(
        {{"buffer", work.document.buffers.size()}, {"byteOffset", work.added.size()}, {"byteLength", bytes.size()}});
    work.added += bytes;
    if (work.added.size() > (size_t(1) << 30)) fail(FROND_RESULT_FILE_FORMAT, "the file unpacks to more than 1 GiB");
    work.is_changed = true;
    return json["bufferViews"].size() - 1;
}

// ---- meshopt ----

static std::string decode_view(const std::string& source, const Json& extension, size_t index) {
    const size_t count = size_t(number_of(extension, "count", 0)),
                 stride = size_t(number_of(extension, "byteStride", 0));
    const std::string mode = text_of_json(extension, "mode"), filter = text_of_json(extension, "filter");
    const auto* bytes = reinterpret_cast<const unsigned char*>(source.data());
    const bool is_vertices = mode == "ATTRIBUTES";
    const bool is_sane =
        count > 0 && count <= 60000000 && stride > 0 && stride <= 256 && count * stride <= (1u << 30) &&
        (is_vertices ? stride % 4 == 0 : (stride == 2 || stride == 4) && (mode != "TRIANGLES" || count % 3 == 0));
    if (!is_sane) fail(FROND_RESULT_FILE_FORMAT, "buffer view %zu is compressed in an unknown way", index);
    std::string out(count * stride, '\0');
    int error;
    if (is_vertices)
        error = meshopt_decodeVertexBuffer(&out[0], count, stride, bytes, source.size());
    else if (mode == "TRIANGLES")
        error = meshopt_decodeIndexBuffer(&out[0], count, stride, bytes, source.size());
    else
        error = meshopt_decodeIndexSequence(&out[0], count, stride, bytes, source.size());
    if (error != 0) fail(FROND_RESULT_FILE_FORMAT, "the compressed buffer view %zu is damaged", index);
    if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) meshopt_decodeFilterOct(&out[0], count, stride);
    if (filter == "QUATERNION" && stride == 8) meshopt_decodeFilterQuat(&out[0], count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(&out[0], count, stride);
    return out;
}

static void unpack_views(Rewriting& work) {
    Json& json = work.document.json;
    if (!json.contains("bufferViews") || !json["bufferViews"].is_array()) return;
    const size_t view_count = json["bufferViews"].size();
    for (size_t i = 0; i < view_count; ++i) {
        const Json view = item_of(json, "bufferViews", (long long)i);
        if (!view.contains("extensions") || !view["extensions"].contains("EXT_meshopt_compression")) continue;
        const Json& extension = view["extensions"]["EXT_meshopt_compression"];
        const long long buffer = number_of(extension, "buffer", -1), offset = number_of(extension, "byteOffset", 0),
                        length = number_of(extension, "byteLength", 0);
        const bool has_buffer = buffer >= 0 && buffer < (long long)work.document.buffers.size();
        const long long size = has_buffer ? (long long)work.document.buffers[size_t(buffer)].size() : 0;
        if (!has_buffer || offset < 0 || length < 0 || offset > size || length > size - offset)
            fail(FROND_RESULT_FILE_FORMAT, "the compressed buffer view %zu is outside its buffer", i);
        const std::string unpacked =
            decode_view(work.document.buffers[size_t(buffer)].substr(size_t(offset), size_t(length)), extension, i);
        Json plain = json["bufferViews"][add_view(work, unpacked)];
        json["bufferViews"].erase(json["bufferViews"].size() - 1);
        if (number_of(extension, "byteStride", 0) >= 4 && text_of_json(extension, "mode") == "ATTRIBUTES")
            plain["byteStride"] = extension["byteStride"];
        json["bufferViews"][i] = plain;
    }
}

// ---- attributes ----

struct UvTransform {
    double offset[2] = {0, 0}, scale[2] = {1, 1}, rotation = 0;
    bool is_identity = true;
};

static double pair_value(const Json& object, const char* key, size_t index, double missing) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array() || found->size() <= index || !(*found)[index].is_number())
        return missing;
    return (*found)[index].get<double>();
}

static UvTransform transform_of(const Json& texture) {
    UvTransform transform;
    if (!texture.is_object() || !texture.contains("extensions") || !texture["extensions"].is_object() ||
        !texture["extensions"].contains("KHR_texture_transform"))
        return transform;
    const Json& extension = texture["extensions"]["KHR_texture_transform"];
    if (!extension.is_object()) return transform;
    for (size_t i = 0; i < 2; ++i) {
        transform.offset[i] = pair_value(extension, "offset", i, 0);
        transform.scale[i] = pair_value(extension, "scale", i, 1);
    }
    if (extension.contains("rotation") && extension["rotation"].is_number())
        transform.rotation = extension["rotation"].get<double>();
    transform.is_identity = false;
    return transform;
}

static double component_at(const char* bytes, long long type, bool is_normalized) {
    const auto read = [bytes](auto value) {
        std::memcpy(&value, bytes, sizeof value);
        return double(value);
    };
    switch (type) {
        case 5120:
            return is_normalized ? std::max(-1.0, read(int8_t()) / 127) : read(int8_t());
        case 5121:
            return read(uint8_t()) / (is_normalized ? 255 : 1);
        case 5122:
            return is_normalized ? std::max(-1.0, read(int16_t()) / 32767) : read(int16_t());
        case 5123:
            return read(uint16_t()) / (is_normalized ? 65535 : 1);
        case 5125:
            return read(uint32_t());
        default:
            return read(float());
    }
}

// Returns the values of an accessor as floats, `wanted` per element; missing ones are 1, as for alpha.
static std::vector<float> floats_of(const Rewriting& work, const Json& accessor, int wanted) {
    const Json& json = work.document.json;
    const Json& view = item_of(json, "bufferViews", number_of(accessor, "bufferView", -1));
    const long long buffer = number_of(view, "buffer", -1), type = number_of(accessor, "componentType", 0);
    const size_t width = size_t(width_of_type(text_of_json(accessor, "type"))), size = size_t(size_of_component(type)),
                 count = size_t(number_of(accessor, "count", 0));
    const bool is_added = buffer == (long long)work.document.buffers.size();
    if (width == 0 || size == 0 || buffer < 0 || buffer > (long long)work.document.buffers.size())
        fail(FROND_RESULT_FILE_FORMAT, "an attribute refers to no buffer");
    const std::string& bytes = is_added ? work.added : work.document.buffers[size_t(buffer)];
    const size_t stride = std::max(size_t(number_of(view, "byteStride", 0)), width * size);
    const size_t begin = size_t(number_of(view, "byteOffset", 0) + number_of(accessor, "byteOffset", 0));
    if (count > 0 && begin + stride * (count - 1) + width * size > bytes.size())
        fail(FROND_RESULT_FILE_FORMAT, "an attribute ends behind its buffer");
    const bool is_normalized = accessor.contains("normalized") && accessor["normalized"] == true;
    std::vector<float> out;
    out.reserve(count * size_t(wanted));
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < size_t(wanted); ++k)
            out.push_back(k < width
                              ? float(component_at(bytes.data() + begin + i * stride + k * size, type, is_normalized))
                              : 1.0f);
    return out;
}

static size_t convert_accessor(Rewriting& work, size_t index, int wanted, const UvTransform& transform) {
    const std::string key = std::to_string(index) + Json({transform.offset[0], transform.offset[1], transform.scale[0],
                                                          transform.scale[1], transform.rotation})
                                                        .dump();
    const auto known = work.converted.find(key);
    if (known != work.converted.end()) return known->second;
    const Json accessor = item_of(work.document.json, "accessors", (long long)index);
    std::vector<float> values = floats_of(work, accessor, wanted);
    if (!transform.is_identity && wanted == 2)
        for (size_t i = 0; i + 1 < values.size(); i += 2) {
            const double u = double(values[i]) * transform.scale[0], v = double(values[i + 1]) * transform.scale[1];
            const double c = frond::cos(transform.rotation), s = frond::sin(transform.rotation);
            values[i] = float(c * u + s * v + transform.offset[0]);
            values[i + 1] = float(-s * u + c * v + transform.offset[1]);
        }
    const std::string bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    Json plain = {{"bufferView", add_view(work, bytes)},
                  {"componentType", 5126},
                  {"count", accessor["count"]},
                  {"type", "VEC" + std::to_string(wanted)}};
    work.document.json["accessors"].push_back(plain);
    return work.converted[key] = work.document.json["accessors"].size() - 1;
}

// Converts position, normal, base-colour coordinates and colour of a primitive to floats; drops its other quantized
// attributes, except joints and weights.
static void rewrite_primitive(Rewriting& work, Json& primitive) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object()) return;
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression")) return;
    Json& attributes = primitive["attributes"];
    const Json& material = item_of(work.document.json, "materials", number_of(primitive, "material", -1));
    const Json texture = material.value("/pbrMetallicRoughness/baseColorTexture"_json_pointer, Json::object());
    const UvTransform transform = transform_of(texture);
    const std::string wanted_set = "TEXCOORD_" + std::to_string(number_of(texture, "texCoord", 0));
    if (wanted_set != "TEXCOORD_0" && attributes.contains(wanted_set)) {
        attributes["TEXCOORD_0"] = attributes[wanted_set];
        attributes.erase(wanted_set);
        work.is_changed = true;
    }
    static const std::map<std::string, int> WANTED = {
        {"POSITION", 3}, {"NORMAL", 3}, {"TEXCOORD_0", 2}, {"COLOR_0", 4}};
    std::vector<std::string> names;
    for (const auto& [name, value] : attributes.items()) names.push_back(name);
    for (const std::string& name : names) {
        const size_t index = size_t(number_of(attributes, name.c_str(), 0));
        const Json& accessor = item_of(work.document.json, "accessors", (long long)index);
        const auto wanted = WANTED.find(name);
        const bool is_float = number_of(accessor, "componentType", 0) == 5126;
        const bool is_right =
            is_float && (wanted == WANTED.end() || width_of_type(text_of_json(accessor, "type")) == wanted->second);
        const bool is_moved = name == "TEXCOORD_0" && !transform.is_identity;
        if ((is_right && !is_moved) || accessor.contains("sparse") || !accessor.contains("bufferView")) continue;
        if (name.compare(0, 7, "JOINTS_") == 0 || name.compare(0, 8, "WEIGHTS_") == 0) continue;
        if (wanted == WANTED.end()) {
            attributes.erase(name);
            work.is_changed = true;
        } else {
            attributes[name] = convert_accessor(work, index, wanted->second, transform);
        }
    }
}

// ---- textures ----

static void rewrite_textures(Rewriting& work) {
    Json& json = work.document.json;
    if (!json.contains("textures") || !json["textures"].is_array()) return;
    for (Json& texture : json["textures"]) {
        if (!texture.is_object() || texture.contains("source") || !texture.contains("extensions")) continue;
        for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds"})
            if (texture["extensions"].is_object() && texture["extensions"].contains(name) &&
                texture["extensions"][name].is_object() && texture["extensions"][name].contains("source"))
                texture["source"] = texture["extensions"][name]["source"];
        work.is_changed = work.is_changed || texture.contains("source");
    }
}

// ---- the result ----

static void append_word(std::string& out, size_t word) {
    const uint32_t value = uint32_t(word);
    out.append(reinterpret_cast<const char*>(&value), 4);
}

static void drop_extensions(Json& json) {
    // Extensions that were rewritten are no longer required, and the parser would reject their names.
    json.erase("extensionsRequired");
    if (json.contains("materials") && json["materials"].is_array())
        for (Json& material : json["materials"]) {
            const auto pointer = "/pbrMetallicRoughness/baseColorTexture"_json_pointer;
            if (!material.is_object() || !material.contains(pointer) || !material[pointer].is_object()) continue;
            if (material[pointer].contains("extensions")) material[pointer].erase("extensions");
            material[pointer].erase("texCoord");
        }
}

// Writes one GLB with one buffer: the old buffers and the new one, one after another.
static std::string write_glb(Rewriting& work) {
    Json& json = work.document.json;
    const bool keeps_draco = json.value("extensionsUsed", Json::array()).dump().find("draco") != std::string::npos;
    drop_extensions(json);
    if (keeps_draco) json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    std::string binary;
    std::vector<size_t> begins;
    work.document.buffers.push_back(work.added);
    for (const std::string& buffer : work.document.buffers) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        begins.push_back(binary.size());
        binary += buffer;
    }
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    if (binary.size() >= 0xF0000000u) fail(FROND_RESULT_FILE_FORMAT, "the file unpacks to more than 4 GiB");
    json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    for (Json& view : json["bufferViews"]) {
        const size_t buffer = size_t(number_of(view, "buffer", 0));
        if (buffer >= begins.size())
            fail(FROND_RESULT_FILE_FORMAT, "a buffer view is in buffer %zu, which does not exist", buffer);
        view["byteOffset"] = size_t(number_of(view, "byteOffset", 0)) + begins[buffer];
        view["buffer"] = 0;
    }
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    append_word(out, 2);
    append_word(out, 12 + 8 + text.size() + 8 + binary.size());
    append_word(out, text.size());
    append_word(out, 0x4E4F534A);
    out += text;
    append_word(out, binary.size());
    append_word(out, 0x004E4942);
    return out + binary;
}

std::string rewrite_gltf(const MeshFile& file) {
    Rewriting work{parse_gltf(file), "", {}, false};
    if (work.document.is_old) return "";
    load_buffers(work.document, file);
    unpack_views(work);
    rewrite_textures(work);
    if (work.document.json.contains("meshes") && work.document.json["meshes"].is_array()) {
        // Works on a copy, because primitives add accessors to the same document.
        Json meshes = work.document.json["meshes"];
        for (Json& mesh : meshes)
            if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
                for (Json& primitive : mesh["primitives"]) rewrite_primitive(work, primitive);
        work.document.json["meshes"] = meshes;
    }
    return work.is_changed ? write_glb(work) : "";
}

}  // namespace frond
