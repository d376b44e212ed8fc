// Path: where a point of a moving plant is at common times, compared with a reference that is refined in time until it
// no longer changes.
#pragma once

#include "study/trial.hpp"

namespace frond::study {

using Start = std::function<void(Trial& trial)>;        // puts a fresh trial into the state it starts from
using Where = std::function<frond_vec3(Trial& trial)>;  // the point that is followed

// Runs the setup and returns the root mean square distance from the reference over the largest distance of the
// reference from where it starts. The reference is made once for each mechanics and resolution, and how well it
// converged is noted.
Outcome compare_path(const ModelPtr& model, const Setup& setup, const Start& start, const Where& where, double duration,
                     Session& session);

}  // namespace frond::study
