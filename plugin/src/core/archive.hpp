// Archive: writes numbers to bytes, or reads them back, by one description of the data: functions visit(Archive&, T&),
// which name the fields of each struct in their order. Bytes are little-endian on every machine.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "core/types.hpp"

namespace frond {

class Archive {
public:
    // What error texts call the bytes, and what they tell the reader to do.
    struct Words {
        const char* what;
        const char* remedy;
    };

    Archive() = default;  // writes
    Archive(const uint8_t* bytes, size_t count, const Words& words)
        : in(bytes), left(count), words(words), mode(Mode::READ) {}
    // Writes no values but a text of the types that are visited, with one element for each list.
    static Archive of_types() {
        Archive archive;
        archive.mode = Mode::DESCRIBE;
        return archive;
    }

    std::vector<uint8_t> out;
    bool is_at_end() const { return left == 0; }

    template <class... Fields>
    void operator()(Fields&... fields) {
        (visit(*this, fields), ...);
    }
    template <class T>
    void one_of(T& value, int values) {
        int32_t number = mode == Mode::READ ? 0 : int32_t(value);
        numbers(&number, 1);
        check_row(number, values);
        value = T(number);
    }
    template <class T>
    void numbers(T* values, size_t count) {
        static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
        // Letters have a sign on some processors only; their bytes are the same.
        constexpr bool has_sign = std::is_signed_v<T> || std::is_same_v<T, char>;
        const char kind = std::is_floating_point_v<T> ? 'f' : has_sign ? 'i' : 'u';
        copy(values, sizeof(T), count, kind);
    }
    bool is_reading() const { return mode == Mode::READ; }

    // Visits a list whose elements are `per_item` numbers each, one behind the other.
    template <class List, class Number>
    void packed(List& list, size_t per_item, Number* (*data)(List&)) {
        const size_t size = list_begins(size_t(list.size()), per_item * sizeof(Number));
        if (is_reading()) list.resize(decltype(list.size())(size));
        numbers(data(list), per_item * (mode == Mode::DESCRIBE ? 1 : size));
        list_ends();
    }
    template <class List>
    void listed(List& list) {
        using Item = typename List::value_type;
        const size_t size = list_begins(list.size(), 1);
        if (is_reading()) list.clear();
        if (mode == Mode::DESCRIBE) {
            Item item = {};
            visit(*this, item);
        }
        for (size_t i = 0; i < size; i++) {
            if (is_reading()) list.emplace_back();
            visit(*this, list[i]);
        }
        list_ends();
    }

private:
    enum class Mode { WRITE, READ, DESCRIBE };

    void copy(void* values, size_t each, size_t count, char kind);
    void check_row(int row, int rows);
    // Writes or reads the number of elements that follow, each of at least `least` bytes.
    size_t list_begins(size_t written, size_t least);
    void list_ends();

    const uint8_t* in = nullptr;
    size_t left = 0;
    Words words = {"", ""};
    Mode mode = Mode::WRITE;
};

template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> visit(Archive& archive, T& value) {
    archive.numbers(&value, 1);
}
// Reads any byte but zero as true.
inline void visit(Archive& archive, bool& value) {
    uint8_t byte = archive.is_reading() ? 0 : value;  // it may not be set yet
    archive.numbers(&byte, 1);
    value = byte != 0;
}
template <class T, int ROWS, int COLUMNS>
void visit(Archive& archive, Eigen::Matrix<T, ROWS, COLUMNS>& matrix) {
    using Matrix = Eigen::Matrix<T, ROWS, COLUMNS>;
    if constexpr (ROWS == Eigen::Dynamic)
        archive.packed<Matrix, T>(matrix, 1, [](Matrix& m) { return m.data(); });
    else
        archive.numbers(matrix.data(), size_t(matrix.size()));
}
template <class T, size_t SIZE>
void visit(Archive& archive, std::array<T, SIZE>& values) {
    for (T& value : values) archive(value);
}

// How many numbers an element of a list consists of, all of one kind and without gaps; 0: it is no such element.
template <class T>
struct Packed {
    using Number = T;
    static constexpr size_t COUNT = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
};
template <class T, size_t SIZE>
struct Packed<std::array<T, SIZE>> {
    using Number = typename Packed<T>::Number;
    static constexpr size_t COUNT = SIZE * Packed<T>::COUNT;
};
template <class T, int ROWS, int COLUMNS>
struct Packed<Eigen::Matrix<T, ROWS, COLUMNS>> {
    using Number = T;
    static constexpr size_t COUNT = ROWS == Eigen::Dynamic ? 0 : size_t(ROWS * COLUMNS);
};

template <class T>
void visit(Archive& archive, std::vector<T>& values) {
    using Number = typename Packed<T>::Number;
    constexpr size_t COUNT = Packed<T>::COUNT;
    if constexpr (COUNT > 0) {
        static_assert(sizeof(T) == COUNT * sizeof(Number));
        archive.packed<std::vector<T>, Number>(
            values, COUNT, [](std::vector<T>& list) { return reinterpret_cast<Number*>(list.data()); });
    } else {
        archive.listed(values);
    }
}
// Reads control letters as blanks: texts end up in messages.
inline void visit(Archive& archive, std::string& text) {
    archive.packed<std::string, char>(text, 1, [](std::string& t) { return t.data(); });
    if (archive.is_reading())
        for (char& letter : text)
            if (uint8_t(letter) < 32) letter = ' ';
}

// Computes the FNV-1a hash of the bytes.
uint64_t checksum_of(const uint8_t* bytes, size_t count);
// Computes a hash by words of eight bytes, several times as quick. No change within one word leaves it as it was.
uint64_t checksum_by_words(const uint8_t* bytes, size_t count);
// Turns the bytes of each of `count` numbers round.
void reverse_each(uint8_t* bytes, size_t each, size_t count);

}  // namespace frond
