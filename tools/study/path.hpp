// Path: positions of a point of a moving plant at common times, compared with a reference that is refined in time until
// it no longer changes.
#pragma once

#include "study/trial.hpp"

namespace frond::study {

using Start = std::function<void(Trial& trial)>;        // puts a new trial into its initial state
using Where = std::function<frond_vec3(Trial& trial)>;  // returns the point that is followed

// Runs the setup and returns the RMS distance from the reference over the largest distance of the reference from its
// start. The reference is computed once for each mechanics and resolution, and its convergence is noted.
Outcome compare_path(const ModelPtr& model, const Setup& setup, const Start& start, const Where& where, double duration,
                     Session& session);

}  // namespace frond::study
