// Processes by POSIX. In: a program and its arguments. Out: what it writes, and how it ended.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "core/platform/files.hpp"
#include "core/platform/process.hpp"

extern char** environ;  // POSIX leaves it to programs, GNU declares it

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
static constexpr bool LIMITS_MEMORY = false;  // the sanitizer reserves terabytes
#else
static constexpr bool LIMITS_MEMORY = true;
#endif

namespace frond {

const char BETWEEN_PATHS = ':';
const char* const PROGRAM_ENDING = "";

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
    // Both ends are above the standard descriptors, so that a host without stdin or stdout does not mix them up.
    void open() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
        for (int i = 0; i < 2; ++i) {
            Descriptor& end = i == 0 ? reading : writing;
            end.number = ends[i];
            if (ends[i] > 2) continue;
            end.number = fcntl(ends[i], F_DUPFD_CLOEXEC, 3);
            close(ends[i]);
        }
        if (reading.number < 0 || writing.number < 0) throw std::system_error(EMFILE, std::generic_category());
    }
};

namespace {

// Appends what a pipe holds; returns false at its end.
bool drain(Descriptor& end, std::string& text) {
    char buffer[65536];
    const ssize_t count = read(end.number, buffer, sizeof buffer);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
    if (count <= 0) return false;
    text.append(buffer, size_t(count));
    return true;
}

void limit(int resource, rlim_t amount) {
    rlimit values;
    if (getrlimit(__rlimit_resource_t(resource), &values) != 0) return;
    values.rlim_cur = values.rlim_max == RLIM_INFINITY ? amount : std::min(amount, values.rlim_max);
    setrlimit(__rlimit_resource_t(resource), &values);
}

}  // namespace

struct Child::Inside {
    Pipe output, messages;
    pid_t process = -1;
};

Child::Child(const std::string& program, const std::vector<std::string>& arguments, const ProcessLimits&)
    : inside(new Inside) {
    inside->output.open();
    inside->messages.open();
    std::vector<char*> texts = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);

    // The child inherits the standard descriptors and default signals.
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, inside->output.writing.number, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, inside->messages.writing.number, STDERR_FILENO);
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
    const int error = posix_spawn(&inside->process, program.c_str(), &actions, &attributes, texts.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) throw std::system_error(error, std::generic_category());
    // Our copies of the writing ends are closed, so that we see when it is done.
    inside->output.writing.reset();
    inside->messages.writing.reset();
}

Child::~Child() {
    if (inside->process > 0) end(true);
}

bool Child::hear(double most_ms, std::string& output, std::string& errors) {
    Descriptor &out = inside->output.reading, &said = inside->messages.reading;
    if (out.number < 0) return false;
    pollfd ends[2] = {{out.number, POLLIN, 0}, {said.number, POLLIN, 0}};
    if (poll(ends, said.number >= 0 ? 2 : 1, int(std::clamp(most_ms, 0.0, 60000.0)) + 1) <= 0) return true;
    if (ends[1].revents && said.number >= 0 && !drain(said, errors)) said.reset();
    if (ends[0].revents && !drain(out, output)) out.reset();
    return out.number >= 0;
}

ChildEnd Child::end(bool stop) {
    const pid_t process = inside->process;
    inside->process = -1;
    if (stop) {
        siginfo_t info;
        info.si_pid = 0;
        // Only a child that nobody has reaped still owns its process number for certain.
        if (waitid(P_PID, id_t(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0)
            kill(process, SIGKILL);
    }
    int status = -1;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) return {};
    if (!WIFSIGNALED(status)) return {ChildEnd::EXITED, ""};
    const int signal = WTERMSIG(status);
    return {signal == SIGXCPU   ? ChildEnd::OUT_OF_CPU_TIME
            : signal == SIGALRM ? ChildEnd::OUT_OF_WALL_TIME
                                : ChildEnd::CRASHED,
            "signal " + std::to_string(signal)};
}

std::vector<std::string> own_arguments(int count, char** words) {
    return {words, words + count};
}

void limit_self(const ProcessLimits& limits) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_CORE, 0);
    if (limits.cpu_seconds > 0) limit(RLIMIT_CPU, rlim_t(limits.cpu_seconds));
    if (limits.wall_seconds > 0) alarm(unsigned(limits.wall_seconds));
    if (limits.memory_mib > 0 && LIMITS_MEMORY) limit(RLIMIT_AS, rlim_t(limits.memory_mib) << 20);
}

bool is_output_a_terminal() {
    return isatty(STDOUT_FILENO);
}

bool write_output(const std::string& bytes) {
    size_t at = 0;
    while (at < bytes.size()) {
        const ssize_t count = write(STDOUT_FILENO, bytes.data() + at, bytes.size() - at);
        if (count <= 0) return false;
        at += size_t(count);
    }
    return true;
}

void leave(int status) {
    _exit(status);
}

std::string environment(const char* name) {
    const char* value = secure_getenv(name);
    return value ? value : "";
}

bool is_program(const std::string& path) {
    return is_regular_file(path) && access(path.c_str(), X_OK) == 0;
}

std::vector<std::string> own_folders() {
    std::vector<std::string> folders;
    Dl_info info;
    const bool known = dladdr(reinterpret_cast<void*>(&own_folders), &info) != 0;
    for (const std::string& path : {std::string(known ? info.dli_fname : ""), std::string("/proc/self/exe")}) {
        const std::string real = real_path(path);
        if (!real.empty()) folders.push_back(folder_of(real));
    }
    return folders;
}

}  // namespace frond
