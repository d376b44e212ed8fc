// Workspace that calls take in turn, from any thread, so that each does not ask for memory again.
#pragma once
#include <memory>
#include <mutex>
#include <utility>

namespace frond {

// A T for as long as this lives: one that an earlier call gave back, as that left it, or a new one. Threads have none
// of their own, as MinGW frees what is thread_local before it runs the destructors of that.
template <class T>
class Borrowed {
public:
    Borrowed() {
        const std::lock_guard<std::mutex> lock(shelf().mutex);
        item = std::move(shelf().first);
        if (item)
            shelf().first = std::move(item->next);
        else
            item = std::make_unique<Item>();
    }
    ~Borrowed() {
        const std::lock_guard<std::mutex> lock(shelf().mutex);
        item->next = std::move(shelf().first);
        shelf().first = std::move(item);
    }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    T& operator*() { return item->value; }
    T* operator->() { return &item->value; }

private:
    struct Item {
        T value;
        std::unique_ptr<Item> next;
    };
    struct Shelf {
        std::mutex mutex;
        std::unique_ptr<Item> first;
    };
    static Shelf& shelf() {
        static Shelf shelf;
        return shelf;
    }
    std::unique_ptr<Item> item;
};

}  // namespace frond
