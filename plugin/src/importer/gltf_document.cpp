// Reads a glTF document. In: bytes. Out: JSON and buffers. Every length is checked.
#include <cstring>

#include "core/platform/files.hpp"
#include "importer/gltf.hpp"
#include "importer/importer.hpp"

namespace frond {

static uint32_t word_at(const std::string& bytes, size_t at) {
    uint32_t word;
    std::memcpy(&word, bytes.data() + at, 4);
    return word;
}

// Splits a GLB into its chunks.
static std::string split_glb(const std::string& bytes, std::string& binary) {
    if (bytes.size() < 20 || bytes.compare(0, 4, "glTF") != 0)
        fail(FROND_RESULT_FILE_FORMAT, "the file does not begin with a GLB header");
    const size_t announced = word_at(bytes, 8);
    if (announced > bytes.size())
        fail(FROND_RESULT_FILE_FORMAT, "the file is cut off: %zu bytes are announced, but there are %zu", announced,
             bytes.size());
    const size_t text_size = word_at(bytes, 12);
    const bool is_old = word_at(bytes, 4) == 1;
    if ((!is_old && word_at(bytes, 16) != 0x4E4F534A) || text_size > announced - 20)
        fail(FROND_RESULT_FILE_FORMAT, "the first chunk of the GLB is not whole JSON");
    const size_t next = 20 + text_size;
    if (!is_old && announced - next >= 8 && announced <= bytes.size()) {
        const size_t size = word_at(bytes, next);
        if (size > announced - next - 8)
            fail(FROND_RESULT_FILE_FORMAT, "the second chunk of the GLB has %zu bytes, but only %zu are left", size,
                 announced - next - 8);
        if (word_at(bytes, next + 4) == 0x004E4942) binary = bytes.substr(next + 8, size);
    }
    return bytes.substr(20, text_size);
}

GltfDocument parse_gltf(const MeshFile& file) {
    GltfDocument document;
    const bool is_glb = file.bytes.compare(0, 4, "glTF") == 0;
    if (file.format == FileFormat::GLB && !is_glb)
        fail(FROND_RESULT_FILE_FORMAT, "the file does not begin with a GLB header");
    const std::string text = is_glb ? split_glb(file.bytes, document.binary) : file.bytes;
    try {
        document.json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        const size_t at = std::min(text.size(), size_t(error.byte));
        fail(FROND_RESULT_FILE_FORMAT, "the JSON is damaged at line %ld (byte %zu)",
             long(1 + std::count(text.begin(), text.begin() + long(at), '\n')), at);
    }
    if (!document.json.is_object() || !document.json.contains("asset") || !document.json["asset"].is_object())
        fail(FROND_RESULT_FILE_FORMAT, "the JSON is not a glTF document: it has no \"asset\"");
    const std::string version = text_of_json(document.json["asset"], "version");
    document.is_old = !version.empty() && version[0] == '1';
    if (!document.is_old && (version.empty() || version[0] != '2'))
        fail(FROND_RESULT_FILE_FORMAT, "the glTF version is \"%.20s\"; 1.0 and 2.0 are read", version.c_str());
    return document;
}

static std::string decode_base64(const std::string& text, size_t begin) {
    std::string out;
    uint32_t word = 0;
    int bits = 0;
    for (size_t i = begin; i < text.size(); ++i) {
        const char letter = text[i];
        int value;
        if (letter >= 'A' && letter <= 'Z')
            value = letter - 'A';
        else if (letter >= 'a' && letter <= 'z')
            value = letter - 'a' + 26;
        else if (letter >= '0' && letter <= '9')
            value = letter - '0' + 52;
        else if (letter == '+' || letter == '-')
            value = 62;
        else if (letter == '/' || letter == '_')
            value = 63;
        else if (letter == '=')
            break;
        else
            continue;
        word = word << 6 | uint32_t(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        out += char(word >> bits & 255);
    }
    return out;
}

static std::string load_buffer(const GltfDocument& document, const Json& buffer, size_t index, const MeshFile& file) {
    const std::string uri = text_of_json(buffer, "uri");
    if (uri.empty()) return index == 0 ? document.binary : "";
    if (uri.compare(0, 5, "data:") == 0) {
        const size_t comma = uri.find(',');
        return comma == std::string::npos ? "" : decode_base64(uri, comma + 1);
    }
    const std::string path = find_beside(file.folder, uri);
    std::string bytes, error;
    if (path.empty() || !read_file(path, size_t(1) << 30, bytes, error))
        fail(FROND_RESULT_FILE_FORMAT, "the file %.200s, which holds its geometry, is not in the model's folder",
             uri.c_str());
    return bytes;
}

void load_buffers(GltfDocument& document, const MeshFile& file) {
    if (!document.json.contains("buffers") || !document.json["buffers"].is_array()) return;
    for (const Json& buffer : document.json["buffers"]) {
        const size_t index = document.buffers.size();
        document.buffers.push_back(load_buffer(document, buffer, index, file));
        // A fallback buffer for compressed geometry may be missing.
        const bool is_fallback = buffer.is_object() && buffer.contains("extensions");
        const long long wanted = number_of(buffer, "byteLength", 0);
        if (!is_fallback && wanted > (long long)document.buffers.back().size())
            fail(FROND_RESULT_FILE_FORMAT, "buffer %zu is cut off: %lld bytes are announced, but there are %zu", index,
                 wanted, document.buffers.back().size());
    }
}

const Json& item_of(const Json& json, const char* list, long long index) {
    static const Json NOTHING = Json::object();
    const auto found = json.find(list);
    if (found == json.end() || !found->is_array() || index < 0 || index >= (long long)found->size()) return NOTHING;
    const Json& item = (*found)[size_t(index)];
    return item.is_object() ? item : NOTHING;
}

long long number_of(const Json& object, const char* key, long long missing) {
    if (!object.is_object()) return missing;
    const auto found = object.find(key);
    if (found == object.end()) return missing;
    const double value = found->is_number() ? found->get<double>() : -1;
    if (!(value >= 0 && value < 1e15))
        fail(FROND_RESULT_FILE_FORMAT, "\"%s\" must be a number that is not negative", key);
    return (long long)value;
}

std::string text_of_json(const Json& object, const char* key) {
    if (!object.is_object()) return "";
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

int width_of_type(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    return type == "MAT4" ? 16 : 0;
}

int size_of_component(long long component) {
    if (component == 5120 || component == 5121) return 1;
    if (component == 5122 || component == 5123) return 2;
    return component == 5125 || component == 5126 ? 4 : 0;
}

}  // namespace frond
