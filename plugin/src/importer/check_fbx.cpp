// Checks FBX: the list of top-level records of a binary file, or the braces of a text one, must be complete.
#include <cstring>

#include "importer/check.hpp"

namespace frond {

template <typename Value>
static Value value_at(const std::string& bytes, size_t at) {
    Value value;
    memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

// Every record stores where it ends; an empty record closes the list.
static void check_binary(const std::string& bytes) {
    if (bytes.size() < 27) fail(FROND_RESULT_FILE_FORMAT, "the file ends in its header");
    const uint32_t version = value_at<uint32_t>(bytes, 23);
    const bool wide = version >= 7500;
    const size_t record = wide ? 25 : 13;
    if (version < 7100)
        fail(FROND_RESULT_FILE_FORMAT, "the FBX version is %u; 7100 (FBX 2011) or later is needed: export it again",
             unsigned(version));
    size_t at = 27;
    for (;;) {
        if (bytes.size() < record || at > bytes.size() - record)
            fail(FROND_RESULT_FILE_FORMAT, "the file is cut off: it ends at byte %zu, before its list of records does",
                 bytes.size());
        const uint64_t end = wide ? value_at<uint64_t>(bytes, at) : value_at<uint32_t>(bytes, at);
        if (end == 0) return;
        if (end < at + record || end > bytes.size())
            fail(FROND_RESULT_FILE_FORMAT,
                 "the file is cut off or damaged: the record at byte %zu ends at %llu, but there are %zu bytes", at,
                 (unsigned long long)end, bytes.size());
        at = size_t(end);
    }
}

static void check_text(const std::string& bytes) {
    if (bytes.find("FBXHeaderExtension") == std::string::npos)
        fail(FROND_RESULT_FILE_FORMAT, "there is no FBX header in the file");
    long depth = 0, line = 1;
    bool in_text = false, in_comment = false;
    for (char letter : bytes) {
        if (letter == '\n') {
            ++line;
            in_comment = false;
        }
        if (in_comment) continue;
        if (letter == '"') in_text = !in_text;
        if (in_text) continue;
        if (letter == ';') in_comment = true;
        if (letter == '{') ++depth;
        if (letter == '}' && --depth < 0)
            fail(FROND_RESULT_FILE_FORMAT, "line %ld: a brace closes that was never opened", line);
    }
    if (depth > 0 || in_text)
        fail(FROND_RESULT_FILE_FORMAT, "the file is cut off at line %ld: %ld braces are open", line, depth);
}

void check_fbx(const MeshFile& file) {
    if (file.bytes.compare(0, 18, "Kaydara FBX Binary") == 0)
        check_binary(file.bytes);
    else
        check_text(file.bytes);
}

}  // namespace frond
