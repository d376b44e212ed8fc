// Checks OBJ text: every index of a face must refer to an existing line. Errors name the line.
#include <cstdlib>
#include <cstring>

#include "importer/check.hpp"

namespace frond {

struct ObjCounts {
    long vertices = 0, texture_coordinates = 0, normals = 0, faces = 0;
};

// Cursor over the lines, with continued lines joined; `number` is the number of the first part.
struct ObjLines {
    const std::string& bytes;
    size_t at = 0;
    long next_number = 1, number = 0;
    std::string line;
};

static bool next_line(ObjLines& lines) {
    if (lines.at >= lines.bytes.size()) return false;
    lines.line.clear();
    lines.number = lines.next_number;
    while (lines.at < lines.bytes.size()) {
        size_t end = lines.bytes.find('\n', lines.at);
        if (end == std::string::npos) end = lines.bytes.size();
        lines.line.append(lines.bytes, lines.at, end - lines.at);
        lines.at = end + 1;
        ++lines.next_number;
        if (!lines.line.empty() && lines.line.back() == '\r') lines.line.pop_back();
        if (lines.line.empty() || lines.line.back() != '\\') break;
        lines.line.back() = ' ';
    }
    return true;
}

static bool is_keyword(const char* text, const char* keyword) {
    const size_t length = strlen(keyword);
    return strncmp(text, keyword, length) == 0 && (text[length] == ' ' || text[length] == '\t');
}

static const char* skip_blanks(const char* text) {
    while (*text == ' ' || *text == '\t') ++text;
    return text;
}

static ObjCounts count_lines(const std::string& bytes) {
    ObjCounts counts;
    ObjLines lines{bytes, 0, 1, 0, ""};
    while (next_line(lines)) {
        const char* text = skip_blanks(lines.line.c_str());
        counts.vertices += is_keyword(text, "v");
        counts.texture_coordinates += is_keyword(text, "vt");
        counts.normals += is_keyword(text, "vn");
        counts.faces += is_keyword(text, "f");
    }
    return counts;
}

static void check_index(long index, long seen, long total, const char* what, long line) {
    if (index >= 1 && index <= total) return;
    if (index < 0 && -index <= seen) return;
    fail(FROND_RESULT_FILE_FORMAT, "line %ld: the face refers to %s %ld, but there are %ld", line, what, index, total);
}

// "f 1 2 3", "f 1/2 ...", "f 1//3 ...", "f 1/2/3 ..."
static void check_face(const char* text, long line, const ObjCounts& seen, const ObjCounts& total) {
    int corners = 0;
    for (text = skip_blanks(text + 1); *text && *text != '#'; text = skip_blanks(text)) {
        const char* const names[] = {"vertex", "texture coordinate", "normal"};
        const long totals[] = {total.vertices, total.texture_coordinates, total.normals};
        const long so_far[] = {seen.vertices, seen.texture_coordinates, seen.normals};
        for (int field = 0; field < 3; ++field) {
            char* end;
            const long index = strtol(text, &end, 10);
            if (end == text && (field == 0 || (*text != '/' && *text != ' ' && *text != '\t' && *text)))
                fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a vertex of a face", line, text);
            if (end != text) check_index(index, so_far[field], totals[field], names[field], line);
            text = end;
            if (*text != '/') break;
            ++text;
        }
        if (*text && *text != ' ' && *text != '\t')
            fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a vertex of a face", line, text);
        ++corners;
    }
    if (corners == 0) fail(FROND_RESULT_FILE_FORMAT, "line %ld: the face has no vertices", line);
}

void check_obj(const MeshFile& file) {
    const ObjCounts total = count_lines(file.bytes);
    if (total.vertices == 0) fail(FROND_RESULT_FILE_FORMAT, "there is no vertex (no line \"v x y z\") in the file");
    if (total.faces == 0) fail(FROND_RESULT_FILE_FORMAT, "there is no face (no line \"f 1 2 3\") in the file");
    ObjCounts seen;
    ObjLines lines{file.bytes, 0, 1, 0, ""};
    while (next_line(lines)) {
        const char* text = skip_blanks(lines.line.c_str());
        seen.vertices += is_keyword(text, "v");
        seen.texture_coordinates += is_keyword(text, "vt");
        seen.normals += is_keyword(text, "vn");
        if (is_keyword(text, "f")) check_face(text, lines.number, seen, total);
    }
}

}  // namespace frond
