// Byte stream: numbers, texts and arrays to bytes and back. Reading checks lengths before it allocates memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "io/urdf.hpp"

namespace frond {

template <typename Value>
void put(std::string& out, const Value& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void put_text(std::string& out, const std::string& text) {
    put(out, uint32_t(text.size()));
    out += text;
}

template <typename Value>
void put_array(std::string& out, const std::vector<Value>& values) {
    put(out, uint32_t(values.size()));
    if (!values.empty()) out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

struct StreamReader {
    const char* at;
    size_t left;
    bool good = true;
};

inline bool take_bytes(StreamReader& in, void* out, size_t count) {
    in.good = in.good && count <= in.left;
    if (!in.good) return false;
    if (count > 0) std::memcpy(out, in.at, count);
    in.at += count;
    in.left -= count;
    return true;
}

template <typename Value>
Value take(StreamReader& in) {
    Value value{};
    take_bytes(in, &value, sizeof value);
    return value;
}

template <typename Array>
void take_array(StreamReader& in, Array& values) {
    const size_t count = take<uint32_t>(in), item = sizeof(values[0]);
    in.good = in.good && count <= in.left / item;
    if (!in.good) return;
    values.resize(count);
    if (count > 0) take_bytes(in, static_cast<void*>(&values[0]), count * item);
}

inline std::string take_text(StreamReader& in) {
    std::string text;
    take_array(in, text);
    for (char& letter : text)
        if (uint8_t(letter) < 32) letter = ' ';
    return text;
}

// Write and read a tree of links, also an empty one. A tree that was read must be checked by what_is_wrong_with().
void put_tree(std::string& out, const UrdfTree& tree);
void take_tree(StreamReader& in, UrdfTree& tree);

}  // namespace frond
