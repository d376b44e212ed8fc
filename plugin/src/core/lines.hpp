// Lines of the processor's memory: where the widest lanes read and write over the end of one, they take twice as long.
#pragma once

#include <new>
#include <vector>

namespace frond {

constexpr std::size_t LINE = 64;  // [bytes]

// Memory that begins with a line.
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

// For so many numbers: as before, then zeros. To give memory back and ask for it again takes longer than a step.
inline void make_room(NumbersInLines& numbers, std::size_t count) {
    numbers.resize(count);
}

}  // namespace frond
