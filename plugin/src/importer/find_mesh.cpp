// Finds the mesh files that a URDF file names.
#include "core/platform/files.hpp"
#include "core/platform/process.hpp"
#include "importer/urdf.hpp"

namespace frond {

static constexpr int MOST_ABOVE = 8;  // folders searched for packages, from the file's own upwards

static bool starts_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

// Returns the folders searched for packages, in order.
static std::vector<std::string> package_folders(const std::string& folder) {
    std::vector<std::string> folders;
    for (const char* variable : {"FROND_PACKAGE_PATH", "ROS_PACKAGE_PATH"}) {
        std::string rest = environment(variable);
        while (!rest.empty()) {
            const size_t colon = rest.find(BETWEEN_PATHS);
            if (colon != 0) folders.push_back(rest.substr(0, colon));
            rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
        }
    }
    std::string above = folder;
    for (int i = 0; i < MOST_ABOVE; ++i, above += "/..") folders.push_back(above);
    return folders;
}

static std::string find_in_package(const std::string& folder, const std::string& package, const std::string& path) {
    for (const std::string& above : package_folders(folder)) {
        if (is_regular_file(above + "/" + package + "/" + path)) return above + "/" + package + "/" + path;
        // The folder may itself be the package, under any name.
        if (is_regular_file(above + "/package.xml") && is_regular_file(above + "/" + path)) return above + "/" + path;
    }
    fail(
        FROND_RESULT_FILE_NOT_FOUND,
        "the mesh package://%.64s/%.256s was not found; set FROND_PACKAGE_PATH to the folder in which the folder %.64s "
        "lies",
        package.c_str(), path.c_str(), package.c_str());
}

std::string find_mesh(const std::string& folder, const std::string& reference) {
    for (const std::string& scheme : {std::string("package://"), std::string("model://")}) {
        if (!starts_with(reference, scheme)) continue;
        const std::string rest = reference.substr(scheme.size());
        const size_t slash = rest.find('/');
        if (slash == std::string::npos || slash == 0)
            fail(FROND_RESULT_FILE_FORMAT, "the mesh %.256s names no file in a package; write %sNAME/PATH",
                 reference.c_str(), scheme.c_str());
        return find_in_package(folder, rest.substr(0, slash), rest.substr(slash + 1));
    }
    const std::string path = starts_with(reference, "file://") ? reference.substr(7) : reference;
    const std::string found = is_absolute(path) ? path : folder + "/" + path;
    if (!is_regular_file(found))
        fail(FROND_RESULT_FILE_NOT_FOUND, "the mesh %.256s was not found; paths are taken from the URDF file's folder",
             reference.c_str());
    return found;
}

}  // namespace frond
