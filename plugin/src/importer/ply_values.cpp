#include "importer/ply_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/platform/number_text.hpp"

namespace frond {

static PlyType type_of(const std::string& name, long line) {
    static const char* const NAMES[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                           {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                           {"float", "float32"}, {"double", "float64"}};
    for (int i = 0; i < 8; ++i)
        if (name == NAMES[i][0] || name == NAMES[i][1]) return PlyType(i);
    fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a PLY type", line, name.c_str());
}

static void read_property(std::istringstream& words, PlyHeader& header) {
    if (header.elements.empty())
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: a property stands before any element", header.line);
    PlyProperty property;
    std::string word, other;
    words >> word;
    if (word == "list") {
        property.is_list = true;
        words >> word >> other;
        property.count_type = type_of(word, header.line);
        word = other;
    }
    property.type = type_of(word, header.line);
    if (!(words >> property.name)) fail(FROND_RESULT_FILE_FORMAT, "line %ld: the property has no name", header.line);
    if (property.is_list && property.count_type >= PlyType::FLOAT)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: a list's length must be an integer", header.line);
    if (header.elements.back().properties.size() >= 1000)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: more than 1000 properties", header.line);
    header.elements.back().properties.push_back(property);
}

static void read_format(std::istringstream& words, PlyHeader& header) {
    std::string format;
    words >> format;
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.30s\" is not a PLY format", header.line, format.c_str());
    header.is_text = format == "ascii";
    header.is_big_endian = format == "binary_big_endian";
}

static void read_element(std::istringstream& words, PlyHeader& header) {
    PlyElement element;
    long long count = -1;
    words >> element.name >> count;
    if (count < 0) fail(FROND_RESULT_FILE_FORMAT, "line %ld: the element has no valid count", header.line);
    if (header.elements.size() >= 100) fail(FROND_RESULT_FILE_FORMAT, "line %ld: more than 100 elements", header.line);
    element.count = size_t(count);
    header.elements.push_back(element);
}

PlyHeader read_ply_header(const std::string& bytes) {
    PlyHeader header;
    size_t at = 0;
    for (header.line = 1;; ++header.line) {
        size_t end = bytes.find('\n', at);
        if (end == std::string::npos || end - at > 4096)
            fail(FROND_RESULT_FILE_FORMAT, "line %ld: the header is cut off: there is no \"end_header\"", header.line);
        std::istringstream words(bytes.substr(at, end - at));
        at = end + 1;
        std::string word;
        words >> word;
        if (header.line == 1 && word != "ply") fail(FROND_RESULT_FILE_FORMAT, "line 1: a PLY file begins with \"ply\"");
        if (word == "end_header") break;
        if (word == "format") read_format(words, header);
        if (word == "element") read_element(words, header);
        if (word == "property") read_property(words, header);
        if (word == "comment" && words >> word && word == "TextureFile") {
            std::getline(words >> std::ws, header.texture);
            while (!header.texture.empty() && header.texture.back() == '\r') header.texture.pop_back();
        }
    }
    ++header.line;
    header.data = at;
    return header;
}

void check_ply_counts(const PlyHeader& header, const std::string& bytes) {
    const size_t left = bytes.size() - header.data;
    for (const PlyElement& element : header.elements) {
        size_t smallest = 0;
        for (const PlyProperty& property : element.properties)
            smallest += header.is_text ? 2 : PLY_TYPE_SIZE[int(property.is_list ? property.count_type : property.type)];
        if (smallest > 0 && element.count > (left + 1) / smallest)
            fail(FROND_RESULT_FILE_FORMAT,
                 "the file is cut off: %zu \"%s\" are announced, but only %zu bytes follow the header", element.count,
                 element.name.c_str(), left);
    }
}

[[noreturn]] static void fail_cut(const PlyCursor& cursor, const PlyElement& element, size_t index) {
    if (cursor.is_text)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: the file ends in \"%s\" %zu of %zu", cursor.line,
             element.name.c_str(), index, element.count);
    fail(FROND_RESULT_FILE_FORMAT, "the file is cut off in \"%s\" %zu of %zu", element.name.c_str(), index,
         element.count);
}

static double read_text_value(PlyCursor& cursor, const PlyElement& element, size_t index) {
    const std::string& bytes = cursor.bytes;
    while (cursor.at < bytes.size() && uint8_t(bytes[cursor.at]) <= 32) cursor.line += bytes[cursor.at++] == '\n';
    if (cursor.at >= bytes.size()) fail_cut(cursor, element, index);
    const char *begin = bytes.data() + cursor.at, *end = bytes.data() + bytes.size();
    if (*begin == '+') ++begin;
    double value = 0;
    const auto result = read_number(begin, end, value);
    const bool is_whole = result.ptr == end || uint8_t(*result.ptr) <= 32;
    if (result.ec == std::errc::invalid_argument || !is_whole)
        fail(FROND_RESULT_FILE_FORMAT, "line %ld: \"%.20s\" is not a number", cursor.line,
             std::string(begin, size_t(std::min<ptrdiff_t>(20, end - begin))).c_str());
    cursor.at = size_t(result.ptr - bytes.data());
    return value;
}

template <typename Value>
static double decode(const char* bytes) {
    Value value;
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
}

double read_ply_value(PlyCursor& cursor, PlyType type, const PlyElement& element, size_t index) {
    if (cursor.is_text) return read_text_value(cursor, element, index);
    const size_t size = PLY_TYPE_SIZE[int(type)];
    if (cursor.bytes.size() - cursor.at < size) fail_cut(cursor, element, index);
    char bytes[8];
    for (size_t i = 0; i < size; ++i) bytes[cursor.is_big_endian ? size - 1 - i : i] = cursor.bytes[cursor.at + i];
    cursor.at += size;
    switch (type) {
        case PlyType::INT8:
            return decode<int8_t>(bytes);
        case PlyType::UINT8:
            return decode<uint8_t>(bytes);
        case PlyType::INT16:
            return decode<int16_t>(bytes);
        case PlyType::UINT16:
            return decode<uint16_t>(bytes);
        case PlyType::INT32:
            return decode<int32_t>(bytes);
        case PlyType::UINT32:
            return decode<uint32_t>(bytes);
        case PlyType::FLOAT:
            return decode<float>(bytes);
        case PlyType::DOUBLE:
            return decode<double>(bytes);
    }
    return 0;
}

void read_ply_list(PlyCursor& cursor, const PlyProperty& property, const PlyElement& element, size_t index,
                   std::vector<double>& values) {
    const double count = read_ply_value(cursor, property.count_type, element, index);
    const size_t left = cursor.bytes.size() - cursor.at,
                 smallest = cursor.is_text ? 2 : PLY_TYPE_SIZE[int(property.type)], most = (left + 1) / smallest;
    if (!(count >= 0) || count != std::floor(count) || count > double(most))
        fail(FROND_RESULT_FILE_FORMAT,
             "the file is cut off or damaged: \"%s\" %zu of %zu has a list of %g values, and %zu bytes are left",
             element.name.c_str(), index, element.count, count, left);
    values.clear();
    for (size_t i = 0; i < size_t(count); ++i) values.push_back(read_ply_value(cursor, property.type, element, index));
}

}  // namespace frond
