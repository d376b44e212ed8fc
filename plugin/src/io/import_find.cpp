// Finds the import program: at the path that the environment gives, beside the library or program that holds this code,
// in libexec relative to that, where it was built, where it was to be installed.
#include "core/error.hpp"
#include "core/platform/process.hpp"
#include "io/import_process.hpp"

namespace frond {

std::string find_importer() {
    const std::string wanted = environment("FROND_IMPORTER");
    if (!wanted.empty()) {
        if (is_program(wanted)) return wanted;
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the environment variable FROND_IMPORTER is \"%s\", which is not a program; set it to the path of "
             "frond-import, or "
             "unset it",
             wanted.c_str());
    }

    std::vector<std::string> candidates;
    const std::string name = std::string("frond-import") + PROGRAM_ENDING;
    for (const std::string& folder : own_folders()) {
        candidates.push_back(folder + "/" + name);
#ifdef FROND_IMPORTER_FROM_LIBRARY
        candidates.push_back(folder + "/" FROND_IMPORTER_FROM_LIBRARY "/" + name);
#endif
        candidates.push_back(folder + "/../libexec/frond/" + name);
        candidates.push_back(folder + "/../../libexec/frond/" + name);
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
