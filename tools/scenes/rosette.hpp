// Rosette: a herb whose long fleshy leaves arch out of its centre on all sides, as a bromeliad's do, made by rule.
#pragma once

#include "scenes/scene.hpp"

namespace frond::tools {

// Makes the model with the stage's model settings; the stage keeps it. The backs of its leaves are some 0.26 m high.
frond_model make_rosette(Stage& stage);

}  // namespace frond::tools
