// The plants of the study, from files that come with Frond.
#pragma once

#include "study/trial.hpp"

namespace frond::study {

struct PlantCase {
    const char* name;
    const char* file;
    std::vector<std::string> materials;  // assignments as for frond run --set
};
extern const PlantCase CORN, CUCUMBER;

ModelPtr load_plant(const PlantCase& plant, frond_model_def def);
// Returns the plant with as many cells or capsules as the setup asks for; the session keeps it.
ModelPtr plant_model(const PlantCase& plant, const Setup& setup, frond_rest rest, Session& session);

}  // namespace frond::study
