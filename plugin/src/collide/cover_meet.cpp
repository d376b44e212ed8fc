// Finds regions that meet: covers of bodies come in, regions whose capsules are near another's go out. Boxes of the
// capsules are sorted along one axis and swept (Baraff 1992, "Dynamic Simulation of Non-penetrating Rigid Bodies"),
// then the capsules are tested.
#include <algorithm>

#include "collide/cover.hpp"

namespace frond {

struct CoverBox {
    Vec3 lower, upper;
    int body, piece;
};

static CoverBox box_of(const Capsule& capsule, double margin, int body, int piece) {
    const Vec3 around = Vec3::Constant(capsule.radius + margin);
    return {capsule.begin.cwiseMin(capsule.end) - around, capsule.begin.cwiseMax(capsule.end) + around, body, piece};
}

static bool boxes_meet(const CoverBox& a, const CoverBox& b) {
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

// Gathers boxes of capsules that overlap the box of another body, and all boxes of bodies that collide with themselves.
static std::vector<CoverBox> gather_boxes(const std::vector<CoveredBody>& bodies, double half_margin) {
    std::vector<CoverBox> wholes, boxes;
    for (size_t b = 0; b < bodies.size(); ++b) {
        CoverBox whole = {Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY), int(b), 0};
        for (const Capsule& capsule : *bodies[b].capsules) {
            const CoverBox box = box_of(capsule, half_margin, int(b), 0);
            whole.lower = whole.lower.cwiseMin(box.lower);
            whole.upper = whole.upper.cwiseMax(box.upper);
        }
        wholes.push_back(whole);
    }
    for (size_t b = 0; b < bodies.size(); ++b)
        for (int piece = 0; piece < bodies[b].collider->piece_count; ++piece) {
            const CoverBox box = box_of((*bodies[b].capsules)[size_t(piece)], half_margin, int(b), piece);
            bool wanted = bodies[b].with_itself;
            for (const CoverBox& whole : wholes) wanted = wanted || (whole.body != int(b) && boxes_meet(box, whole));
            if (wanted) boxes.push_back(box);
        }
    return boxes;
}

std::vector<std::vector<uint8_t>> find_meeting_pieces(const std::vector<CoveredBody>& bodies, double margin) {
    std::vector<CoverBox> boxes = gather_boxes(bodies, 0.5 * margin);
    std::vector<std::vector<uint8_t>> pieces(bodies.size());
    const auto takes_part = [&](const CoverBox& box) {
        std::vector<uint8_t>& list = pieces[size_t(box.body)];
        list.resize(size_t(bodies[size_t(box.body)].collider->piece_count), 0);
        list[size_t(box.piece)] = 1;
    };

    // Sweep along the axis on which they are spread most.
    Vec3 lower = Vec3::Constant(INFINITY), upper = Vec3::Constant(-INFINITY);
    for (const CoverBox& box : boxes) {
        lower = lower.cwiseMin(box.lower);
        upper = upper.cwiseMax(box.upper);
    }
    int axis;
    (upper - lower).maxCoeff(&axis);
    std::sort(boxes.begin(), boxes.end(),
              [axis](const CoverBox& a, const CoverBox& b) { return a.lower[axis] < b.lower[axis]; });
    for (size_t i = 0; i < boxes.size(); ++i)
        for (size_t k = i + 1; k < boxes.size() && boxes[k].lower[axis] <= boxes[i].upper[axis]; ++k) {
            const CoverBox &a = boxes[i], &b = boxes[k];
            if (!boxes_meet(a, b)) continue;
            const CoveredBody &of_a = bodies[size_t(a.body)], &of_b = bodies[size_t(b.body)];
            if (a.body == b.body && (!of_a.with_itself || of_a.collider->are_near(a.piece, b.piece))) continue;
            if (gap_between((*of_a.capsules)[size_t(a.piece)], (*of_b.capsules)[size_t(b.piece)]).distance > margin)
                continue;
            takes_part(a);
            takes_part(b);
        }
    return pieces;
}

}  // namespace frond
