// In: a plant whose pins were moved. Out: the plant translated with them, if they were put somewhere else altogether.
//
// No step of elastic mechanics leads there: the plant would be rewound in every step and stay behind for ever.
#include "plant/guard.hpp"
#include "plant/plant.hpp"

namespace frond {

bool jump_with_pins(Plant& plant, double least) {
    Motion& motion = plant.state.motion;
    Vec3 sum = Vec3::Zero();
    double count = 0;
    const auto add = [&](const Vec3& way) {
        sum += way;
        count++;
    };
    const int next = plant.follow ? 2 : 1, pinned_count = int(motion.pinned.size());
    for (int i = next_pinned(motion, 0); i < pinned_count; i = next_pinned(motion, i + 1))
        if (i % next == 0) add(point(motion.pin_target, i) - point(motion.x, i));
    for (const Spring& spring : plant.input.pin_springs)
        add(spring.target - attachment_place(spring.attachment, motion.x));
    if (count == 0 || !(sum.norm() > least * double(plant.size) * count)) return false;
    const Vec3 way = sum / count;
    for (int i = 0; i < motion.x.size() / 3; i += next) point(motion.x, i) += way;
    motion.history.valid = false;
    plant.step.x_good = motion.x;
    update_chain(plant);
    return true;
}

}  // namespace frond
