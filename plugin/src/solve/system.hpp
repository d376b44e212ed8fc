// System: data for solving that all plants of one model share. Read-only once made.
#pragma once

#include "solve/block_factor.hpp"
#include "solve/solve.hpp"

namespace frond {

struct System {
    std::shared_ptr<const Model> model;
    const Mechanics* row = nullptr;
    std::unique_ptr<const Elements> elements;
    Masses masses;
    bool damps_alike = true;     // all elements have the same damping ratio
    std::vector<uint8_t> loose;  // one a node: it belongs to no element
    bool is_gone = false;        // all nodes are loose: the whole plant broke off
    double size = 0;             // longest side of the box around the nodes at rest [m]
    BlockPlan plan;
    std::vector<Attachment> chain;  // attachment of each chain node of a cage
};

// Computes y = M v, with the rotary inertia of nodes that rotate, if there are any.
void multiply_mass(const System& system, const std::vector<Mat3>& inertia, const VecX& v, VecX& y);

}  // namespace frond
