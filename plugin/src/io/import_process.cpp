// Runs the import program on a file. In: a path. Out: a surface or a tree of links, or an error with the file's name
// and the cause. The program has limits on time and memory, and all of its output is checked. Its exit status is a hint
// only: a host may ignore SIGCHLD or reap our child before us, so only a complete stream counts.
#include "io/import_process.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <system_error>

#include "core/log.hpp"
#include "core/platform/files.hpp"
#include "core/platform/process.hpp"
#include "core/timer.hpp"

namespace frond {

static constexpr double LARGEST_FILE = 1073741824.0;  // [byte]
static constexpr size_t STDERR_KEPT = 4096;           // of what the program says [byte]

// Replaces limits of 0 by limits chosen from the file's size.
static ImportLimits choose_limits(const ImportLimits& wanted, double file_bytes) {
    const double mib = file_bytes / 1048576;
    ImportLimits limits = wanted;
    if (limits.cpu_seconds <= 0) limits.cpu_seconds = 10 + 3 * mib;
    if (limits.wall_seconds <= 0) limits.wall_seconds = 30 + 4 * limits.cpu_seconds;
    if (limits.memory_mib <= 0) limits.memory_mib = std::min(16384.0, 2048 + 48 * mib);
    if (limits.output_mib <= 0) limits.output_mib = 2048;
    return limits;
}

static Child start_program(const std::string& program, const std::string& path, const ImportLimits& limits, UrdfUse use,
                           const std::string& corrections) {
    const ProcessLimits whole = {std::ceil(limits.cpu_seconds), std::ceil(limits.wall_seconds),
                                 std::floor(limits.memory_mib)};
    std::vector<std::string> arguments = {path};
    for (const double limit : {whole.cpu_seconds, whole.wall_seconds, whole.memory_mib})
        arguments.push_back(std::to_string(int64_t(limit)));
    arguments.push_back(use == UrdfUse::COLLIDES ? "collides" : "seen");
    arguments.push_back(corrections);
    try {
        return Child(program, arguments, whole);
    } catch (const std::system_error& error) {
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the program %s, which reads mesh files, could not be started: %s; install frond-import again or set "
             "FROND_IMPORTER",
             program.c_str(), error.code().message().c_str());
    }
}

enum class Ending { COMPLETE, LATE, TOO_MUCH, WRONG_PROGRAM };

// Returns whether the program has written all that it announced.
static bool is_whole(const std::string& stream) {
    uint64_t length;
    if (stream.size() < IMPORT_GREETING_SIZE + sizeof length) return false;
    std::memcpy(&length, stream.data() + IMPORT_GREETING_SIZE, sizeof length);
    return stream.size() - IMPORT_GREETING_SIZE - sizeof length >= 8 &&
           stream.size() - IMPORT_GREETING_SIZE - sizeof length - 8 >= length;
}

static Ending listen_to(Child& child, const ImportLimits& limits, std::string& stream, std::string& errors) {
    const Timer timer;
    for (bool goes_on = true; goes_on;) {
        // The program ends itself at its limit of wall time; the additional second is for the case that it cannot.
        const double left = 1000 * (limits.wall_seconds + 1) - timer.ms();
        if (left <= 0) return Ending::LATE;
        goes_on = child.hear(left, stream, errors);
        if (errors.size() > 2 * STDERR_KEPT) errors.erase(0, errors.size() - STDERR_KEPT);
        if (stream.compare(0, IMPORT_GREETING_SIZE, import_greeting(), 0, stream.size()) != 0)
            return Ending::WRONG_PROGRAM;
        if (double(stream.size()) > limits.output_mib * 1048576) return Ending::TOO_MUCH;
        // Does not wait for the pipe to close: a host that forks at this moment holds a copy of its writing end.
        if (is_whole(stream)) return Ending::COMPLETE;
    }
    return Ending::COMPLETE;
}

// Returns the last line that the program wrote to stderr.
static std::string last_line(std::string text) {
    while (!text.empty() && uint8_t(text.back()) <= 32) text.pop_back();
    text = text.substr(text.rfind('\n') + 1).substr(0, 300);
    for (char& letter : text)
        if (uint8_t(letter) < 32) letter = ' ';
    return text;
}

[[noreturn]] static void fail_incomplete(const std::string& name, const std::string& program,
                                         const ImportLimits& limits, Ending ending, bool greeted, const ChildEnd& end,
                                         const std::string& errors) {
    if (ending == Ending::TOO_MUCH)
        fail(FROND_RESULT_FILE_FORMAT, "%s: the file becomes more than %.0f MiB of geometry; simplify it", name.c_str(),
             limits.output_mib);
    const bool used_up = end.how == ChildEnd::OUT_OF_CPU_TIME;
    if (ending == Ending::LATE || used_up || end.how == ChildEnd::OUT_OF_WALL_TIME)
        fail(FROND_RESULT_FILE_FORMAT,
             "%s: the reader did not finish within %.0f s: the file is damaged or far too large", name.c_str(),
             used_up ? limits.cpu_seconds : limits.wall_seconds);
    if (!greeted) {
        const std::string said = last_line(errors);
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the program %s, which reads mesh files, does not work or is of another version%s%s; install frond-import "
             "again or set FROND_IMPORTER",
             program.c_str(), said.empty() ? "" : ": ", said.c_str());
    }
    fail(FROND_RESULT_FILE_FORMAT, "%s: the reader crashed%s%s: the file is damaged", name.c_str(),
         end.how == ChildEnd::CRASHED ? " with " : "", end.how == ChildEnd::CRASHED ? end.words.c_str() : "");
}

static ImportResult run_program(const std::string& path, const ImportLimits& wanted, UrdfUse use,
                                const std::string& corrections) {
    // Checks what can be checked without the program.
    const std::string name = file_name(path);
    if (path.empty() || path.find('\0') != std::string::npos)
        fail(FROND_RESULT_FILE_NOT_FOUND, "the path is empty or has a zero byte; give the path of a mesh file");
    const FileStatus status = status_of(path);
    if (!status.exists) fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), status.error.c_str());
    if (status.is_folder) fail(FROND_RESULT_FILE_NOT_FOUND, "%s is a directory; give a file in it", path.c_str());
    if (!status.is_regular) fail(FROND_RESULT_FILE_NOT_FOUND, "%s is not a regular file", path.c_str());
    std::string bytes, unread;
    if (!read_file(path, 0, bytes, unread)) fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), unread.c_str());
    if (status.size == 0) fail(FROND_RESULT_FILE_FORMAT, "%s: the file is empty", name.c_str());
    if (double(status.size) > LARGEST_FILE)
        fail(FROND_RESULT_FILE_FORMAT, "%s: the file has %.1f GiB; at most 1 GiB is read", name.c_str(),
             double(status.size) / LARGEST_FILE);
    const ImportLimits limits = choose_limits(wanted, double(status.size));
    const std::string program = find_importer();

    Child child = start_program(program, path, limits, use, corrections);
    std::string stream, errors;
    const Ending ending = listen_to(child, limits, stream, errors);
    const ChildEnd end = child.end(ending != Ending::COMPLETE);

    // Only a complete and consistent stream counts.
    const bool greeted = stream.compare(0, IMPORT_GREETING_SIZE, import_greeting()) == 0;
    ImportResult result;
    if (!greeted || ending != Ending::COMPLETE ||
        !decode_import(stream.data() + IMPORT_GREETING_SIZE, stream.size() - IMPORT_GREETING_SIZE, result))
        fail_incomplete(name, program, limits, ending, greeted, end, errors);
    for (const std::string& warning : result.warnings) warn("%s: %s", name.c_str(), warning.c_str());
    if (result.code != FROND_OK) fail(result.code, "%s: %s", name.c_str(), result.error.c_str());
    return result;
}

Surface run_importer(const std::string& path, const ImportLimits& limits) {
    return run_program(path, limits, UrdfUse::SEEN, "").surface;
}

// Returns the path of the file with corrections, "" for none.
static std::string find_corrections(const std::string& path, const std::string& wanted) {
    if (wanted != "beside") return wanted;
    const size_t dot = path.rfind('.'), name = path.size() - file_name(path).size();
    const std::string beside = (dot == std::string::npos || dot < name ? path : path.substr(0, dot)) + ".frond.json";
    return status_of(beside).exists ? beside : "";
}

Surface import_surface(const std::string& path, const ImportOptions& options, Corrections* corrections) {
    ImportResult result = run_program(path, ImportLimits(), UrdfUse::SEEN, find_corrections(path, options.corrections));
    Surface surface = std::move(result.surface);
    try {
        ImportOptions named = options;
        if (named.scale == 0) named.scale = result.corrections.unit;
        if (named.up.isZero(0)) named.up = result.corrections.up;
        if (corrections) *corrections = std::move(result.corrections);
        named.name = file_name(path);
        place_surface(surface, named);
    } catch (const Error& error) {
        throw Error(error.code, file_name(path) + ": " + error.what());
    }
    return surface;
}

bool is_urdf(const std::string& path) {
    return has_ending(path, ".urdf");
}

UrdfTree import_urdf(const std::string& path, UrdfUse use) {
    if (!is_urdf(path))
        fail(FROND_RESULT_FILE_FORMAT, "%s: the name does not end in .urdf; give the path of a URDF file",
             file_name(path).c_str());
    return run_program(path, ImportLimits(), use, "").tree;
}

}  // namespace frond
