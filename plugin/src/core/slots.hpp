// Slots: objects behind handles. A handle is kind (8 bits), generation (32) and index + 1 (24), so that a null, stale
// or foreign handle is recognised without touching freed memory.
#pragma once

#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

namespace frond {

template <class T, uint8_t KIND>
class Slots {
public:
    // Returns 0 when all slots are taken.
    uint64_t insert(T value) {
        std::unique_lock<std::shared_mutex> lock(mutex);
        uint32_t index;
        if (!free_slots.empty()) {
            index = free_slots.back();
            free_slots.pop_back();
        } else {
            if (slots.size() >= MAX_COUNT) return 0;
            index = uint32_t(slots.size());
            slots.push_back({});
        }
        slots[index].value = std::move(value);
        slots[index].used = true;
        return uint64_t(KIND) << 56 | uint64_t(slots[index].generation) << 24 | (index + 1);
    }
    // Returns a default T if the handle is unknown.
    T find(uint64_t id) const {
        std::shared_lock<std::shared_mutex> lock(mutex);
        const Slot* slot = slot_of(id);
        return slot ? slot->value : T{};
    }
    // Removes and returns the object; a default T if the handle is unknown.
    T erase(uint64_t id) {
        std::unique_lock<std::shared_mutex> lock(mutex);
        Slot* slot = const_cast<Slot*>(slot_of(id));
        if (!slot) return T{};
        T value = std::exchange(slot->value, T{});
        slot->used = false;
        slot->generation++;
        free_slots.push_back(uint32_t(slot - slots.data()));
        return value;
    }

private:
    static constexpr size_t MAX_COUNT = (1u << 24) - 2;  // what the index in a handle can tell apart
    struct Slot {
        T value{};
        uint32_t generation = 1;
        bool used = false;
    };
    const Slot* slot_of(uint64_t id) const {
        const uint64_t index = (id & 0xffffffu) - 1;
        if (id >> 56 != KIND || index >= slots.size()) return nullptr;
        const Slot& slot = slots[index];
        return slot.used && slot.generation == uint32_t(id >> 24) ? &slot : nullptr;
    }
    mutable std::shared_mutex mutex;
    std::vector<Slot> slots;
    std::vector<uint32_t> free_slots;
};

}  // namespace frond
