// Attachments without rotating arms, for a batch of plants.
#pragma once

#include "core/lane_vectors.hpp"
#include "mechanics/attachment.hpp"

namespace frond {

// Returns the weighted sum of the nodes' values, as attachment_place() and attachment_velocity() do.
template <class S>
FROND_INLINE Lanes3<S> attachment_sum(const Attachment& attachment, const double* of_nodes) {
    Lanes3<S> sum = {};
    for (size_t k = 0; k < size_t(attachment.count); ++k)
        sum = sum + constant<S>(attachment.weight[k]) * load3<S>(of_nodes, 3 * attachment.node[k]);
    return sum;
}

}  // namespace frond
