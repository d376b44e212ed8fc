// Reads Gmsh files of versions 2.2 and 4.1, text and binary: tetrahedra of any order, of which the four corners are
// kept; the names of physical volumes become regions. Follows the file format chapter of the Gmsh manual.
#include <map>
#include <unordered_map>

#include "core/error.hpp"
#include "core/log.hpp"
#include "io/tet_file.hpp"

namespace frond {

struct GmshReading {
    TetMesh mesh;
    std::unordered_map<int64_t, int> node_index;
    std::map<int64_t, std::string> physical_names;  // names of volumes, by tag
    std::map<int64_t, int64_t> volume_physical;     // version 4: volume -> first physical tag
    std::vector<std::array<int64_t, 4>> corners;    // corners of the tets, by node tag
    size_t other_volumes = 0;                       // volume elements other than tets
    bool is_binary = false, is_version_4 = false, is_swapped = false;
};

// Returns the number of nodes of an element type of Gmsh; 0 if unknown.
static int node_count_of(int64_t type) {
    static const int COUNTS[] = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
    if (type >= 1 && type <= 31) return COUNTS[type];
    return type == 92 ? 64 : type == 93 ? 125 : 0;
}

static bool is_tet(int64_t type) {
    return type == 4 || type == 11 || (type >= 29 && type <= 31);
}

// Returns whether a type is a hexahedron, prism or pyramid of any order.
static bool is_other_volume(int64_t type) {
    return (type >= 5 && type <= 7) || (type >= 12 && type <= 14) || (type >= 17 && type <= 19) || type == 92 ||
           type == 93;
}

// The text between a section's name line and its end is binary if the file is.
static void begin_numbers(TetFile& file, const GmshReading& reading) {
    file.is_binary = reading.is_binary;
    file.is_swapped = reading.is_swapped;
}

static void read_format(TetFile& file, GmshReading& reading) {
    const double version = read_real(file);
    const int64_t type = read_whole(file), size = read_whole(file);
    if (version != 2.2 && version != 4.1 && version != 2.0 && version != 2.1)
        fail_at(file, text_of("the version is %g; 2.2 and 4.1 are read", version));
    reading.is_version_4 = version == 4.1;
    reading.is_binary = type == 1;
    if (size != 8) fail_at(file, "numbers of 8 bytes are read only");
    if (!reading.is_binary) return;
    skip_line_end(file);
    file.is_binary = true;
    const int64_t one = read_whole(file);
    file.is_binary = false;
    if (one != 1 && one != 16777216) fail_at(file, "the byte order cannot be determined");
    reading.is_swapped = one != 1;
}

static void read_names(TetFile& file, GmshReading& reading) {
    const size_t count = read_count(file, read_whole(file), 2, "names");
    for (size_t i = 0; i < count; ++i) {
        const int64_t dimension = read_whole(file), tag = read_whole(file);
        const std::string line = read_line(file);
        const size_t begin = line.find('"'), end = line.rfind('"');
        if (begin == std::string::npos || end <= begin) fail_at(file, "the name of a group must stand in quotes");
        if (dimension == 3) reading.physical_names[tag] = line.substr(begin + 1, end - begin - 1);
    }
}

static void add_node(TetFile& file, GmshReading& reading, int64_t tag, const Vec3& position) {
    if (!position.allFinite()) fail_at(file, text_of("node %lld is not finite", (long long)tag));
    if (!reading.node_index.emplace(tag, int(reading.mesh.nodes.size())).second)
        fail_at(file, text_of("node %lld is given twice", (long long)tag));
    reading.mesh.nodes.push_back(position);
}

static Vec3 read_position(TetFile& file) {
    Vec3 position;
    for (int axis = 0; axis < 3; ++axis) position[axis] = read_real(file);
    return position;
}

static void add_tet(TetFile& file, GmshReading& reading, const std::array<int64_t, 4>& corners,
                    const std::string& region) {
    if (reading.corners.size() >= 5000000) fail_at(file, "there are more than 5 million tetrahedra");
    reading.corners.push_back(corners);
    const int index = region_index(reading.mesh, region);
    reading.mesh.tet_region.push_back(index);
}

static std::string region_name(const GmshReading& reading, int64_t physical, int64_t volume) {
    const auto named = reading.physical_names.find(physical);
    if (named != reading.physical_names.end()) return named->second;
    if (physical != 0) return "region_" + std::to_string(physical);
    return volume != 0 ? "volume_" + std::to_string(volume) : "plant";
}

// Reads the nodes of one element; its corners are the first four.
static std::array<int64_t, 4> read_corners(TetFile& file, int node_count, bool is_long) {
    std::array<int64_t, 4> corners = {0, 0, 0, 0};
    for (int k = 0; k < node_count; ++k) {
        const int64_t node = is_long ? read_long(file) : read_whole(file);
        if (k < 4) corners[size_t(k)] = node;
    }
    return corners;
}

// ---- version 2 ----

static void read_nodes_2(TetFile& file, GmshReading& reading) {
    const size_t count = read_count(file, read_whole(file), 28, "nodes");
    skip_line_end(file);
    begin_numbers(file, reading);
    for (size_t i = 0; i < count; ++i) {
        const int64_t tag = read_whole(file);
        add_node(file, reading, tag, read_position(file));
    }
    file.is_binary = false;
}

static void read_element_2(TetFile& file, GmshReading& reading, int64_t type, int64_t tag_count) {
    const int node_count = node_count_of(type);
    if (node_count == 0) fail_at(file, text_of("the element type %lld is unknown", (long long)type));
    if (tag_count < 0 || tag_count > 1000) fail_at(file, text_of("an element has %lld tags", (long long)tag_count));
    int64_t physical = 0, volume = 0;
    for (int64_t k = 0; k < tag_count; ++k) {
        const int64_t tag = read_whole(file);
        if (k == 0) physical = tag;
        if (k == 1) volume = tag;
    }
    const std::array<int64_t, 4> corners = read_corners(file, node_count, false);
    if (is_tet(type)) add_tet(file, reading, corners, region_name(reading, physical, volume));
    if (is_other_volume(type)) ++reading.other_volumes;
}

static void read_elements_2(TetFile& file, GmshReading& reading) {
    const size_t count = read_count(file, read_whole(file), 8, "elements");
    skip_line_end(file);
    begin_numbers(file, reading);
    for (size_t i = 0; i < count;) {
        if (!reading.is_binary) {
            read_whole(file);
            const int64_t type = read_whole(file), tag_count = read_whole(file);
            read_element_2(file, reading, type, tag_count);
            ++i;
            continue;
        }
        // Binary elements come in runs of one type.
        const int64_t type = read_whole(file), run = read_whole(file), tag_count = read_whole(file);
        if (run < 1 || size_t(run) > count - i) fail_at(file, text_of("a run of %lld elements", (long long)run));
        for (int64_t k = 0; k < run; ++k) {
            read_whole(file);
            read_element_2(file, reading, type, tag_count);
        }
        i += size_t(run);
    }
    file.is_binary = false;
}

// ---- version 4 ----

static void read_entities(TetFile& file, GmshReading& reading) {
    begin_numbers(file, reading);
    size_t counts[4];
    for (size_t& count : counts) count = read_count(file, read_long(file), 4, "entities");
    for (int dimension = 0; dimension < 4; ++dimension)
        for (size_t i = 0; i < counts[dimension]; ++i) {
            const int64_t tag = read_whole(file);
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) read_real(file);
            const size_t physical_count = read_count(file, read_long(file), 4, "physical tags");
            for (size_t k = 0; k < physical_count; ++k) {
                const int64_t physical = read_whole(file);
                if (k == 0 && dimension == 3) reading.volume_physical[tag] = physical;
            }
            if (dimension == 0) continue;
            const size_t border_count = read_count(file, read_long(file), 4, "bounding entities");
            for (size_t k = 0; k < border_count; ++k) read_whole(file);
        }
    file.is_binary = false;
}

static void read_nodes_4(TetFile& file, GmshReading& reading) {
    begin_numbers(file, reading);
    const size_t block_count = read_count(file, read_long(file), 20, "blocks of nodes");
    for (int k = 0; k < 3; ++k) read_long(file);
    for (size_t b = 0; b < block_count; ++b) {
        const int64_t dimension = read_whole(file);
        read_whole(file);
        const bool is_parametric = read_whole(file) != 0;
        const size_t count = read_count(file, read_long(file), 32, "nodes");
        if (dimension < 0 || dimension > 3) fail_at(file, "an entity must have 0 to 3 dimensions");
        std::vector<int64_t> tags;
        for (size_t i = 0; i < count; ++i) tags.push_back(read_long(file));
        for (size_t i = 0; i < count; ++i) {
            add_node(file, reading, tags[i], read_position(file));
            for (int64_t k = 0; is_parametric && k < dimension; ++k) read_real(file);
        }
    }
    file.is_binary = false;
}

static void read_elements_4(TetFile& file, GmshReading& reading) {
    begin_numbers(file, reading);
    const size_t block_count = read_count(file, read_long(file), 20, "blocks of elements");
    for (int k = 0; k < 3; ++k) read_long(file);
    for (size_t b = 0; b < block_count; ++b) {
        read_whole(file);
        const int64_t volume = read_whole(file), type = read_whole(file);
        const int node_count = node_count_of(type);
        if (node_count == 0) fail_at(file, text_of("the element type %lld is unknown", (long long)type));
        const size_t count = read_count(file, read_long(file), 16, "elements");
        const auto physical = reading.volume_physical.find(volume);
        const std::string region =
            region_name(reading, physical == reading.volume_physical.end() ? 0 : physical->second, volume);
        for (size_t i = 0; i < count; ++i) {
            read_long(file);
            const std::array<int64_t, 4> corners = read_corners(file, node_count, true);
            if (is_tet(type)) add_tet(file, reading, corners, region);
            if (is_other_volume(type)) ++reading.other_volumes;
        }
    }
    file.is_binary = false;
}

// ---- both ----

static void skip_section(TetFile& file, const std::string& end) {
    const size_t found = file.bytes.find(end, file.at);
    if (found == std::string::npos) fail_at(file, "the file is cut off: there is no " + end);
    for (; file.at < found; ++file.at) file.line += file.bytes[file.at] == '\n';
}

static void read_section(TetFile& file, GmshReading& reading, const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    if (section == "$MeshFormat")
        read_format(file, reading);
    else if (section == "$PhysicalNames")
        read_names(file, reading);
    else if (section == "$Entities" && reading.is_version_4)
        read_entities(file, reading);
    else if (section == "$Nodes")
        reading.is_version_4 ? read_nodes_4(file, reading) : read_nodes_2(file, reading);
    else if (section == "$Elements")
        reading.is_version_4 ? read_elements_4(file, reading) : read_elements_2(file, reading);
    else
        skip_section(file, end);
    const std::string word = read_word(file);
    if (word != end) fail_at(file, "\"" + word.substr(0, 40) + "\" stands where " + end + " should");
}

// Replaces node tags by indices.
static void join_tets(TetFile& file, GmshReading& reading) {
    for (size_t t = 0; t < reading.corners.size(); ++t) {
        Tet tet;
        for (size_t k = 0; k < 4; ++k) {
            const auto node = reading.node_index.find(reading.corners[t][k]);
            if (node == reading.node_index.end())
                fail(FROND_RESULT_FILE_FORMAT, "%s: tetrahedron %zu refers to node %lld, which is not in the file",
                     file.name.c_str(), t, (long long)reading.corners[t][k]);
            tet[k] = node->second;
        }
        reading.mesh.tets.push_back(tet);
    }
}

TetMesh read_gmsh(TetFile& file) {
    GmshReading reading;
    if (file.bytes.compare(0, 11, "$MeshFormat") != 0) fail_at(file, "a Gmsh file begins with $MeshFormat");
    while (!is_at_end(file)) {
        while (!is_at_end(file) && uint8_t(file.bytes[file.at]) <= 32) file.line += file.bytes[file.at++] == '\n';
        if (is_at_end(file)) break;
        const std::string section = read_word(file);
        if (section[0] != '$') fail_at(file, "\"" + section.substr(0, 40) + "\" stands where a section should begin");
        skip_line_end(file);
        read_section(file, reading, section);
    }
    join_tets(file, reading);
    if (reading.other_volumes > 0)
        warn("%s: %zu elements that are not tetrahedra are left out", file.name.c_str(), reading.other_volumes);
    return std::move(reading.mesh);
}

}  // namespace frond
