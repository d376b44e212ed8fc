// Host: a Bullet world of any of the six kinds, owned by the program as a game would.
#pragma once

#include <memory>
#include <string>

#include "frond/frond.h"

namespace frond::programs {

// Makes a Bullet world of a kind, 0 .. HOST_KINDS - 1, and attaches a world of plants to it.
constexpr int HOST_KINDS = 6;
class Host {
public:
    Host(int kind, const frond_world_def& def, frond_world* out);
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    ~Host();  // call frond_world_destroy before
    void step(double dt);

private:
    struct Parts;
    std::unique_ptr<Parts> parts;
};

// Returns the same as C++: the headers, and the lines that make the world `host`.
std::string host_headers();
std::string host_lines(int kind);

}  // namespace frond::programs
