// Rosette: a herb whose long fleshy leaves arch out of its heart on all sides, as a bromeliad's do, made by rule.
#pragma once

#include "scenes/scene.hpp"

namespace frond::tools {

// With the model settings of the stage, which keeps it. Its leaves' backs are some 0.26 m high.
frond_model make_rosette(Stage& stage);

}  // namespace frond::tools
