// Import stream: what the import program says to the library through a pipe. A greeting (is it the right program?),
// then one message: length, content, checksum. Little-endian, as the two run on one machine.
#pragma once

#include "core/error.hpp"
#include "model/surface.hpp"
#include "model/urdf.hpp"

namespace frond {

struct ImportResult {
    frond_result code = FROND_OK;
    std::string error;  // if code is not FROND_OK
    std::vector<std::string> warnings;
    // If it is, one of these: the other is empty.
    Surface surface;
    UrdfTree tree;
};

constexpr size_t IMPORT_GREETING_SIZE = 16;
// Magic and version.
std::string import_greeting();
std::string encode_import(const ImportResult& result);
// False if the bytes after the greeting are not one whole message that holds together: everything is checked.
bool decode_import(const char* bytes, size_t byte_count, ImportResult& result);

}  // namespace frond
