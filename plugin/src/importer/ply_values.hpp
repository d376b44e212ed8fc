// A PLY file as its header describes it, and the values that follow.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "importer/importer.hpp"

namespace frond {

enum class PlyType { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE };
constexpr size_t PLY_TYPE_SIZE[] = {1, 1, 2, 2, 4, 4, 4, 8};  // [byte]

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType count_type = PlyType::UINT8, type = PlyType::FLOAT;
};

struct PlyElement {
    std::string name;
    size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    bool is_text = true, is_big_endian = false;
    std::vector<PlyElement> elements;
    std::string texture;  // "comment TextureFile leaf.png"
    size_t data = 0;      // start of the data [byte]
    long line = 1;        // current line; after the header, the first line of the data
};

// Reads the header, which `bytes` begin with. Throws FILE_FORMAT, with the line.
PlyHeader read_ply_header(const std::string& bytes);
// Rejects counts that cannot fit into the file before memory is allocated for them.
void check_ply_counts(const PlyHeader& header, const std::string& bytes);

// Where the next value is.
struct PlyCursor {
    const std::string& bytes;
    size_t at;
    long line;
    bool is_text, is_big_endian;
};

// Read the next value, or list of values, of an element's entry `index`. Throw FILE_FORMAT where the file ends, or is
// none of numbers.
double read_ply_value(PlyCursor& cursor, PlyType type, const PlyElement& element, size_t index);
void read_ply_list(PlyCursor& cursor, const PlyProperty& property, const PlyElement& element, size_t index,
                   std::vector<double>& values);

}  // namespace frond
