// frond_model_write_urdf.
#include "io/write_urdf.hpp"

#include "api/call.hpp"
#include "api/handles.hpp"
#include "core/platform/files.hpp"
#include "frond/frond_robot.h"

using namespace frond;

extern "C" {

frond_result frond_model_write_urdf(frond_model model, const char* path) {
    return call([&] {
        const std::shared_ptr<const Model> found = get(model);
        check_text(path, "path");
        const std::string name = file_name(path);
        std::string error;
        if (!write_file(path, urdf_of(*found, name.substr(0, name.rfind('.'))), error))
            fail(FROND_RESULT_FILE_NOT_FOUND, "%s cannot be written: %s", path, error.c_str());
    });
}

}  // extern "C"
