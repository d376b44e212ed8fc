// Turns failures of calls of frond and frond_picture into errors of the picture library, with their text.
#pragma once

#include <string>

#include "error.hpp"
#include "frond_picture.h"

namespace picture {

inline void require(frond_result result, const char* what) {
    if (result != FROND_OK) fail("%s: %s", what, frond_last_error());
}
inline void require(bool ok) {
    if (!ok) fail("%s", std::string(frond_picture_last_error()).c_str());
}

}  // namespace picture
