// Registry: which objects are alive, so that null and destroyed pointers from outside are recognised, never followed.
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
    // True if it was there.
    bool remove(const Object* object) {
        std::lock_guard<std::mutex> lock(mutex_);
        return objects_.erase(object) > 0;
    }
    bool holds(const Object* object) {
        std::lock_guard<std::mutex> lock(mutex_);
        return objects_.count(object) > 0;
    }

    // That of a kind of object; never destroyed, since a host may destroy objects while it exits.
    static Registry& instance() {
        static Registry& registry = *new Registry;
        return registry;
    }

private:
    std::mutex mutex_;
    std::unordered_set<const Object*> objects_;
};

}  // namespace picture
