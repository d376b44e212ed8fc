#include "world/archive.hpp"

#include <cstring>

#include "core/error.hpp"

namespace frond {

void Archive::copy(void* value, size_t size) {
    if (size == 0) return;
    if (!is_reading) {
        const auto* bytes = static_cast<const uint8_t*>(value);
        out.insert(out.end(), bytes, bytes + size);
        return;
    }
    if (size > left)
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot ends too early; pass all bytes that frond_world_save wrote");
    std::memcpy(value, in, size);
    in += size;
    left -= size;
}

void Archive::check_row(int row, int rows) {
    if (row < 0 || row >= rows)
        fail(FROND_RESULT_FILE_FORMAT, "the snapshot contains an unknown choice; it is damaged");
}

size_t Archive::count(size_t written, size_t least) {
    uint64_t number = written;
    (*this)(number);
    if (is_reading && number > left / least)
        fail(FROND_RESULT_FILE_FORMAT,
             "the snapshot names more than it holds; pass the bytes that frond_world_save wrote");
    return size_t(number);
}

uint64_t checksum_of(const uint8_t* bytes, size_t count) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

}  // namespace frond
