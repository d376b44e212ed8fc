// Runs the import program on a file. In: a path. Out: a surface or a tree of links, or an error with the file's name
// and the cause. The program has limits on time and memory, and all of its output is checked. Its exit status is a hint
// only: a host may ignore SIGCHLD or reap our child before us, so only a complete stream counts.
#include "model/import_process.hpp"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "core/log.hpp"
#include "core/timer.hpp"

extern char** environ;

namespace frond {

static constexpr double LARGEST_FILE = 1073741824.0;  // [byte]
static constexpr size_t STDERR_KEPT = 4096;

// A descriptor that closes itself.
struct Descriptor {
    int number = -1;
    Descriptor() = default;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { reset(); }
    void reset() {
        if (number >= 0) close(number);
        number = -1;
    }
};

struct Pipe {
    Descriptor reading, writing;
};

// Opens a pipe with both ends above the standard descriptors, so that a host without stdin or stdout does not mix them
// up.
static void open_pipe(Pipe& pipe) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(FROND_RESULT_INTERNAL, "no pipe could be opened: %s", strerror(errno));
    for (int i = 0; i < 2; ++i) {
        Descriptor& end = i == 0 ? pipe.reading : pipe.writing;
        end.number = ends[i];
        if (ends[i] > 2) continue;
        end.number = fcntl(ends[i], F_DUPFD_CLOEXEC, 3);
        close(ends[i]);
    }
    if (pipe.reading.number < 0 || pipe.writing.number < 0) fail(FROND_RESULT_INTERNAL, "no pipe could be opened");
}

static std::string file_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

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

static pid_t start_program(const std::string& program, const std::string& path, const ImportLimits& limits, UrdfUse use,
                           Pipe& output, Pipe& messages) {
    const std::string cpu = std::to_string(int(limits.cpu_seconds + 0.999));
    const std::string wall = std::to_string(int(limits.wall_seconds + 0.999));
    const std::string memory = std::to_string(int64_t(limits.memory_mib));
    const char* what = use == UrdfUse::COLLIDES ? "collides" : nullptr;
    const char* arguments[] = {program.c_str(), path.c_str(), cpu.c_str(), wall.c_str(), memory.c_str(), what, nullptr};

    // The child inherits the standard descriptors and default signals, nothing else of the host's.
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, output.writing.number, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages.writing.number, STDERR_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
#if defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 34)
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);
#endif
#endif
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    pid_t process = -1;
    const int error =
        posix_spawn(&process, program.c_str(), &actions, &attributes, const_cast<char**>(arguments), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0)
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the program %s, which reads mesh files, could not be started: %s; install frond-import again or set "
             "FROND_IMPORTER",
             program.c_str(), strerror(error));
    return process;
}

enum class Ending { COMPLETE, LATE, TOO_MUCH, WRONG_PROGRAM };

// Appends what a pipe holds; returns false at its end.
static bool drain(Descriptor& end, std::string& text, std::vector<char>& buffer) {
    const ssize_t count = read(end.number, buffer.data(), buffer.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
    if (count <= 0) return false;
    text.append(buffer.data(), size_t(count));
    return true;
}

// Returns whether the program has written all that it announced.
static bool is_whole(const std::string& stream) {
    uint64_t length;
    if (stream.size() < IMPORT_GREETING_SIZE + sizeof length) return false;
    memcpy(&length, stream.data() + IMPORT_GREETING_SIZE, sizeof length);
    return stream.size() - IMPORT_GREETING_SIZE - sizeof length >= 8 &&
           stream.size() - IMPORT_GREETING_SIZE - sizeof length - 8 >= length;
}

static Ending listen_to(Pipe& output, Pipe& messages, const ImportLimits& limits, std::string& stream,
                        std::string& errors) {
    const Timer timer;
    std::vector<char> buffer(65536);
    while (output.reading.number >= 0) {
        // The program ends itself at its limit of wall time; the additional second is for the case that it cannot.
        const double left = 1000 * (limits.wall_seconds + 1) - timer.ms();
        if (left <= 0) return Ending::LATE;
        pollfd ends[2] = {{output.reading.number, POLLIN, 0}, {messages.reading.number, POLLIN, 0}};
        const int ready = poll(ends, messages.reading.number >= 0 ? 2 : 1, int(std::min(left, 60000.0)) + 1);
        if (ready <= 0) continue;
        if (ends[1].revents && messages.reading.number >= 0) {
            if (!drain(messages.reading, errors, buffer)) messages.reading.reset();
            if (errors.size() > 2 * STDERR_KEPT) errors.erase(0, errors.size() - STDERR_KEPT);
        }
        if (ends[0].revents && !drain(output.reading, stream, buffer)) output.reading.reset();
        if (stream.compare(0, IMPORT_GREETING_SIZE, import_greeting(), 0, stream.size()) != 0)
            return Ending::WRONG_PROGRAM;
        if (double(stream.size()) > limits.output_mib * 1048576) return Ending::TOO_MUCH;
        // Does not wait for the pipe to close: a host that forks at this moment holds a copy of its writing end.
        if (is_whole(stream)) return Ending::COMPLETE;
    }
    return Ending::COMPLETE;
}

// Ends the program if it still runs and leaves no zombie. Returns its wait status, or -1 if another part reaped it.
static int end_program(pid_t process, bool stop) {
    if (stop) {
        siginfo_t info;
        info.si_pid = 0;
        // Only a child that nobody has reaped still owns its process number for certain.
        if (waitid(P_PID, id_t(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0)
            kill(process, SIGKILL);
    }
    int status = -1;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) return -1;
    return status;
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
                                         const ImportLimits& limits, Ending ending, bool greeted, int status,
                                         const std::string& errors) {
    if (ending == Ending::TOO_MUCH)
        fail(FROND_RESULT_FILE_FORMAT, "%s: the file becomes more than %.0f MiB of geometry; simplify it", name.c_str(),
             limits.output_mib);
    const bool signalled = status >= 0 && WIFSIGNALED(status);
    const int signal = signalled ? WTERMSIG(status) : 0;
    if (ending == Ending::LATE || signal == SIGXCPU || signal == SIGALRM)
        fail(FROND_RESULT_FILE_FORMAT,
             "%s: the reader did not finish within %.0f s: the file is damaged or far too large", name.c_str(),
             signal == SIGXCPU ? limits.cpu_seconds : limits.wall_seconds);
    if (!greeted) {
        const std::string said = last_line(errors);
        fail(FROND_RESULT_FILE_NOT_FOUND,
             "the program %s, which reads mesh files, does not work or is of another version%s%s; install frond-import "
             "again or set FROND_IMPORTER",
             program.c_str(), said.empty() ? "" : ": ", said.c_str());
    }
    fail(FROND_RESULT_FILE_FORMAT, "%s: the reader crashed%s%s: the file is damaged", name.c_str(),
         signalled ? " with signal " : "", signalled ? std::to_string(signal).c_str() : "");
}

static ImportResult run_program(const std::string& path, const ImportLimits& wanted, UrdfUse use) {
    // Checks what can be checked without the program.
    const std::string name = file_name(path);
    struct stat status;
    if (path.empty() || path.find('\0') != std::string::npos)
        fail(FROND_RESULT_FILE_NOT_FOUND, "the path is empty or has a zero byte; give the path of a mesh file");
    if (stat(path.c_str(), &status) != 0) fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), strerror(errno));
    if (S_ISDIR(status.st_mode))
        fail(FROND_RESULT_FILE_NOT_FOUND, "%s is a directory; give a file in it", path.c_str());
    if (!S_ISREG(status.st_mode)) fail(FROND_RESULT_FILE_NOT_FOUND, "%s is not a regular file", path.c_str());
    if (access(path.c_str(), R_OK) != 0) fail(FROND_RESULT_FILE_NOT_FOUND, "%s: %s", path.c_str(), strerror(errno));
    if (status.st_size == 0) fail(FROND_RESULT_FILE_FORMAT, "%s: the file is empty", name.c_str());
    if (double(status.st_size) > LARGEST_FILE)
        fail(FROND_RESULT_FILE_FORMAT, "%s: the file has %.1f GiB; at most 1 GiB is read", name.c_str(),
             double(status.st_size) / LARGEST_FILE);
    const ImportLimits limits = choose_limits(wanted, double(status.st_size));
    const std::string program = find_importer();

    // The program writes to the pipes; our copies of their writing ends are closed, so that we see when it is done.
    Pipe output, messages;
    open_pipe(output);
    open_pipe(messages);
    const pid_t process = start_program(program, path, limits, use, output, messages);
    output.writing.reset();
    messages.writing.reset();
    std::string stream, errors;
    Ending ending = Ending::LATE;
    try {
        ending = listen_to(output, messages, limits, stream, errors);
    } catch (...) {
        end_program(process, true);
        throw;
    }
    const int exit_status = end_program(process, ending != Ending::COMPLETE);

    // Only a complete and consistent stream counts.
    const bool greeted = stream.compare(0, IMPORT_GREETING_SIZE, import_greeting()) == 0;
    ImportResult result;
    if (!greeted || ending != Ending::COMPLETE ||
        !decode_import(stream.data() + IMPORT_GREETING_SIZE, stream.size() - IMPORT_GREETING_SIZE, result))
        fail_incomplete(name, program, limits, ending, greeted, exit_status, errors);
    for (const std::string& warning : result.warnings) warn("%s: %s", name.c_str(), warning.c_str());
    if (result.code != FROND_OK) fail(result.code, "%s: %s", name.c_str(), result.error.c_str());
    return result;
}

Surface run_importer(const std::string& path, const ImportLimits& limits) {
    return run_program(path, limits, UrdfUse::SEEN).surface;
}

Surface import_surface(const std::string& path, const ImportOptions& options) {
    Surface surface = run_importer(path, ImportLimits());
    try {
        ImportOptions named = options;
        named.name = file_name(path);
        place_surface(surface, named);
    } catch (const Error& error) {
        throw Error(error.code, file_name(path) + ": " + error.what());
    }
    return surface;
}

bool is_urdf(const std::string& path) {
    const size_t dot = path.rfind('.');
    return dot != std::string::npos && strcasecmp(path.c_str() + dot, ".urdf") == 0;
}

UrdfTree import_urdf(const std::string& path, UrdfUse use) {
    if (!is_urdf(path))
        fail(FROND_RESULT_FILE_FORMAT, "%s: the name does not end in .urdf; give the path of a URDF file",
             file_name(path).c_str());
    return run_program(path, ImportLimits(), use).tree;
}

}  // namespace frond
