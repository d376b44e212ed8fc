// Import stream: output of the import program to the library through a pipe. A greeting (is it the right program?),
// then one message: length, content, checksum. Little-endian, as the two run on one machine.
#pragma once

#include "core/error.hpp"
#include "io/urdf.hpp"
#include "skeleton/organ_correct.hpp"
#include "surface/surface.hpp"

namespace frond {

struct ImportResult {
    frond_result code = FROND_OK;
    std::string error;  // if code is not FROND_OK
    std::vector<std::string> warnings;
    // If code is FROND_OK, one of these; the other is empty.
    Surface surface;
    UrdfTree tree;
    Corrections corrections = {};
};

constexpr size_t IMPORT_GREETING_SIZE = 16;  // [byte]
// Returns magic and version.
std::string import_greeting();
std::string encode_import(ImportResult& result);
// Returns false unless the bytes after the greeting are one whole, consistent message; everything is checked.
bool decode_import(const char* bytes, size_t byte_count, ImportResult& result);

}  // namespace frond
