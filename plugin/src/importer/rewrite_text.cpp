// Rewrites OBJ and Collada text for assimp 5.2, which misreads some common variants. In: the file. Out: the text to
// read instead; empty if the file needs no change.
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/log.hpp"
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

static bool is_vertex(const std::string& bytes, size_t begin) {
    return bytes[begin] == 'v' && begin + 1 < bytes.size() && is_blank(bytes[begin + 1]);
}

// Returns what to subtract from the vertices of an OBJ file so that single precision, in which assimp reads them, keeps
// their details; zero along axes on which they are near enough to the origin.
static Vec3 far_origin(const std::string& bytes) {
    constexpr double ROUNDING = 6e-8, FINE = 1e-6, LARGEST = 1e9;  // of a coordinate; of the plant's size; [units]
    Eigen::AlignedBox3d box;
    for (size_t begin = 0; begin < bytes.size();) {
        if (is_vertex(bytes, begin)) {
            char* at = const_cast<char*>(bytes.c_str()) + begin + 2;
            Vec3 place;
            for (int k = 0; k < 3; ++k) place[k] = strtod(at, &at);
            if (place.cwiseAbs().maxCoeff() < LARGEST) box.extend(place);
        }
        begin = std::min(bytes.find('\n', begin), bytes.size()) + 1;
    }
    Vec3 origin = Vec3::Zero();
    for (int k = 0; k < 3 && !box.isEmpty(); ++k)
        if (ROUNDING * std::max(-box.min()[k], box.max()[k]) > FINE * box.diagonal().norm())
            origin[k] = box.center()[k];
    return origin;
}

// Rewrites the lines of an OBJ file's vertices relative to an origin.
static std::string move_vertices(const std::string& bytes, const Vec3& origin) {
    std::string out;
    out.reserve(bytes.size());
    for (size_t begin = 0; begin < bytes.size();) {
        const size_t end = std::min(bytes.find('\n', begin), bytes.size());
        const std::vector<size_t> words =
            is_vertex(bytes, begin) ? find_words(bytes, begin, end) : std::vector<size_t>();
        if (words.size() >= 5) {
            char numbers[100];
            const auto number = [&](int k) {
                return strtod(bytes.c_str() + words[size_t(k) + 1], nullptr) - origin[k];
            };
            snprintf(numbers, sizeof numbers, "v %.9g %.9g %.9g ", number(0), number(1), number(2));
            out += numbers + bytes.substr(words[4], end - words[4]);
        } else {
            out.append(bytes, begin, end - begin);
        }
        out += '\n';
        begin = end + 1;
    }
    return out;
}

std::string rewrite_obj(const MeshFile& file) {
    const Vec3 origin = far_origin(file.bytes);
    if (!origin.isZero(0)) {
        warn("the plant is %.3g units from its origin and is read relative to its own middle", origin.norm());
        MeshFile near = file;
        near.bytes = move_vertices(file.bytes, origin);
        const std::string rewritten = rewrite_obj(near);
        return rewritten.empty() ? near.bytes : rewritten;
    }
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
