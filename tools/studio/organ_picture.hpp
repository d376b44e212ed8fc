// Organ picture: what Frond found in a plant file, to look at.
#pragma once

#include "studio/canvas.hpp"

namespace frond::tools {

// Draws the first plant on a stage, as it is now: organs in colours with their names, the chain as a line through them,
// roots as red dots, a scale bar, and a list of the organs with their weights and how sure their kinds are. Throws a
// SceneError if the stage has no plant.
Canvas draw_organs(const Stage& stage, const View& view);
// Returns a round length that a scale bar of about `pixels` stands for, with its unit: "0.2 m" [m].
double scale_bar(double pixels_per_metre, double pixels, std::string& text);

}  // namespace frond::tools
