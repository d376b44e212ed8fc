// Checks COLLADA: the document must have its root element and its end tag.
#include "importer/check.hpp"

namespace frond {

void check_dae(const MeshFile& file) {
    const std::string& bytes = file.bytes;
    const bool is_wide = bytes.size() > 1 && (uint8_t(bytes[0]) >= 0xfe);
    if (is_wide) return;
    if (bytes.find("<COLLADA") == std::string::npos)
        fail(FROND_RESULT_FILE_FORMAT, "there is no <COLLADA> element in the file");
    if (bytes.find("</COLLADA", bytes.size() > 4096 ? bytes.size() - 4096 : 0) == std::string::npos)
        fail(FROND_RESULT_FILE_FORMAT, "the file is cut off: it ends without </COLLADA>");
}

}  // namespace frond
