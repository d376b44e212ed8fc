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
// Throws FILE_FORMAT unless indices, sizes and numbers are such as plants can be made of.
void check_cooked(const Model& model);
// Returns whether a model passes these checks, as each that is built has to.
bool is_whole(const Model& model);
// Throws FILE_FORMAT for a damaged model, in words for the reader.
[[noreturn]] void fail_cooked(const std::string& what);

}  // namespace frond
