// Rewrites OBJ and Collada text for assimp 5.2, which misreads some common variants. In: the file. Out: the text to
// read instead; empty if the file needs no change.
#include <cctype>
#include <cstring>

#include "importer/importer.hpp"

namespace frond {

// ---- OBJ ----

static bool is_blank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\r';
}

// Returns where the words of a line begin, followed by the line's end.
static std::vector<size_t> find_words(const std::string& bytes, size_t begin, size_t end) {
    std::vector<size_t> words;
    for (size_t at = begin; at < end; ++at)
        if (!is_blank(bytes[at]) && (at == begin || is_blank(bytes[at - 1]))) words.push_back(at);
    words.push_back(end);
    return words;
}

// Returns how many numbers of a vertex to keep: "v x y z", with a weight, or with a colour; some programs write opacity
// and more after the colour.
static size_t numbers_of_vertex(size_t numbers) {
    return numbers > 6 ? 6 : numbers == 5 ? 3 : numbers;
}

std::string rewrite_obj(const MeshFile& file) {
    const std::string& bytes = file.bytes;
    std::string out;
    size_t copied = 0;
    bool has_library = false;
    for (size_t begin = 0; begin < bytes.size();) {
        size_t end = bytes.find('\n', begin);
        if (end == std::string::npos) end = bytes.size();
        if (bytes.compare(begin, 2, "v ") == 0) {
            const std::vector<size_t> words = find_words(bytes, begin, end);
            const size_t numbers = words.size() - 2, kept = numbers_of_vertex(numbers);
            if (kept != numbers) {
                out.append(bytes, copied, words[kept + 1] - copied);
                copied = end;
            }
        }
        has_library = has_library || bytes.compare(begin, 7, "mtllib ") == 0;
        begin = end + 1;
    }
    const std::string library = file.name.substr(0, file.name.rfind('.')) + ".mtl";
    if (!has_library && !find_beside(file.folder, library).empty())
        out = "mtllib " + library + "\n" + out;
    else if (copied == 0)
        return "";
    return out.append(bytes, copied, std::string::npos);
}

// ---- Collada ----

std::string rewrite_dae(const MeshFile& file) {
    const std::string& bytes = file.bytes;
    std::string out;
    size_t copied = 0;
    for (size_t at = bytes.find('>'); at != std::string::npos; at = bytes.find('>', at + 1)) {
        size_t text = at + 1;
        while (text < bytes.size() && isspace(uint8_t(bytes[text]))) ++text;
        if (text == at + 1 || text == bytes.size() || !strchr("+-.0123456789", bytes[text])) continue;
        out.append(bytes, copied, at + 1 - copied);
        copied = text;
    }
    return copied == 0 ? "" : out.append(bytes, copied, std::string::npos);
}

}  // namespace frond
