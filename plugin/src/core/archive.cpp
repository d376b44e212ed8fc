#include "core/archive.hpp"

#include <algorithm>
#include <cstring>

#include "core/error.hpp"

namespace frond {

static bool is_little_endian() {
    const uint16_t one = 1;
    uint8_t first;
    std::memcpy(&first, &one, 1);
    return first == 1;
}

void reverse_each(uint8_t* bytes, size_t each, size_t count) {
    for (size_t i = 0; i < count; i++) std::reverse(bytes + i * each, bytes + (i + 1) * each);
}

void Archive::copy(void* values, size_t each, size_t count, char kind) {
    if (mode == Mode::DESCRIBE) {
        for (size_t i = 0; i < count; i++) out.insert(out.end(), {uint8_t(kind), uint8_t('0' + each)});
        return;
    }
    const size_t size = each * count;
    if (size == 0) return;
    auto* bytes = static_cast<uint8_t*>(values);
    if (mode == Mode::WRITE) {
        out.insert(out.end(), bytes, bytes + size);
        if (!is_little_endian()) reverse_each(out.data() + out.size() - size, each, count);
        return;
    }
    if (size > left) fail(FROND_RESULT_FILE_FORMAT, "%s ends too early; %s", words.what, words.remedy);
    std::memcpy(bytes, in, size);
    if (!is_little_endian()) reverse_each(bytes, each, count);
    in += size;
    left -= size;
}

void Archive::check_row(int row, int rows) {
    if (row < 0 || row >= rows)
        fail(FROND_RESULT_FILE_FORMAT, "%s contains an unknown choice and is damaged; %s", words.what, words.remedy);
}

size_t Archive::list_begins(size_t written, size_t least) {
    if (mode == Mode::DESCRIBE) {
        out.push_back('[');
        return 0;
    }
    uint64_t number = written;
    numbers(&number, 1);
    if (is_reading() && number > left / least)
        fail(FROND_RESULT_FILE_FORMAT, "%s names more than it holds; %s", words.what, words.remedy);
    return size_t(number);
}

void Archive::list_ends() {
    if (mode == Mode::DESCRIBE) out.push_back(']');
}

uint64_t checksum_of(const uint8_t* bytes, size_t count) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < count; i++) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

uint64_t checksum_by_words(const uint8_t* bytes, size_t count) {
    uint64_t hash = 0xcbf29ce484222325u ^ count;
    for (size_t at = 0; at < count; at += 8) {
        uint8_t word[8] = {};
        std::memcpy(word, bytes + at, std::min<size_t>(8, count - at));
        uint64_t number = 0;
        for (int i = 0; i < 8; i++) number |= uint64_t(word[i]) << 8 * i;
        hash = (hash ^ number) * 0x100000001b3u;
        hash ^= hash >> 29;
    }
    return hash;
}

}  // namespace frond
