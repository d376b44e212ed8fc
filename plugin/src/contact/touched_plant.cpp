// In: attachments of a plant whose step is solved. Out: compliances between them, each found once.
#include "contact/touched_plant.hpp"

#include "core/assert.hpp"

namespace frond {

static bool are_one(const Attachment& a, const Attachment& b) {
    return a.count == b.count && a.turns == b.turns && a.node == b.node && a.weight == b.weight && a.arm == b.arm;
}

int find_touch(TouchedPlant& touched, Plant& plant, const Attachment& attachment) {
    for (size_t i = 0; i < touched.at.size(); i++)
        if (are_one(touched.at[i], attachment)) return int(i);
    NodeCompliance compliance;
    if (!find_compliance(plant, attachment, compliance)) return -1;
    touched.at.push_back(attachment);
    touched.compliances.push_back(std::move(compliance));
    touched.known.emplace_back();
    return int(touched.at.size()) - 1;
}

const std::vector<Mat3>& compliances_to(TouchedPlant& touched, size_t by) {
    FROND_ASSERT(by < touched.known.size());
    std::vector<Mat3>& found = touched.known[by];
    const size_t before = found.size();
    found.resize(touched.at.size());
    // Where that of `by` to the other touch is known, it is transposed, as A^-1 is symmetric.
    std::vector<const NodeCompliance*> asked;
    std::vector<size_t> places;
    for (size_t i = before; i < found.size(); i++) {
        if (i != by && touched.known[i].size() > by) {
            found[i] = touched.known[i][by].transpose();
            continue;
        }
        asked.push_back(&touched.compliances[i]);
        places.push_back(i);
    }
    if (asked.empty()) return found;
    std::vector<Mat3> blocks(asked.size(), Mat3::Zero());
    add_compliances(asked, touched.compliances[by], touched.spread, blocks);
    for (size_t i = 0; i < places.size(); i++) found[places[i]] = blocks[i];
    return found;
}

}  // namespace frond
