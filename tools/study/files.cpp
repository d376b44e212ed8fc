// Folders, files and gnuplot.
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "study/report.hpp"

namespace frond::study {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line))
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

void write_file(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file)
        throw SceneError(path + " cannot be written (" + std::strerror(errno) +
                         "); give a folder that you may write to with --out");
}

void prepare_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw SceneError("the folder " + folder + " cannot be made (" + error.message() +
                         "); give another one with --out");
    // Fail before anything is measured rather than after.
    const std::string probe = folder + "/.frond_study";
    write_file(probe, "");
    std::filesystem::remove(probe, error);
}

// Returns a path quoted as one word for the shell.
static std::string shell_word(const std::string& path) {
    std::string word = "'";
    for (char c : path) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

void require_gnuplot() {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0)
        throw SceneError(
            "gnuplot draws the diagrams and is not there; install it (Debian: apt-get install gnuplot-nox)");
}

void prepare_diagrams(const std::string& folder) {
    if (folder.empty()) return;
    require_gnuplot();
    prepare_folder(folder);
}

void run_gnuplot(const std::string& script_path) {
    const int status = std::system(("gnuplot " + shell_word(script_path)).c_str());
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw SceneError("gnuplot could not draw " + script_path + "; its own message stands above");
}

}  // namespace frond::study
