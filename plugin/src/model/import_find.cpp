// Finds the import program: at the path that the environment gives, beside the library or program that holds this code,
// in libexec relative to that, where it was built, where it was to be installed.
#include <dlfcn.h>
#include <limits.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"
#include "model/import_process.hpp"

namespace frond {

static bool is_program(const std::string& path) {
    struct stat status;
    return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(path.c_str(), X_OK) == 0;
}

// Returns the folder of a file, links resolved; "" if it does not exist.
static std::string folder_of(const char* path) {
    char resolved[PATH_MAX];
    if (!path || !realpath(path, resolved)) return "";
    const std::string text = resolved;
    return text.substr(0, text.rfind('/'));
}

std::string find_importer() {
    const char* wanted = secure_getenv("FROND_IMPORTER");
    if (wanted && *wanted) {
        if (is_program(wanted)) return wanted;
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the environment variable FROND_IMPORTER is \"%s\", which is not a program; set it to the path of "
             "frond-import, or "
             "unset it",
             wanted);
    }

    std::vector<std::string> candidates;
    Dl_info info;
    std::vector<std::string> folders;
    if (dladdr(reinterpret_cast<void*>(&find_importer), &info)) folders.push_back(folder_of(info.dli_fname));
    folders.push_back(folder_of("/proc/self/exe"));
    for (const std::string& folder : folders) {
        if (folder.empty()) continue;
        candidates.push_back(folder + "/frond-import");
        candidates.push_back(folder + "/../libexec/frond/frond-import");
        candidates.push_back(folder + "/../../libexec/frond/frond-import");
    }
#ifdef FROND_IMPORTER_BUILD_PATH
    candidates.push_back(FROND_IMPORTER_BUILD_PATH);
#endif
#ifdef FROND_IMPORTER_INSTALL_PATH
    candidates.push_back(FROND_IMPORTER_INSTALL_PATH);
#endif
    for (const std::string& candidate : candidates)
        if (is_program(candidate)) return candidate;
    fail(FROND_RESULT_FILE_NOT_FOUND,
         "the program frond-import, which reads mesh files, was not found%s%s; install it beside the library or in "
         "libexec/frond, or set the environment variable FROND_IMPORTER to its path",
         candidates.empty() ? "" : " (looked first for ", candidates.empty() ? "" : (candidates.front() + ")").c_str());
}

}  // namespace frond
