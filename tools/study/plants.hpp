// The plants of the study, from the files that come with Frond.
#pragma once

#include "study/trial.hpp"

namespace frond::study {

struct PlantCase {
    const char* name;
    const char* file;
    std::vector<std::string> materials;  // assignments of frond run --set
};
extern const PlantCase CORN, CUCUMBER;

ModelPtr load_plant(const PlantCase& plant, frond_model_def def);

}  // namespace frond::study
