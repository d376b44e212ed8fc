// TouchedPlant: where a plant is touched in a step, and its compliances there. They are found on request, and kept for
// all responses of the step as long as its factor stays.
#pragma once

#include "plant/touch.hpp"

namespace frond {

struct TouchedPlant {
    std::vector<Attachment> at;
    std::vector<NodeCompliance> compliances;  // one per attachment
    // Compliances of touches to one of them, of as many of the first ones as there were when it was last asked for.
    std::vector<std::vector<Mat3>> known;
    Columns3 spread;  // scratch
};

// Returns the index of the touch at an attachment, which is added if it is new; -1 if the plant has no compliance.
int find_touch(TouchedPlant& touched, Plant& plant, const Attachment& attachment);
// Returns the compliances of all touches to touch `by`.
const std::vector<Mat3>& compliances_to(TouchedPlant& touched, size_t by);

}  // namespace frond
