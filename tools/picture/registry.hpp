// Registry: the set of living objects, by which null and destroyed pointers are recognised, never dereferenced.
#pragma once

#include <mutex>
#include <unordered_set>

namespace picture {

template <class Object>
class Registry {
public:
    void add(const Object* object) {
        std::lock_guard<std::mutex> lock(mutex_);
        objects_.insert(object);
    }
    // Returns whether it was in the set.
    bool remove(const Object* object) {
        std::lock_guard<std::mutex> lock(mutex_);
        return objects_.erase(object) > 0;
    }
    bool holds(const Object* object) {
        std::lock_guard<std::mutex> lock(mutex_);
        return objects_.count(object) > 0;
    }

    // Returns the registry of a kind of object; never destroyed, since a host may destroy objects while it exits.
    static Registry& instance() {
        static Registry& registry = *new Registry;
        return registry;
    }

private:
    std::mutex mutex_;
    std::unordered_set<const Object*> objects_;
};

}  // namespace picture
