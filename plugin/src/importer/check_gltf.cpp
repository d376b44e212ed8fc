// Checks glTF: required extensions must be supported, accessors must lie in their views and views in their buffers.
#include "importer/gltf.hpp"
#include "importer/importer.hpp"

namespace frond {

// Returns whether a file may require an extension: it is read, rewritten by rewrite_gltf(), or irrelevant to shape and
// base colour.
static bool is_supported(const std::string& extension) {
    static const char* const NAMES[] = {"KHR_draco_mesh_compression",
                                        "KHR_mesh_quantization",
                                        "KHR_texture_transform",
                                        "EXT_texture_webp",
                                        "KHR_texture_basisu",
                                        "KHR_lights_punctual",
                                        "EXT_meshopt_compression",
                                        "MSFT_texture_dds",
                                        "KHR_xmp",
                                        "KHR_xmp_json_ld"};
    if (extension.compare(0, 14, "KHR_materials_") == 0 || extension.compare(0, 14, "KHR_animation_") == 0) return true;
    for (const char* name : NAMES)
        if (extension == name) return true;
    return false;
}

static void check_extensions(const Json& json) {
    const auto required = json.find("extensionsRequired");
    if (required == json.end() || !required->is_array()) return;
    for (const Json& extension : *required)
        if (extension.is_string() && !is_supported(extension.get<std::string>()))
            fail(FROND_RESULT_FILE_FORMAT,
                 "the file needs the glTF extension %.60s, which is not read; export it without",
                 extension.get<std::string>().c_str());
}

static void check_views(const GltfDocument& document) {
    const auto views = document.json.find("bufferViews");
    if (views == document.json.end() || !views->is_array()) return;
    for (size_t i = 0; i < views->size(); ++i) {
        const Json& view = item_of(document.json, "bufferViews", (long long)i);
        if (view.contains("extensions")) continue;  // compressed
        const long long buffer = number_of(view, "buffer", -1), offset = number_of(view, "byteOffset", 0),
                        length = number_of(view, "byteLength", 0);
        if (buffer < 0 || buffer >= (long long)document.buffers.size())
            fail(FROND_RESULT_FILE_FORMAT, "buffer view %zu is in buffer %lld, but there are %zu", i, buffer,
                 document.buffers.size());
        if (offset + length > (long long)document.buffers[size_t(buffer)].size())
            fail(FROND_RESULT_FILE_FORMAT, "buffer view %zu ends at byte %lld, but buffer %lld has %zu", i,
                 offset + length, buffer, document.buffers[size_t(buffer)].size());
    }
}

static void check_accessors(const Json& json) {
    const auto accessors = json.find("accessors");
    if (accessors == json.end() || !accessors->is_array()) return;
    for (size_t i = 0; i < accessors->size(); ++i) {
        const Json& accessor = item_of(json, "accessors", (long long)i);
        const long long width = width_of_type(text_of_json(accessor, "type")),
                        size = size_of_component(number_of(accessor, "componentType", 0)),
                        count = number_of(accessor, "count", 0), view_index = number_of(accessor, "bufferView", -1);
        if (width == 0 || size == 0) fail(FROND_RESULT_FILE_FORMAT, "accessor %zu is of no known type", i);
        if (count > 100000000) fail(FROND_RESULT_FILE_FORMAT, "accessor %zu has %lld elements", i, count);
        if (view_index < 0) continue;
        const Json& view = item_of(json, "bufferViews", view_index);
        if (view.empty())
            fail(FROND_RESULT_FILE_FORMAT, "accessor %zu is in buffer view %lld, which does not exist", i, view_index);
        const long long stride = std::max(number_of(view, "byteStride", 0), width * size);
        const long long end =
            number_of(accessor, "byteOffset", 0) + (count > 0 ? stride * (count - 1) + width * size : 0);
        if (end > number_of(view, "byteLength", 0))
            fail(FROND_RESULT_FILE_FORMAT, "accessor %zu ends at byte %lld, but its buffer view has %lld", i, end,
                 number_of(view, "byteLength", 0));
    }
}

void check_gltf(const MeshFile& file) {
    GltfDocument document = parse_gltf(file);
    if (document.is_old) return;
    check_extensions(document.json);
    load_buffers(document, file);
    check_views(document);
    check_accessors(document.json);
}

}  // namespace frond
