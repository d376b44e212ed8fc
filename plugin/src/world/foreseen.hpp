// Foreseen: what a plant does to a link of a multi-body, as it is foreseen for Bullet's next step (link_loads.hpp).
#pragma once

#include <vector>

#include "core/types.hpp"

namespace frond {

// A contact or a bond, by the parts of its impulse.
struct Foreseen {
    // Along the normal; friction and bonds along each axis of the world.
    enum class Kind : uint8_t { normal, friction_x, friction_y, friction_z, bond_x, bond_y, bond_z };
    static constexpr int KIND_COUNT = 7;
    static bool is_friction(Kind kind) { return kind >= Kind::friction_x && kind <= Kind::friction_z; }
    // All impulses of a kind on a link.
    struct Load {
        int link;
        Kind kind;
        bool operator==(const Load& other) const { return link == other.link && kind == other.kind; }
    };
    // Work of an impulse on plants as these give way to a load.
    struct Give {
        Load to;
        double work;  // [J]
    };
    struct Part {
        Kind kind = Kind::normal;
        Vec3 impulse = Vec3::Zero();  // on the plant [N s]
        double work = 0;              // of the impulse, where the link goes on as it may [J]
        std::vector<Give> gives;
    };
    std::vector<Part> parts;    // none: nothing is foreseen
    Vec3 place = Vec3::Zero();  // on the link, in its frame [m]
    double most_friction = 0;   // [N s]
};

}  // namespace frond
