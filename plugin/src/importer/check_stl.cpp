// Checks STL: a binary file's length must match its triangle count, a text file must be complete.
#include <cstring>

#include "importer/check.hpp"

namespace frond {

static constexpr size_t HEADER = 84, TRIANGLE = 50;  // [byte]

void check_stl(const MeshFile& file) {
    const std::string& bytes = file.bytes;
    uint32_t count = 0;
    if (bytes.size() >= HEADER) memcpy(&count, bytes.data() + 80, 4);
    const size_t needed = HEADER + TRIANGLE * size_t(count);
    if (bytes.size() >= HEADER && bytes.size() == needed) {
        if (count == 0) fail(FROND_RESULT_FILE_FORMAT, "there are no triangles in the file");
        return;
    }

    // A text file begins with "solid" and has no zero byte.
    const size_t first = bytes.find_first_not_of(" \t\r\n");
    const bool is_text =
        first != std::string::npos && bytes.compare(first, 5, "solid") == 0 && bytes.find('\0') == std::string::npos;
    if (is_text) {
        if (bytes.find("facet") == std::string::npos)
            fail(FROND_RESULT_FILE_FORMAT, "there are no triangles in the file");
        if (bytes.find("endsolid", bytes.size() > 4096 ? bytes.size() - 4096 : 0) == std::string::npos)
            fail(FROND_RESULT_FILE_FORMAT, "the file is cut off: it ends without \"endsolid\"");
        return;
    }
    if (bytes.size() < HEADER)
        fail(FROND_RESULT_FILE_FORMAT, "the file is neither STL text nor long enough for binary STL");
    if (bytes.size() < needed)
        fail(FROND_RESULT_FILE_FORMAT, "the file is cut off: %u triangles need %zu bytes, but there are %zu",
             unsigned(count), needed, bytes.size());
    if (count == 0) fail(FROND_RESULT_FILE_FORMAT, "there are no triangles in the file");
}

}  // namespace frond
