// Archive: writes numbers to bytes, or reads them back, by one description of the data.
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "core/types.hpp"

namespace frond {

class Archive {
public:
    Archive() = default;  // writes
    Archive(const uint8_t* bytes, size_t count) : in(bytes), left(count), is_reading(true) {}

    std::vector<uint8_t> out;
    bool is_at_end() const { return left == 0; }

    template <class T>
    std::enable_if_t<std::is_arithmetic_v<T>> operator()(T& value) {
        copy(&value, sizeof value);
    }
    template <class T>
    void one_of(T& value, int values) {
        int32_t number = is_reading ? 0 : int32_t(value);
        copy(&number, sizeof number);
        check_row(number, values);
        value = T(number);
    }
    // Reads any byte but zero as true.
    void operator()(bool& value) {
        uint8_t byte = !is_reading && value;
        copy(&byte, 1);
        value = byte != 0;
    }
    template <class T, int ROWS, int COLUMNS>
    void operator()(Eigen::Matrix<T, ROWS, COLUMNS>& matrix) {
        if constexpr (ROWS == Eigen::Dynamic) {
            const size_t size = count(size_t(matrix.size()), sizeof(T));
            if (is_reading) matrix.resize(Eigen::Index(size));
        }
        copy(matrix.data(), size_t(matrix.size()) * sizeof(T));
    }
    template <class T, size_t SIZE>
    void operator()(std::array<T, SIZE>& values) {
        for (T& value : values) (*this)(value);
    }
    template <class T>
    void operator()(std::vector<T>& values) {
        const size_t size = count(values.size(), 1);
        if (is_reading) values.clear();
        for (size_t i = 0; i < size; i++) {
            if (is_reading) values.emplace_back();
            visit(*this, values[i]);
        }
    }

private:
    void copy(void* value, size_t size);
    void check_row(int row, int rows);
    // Writes or reads the number of elements that follow, each of at least `least` bytes.
    size_t count(size_t written, size_t least);

    const uint8_t* in = nullptr;
    size_t left = 0;
    bool is_reading = false;
};

// Visits plain numbers in lists; other types have overloads of their own.
template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> visit(Archive& archive, T& value) {
    archive(value);
}
inline void visit(Archive& archive, Vec3& value) {
    archive(value);
}

// Computes the FNV-1a hash of the bytes.
uint64_t checksum_of(const uint8_t* bytes, size_t count);

}  // namespace frond
