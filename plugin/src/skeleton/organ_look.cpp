// Organ looks. In: colours and textures of parts. Out: what they look like.
#include "skeleton/organ_look.hpp"

#include <algorithm>

namespace frond {

bool is_green(const std::array<float, 4>& color) {
    return color[1] > 1.1f * color[0] && color[1] > 1.3f * color[2];
}

bool is_brown(const std::array<float, 4>& color) {
    return color[0] > color[1] && color[1] >= color[2] && color[0] < 0.35f && color[0] < 4 * color[1];
}

bool is_bright(const std::array<float, 4>& color) {
    const float most = std::max({color[0], color[1], color[2]}), least = std::min({color[0], color[1], color[2]});
    return !is_green(color) && !is_brown(color) && (most - least > 0.15f || least > 0.75f);
}

}  // namespace frond
