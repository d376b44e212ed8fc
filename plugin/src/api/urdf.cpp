// frond_model_write_urdf.
#include "model/write_urdf.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "api/call.hpp"
#include "api/handles.hpp"
#include "frond/frond_robot.h"

using namespace frond;

extern "C" {

frond_result frond_model_write_urdf(frond_model model, const char* path) {
    return call([&] {
        const std::shared_ptr<const Model> found = get(model);
        check_text(path, "path");
        std::string name = path;
        name = name.substr(name.rfind('/') + 1);
        const std::string text = urdf_of(*found, name.substr(0, name.rfind('.')));
        FILE* file = fopen(path, "w");
        if (!file) fail(FROND_RESULT_FILE_NOT_FOUND, "%s cannot be written: %s", path, strerror(errno));
        const bool written = fwrite(text.data(), 1, text.size(), file) == text.size();
        if (fclose(file) != 0 || !written)
            fail(FROND_RESULT_FILE_NOT_FOUND, "%s could not be written whole: is the disk full?", path);
    });
}

}  // extern "C"
