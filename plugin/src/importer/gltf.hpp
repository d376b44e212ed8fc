// glTF document: the JSON of a .gltf or .glb file and the bytes that it refers to.
#pragma once

#include <nlohmann/json.hpp>

#include "importer/check.hpp"

namespace frond {

using Json = nlohmann::json;

struct GltfDocument {
    Json json;
    bool is_old = false;               // version 1, which has another structure
    std::string binary;                // the GLB's second chunk
    std::vector<std::string> buffers;  // contents, once load_buffers() has run
};

// Parses the document without its buffers. Throws FILE_FORMAT.
GltfDocument parse_gltf(const MeshFile& file);
// Loads the buffers: chunk, data URI or file in the model's folder.
void load_buffers(GltfDocument& document, const MeshFile& file);

// Returns an element of a list in the document, or an empty object if there is none.
const Json& item_of(const Json& json, const char* list, long long index);
// Returns a number >= 0 of an object, rounded down, or `missing` if the key is absent; throws FILE_FORMAT for anything
// else.
long long number_of(const Json& object, const char* key, long long missing);
std::string text_of_json(const Json& object, const char* key);
// Return the values per element ("VEC3": 3) and the bytes per value (5126, a float: 4); 0 if unknown.
int width_of_type(const std::string& type);
int size_of_component(long long component);

}  // namespace frond
