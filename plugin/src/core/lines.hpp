// Memory aligned to cache lines: loads and stores of the widest lanes take twice as long where they cross a line.
#pragma once

#include <new>
#include <vector>

namespace frond {

constexpr std::size_t LINE = 64;  // [bytes]

// Allocator of memory that begins at a cache line.
template <class T>
struct InLines {
    using value_type = T;
    InLines() = default;
    template <class U>
    InLines(const InLines<U>&) {}
    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(LINE)));
    }
    void deallocate(T* from, std::size_t) { ::operator delete(from, std::align_val_t(LINE)); }
    template <class U>
    bool operator==(const InLines<U>&) const {
        return true;
    }
    template <class U>
    bool operator!=(const InLines<U>&) const {
        return false;
    }
};
using NumbersInLines = std::vector<double, InLines<double>>;

// Resizes to `count` numbers: old ones stay, new ones are zero. Memory is kept, since freeing and allocating it again
// takes longer than a step.
inline void make_room(NumbersInLines& numbers, std::size_t count) {
    numbers.resize(count);
}

}  // namespace frond
