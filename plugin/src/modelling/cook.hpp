// Cook: a model as bytes, with all that was built for it, so that a game need not build it again.
#pragma once

#include <memory>

#include "core/archive.hpp"
#include "model/model.hpp"

namespace frond {

// Writes a model; the same one gives the same bytes, but for rest shapes that were found in between.
std::vector<uint8_t> cook(const Model& model);
// Reads what cook() wrote. Throws FILE_FORMAT for anything else, also for bytes with a right checksum that describe no
// plant.
std::shared_ptr<const Model> model_from_cooked(const uint8_t* bytes, size_t count);

// Returns whether a file begins as cooked ones do.
bool is_cooked(const std::string& path);
std::shared_ptr<const Model> load_cooked(const std::string& path);

// Visits all that is kept of a model.
void visit(Archive& archive, Model& model);
// Returns what keeps plants from being made of a model: an index, a size or a number that is out of range. Empty: none.
std::string find_fault(const Model& model);
// Throws BAD_GEOMETRY for a model with a fault.
void refuse_faults(const Model& model);
// Throws FILE_FORMAT for a damaged model, in words for the reader.
[[noreturn]] void fail_cooked(const std::string& what);

}  // namespace frond
